#include "solver/simulation/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "solver/grains/body_contacts.h"
#include "solver/grains/packing.h"
#include "solver/simulation/objection.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::settled;
using support::small_bed;
using support::small_drive;

TEST(Build, ABedAloneHasNoPile) {
  scene::SceneSpec scene;
  scene.bed = small_bed(100, 0.5);
  const Simulation sim = build(scene, settled(scene.bed), {});
  EXPECT_FALSE(sim.pile.has_value());
  EXPECT_EQ(sim.grains.count(), 100u);
}

TEST(Build, ThePileStartsAboveTheHighestGrainUnderItAndTouchesNone) {
  for (const pile::Tip& tip : {pile::Tip{pile::FlatTip{}}, pile::Tip{pile::ConicalTip{}}}) {
    const scene::SceneSpec scene = small_drive(300, 0.8, tip);
    const Simulation sim = build(scene, settled(scene.bed), {});
    double highest = 0;
    for (std::size_t i = 0; i < sim.grains.count(); ++i) {
      const grains::Disc& d = sim.grains.disc[i];
      EXPECT_GT(nearest_place(sim.pile->body, {d.x, d.y}).distance, d.radius);
      if (std::abs(d.x) < 0.05) highest = std::max(highest, d.y + d.radius);
    }
    EXPECT_GT(sim.pile->start, highest);
    EXPECT_LT(sim.pile->start, highest + 0.05) << "but not far above";
    EXPECT_EQ(sim.pile->body.position, (base::Vec2{0, sim.pile->start}));
  }
}

// A grain beside the pile that is higher than all those under it is in nobody's way; one that overlaps its width is.
TEST(Build, OnlyGrainsUnderThePileDecideWhereItStarts) {
  const scene::SceneSpec scene = small_drive(3, 0.8, pile::FlatTip{});
  const auto start_with = [&](double x) {
    Bed bed;
    bed.grains = {{{"grains/id", "-", "", 1, Entity::grain}, std::vector<std::int64_t>{0, 1, 2}},
                  {{"grains/position", "m", "", 2, Entity::grain}, std::vector<double>{0, 0.015, x, 0.3, -0.2, 0.015}},
                  {{"grains/radius", "m", "", 1, Entity::grain}, std::vector<double>(3, 0.015)}};
    return build(scene, bed, {}).pile->start;
  };
  EXPECT_LT(start_with(0.0651), 0.031);
  EXPECT_GT(start_with(0.0649), 0.315);
}

TEST(Build, DepthCountsFromTheBedsSurface) {
  const scene::SceneSpec scene = small_drive(300, 0.8, pile::FlatTip{});
  const Bed& bed = settled(scene.bed);
  const Simulation sim = build(scene, bed, {});
  EXPECT_EQ(sim.surface, support::metric(bed.metrics, "surface"));
  EXPECT_EQ(sim.surface, grains::bed_surface({sim.grains.disc.data(), 300}, -0.4, 0.4));
}

/// A drive in steps of another size, whose contacts are stiffer or softer than the bed's in proportion to 1/h^2.
scene::SceneSpec drive_on(double step, std::int64_t substeps) {
  scene::SceneSpec scene = small_drive(300, 0.8, pile::FlatTip{});
  scene.contact.step = step;
  scene.contact.substeps = substeps;
  return scene;
}

TEST(Build, OnContactsOfTheBedsStiffnessADriveStartsFromTheBedItself) {
  for (const scene::SceneSpec& scene : {drive_on(5e-4, 10), drive_on(1e-3, 20)}) {
    EXPECT_FALSE(has_other_contacts(scene));
    const Bed& bed = settled(scene.bed);
    EXPECT_EQ(compare(arrays_of(build(scene, bed, {}).grains), bed.grains), "");
  }
}

/// What the grains of a drive do in its first 20 ms, in which its pile meets none.
struct Start {
  double kinetic = 0;  ///< largest energy [J/m]
  double made = 0;     ///< by the contacts [J/m]
  double overlap = 0;  ///< mean at the end [-]
  double moved = 0;    ///< rms way of the grains from the bed to the start of the drive, across [m]
};
Start start_of(scene::SceneSpec scene, const Bed& bed) {
  scene.pile->driving = pile::ConstantDriving{-0.1};
  Simulation sim = build(scene, bed, {});
  Start start;
  const std::vector<double> place = support::values<double>(arrays_of(sim.grains), "grains/position"),
                            before = support::values<double>(bed.grains, "grains/position");
  for (std::size_t i = 0; i < place.size(); i += 2) start.moved += (place[i] - before[i]) * (place[i] - before[i]);
  start.moved = std::sqrt(start.moved / static_cast<double>(sim.grains.count()));
  while (sim.clock.time() < 0.02) {
    gather(sim, step(sim));
    const EnergyLevel now = energy_level(sim);
    start.kinetic = std::max(start.kinetic, now.kinetic);
    start.made = std::max(start.made, -now.dissipation);
  }
  start.overlap =
      std::visit([&](const auto& system) { return overlaps(system, sim.grains, nullptr).mean; }, sim.contacts);
  return start;
}

