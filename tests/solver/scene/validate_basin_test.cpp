// The bounds of a basin, each from both sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/scene/validate.h"

namespace seapile::scene {
namespace {

std::string pointers(const basin::BasinSpec& basin) {
  SceneSpec scene;
  scene.basin = basin;
  std::string text;
  for (const auto& problem : validate(scene)) text += problem.pointer + " ";
  return text;
}

/// The thesis' basin: ch. 4.3.
basin::BasinSpec with_pile() {
  basin::BasinSpec basin;
  basin.width = 5;
  basin.depth = 2.5;
  basin.pile.emplace();
  basin.mesh = {basin::UnstructuredMesh{}, basin::ZonesMotion{}, basin::RemeshSpec{}};
  basin.time.duration = 10;
  return basin;
}

TEST(ValidateBasin, TheBasinsOfTheThesisCanBeBuilt) {
  EXPECT_EQ(pointers({}), "");
  EXPECT_EQ(pointers(with_pile()), "");
  basin::BasinSpec fixed;
  fixed.surface.reset();
  EXPECT_EQ(pointers(fixed), "");
  basin::BasinSpec hump;
  hump.surface->initial = basin::HumpSurface{};
  EXPECT_EQ(pointers(hump), "");
}

TEST(ValidateBasin, WhatIsWrittenOfABedBesideItIsNotJudged) {
  SceneSpec scene;
  scene.basin.emplace();
  scene.bed.grains.count = 10'000'000;
  EXPECT_TRUE(validate(scene).empty());
}

TEST(ValidateBasin, TheShoulderStaysAThousandthOfTheDepthUnderTheRestLevel) {
  basin::BasinSpec basin = with_pile();
  basin.pile->driving = pile::SinusoidalDriving{-0.2, 0.1};  // up first
  const double up = 0.2 / (std::numbers::pi * 0.1);
  const double shoulder = 0.125 / std::tan(std::numbers::pi / 6);
  basin.pile->start = shoulder + up + 1e-3 * 2.5 + 1e-9;
  EXPECT_EQ(pointers(basin), "");
  basin.pile->start -= 2e-9;
  EXPECT_EQ(pointers(basin), "/basin/pile/start ");
  basin.pile->tip = pile::FlatTip{};
  EXPECT_EQ(pointers(basin), "") << "a flat tip is its own shoulder";
}

TEST(ValidateBasin, TheTipStaysAHundredthOfTheDepthAboveTheBottom) {
  basin::BasinSpec basin = with_pile();
  const double down = 0.2 / (std::numbers::pi * 0.1);
  basin.pile->start = 0.99 * 2.5 - down - 1e-9;
  EXPECT_EQ(pointers(basin), "");
  basin.pile->start += 2e-9;
  EXPECT_EQ(pointers(basin), "/basin/pile/start ");
  basin.time.duration = 1;
  EXPECT_EQ(pointers(basin), "") << "it goes on only while the run does";
}

TEST(ValidateBasin, ASineAndAVibrationRiseNoHigherThanTheyStart) {
  basin::BasinSpec basin = with_pile();
  basin.pile->start = 0.125 / std::tan(std::numbers::pi / 6) + 2.6e-3;
  for (const pile::Driving& driving :
       {pile::Driving{pile::SinusoidalDriving{}}, pile::Driving{pile::VibratoryDriving{}}}) {
    basin.pile->driving = driving;
    EXPECT_EQ(pointers(basin), "");
  }
  basin.pile->driving = pile::VibratoryDriving{-0.01, 1e-3, 20};
  EXPECT_EQ(pointers(basin), "/basin/pile/start ");
}

TEST(ValidateBasin, ThePileIsNarrowerThanTheBasin) {
  basin::BasinSpec basin = with_pile();
  basin.pile->tip = pile::FlatTip{};
  basin.pile->radius = 2.5 * (1 - 1e-12);
  EXPECT_EQ(pointers(basin), "");
  basin.pile->radius = 2.5;
  EXPECT_EQ(pointers(basin), "/basin/pile/radius ");
}

TEST(ValidateBasin, TheSurfaceStartsAboveTheBottom) {
  basin::BasinSpec basin;
  basin.surface->initial = basin::CosineSurface{0.25 * (1 - 1e-12), 1};
  EXPECT_EQ(pointers(basin), "");
  basin.surface->initial = basin::CosineSurface{-0.25, 1};
  EXPECT_EQ(pointers(basin), "/basin/surface/initial/cosine/amplitude ");
  // sin(s)/s falls to -0.217234 where tan(s) = s, unless the walls are nearer.
  basin.surface->initial = basin::HumpSurface{0.25 / 0.217233 * (1 - 1e-5), 1.0 / 30};
  EXPECT_EQ(pointers(basin), "");
  basin.surface->initial = basin::HumpSurface{0.25 / 0.217233 * (1 + 1e-5), 1.0 / 30};
  EXPECT_EQ(pointers(basin), "/basin/surface/initial/hump/amplitude ");
  basin.surface->initial = basin::HumpSurface{10, 1};
  EXPECT_EQ(pointers(basin), "") << "the walls cut the hump where it is high";
}

TEST(ValidateBasin, TheSurfaceStartsAboveThePilesShoulder) {
  basin::BasinSpec basin = with_pile();
  const double cover = 0.5 - 0.125 / std::tan(std::numbers::pi / 6);
  basin.surface->initial = basin::CosineSurface{cover * (1 - 1e-9), 1};
  EXPECT_EQ(pointers(basin), "");
  basin.surface->initial = basin::CosineSurface{cover * (1 + 1e-9), 1};
  EXPECT_EQ(pointers(basin), "/basin/surface/initial/cosine/amplitude ");
}

TEST(ValidateBasin, AHalfWaveHasFourColumnsOfTheMesh) {
  basin::BasinSpec basin;
  basin.surface->initial = basin::CosineSurface{1e-3, 48};
  EXPECT_EQ(pointers(basin), "");
  basin.surface->initial = basin::CosineSurface{1e-3, 49};
  EXPECT_EQ(pointers(basin), "/basin/surface/initial/cosine/mode ");
  basin.mesh.pattern = basin::UnstructuredMesh{1.0 / 196, 1.0 / 196, 0.15};
  EXPECT_EQ(pointers(basin), "");
}

TEST(ValidateBasin, AVibrationHasTenStepsPerPeriod) {
  basin::BasinSpec basin = with_pile();
  basin.time.step = 5e-3;
  basin.pile->driving = pile::VibratoryDriving{0, 1e-3, 20};
  EXPECT_EQ(pointers(basin), "");
  basin.pile->driving = pile::VibratoryDriving{0, 1e-3, 20.01};
  EXPECT_EQ(pointers(basin), "/basin/pile/driving/vibratory/frequency ");
}

TEST(ValidateBasin, ABillionStepsAreTheMost) {
  basin::BasinSpec basin;
  basin.time = {.step = 1e-3, .duration = 1e6};
  EXPECT_EQ(pointers(basin), "");
  basin.time.step = 0.999e-3;
  EXPECT_EQ(pointers(basin), "/basin/time/duration ");
}

TEST(ValidateBasin, TimesOfFramesLieInTheRun) {
  SceneSpec scene;
  scene.basin.emplace();
  RecordSpec record;
  record.times = {0, 1};
  EXPECT_TRUE(validate(record, scene).empty());
  record.times = {0, 1.0001, 1.0001};
  ASSERT_EQ(validate(record, scene).size(), 3u);
  EXPECT_EQ(validate(record, scene)[0].pointer, "/times/1");
  EXPECT_EQ(validate(record, scene)[2].what, "is there twice");
  record.times.assign(10'001, 0.5);
  ASSERT_EQ(validate(record, scene).size(), 1u);
  EXPECT_EQ(validate(record, scene)[0].what, "has 10001 times");
  record.frames = {7, 7};
  record.times = {};
  EXPECT_TRUE(validate(record, scene).empty()) << "depths are a pile's in a bed";
}

}  // namespace
}  // namespace seapile::scene
