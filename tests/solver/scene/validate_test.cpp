#include "solver/scene/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seapile::scene {
namespace {

SceneSpec with_pile(pile::PileSpec pile = {}) {
  SceneSpec scene;
  scene.pile = pile;
  return scene;
}

std::string pointers(const base::Problems& problems) {
  std::string text;
  for (const auto& problem : problems) text += problem.pointer + " ";
  return text;
}

TEST(ValidateScene, ThesisSceneCanBeBuilt) {
  EXPECT_EQ(pointers(validate(SceneSpec{})), "");
  EXPECT_EQ(pointers(validate(with_pile())), "");
  EXPECT_EQ(pointers(validate(with_pile({.tip = pile::FlatTip{}}))), "");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::VibratoryDriving{}}))), "");
}

TEST(ValidateScene, RadiiAreOrderedAndNotTooFarApart) {
  SceneSpec scene;
  scene.bed.grains.radius = {0.02, 0.02};
  EXPECT_EQ(pointers(validate(scene)), "") << "equal radii are a bed too";
  scene.bed.grains.radius = {0.0200001, 0.02};
  EXPECT_EQ(pointers(validate(scene)), "/bed/grains/radius/min ");
  scene.bed.grains.radius = {0.0002, 0.02};
  EXPECT_EQ(pointers(validate(scene)), "") << "a ratio of 100";
  scene.bed.grains.radius = {0.000199, 0.02};
  EXPECT_EQ(pointers(validate(scene)), "/bed/grains/radius/max ");
}

// With equal radii the area of the grains is known exactly.
TEST(ValidateScene, GrainsFitUpToThreeQuartersOfTheBox) {
  SceneSpec scene;
  const double radius = 0.02;
  scene.bed.grains.radius = {radius, radius};
  const double most = 0.75 * 20 / (std::numbers::pi * radius * radius);
  scene.bed.grains.count = static_cast<std::int64_t>(std::floor(most));
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.bed.grains.count += 1;
  EXPECT_EQ(pointers(validate(scene)), "/bed/grains/count ");
}

TEST(ValidateScene, TwoLargestGrainsPassThePileOnEachSide) {
  SceneSpec scene = with_pile();
  const double widest = (scene.bed.domain.width - 8 * scene.bed.grains.radius.max) / 2;
  scene.pile->tip = pile::FlatTip{};
  scene.pile->radius = widest * (1 - 1e-12);
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.pile->radius = widest;
  EXPECT_EQ(pointers(validate(scene)), "/pile/radius ");
}

TEST(ValidateScene, TheTipIsNotLongerThanTheBoxIsHigh) {
  SceneSpec scene = with_pile();
  scene.pile->radius = 0.5;
  scene.pile->tip = pile::ConicalTip{2 * std::atan(0.5 / 4) * 1.001};
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.pile->tip = pile::ConicalTip{2 * std::atan(0.5 / 4) * 0.999};
  EXPECT_EQ(pointers(validate(scene)), "/pile/tip/conical/apex_angle ");
}

TEST(ValidateScene, ThePileStaysInTheBed) {
  SceneSpec scene = with_pile();
  scene.pile->depth = 2.1;
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.pile->depth = 2.2;
  EXPECT_EQ(pointers(validate(scene)), "/pile/depth ");
  EXPECT_EQ(pointers(validate(scene, 2.3)), "") << "a known height counts, not the estimate";
  scene.bed.preparation.solid_fraction = 0.76;
  EXPECT_EQ(pointers(validate(scene)), "") << "a looser bed is higher";
}

TEST(ValidateScene, AHeightThatNobodyKnowsIsNotJudged) {
  SceneSpec scene = with_pile({.depth = 3});
  scene.bed.file_content = "a file's";
  EXPECT_EQ(pointers(validate(scene)), "");
  EXPECT_EQ(pointers(validate(scene, 1.0)), "/pile/depth ");
}

TEST(ValidateScene, ARunByTimeDoesNotGoThroughTheBaseEither) {
  SceneSpec scene = with_pile({.depth = {}, .duration = 30.0});
  EXPECT_EQ(pointers(validate(scene)), "") << "1.8 m";
  scene.pile->duration = 40;
  EXPECT_EQ(pointers(validate(scene)), "/pile/duration ") << "2.4 m";
  scene.pile->depth = 1;
  EXPECT_EQ(pointers(validate(scene)), "") << "the depth ends it before";
}

TEST(ValidateScene, ARunHasAnEnd) {
  EXPECT_EQ(pointers(validate(with_pile({.depth = {}, .duration = {}}))), "/pile/depth ");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::ConstantDriving{0}}))), "/pile/driving/constant/speed ");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::ConstantDriving{-0.1}}))), "/pile/driving/constant/speed ");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::VibratoryDriving{0, 1e-3, 20}}))),
            "/pile/driving/vibratory/speed ");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::ConstantDriving{0}, .duration = 1.0}))), "")
      << "a pile at rest for a second";
}

