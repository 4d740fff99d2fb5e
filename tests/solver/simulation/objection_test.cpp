// Each cause for which a step is rejected, made on purpose: seen at that step, by its name.
#include "solver/simulation/objection.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "solver/basin/step.h"
#include "solver/fluid/jet_in_time.h"
#include "solver/simulation/bounds.h"
#include "solver/simulation/build.h"
#include "solver/simulation/settle.h"
#include "solver/simulation/state.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kPressure10 = 32;  // of the eleventh vertex: no value that is held

scene::SceneSpec wet() { return support::small_saturated_drive(); }

/// Where a step of the fluid begins.
Simulation started(const scene::SceneSpec& scene) {
  Simulation sim = build(scene, support::settled(scene.bed), {});
  for (int k = 0; k < 20; ++k) EXPECT_EQ(objection(sim, step(sim)).why, "");
  return sim;
}

Objection after_a_step(Simulation& sim) { return objection(sim, step(sim)); }

basin::Basin wave() {
  basin::BasinSpec spec;
  spec.surface->initial = basin::CosineSurface{0.01, 1};
  spec.mesh.pattern = basin::StructuredMesh{16, 4};
  spec.time.step = 5e-3;
  basin::Basin basin = basin::filled(spec, base::InstructionSet::generic);
  base::Profile profile;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(step(basin, profile).why, "");
  return basin;
}

Objection after_a_step(basin::Basin& basin) {
  base::Profile profile;
  Objection why = step(basin, profile);
  return why.empty() ? objection(basin) : why;
}

fluid::JetInTime jet() {
  fluid::JetSpec spec;
  spec.lip_size = 0.05;
  spec.growth = 0.3;
  spec.largest_size = 0.3;
  spec.downstream = 6;
  fluid::JetInTime jet = started(spec, fluid::TransientMethod{0.02, 1, 2}, base::InstructionSet::generic);
  base::Profile profile;
  for (int k = 0; k < 5; ++k) EXPECT_EQ(step(jet, profile).why, "");
  EXPECT_EQ(objection(jet.jet).why, "");
  return jet;
}

Objection after_a_step(fluid::JetInTime& jet) {
  base::Profile profile;
  Objection why = step(jet, profile);
  return why.empty() ? objection(jet.jet) : why;
}

#define EXPECT_CAUSE(objection_, cause_)                                        \
  do {                                                                          \
    const Objection found = objection_;                                         \
    EXPECT_FALSE(found.empty());                                                \
    EXPECT_STREQ(text_of(found.cause).name, text_of(cause_).name) << found.why; \
  } while (false)

TEST(Objection, AMotionThatIsNoNumberIsSeenAtOnce) {
  for (const auto precision : {grains::Precision::single_, grains::Precision::double_})
    for (const bool saturated : {false, true}) {
      scene::SceneSpec scene = wet();
      if (!saturated) scene.fluid.reset();
      scene.contact.precision = precision;
      Simulation sim = started(scene);
      std::visit([](auto& system) { system.motion(75).vx = NAN; }, sim.contacts);
      EXPECT_CAUSE(after_a_step(sim), Cause::not_finite);
    }
}

TEST(Objection, ASpinThatIsNoNumberIsSeenBeforeTheStretchIsAccepted) {
  scene::SceneSpec scene = wet();
  scene.fluid.reset();
  Simulation sim = started(scene);
  const EnergyLevel before = energy_level(sim);
  const std::vector<Array> start = snapshot(sim);
  EXPECT_EQ(stretch_objection(sim, before, start).why, "");
  std::visit([](auto& system) { system.motion(75).u = NAN; }, sim.contacts);
  EXPECT_CAUSE(stretch_objection(sim, before, start), Cause::not_finite);
}

TEST(Objection, AFlowThatIsNoNumberIsSeenAtOnce) {
  Simulation sim = started(wet());
  sim.water->basin.past.level[0].unknown[kPressure10] = kNaN;
  EXPECT_CAUSE(after_a_step(sim), Cause::not_finite);
  basin::Basin before = wave(), after = wave();
  before.past.level[0].unknown[kPressure10] = kNaN;
  EXPECT_CAUSE(after_a_step(before), Cause::not_finite);
  after.flow.unknown[kPressure10] = kNaN;
  EXPECT_CAUSE(objection(after), Cause::not_finite);
}

