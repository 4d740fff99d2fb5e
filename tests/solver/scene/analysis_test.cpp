// What a scene is built with, and which of its numbers says so.
#include "solver/scene/analysis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/scene/predictions.h"

namespace seapile::scene {
namespace {

using std::numbers::pi;

Decision of(const SceneSpec& scene, const std::string& name) {
  for (const Decision& decision : decisions(scene))
    if (decision.name == name) return decision;
  throw std::out_of_range(name);
}
bool built(const SceneSpec& scene, const std::string& name) { return of(scene, name).built; }

/// A wave of wave number pi/m in water.
SceneSpec wave(double tension) {
  SceneSpec scene;
  scene.basin.emplace();
  scene.basin->surface->tension = tension;
  scene.basin->surface->initial = basin::CosineSurface{};
  return scene;
}
SceneSpec pile_in_water() {
  SceneSpec scene;
  basin::BasinSpec& basin = scene.basin.emplace();
  basin.width = 5;
  basin.depth = 2.4;
  basin.pile.emplace();
  basin.time.duration = 20;
  basin.mesh = {basin::UnstructuredMesh{}, basin::ZonesMotion{}, basin::RemeshSpec{}};
  return scene;
}
SceneSpec saturated() {
  SceneSpec scene;
  scene.pile.emplace();
  scene.fluid.emplace();
  return scene;
}

TEST(Analysis, SurfaceTensionIsNeededUpToABondNumberOfAThousand) {
  const double crossing = 9810 / (kLargeBond * pi * pi);  // gamma at which rho g/(gamma k^2) is that
  EXPECT_TRUE(built(wave(1.001 * crossing), "surface_tension"));
  EXPECT_FALSE(built(wave(0.999 * crossing), "surface_tension"));
  const Decision decision = of(wave(0.5 * crossing), "surface_tension");
  EXPECT_NEAR(decision.criterion->number, 2 * kLargeBond, 1e-9 * kLargeBond);
  EXPECT_NEAR(decision.criterion->bound, 0.25 / kLargeBond, 1e-12);
  EXPECT_EQ(decision.by, By::scene);
  EXPECT_EQ(decision.reason, "the Bond number is 2e+03, above 1e+03");
}

TEST(Analysis, AWaveOfTensionAloneKeepsIt) {
  SceneSpec scene = wave(0.07);
  scene.basin->gravity = 0;
  EXPECT_EQ(*predictions(scene)->bond, 0);
  EXPECT_TRUE(built(scene, "surface_tension"));
}

// A pile stirs waves of any length: the shortest that the mesh has counts.
TEST(Analysis, BesideAPileTheMeshSaysHowShortWavesAre) {
  SceneSpec scene = pile_in_water();
  scene.basin->surface->tension = 0.07;
  EXPECT_NEAR(*predictions(scene)->bond, 9810 / (0.07 * std::pow(pi / 0.112, 2)), 1e-6);
  EXPECT_TRUE(built(scene, "surface_tension"));
}

TEST(Analysis, NoTensionAndNoSurfaceAreLeftOutForWantOfThem) {
  EXPECT_EQ(of(wave(0), "surface_tension").reason, "the surface has none: \"tension\" is 0");
  EXPECT_FALSE(of(wave(0), "surface_tension").criterion);
  SceneSpec scene = wave(0.07);
  scene.basin->surface.reset();
  EXPECT_FALSE(built(scene, "free_surface"));
  EXPECT_EQ(of(scene, "surface_tension").reason, "there is no free surface");
  scene.model.free_surface = scene.model.surface_tension = Choice::yes;
  EXPECT_FALSE(built(scene, "free_surface")) << "yes adds nothing that the scene has not";
}

TEST(Analysis, ConvectionIsNeededFromAReynoldsNumberOfAThousandth) {
  SceneSpec scene = wave(0);
  const double speed = 5e-4 * wave_frequency(9.81, 0, 1000, 0.25, pi);
  const double crossing = 1000 * speed / pi / kSmallReynolds;  // mu at which rho U/(k mu) is that
  scene.basin->viscosity = 0.999 * crossing;
  EXPECT_TRUE(built(scene, "convection"));
  scene.basin->viscosity = 1.001 * crossing;
  EXPECT_FALSE(built(scene, "convection"));
  EXPECT_NEAR(of(scene, "convection").criterion->bound, kSmallReynolds, 0.01 * kSmallReynolds);
}

TEST(Analysis, TheSurfaceIsNeededWhereThePileLiftsItByAThousandthOfTheDepth) {
  SceneSpec scene = pile_in_water();
  auto& driving = scene.basin->pile->driving.emplace<pile::ConstantDriving>();
  driving.speed = 1e-3;
  const auto change = [&](double duration) {
    scene.basin->time.duration = duration;
    return *predictions(scene)->surface_change;
  };
  // Linear in the travel: what it displaces over the surface beside it.
  const double start = change(0), growth = change(1) - start;
  EXPECT_NEAR(growth, 0.25 * 1e-3 / 4.75 / 2.4, 1e-12);
  EXPECT_NEAR(start, (0.125 * 1e-3 / std::sqrt(9.81 * 2.4) + 1e-6 / 9.81) / 2.4, 1e-15);
  const double crossing = (kSmallSurfaceChange - start) / growth;
  scene.basin->time.duration = 1.001 * crossing;
  EXPECT_TRUE(built(scene, "free_surface"));
  scene.basin->time.duration = 0.999 * crossing;
  EXPECT_FALSE(built(scene, "free_surface"));
  EXPECT_EQ(of(scene, "surface_tension").reason, "there is no free surface");
  scene.basin->surface->initial = basin::CosineSurface{.amplitude = 0.01};
  EXPECT_TRUE(built(scene, "free_surface")) << "a wave is there by itself";
}

TEST(Analysis, ASurfaceWithoutAPileIsWhatItsSceneIsAbout) {
  SceneSpec scene = wave(0);
  scene.basin->surface->initial = basin::FlatSurface{};
  EXPECT_TRUE(built(scene, "free_surface"));
  EXPECT_FALSE(of(scene, "free_surface").criterion);
  scene.model.free_surface = Choice::no;
  EXPECT_FALSE(built(scene, "free_surface"));
  EXPECT_EQ(of(scene, "free_surface").by, By::asked);
}

TEST(Analysis, APileThatHardlyMovesNeedsNoNewMesh) {
  SceneSpec scene = pile_in_water();
  EXPECT_TRUE(built(scene, "remeshing"));
  scene.basin->pile->driving = pile::ConstantDriving{0};
  EXPECT_FALSE(built(scene, "remeshing"));
  EXPECT_FALSE(built(scene, "free_surface"));
  EXPECT_FALSE(built(scene, "mesh_motion"));
  EXPECT_FALSE(built(scene, "convection"));
  scene.model.free_surface = Choice::yes;
  EXPECT_TRUE(built(scene, "mesh_motion"));
}

TEST(Analysis, ADrySceneHasNothingOfAFluid) {
  SceneSpec scene;
  scene.pile.emplace();
  EXPECT_FALSE(predictions(scene));
  for (const char* name :
       {"mesh", "mesh_motion", "remeshing", "fluid", "convection", "free_surface", "surface_tension", "coupling"}) {
    EXPECT_FALSE(built(scene, name)) << name;
    EXPECT_EQ(of(scene, name).reason, "the scene is dry: \"fluid\" is null") << name;
  }
}

TEST(Analysis, ASaturatedBedHasItAll) {
  for (const Decision& decision : decisions(saturated()))
    EXPECT_EQ(decision.built, decision.name != "restitution" && decision.name != "surface_tension") << decision.name;
}

TEST(Analysis, AJetIsJudgedByItsOwnNumbers) {
  SceneSpec scene;
  scene.jet.emplace();
  EXPECT_TRUE(built(scene, "convection"));
  EXPECT_FALSE(built(scene, "surface_tension"));
  scene.jet->reynolds = 0.9 * kSmallReynolds;
  EXPECT_FALSE(built(scene, "convection"));
  scene.jet->capillary = 0.9 * kLargeCapillary;
  EXPECT_TRUE(built(scene, "surface_tension"));
  scene.jet->capillary = 1.1 * kLargeCapillary;
  EXPECT_FALSE(built(scene, "surface_tension"));
  const SceneSpec stripped = as_built(scene);
  EXPECT_FALSE(stripped.jet->capillary);
  EXPECT_EQ(stripped.jet->convection, fluid::Convection::omitted);
}

TEST(Analysis, AStudyMayForceEitherWay) {
  SceneSpec scene = pile_in_water();
  scene.basin->surface->tension = 0.07;
  scene.model = {Choice::yes, Choice::no, Choice::no, Choice::no};
  for (const char* name : {"surface_tension", "convection", "remeshing"}) {
    EXPECT_FALSE(built(scene, name)) << name;
    EXPECT_EQ(of(scene, name).by, By::asked) << name;
    EXPECT_NE(of(scene, name).reason.find("the study says no: \"model." + std::string(name)), std::string::npos);
    EXPECT_TRUE(of(scene, name).criterion) << "what it costs is said all the same";
  }
  const SceneSpec stripped = as_built(scene);
  EXPECT_EQ(stripped.basin->surface->tension, 0);
  EXPECT_EQ(stripped.basin->convection, fluid::Convection::omitted);
  EXPECT_FALSE(stripped.basin->mesh.remesh);
  scene.basin->pile->driving = pile::ConstantDriving{0};
  scene.model = {Choice::yes, Choice::yes, Choice::yes, Choice::yes};
  for (const char* name : {"free_surface", "surface_tension", "convection", "remeshing"})
    EXPECT_TRUE(built(scene, name)) << name;
  EXPECT_EQ(as_built(scene), scene);
}

TEST(Analysis, OfASaturatedBedTheSamePartsAreTakenOut) {
  SceneSpec scene = saturated();
  scene.fluid->surface->tension = 0.07;
  scene.model = {Choice::as_needed, Choice::no, Choice::no, Choice::no};
  SceneSpec stripped = as_built(scene);
  EXPECT_EQ(stripped.fluid->surface->tension, 0);
  EXPECT_EQ(stripped.fluid->convection, fluid::Convection::omitted);
  EXPECT_FALSE(stripped.fluid->mesh.remesh);
  scene.model.free_surface = Choice::no;
  EXPECT_FALSE(as_built(scene).fluid->surface);
}

TEST(Analysis, WhatIsDecidedIsDecidedOnce) {
  for (const SceneSpec& scene : {wave(1e-3), wave(0.07), pile_in_water(), saturated()}) {
    const SceneSpec once = as_built(scene);
    EXPECT_EQ(as_built(once), once);
    EXPECT_NE(once.model.convection, Choice::as_needed);
  }
}

// Today's questions about water are about all of it.
TEST(Analysis, TheDefaultsLeaveNothingOutOfTheStudies) {
  SceneSpec hump = wave(0.07);
  hump.basin->surface->initial = basin::HumpSurface{};
  EXPECT_NEAR(*predictions(hump)->bond, 9810 / (0.07 * 900), 1e-9);
  EXPECT_TRUE(built(hump, "surface_tension"));
  SceneSpec thick = wave(0);
  thick.basin->depth = 0.5;
  thick.basin->viscosity = 10;
  EXPECT_TRUE(built(thick, "convection"));
  for (const double speed : {0.06, 0.2, 0.4}) {
    SceneSpec scene = saturated();
    scene.pile->driving = pile::ConstantDriving{speed};
    for (const char* name : {"free_surface", "convection", "remeshing", "mesh_motion"})
      EXPECT_TRUE(built(scene, name)) << name;
  }
}

}  // namespace
}  // namespace seapile::scene