TEST(ValidateScene, ASineReachesItsStrokeAndNoMore) {
  // Stroke V / (pi f) = 2 m; 4 of the largest radii are granted to the start above the grains.
  const pile::SinusoidalDriving sine{0.2, 0.1 / std::numbers::pi};
  EXPECT_EQ(pointers(validate(with_pile({.driving = sine, .depth = 1.92}))), "");
  EXPECT_EQ(pointers(validate(with_pile({.driving = sine, .depth = 1.93}))), "/pile/depth ");
  EXPECT_EQ(pointers(validate(with_pile({.driving = sine, .depth = 1.93, .duration = 60.0}))), "");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::SinusoidalDriving{-0.2, 0.1}, .depth = 0.1}))),
            "/pile/depth ")
      << "up first, and never below the start";
}

TEST(ValidateScene, ABillionStepsAreTheMost) {
  SceneSpec scene = with_pile();
  scene.contact.step = 2.01e-8;
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.contact.step = 1.99e-8;
  EXPECT_EQ(pointers(validate(scene)), "/pile/driving/constant/speed ") << "20 s in steps of 19.9 ns";
  scene.pile->duration = 1;
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.bed.preparation.contact.step = 1e-8;
  EXPECT_EQ(pointers(validate(scene)), "/bed/preparation/contact/step ") << "12 s in steps of 10 ns";
}

TEST(ValidateScene, ThePileDoesNotJumpOverAGrain) {
  SceneSpec scene = with_pile({.driving = pile::ConstantDriving{10}});
  scene.contact.step = 1.11e-3;
  EXPECT_EQ(pointers(validate(scene)), "");
  scene.contact.step = 1.13e-3;
  EXPECT_EQ(pointers(validate(scene)), "/contact/step ");
}

TEST(ValidateScene, APeriodHasTenSteps) {
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::VibratoryDriving{0.06, 1e-4, 200}}))), "");
  EXPECT_EQ(pointers(validate(with_pile({.driving = pile::VibratoryDriving{0.06, 1e-4, 201}}))),
            "/pile/driving/vibratory/frequency ");
}

TEST(ValidateScene, IndependentProblemsComeTogether) {
  SceneSpec scene = with_pile({.radius = 3, .depth = 5});
  scene.bed.grains.count = 50'000;
  EXPECT_EQ(pointers(validate(scene)), "/bed/grains/count /pile/radius ");
  scene.bed.grains.count = 5'000;
  EXPECT_EQ(pointers(validate(scene)), "/pile/radius /pile/depth ");
}

TEST(ValidateRecord, FramesAreWhereThePileComes) {
  const SceneSpec scene = with_pile();
  EXPECT_EQ(pointers(validate(RecordSpec{}, scene)), "");
  EXPECT_EQ(pointers(validate(RecordSpec{.frames = {1.3, -0.1, 0.4, 0.2, 2}}, scene)), "/frames/0 /frames/4 ");
  EXPECT_EQ(pointers(validate(RecordSpec{.frames = {0.3, 0.4}}, with_pile({.duration = 6.0}))), "/frames/1 ")
      << "0.36 m in 6 s";
}

TEST(ValidateRecord, FramesAreDifferentAndNotTooMany) {
  EXPECT_EQ(pointers(validate(RecordSpec{.frames = {0.2, 0.4, 0.2}}, with_pile())), "/frames/2 ");
  EXPECT_EQ(pointers(validate(RecordSpec{.frames = std::vector<double>(10'001)}, with_pile())), "/frames ");
}

TEST(ValidateRecord, AMillionRecordsAreTheMost) {
  EXPECT_EQ(pointers(validate(RecordSpec{.travel = 1.21e-6}, with_pile())), "");
  EXPECT_EQ(pointers(validate(RecordSpec{.travel = 1.19e-6}, with_pile())), "/travel ");
  const SceneSpec shaken = with_pile({.driving = pile::VibratoryDriving{0.06, 0.01, 20}});
  EXPECT_EQ(pointers(validate(RecordSpec{.travel = 1.73e-5}, shaken)), "") << "1.2 m down and 16 m up and down";
  EXPECT_EQ(pointers(validate(RecordSpec{.travel = 1.71e-5}, shaken)), "/travel ");
}

TEST(ValidateRecord, TheGridHasNotTooManyCells) {
  EXPECT_EQ(pointers(validate(RecordSpec{.spacing = 1.42e-3}, with_pile())), "");
  EXPECT_EQ(pointers(validate(RecordSpec{.spacing = 1.41e-3}, with_pile())), "/spacing ");
  EXPECT_EQ(pointers(validate(RecordSpec{.spacing = 4.1}, with_pile())), "/spacing ");
}

TEST(ValidateRecord, OfABedAloneNothingIsRecordedAlongAPile) {
  EXPECT_EQ(pointers(validate(RecordSpec{.frames = {99}}, SceneSpec{})), "");
}

}  // namespace
}  // namespace seapile::scene