TEST(Objection, ASurfaceThatIsNoNumberIsSeenAtOnce) {
  basin::Basin before = wave(), after = wave();
  before.past.level[0].position[static_cast<std::size_t>(before.top.vertex[3])].y = kNaN;
  EXPECT_CAUSE(after_a_step(before), Cause::not_finite);
  after.top.height[3] = kNaN;
  EXPECT_CAUSE(objection(after), Cause::not_finite);
}

TEST(Objection, AJetThatIsNoNumberOrTouchesItsAxisIsSeenAtOnce) {
  fluid::JetInTime flow = jet(), surface = jet(), low = jet(), unsolved = jet();
  flow.past.level[0].unknown[kPressure10] = kNaN;
  EXPECT_CAUSE(after_a_step(flow), Cause::not_finite);
  const auto film = static_cast<std::size_t>(surface.jet.surface.vertex[3]);
  surface.past.level[0].position[film].y = kNaN;
  EXPECT_CAUSE(after_a_step(surface), Cause::not_finite);
  low.past.level[0].position[film].y = -1;
  EXPECT_CAUSE(after_a_step(low), Cause::mesh);
  unsolved.solver.tolerance = -1;
  EXPECT_CAUSE(after_a_step(unsolved), Cause::flow);

  fluid::Jet accepted = jet().jet;
  accepted.flow.unknown[kPressure10] = kNaN;
  EXPECT_CAUSE(objection(accepted), Cause::not_finite);
  accepted = jet().jet;
  accepted.surface.height[3] = kNaN;
  EXPECT_CAUSE(objection(accepted), Cause::not_finite);
  accepted.surface.height[3] = 0;
  EXPECT_CAUSE(objection(accepted), Cause::mesh);
}

/// With what a bed refuses to settle, and how often it was tried.
void expect_unsettled(Simulation sim) {
  std::vector<Record> records;
  try {
    settle(sim, 60, {}, records, [](double) {});
    ADD_FAILURE() << "it has settled";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).find("the bed does not settle: a grain's "), 0u) << error.what();
  }
  EXPECT_TRUE(records.empty()) << "nothing is recorded of a stretch that was not accepted";
  EXPECT_EQ(sim.stepping.rejected[static_cast<std::size_t>(Cause::not_finite)], 9) << "the step, and its halvings";
  EXPECT_EQ(sim.stepping.smallest, base::kMostHalvings);
}

TEST(Objection, ABedThatIsNoNumberDoesNotSettle) {
  const scene::BedSpec spec = support::small_bed(100, 0.5);
  const auto bed = [&] { return build_bed(spec, grains_of(support::settled(spec).grains, 1500), 0.5, {}); };
  Simulation moving = bed();
  std::visit([](auto& system) { system.motion(50).vx = NAN; }, moving.contacts);
  expect_unsettled(std::move(moving));
  // Of a grain that touches nothing, only its spin.
  Simulation spinning = bed();
  spinning.grains.disc[50].y += 100;
  std::visit([](auto& system) { system.motion(50).u = NAN; }, spinning.contacts);
  expect_unsettled(std::move(spinning));
}

TEST(Objection, WhatIsReportedIsHeldAgainstItsBound) {
  scene::SceneSpec scene = wet();
  Simulation sim = started(scene);
  const double smallest = std::visit([](const auto& system) { return system.smallest_radius; }, sim.contacts);
  for (const double beyond : {1.001, kNaN}) {
    StepReport report;
    report.contact.longest_path = beyond * kLongestPath * smallest;
    EXPECT_CAUSE(objection(sim, report), Cause::path);
    report.contact.longest_path = 0;
    report.contact.residual = beyond * kSoftBounds.residual * smallest / sim.law.step;
    EXPECT_CAUSE(objection(sim, report), Cause::residual);
    EXPECT_CAUSE(overlap_objection(sim, beyond * kSoftBounds.overlap), Cause::overlap);
  }
  EXPECT_EQ(overlap_objection(sim, 0.999 * kSoftBounds.overlap).why, "");

  StepReport flowed;
  flowed.flowed = true;
  EXPECT_EQ(objection(sim, flowed).why, "");
  const coupling::Porosity good = sim.water->expected.porosity;
  sim.water->expected.porosity.lowest = kNaN;
  EXPECT_CAUSE(objection(sim, flowed), Cause::porosity);
  sim.water->expected.porosity = good;
  sim.water->expected.porosity.clipped = 1;
  EXPECT_CAUSE(objection(sim, flowed), Cause::porosity);
  sim.water->expected.porosity = good;
  sim.water->basin.volume_at_start *= 1 + 2 * kVolumeChange;
  EXPECT_CAUSE(objection(sim, flowed), Cause::volume);
}