// Overlaps under the same weight go with 1/k, k with 1/h^2. What is left of a shock is compared with a bed that is put
// on such contacts at once, as if it had come to rest on them.
TEST(Build, OnOtherContactsTheBedIsBroughtToRestWithoutAShock) {
  const Bed& bed = settled(drive_on(5e-4, 10).bed);
  const Start own = start_of(drive_on(5e-4, 10), bed);
  for (const auto& [step, substeps, stiffer, left] : {std::tuple{1.25e-4, 20, 64.0, 1e-3}, {2e-3, 10, 1.0 / 16, 0.2}}) {
    scene::SceneSpec scene = drive_on(step, substeps);
    EXPECT_TRUE(has_other_contacts(scene));
    const Start eased = start_of(scene, bed);
    EXPECT_NEAR(own.overlap / eased.overlap / stiffer, 1, 0.2) << stiffer;
    scene.bed.preparation.contact = scene.contact;
    const Start at_once = start_of(scene, bed);
    std::printf("k x %g: %g and %g J/m in motion, %g and %g J/m made\n", stiffer, eased.kinetic, at_once.kinetic,
                eased.made, at_once.made);
    EXPECT_LT(eased.moved, 1e-4) << stiffer << ": by a shock 1.8e-4 m";
    EXPECT_LT(eased.kinetic, left * at_once.kinetic) << stiffer;
  }
}

TEST(Build, GrainsGoToTheSolversOrderAndBack) {
  const Bed& bed = settled(small_bed(300, 0.8));
  EXPECT_EQ(compare(arrays_of(grains_of(bed.grains, 1500)), bed.grains), "");
}

TEST(Build, ABedThatIsNotOneIsRefused) {
  const scene::SceneSpec scene = small_drive(100, 0.5, pile::FlatTip{});
  const Bed& bed = settled(scene.bed);
  for (std::size_t k = 0; k < 3; ++k) {
    Bed missing = bed, wrong_type = bed;
    missing.grains.erase(missing.grains.begin() + static_cast<std::ptrdiff_t>(k));
    wrong_type.grains[k].values = std::vector<float>(100);
    EXPECT_THROW(build(scene, missing, {}), std::invalid_argument);
    EXPECT_THROW(build(scene, wrong_type, {}), std::invalid_argument);
  }
  Bed shorter = bed;
  std::get<std::vector<double>>(shorter.grains[2].values).pop_back();
  EXPECT_THROW(build(scene, shorter, {}), std::invalid_argument);
}

TEST(Build, ABedOfAnotherSceneIsRefused) {
  EXPECT_THROW(build(small_drive(101, 0.5, pile::FlatTip{}), settled(small_bed(100, 0.5)), {}), std::invalid_argument);
}

TEST(Build, ThePrecisionIsTheOneAskedFor) {
  scene::SceneSpec scene = small_drive(100, 0.5, pile::FlatTip{});
  const Bed& bed = settled(scene.bed);
  EXPECT_TRUE(std::holds_alternative<grains::ContactSystem<float>>(build(scene, bed, {}).contacts));
  scene.contact.precision = grains::Precision::double_;
  EXPECT_TRUE(std::holds_alternative<grains::ContactSystem<double>>(build(scene, bed, {}).contacts));
}

TEST(Parts, ADrySceneHasNoMeshNoFluidNoFreeSurfaceAndSaysWhy) {
  const std::vector<Part> all = parts(small_drive(100, 0.5, pile::FlatTip{}));
  std::vector<std::string> built, left_out;
  for (const Part& part : all) {
    (part.built ? built : left_out).push_back(part.name);
    EXPECT_FALSE(part.reason.empty()) << part.name;
    if (part.name == "mesh" || part.name == "fluid" || part.name == "free_surface" || part.name == "coupling") {
      EXPECT_THAT(part.reason, testing::HasSubstr("dry")) << part.name;
    }
  }
  EXPECT_THAT(built, testing::UnorderedElementsAre("grains", "walls", "pile", "rotation"));
  EXPECT_THAT(left_out, testing::UnorderedElementsAre("restitution", "mesh", "mesh_motion", "remeshing", "fluid",
                                                      "convection", "free_surface", "surface_tension", "coupling"));
}

TEST(Parts, ASaturatedSceneHasAllThatADryOneLeavesOutForTheFluid) {
  scene::SceneSpec scene = small_drive(100, 0.5, pile::FlatTip{});
  scene.fluid.emplace();
  for (const Part& part : parts(scene)) {
    EXPECT_EQ(part.built, part.name != "restitution" && part.name != "surface_tension") << part.name;
    EXPECT_FALSE(part.reason.empty()) << part.name;
  }
  scene.fluid->surface.reset();
  for (const Part& part : parts(scene))
    EXPECT_EQ(part.built, part.name != "restitution" && part.name != "free_surface" && part.name != "surface_tension")
        << part.name;
}

TEST(Parts, ABedAloneIsBuiltWithoutAPile) {
  scene::SceneSpec scene;
  scene.bed = small_bed(100, 0.5);
  for (const Part& part : parts(scene))
    EXPECT_EQ(part.built, part.name == "grains" || part.name == "walls" || part.name == "rotation") << part.name;
}

}  // namespace
}  // namespace seapile::simulation
