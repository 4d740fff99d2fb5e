// The bounds of a saturated scene's fluid, each from both sides.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "solver/scene/validate.h"

namespace seapile::scene {
namespace {

constexpr double kBed = 2;  ///< height of the bed [m]

/// A pile in a bed that is known to be 2 m high, as one from a file is.
SceneSpec saturated() {
  SceneSpec scene;
  scene.bed.file = "grains.csv";
  scene.pile.emplace();
  scene.fluid.emplace();
  return scene;
}

std::string pointers(const SceneSpec& scene) {
  std::string text;
  for (const auto& problem : validate(scene, kBed)) text += problem.pointer + " ";
  return text;
}

double shoulder() { return 0.125 / std::tan(std::numbers::pi / 6); }

TEST(ValidateFluid, TheDefaultOneFitsTheDefaultBedAndPile) {
  EXPECT_EQ(pointers(saturated()), "");
  SceneSpec drawn;
  drawn.pile.emplace();
  drawn.fluid.emplace();
  EXPECT_TRUE(validate(drawn).empty());
  drawn.fluid->surface.reset();
  drawn.bed.grains.restitution = 0.5;
  EXPECT_TRUE(validate(drawn).empty());
  drawn.pile.reset();
  EXPECT_EQ(validate(drawn).at(0).pointer, "/fluid");
}

TEST(ValidateFluid, ItCoversTheShoulderByAThousandthOfItsDepthAtTheStart) {
  SceneSpec scene = saturated();
  const double least = (kBed + shoulder()) / (1 - 1e-3);
  scene.fluid->depth = least + 1e-9;
  EXPECT_EQ(pointers(scene), "");
  scene.fluid->depth = least - 1e-9;
  EXPECT_EQ(pointers(scene), "/fluid/depth ");
  scene.pile->tip = pile::FlatTip{};
  EXPECT_EQ(pointers(scene), "") << "a flat tip is its own shoulder";
}

TEST(ValidateFluid, ItCoversTheShoulderOfAPileThatRises) {
  SceneSpec scene = saturated();
  scene.pile->driving = pile::ConstantDriving{-0.1};
  scene.pile->depth.reset();
  scene.pile->duration = (4 * (1 - 1e-3) - kBed - shoulder()) / 0.1 - 1e-6;
  EXPECT_EQ(pointers(scene), "");
  *scene.pile->duration += 2e-6;
  EXPECT_EQ(pointers(scene), "/fluid/depth ");
}

TEST(ValidateFluid, TheTipStaysAHundredthOfTheDepthAboveTheBottom) {
  SceneSpec scene = saturated();
  scene.pile->depth = kBed - 0.01 * 4 - 1e-9;
  EXPECT_EQ(pointers(scene), "");
  scene.pile->depth = kBed - 0.01 * 4 + 1e-9;
  EXPECT_EQ(pointers(scene), "/pile/depth ");
  scene.pile->duration = 10;  // at 0.06 m/s
  EXPECT_EQ(pointers(scene), "") << "it goes on only while the run does";
  scene.pile->duration = 33;
  scene.pile->depth.reset();
  EXPECT_EQ(pointers(scene), "/pile/duration ");
}

TEST(ValidateFluid, ItStandsNoHigherThanTheBox) {
  SceneSpec scene = saturated();
  scene.fluid->depth = scene.bed.domain.height;
  EXPECT_EQ(pointers(scene), "");
  scene.fluid->depth += 1e-9;
  EXPECT_EQ(pointers(scene), "/fluid/depth ");
}

TEST(ValidateFluid, ItsStepIsAWholeNumberOfTheGrains) {
  SceneSpec scene = saturated();
  scene.contact.step = 1e-4;
  for (const int n : {1, 3, 5, 7}) {
    scene.fluid->time.step = n * 1e-4;
    EXPECT_EQ(pointers(scene), "") << n;
    scene.fluid->time.step = n * 1e-4 * (1 + 0.9e-9);
    EXPECT_EQ(pointers(scene), "") << n;
    scene.fluid->time.step = n * 1e-4 * (1 + 1.1e-9);
    EXPECT_EQ(pointers(scene), "/fluid/time/step ") << n;
  }
  scene.fluid->time.step = 0.5e-4;
  EXPECT_EQ(pointers(scene), "/fluid/time/step ") << "less than one";
}

TEST(ValidateFluid, TheSurfaceStartsAboveTheShoulder) {
  SceneSpec scene = saturated();
  const double cover = 4 - kBed - shoulder();
  scene.fluid->surface->initial = basin::CosineSurface{cover * (1 - 1e-9), 1};
  EXPECT_EQ(pointers(scene), "");
  scene.fluid->surface->initial = basin::CosineSurface{cover * (1 + 1e-9), 1};
  EXPECT_EQ(pointers(scene), "/fluid/surface/initial/cosine/amplitude ");
}

TEST(ValidateFluid, WhereTheBedsHeightIsNotKnownNothingIsSaidOfIt) {
  SceneSpec scene = saturated();
  scene.fluid->depth = 1;
  EXPECT_TRUE(validate(scene).empty());
}

}  // namespace
}  // namespace seapile::scene