TEST(Objection, AFlowThatIsNotSolvedHasItsCause) {
  basin::Basin basin = wave();
  basin.solver.tolerance = -1;
  EXPECT_CAUSE(after_a_step(basin), Cause::flow);
}

// Two grains in touch, the second pushed into the first by a tenth of its radius.
TEST(Objection, SoftContactsHoldTheEnergyOfTheirSprings) {
  scene::SceneSpec scene = support::small_drive(150, 0.6, pile::FlatTip{});
  Simulation sim = build(scene, support::settled(scene.bed), {});
  const double rest = elastic_energy(sim, snapshot(sim));
  grains::Disc &one = sim.grains.disc[0], &other = sim.grains.disc[1];
  one.y = 5;
  const double alone = elastic_energy(sim, snapshot(sim));
  EXPECT_LE(alone, rest);
  other.x = one.x + one.radius + 0.9 * other.radius;
  other.y = one.y;
  const double mass = 1 / (1 / sim.grains.mass[0] + 1 / sim.grains.mass[1]),
               omega = 2 * std::numbers::pi * 0.125 / 5e-5;
  const double held = 0.5 * mass * std::pow(omega * 0.1 * other.radius, 2);
  EXPECT_NEAR(elastic_energy(sim, snapshot(sim)) / held, 1, 1e-3) << "beside it the bed's is small";
  scene.contact.method = grains::NonSmoothMethod{};
  Simulation rigid = build(scene, support::settled(scene.bed), {});
  EXPECT_EQ(elastic_energy(rigid, snapshot(sim)), 0);
}

TEST(Objection, GrainsThatOverlapOrGainEnergyAreNotAccepted) {
  scene::SceneSpec scene = wet();
  scene.fluid.reset();
  scene.pile->driving = pile::ConstantDriving{0};
  scene.contact.solver = grains::Solver::brute_force;  // it has no lists that a grain can be put past
  Simulation sim = started(scene);
  const EnergyLevel before = energy_level(sim);
  const std::vector<Array> start = snapshot(sim);
  std::visit([](auto& system) { system.motion(75).vy = 3; }, sim.contacts);
  EXPECT_CAUSE(stretch_objection(sim, before, start), Cause::energy);
  // What soft contacts say that they made is no better; non-smooth ones put apart what overlaps.
  sim.totals.dissipation -= energy_level(sim).kinetic - before.kinetic;
  EXPECT_CAUSE(stretch_objection(sim, before, start), Cause::energy);
  // Unless they held it: grain 76 began a tenth of a radius inside 75.
  std::vector<Array> strained = start;
  for (Array& array : strained) {
    if (array.info.name != "grains/position") continue;
    auto& place = std::get<std::vector<double>>(array.values);
    place[2 * 76] = place[2 * 75];
    place[2 * 76 + 1] = place[2 * 75 + 1] + sim.grains.disc[75].radius + 0.9 * sim.grains.disc[76].radius;
  }
  EXPECT_EQ(stretch_objection(sim, before, strained).why, "");
  sim.law.nonsmooth.emplace();
  EXPECT_EQ(stretch_objection(sim, before, start).why, "");
  sim.law.nonsmooth.reset();
  // No step leaves them as deep as that: it is their state that says so. One that leaves the other is not counted.
  std::visit([](auto& system) { system.motion(75).vy = 0; }, sim.contacts);
  grains::Disc& one = sim.grains.disc[75];
  one.x = sim.grains.disc[76].x;
  one.y = sim.grains.disc[76].y + 0.3 * one.radius;
  step(sim);
  EXPECT_CAUSE(stretch_objection(sim, energy_level(sim), start), Cause::overlap);
}

}  // namespace
}  // namespace seapile::simulation
