// Laws of a saturated bed: grains, water and pile together, from the scene to the result.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "solver/simulation/build.h"
#include "solver/simulation/flow_state.h"
#include "solver/simulation/objection.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::settled;

scene::SceneSpec wet() { return support::small_saturated_drive(); }

struct Told {
  std::vector<Record> records;
  std::vector<FlowRecord> flow_records;
  std::vector<Frame> frames;
  std::vector<FlowFrame> flow_frames;
  std::vector<std::vector<Array>> states;
  std::vector<std::size_t> records_before;  ///< of each state
  RunResult result;
};

Told told(const scene::SceneSpec& scene, const Execution& execution = {}, const std::vector<Array>& from = {},
          const RecordsSoFar& so_far = {}, int checkpoint_every = 0) {
  Told all;
  RunHooks hooks;
  hooks.record = [&](const Record& r) { all.records.push_back(r); };
  hooks.flow_record = [&](const FlowRecord& r) { all.flow_records.push_back(r); };
  hooks.frame = [&](const Frame& f) { all.frames.push_back(f); };
  hooks.flow_frame = [&](const FlowFrame& f) { all.flow_frames.push_back(f); };
  if (checkpoint_every > 0) {
    hooks.checkpoint_due = [&] {
      const std::size_t count = all.records.size();
      return count % static_cast<std::size_t>(checkpoint_every) == 0 &&
             (all.records_before.empty() ? count > 0 : all.records_before.back() < count);
    };
    hooks.checkpoint = [&](const std::vector<Array>& state) {
      all.states.push_back(state);
      all.records_before.push_back(all.records.size());
    };
  }
  Execution asked = execution;
  if (checkpoint_every > 0) asked.trying.stretch = 2;  // a step of the fluid
  all.result = run(scene, support::small_record(), settled(scene.bed), asked, from, so_far, hooks);
  EXPECT_EQ(all.result.outcome, Outcome::completed) << all.result.reason;
  return all;
}

double metric(const RunResult& result, const std::string& name) {
  const auto found = std::ranges::find(result.metrics, name, &Metric::name);
  EXPECT_NE(found, result.metrics.end()) << name;
  return found == result.metrics.end() ? std::nan("") : found->value;
}

template <class R>
std::vector<double> row_of(const R& record) {
  std::vector<double> row;
  columns([&](const char*, const char*, const char*, double v) { row.push_back(v); }, record);
  return row;
}

/// NaN is what is absent: it equals itself here.
template <class R>
bool same(const R& a, const R& b) {
  return std::ranges::equal(row_of(a), row_of(b), [](double x, double y) { return x == y || (x != x && y != y); });
}

TEST(SaturatedRun, KeepsTheVolumeOfTheMixtureThroughAPenetrationWithARemesh) {
  const Told all = told(wet());
  EXPECT_GE(metric(all.result, "meshes"), 2);
  // What is measured is 1e-15 to 1e-13; a fluid that lost what one grain fills would show 1e-3.
  EXPECT_LT(metric(all.result, "volume_error_max"), 1e-8);
  EXPECT_EQ(metric(all.result, "clipped_volume_max"), 0);
  // Grains overlap walls and pile by some 1e-4 of their radius.
  for (const FlowRecord& r : all.flow_records) EXPECT_NEAR(r.immersed, 1, 1e-5);
}

TEST(SaturatedRun, BelowAnOpenTopNoVolumeIsKeptAndNoneIsTold) {
  scene::SceneSpec scene = wet();
  scene.fluid->surface.reset();
  scene.pile->depth = 0.02;
  const Told all = told(scene);
  EXPECT_EQ(all.result.outcome, Outcome::completed) << all.result.reason;
  EXPECT_TRUE(std::ranges::none_of(all.result.metrics, [](const Metric& m) { return m.name == "volume_error_max"; }));
}

/// Impulses on the grains, and what they have gained by them, over the sum of their magnitudes.
double lost_momentum(Simulation& sim, int steps) {
  const auto momentum = [&] {
    base::Vec2 sum;
    std::visit(
        [&](const auto& system) {
          for (std::size_t i = 0; i < sim.grains.count(); ++i) {
            const auto& m = system.motion(static_cast<std::int32_t>(i));
            sum = sum + sim.grains.mass[i] * base::Vec2{static_cast<double>(m.vx), static_cast<double>(m.vy)};
          }
        },
        sim.contacts);
    return sum;
  };
  double weight = 0;
  for (const double m : sim.grains.mass) weight += m * sim.law.gravity;
  const auto by_contacts = [&] {
    base::Vec2 sum;
    for (const grains::Impulse& p : {sim.totals.left, sim.totals.right, sim.totals.base})
      sum = sum - base::Vec2{p.x, p.y};
    for (const grains::Impulse& p : sim.totals.feature) sum = sum - base::Vec2{p.x, p.y};
    return sum;
  };
  const base::Vec2 before = momentum(), contacts_before = by_contacts();
  base::Vec2 expected;
  double size = 0;
  for (int k = 0; k < steps; ++k) {
    step(sim);
    expected = expected - base::Vec2{0, sim.clock.dt * weight};
    for (std::size_t i = 0; i < sim.grains.count(); ++i) {
      expected = expected + sim.clock.dt * sim.grains.mass[i] * sim.grains.push[i];
      size += sim.clock.dt * (norm(sim.water->drag[i]) + norm(sim.water->pressure[i]));
    }
    size += sim.clock.dt * weight;
  }
  expected = expected + by_contacts() - contacts_before;
  EXPECT_GT(norm(by_contacts() - contacts_before), 0.1 * weight * sim.clock.dt * steps) << "they do press";
  return norm(momentum() - before - expected) / size;
}

// What the water gives them it loses: Exchange. Each sub-step rounds the velocity of each grain once.
TEST(SaturatedRun, MomentumOfTheGrainsComesFromWeightWaterWallsAndPile) {
  scene::SceneSpec scene = wet();
  for (const auto precision : {grains::Precision::double_, grains::Precision::single_}) {
    scene.contact.precision = precision;
    Simulation sim = build(scene, settled(scene.bed), {});
    const double lost = lost_momentum(sim, 400);
    std::printf("%s precision: momentum lost, by all impulses: %.1e\n",
                precision == grains::Precision::single_ ? "single" : "double", lost);
    EXPECT_LT(lost, precision == grains::Precision::single_ ? 1e-6 : 1e-12);
  }
}

// And not from where the last step expected them; but for what contacts do to single grains, which is finer than the
// mesh.
TEST(SaturatedRun, TheRateOfPorosityStartsFromWhereTheGrainsAre) {
  const scene::SceneSpec scene = wet();
  Simulation sim = build(scene, settled(scene.bed), {});
  double expected = 0, found = 0;  // squares of differences to the grains' own deposit
  for (int k = 0; k < 400; ++k) {
    std::optional<coupling::OnMesh> there;
    if (k % sim.water->grain_steps == 0) {
      coupling::Location location(sim.water->basin.flow.mesh);
      there = coupling::put_on(sim.water->basin.flow.mesh, location, {sim.grains.disc.begin(), sim.grains.disc.end()},
                               sim.water->coupling.porosity, base::fastest(), nullptr);
      for (std::size_t v = 0; v < there->solid.size(); ++v)
        expected += std::pow(sim.water->expected.porosity.phi[v] - there->porosity.phi[v], 2);
    }
    ASSERT_EQ(objection(sim, step(sim)).why, "");
    const fluid::Past& past = sim.water->basin.past;
    if (!there || past.level.size() < 2) continue;  // a new mesh
    const fluid::Flow& flow = sim.water->basin.flow;
    const fluid::TimeLevel &now = past.level[0], &before = past.level[1];
    const std::vector<double> volume = coupling::vertex_volume(flow.mesh.triangle, now.position),
                              volume_before = coupling::vertex_volume(flow.mesh.triangle, before.position);
    for (std::size_t v = 0; v < there->solid.size(); ++v) {
      found += std::pow(before.porosity[v] - there->porosity.phi[v], 2);
      const double grown = volume[v] - volume_before[v],
                   filled = volume[v] * (1 - now.porosity[v]) - volume_before[v] * (1 - before.porosity[v]);
      ASSERT_NEAR(flow.porosity_rate[v] * past.dt, ((1 - now.porosity[v]) * grown - filled) / volume[v], 1e-13);
    }
  }
  std::printf("of what was not expected %.2g is left\n", std::sqrt(found / expected));
  EXPECT_LT(found, 0.55 * expected);  // 0.42 is seen
}

// The water past which the pile goes at 0.4 m/s, in steps of 1 ms, on edges of at most 9 cm.
TEST(SaturatedRun, SaysHowFarItsWaterGoesInAStepAndHowItsMeshChanges) {
  const Told all = told(wet());
  double most = 0, fewest = 1e9;
  std::size_t absent = 0;
  for (const FlowRecord& r : all.flow_records) {
    fewest = std::min(fewest, r.vertices);
    if (std::isnan(r.cfl))
      ++absent;
    else
      most = std::max(most, r.cfl);
  }
  EXPECT_EQ(metric(all.result, "cfl_max"), most);
  EXPECT_GT(most, 0.4 * 1e-3 / 0.09);
  EXPECT_LT(most, 1);
  EXPECT_LE(absent, 2 * (metric(all.result, "meshes") - 1)) << "only where a mesh is new";
  EXPECT_EQ(metric(all.result, "vertices_min"), fewest);
  EXPECT_GE(metric(all.result, "vertices_max"), fewest);
  EXPECT_TRUE(std::isfinite(metric(all.result, "stress_under_tip_0.05")));
}

TEST(SaturatedRun, HandsOutBothPhasesTogether) {
  const Told all = told(wet());
  ASSERT_EQ(all.records.size(), all.flow_records.size());
  ASSERT_EQ(all.frames.size(), all.flow_frames.size());
  EXPECT_EQ(all.frames.size(), 3u);
  const double dt = wet().fluid->time.step;
  for (std::size_t k = 0; k < all.records.size(); ++k)
    EXPECT_LE(std::abs(all.records[k].time - all.flow_records[k].time), dt);
}

TEST(SaturatedRun, BalancesTheEnergyOfItsGrainsWithTheWorkOfTheFluid) {
  // In single precision the dry balance closes to the same 1e-4.
  EXPECT_LT(std::abs(metric(told(wet()).result, "energy_error")), 1e-4);
}

TEST(SaturatedRun, ContinuesWithTheSameBitsBeforeAndAfterARemesh) {
  scene::SceneSpec scene = wet();
  const Told whole = told(scene, {}, {}, {}, 29);
  ASSERT_GE(metric(whole.result, "meshes"), 2);
  ASSERT_GE(whole.states.size(), 4u);
  bool first_mesh = false, later_mesh = false;
  for (std::size_t k = 0; k < whole.states.size(); ++k) {
    const auto before = static_cast<std::ptrdiff_t>(whole.records_before[k]);
    (whole.flow_records[before - 1].meshes > 1 ? later_mesh : first_mesh) = true;
    const RecordsSoFar so_far{{whole.records.begin(), whole.records.begin() + before},
                              {whole.flow_records.begin(), whole.flow_records.begin() + before}};
    const Told rest = told(scene, {}, whole.states[k], so_far);
    EXPECT_EQ(rest.result.state_hash, whole.result.state_hash) << k;
    ASSERT_EQ(rest.records.size() + so_far.records.size(), whole.records.size());
    for (std::size_t i = 0; i < rest.records.size(); ++i) {
      EXPECT_TRUE(same(rest.records[i], whole.records[so_far.records.size() + i])) << k << " " << i;
      EXPECT_TRUE(same(rest.flow_records[i], whole.flow_records[so_far.records.size() + i])) << k << " " << i;
    }
    EXPECT_EQ(hash_of(rest.flow_frames.back()), hash_of(whole.flow_frames.back()));
    ASSERT_EQ(rest.result.metrics.size(), whole.result.metrics.size());
    for (std::size_t m = 0; m < whole.result.metrics.size(); ++m)
      EXPECT_EQ(rest.result.metrics[m].value, whole.result.metrics[m].value) << whole.result.metrics[m].name;
  }
  EXPECT_TRUE(first_mesh && later_mesh);
}

TEST(SaturatedRun, ContinuesWithTheSameBitsFromTheStepOfARemesh) {
  const scene::SceneSpec scene = wet();
  Simulation sim = build(scene, settled(scene.bed), {});
  for (int k = 0; sim.water->basin.remeshes.empty(); ++k) {
    ASSERT_LT(k, 2000);
    ASSERT_EQ(objection(sim, step(sim)).why, "");
  }
  Simulation other = build(scene, settled(scene.bed), {}, snapshot(sim));
  for (int k = 0; k < 10; ++k) {
    ASSERT_EQ(state_hash(other), state_hash(sim)) << k;
    step(sim);
    step(other);
  }
}

TEST(SaturatedRun, GivesTheSameBitsForAnyThreadsAndInstructions) {
  scene::SceneSpec scene = wet();
  scene.pile->depth = 0.06;
  const std::uint64_t hash = told(scene, {1, Simd::generic}).result.state_hash;
  for (const Execution execution : {Execution{1, Simd::best}, Execution{2, Simd::best}, Execution{3, Simd::generic}})
    EXPECT_EQ(told(scene, execution).result.state_hash, hash) << execution.threads;
}

TEST(SaturatedRun, DoesTheSameStepsBetweenRecordsWhateverIsRecorded) {
  scene::SceneSpec scene = wet();
  scene.pile->depth = 0.06;
  scene::RecordSpec seldom;
  seldom.travel = 0.03;
  seldom.frames = {};
  const RunResult result = run(scene, seldom, settled(scene.bed), {}, {}, {}, {});
  const Told often = told(scene);
  EXPECT_EQ(result.time, often.result.time);
  EXPECT_EQ(metric(result, "steps"), metric(often.result, "steps"));
  EXPECT_EQ(metric(result, "corrections"), metric(often.result, "corrections"));
}

TEST(SaturatedRun, GoesBackToTheSameBitsWhenAStepIsRejected) {
  const scene::SceneSpec scene = wet();
  Simulation sim = build(scene, settled(scene.bed), {});
  for (int k = 0; k < 7; ++k) step(sim);  // in the middle of a step of the fluid
  const Trial trial(sim);
  const auto go_on = [&] {
    for (int k = 0; k < 60; ++k) {
      const StepReport report = step(sim);
      EXPECT_EQ(objection(sim, report).why, "");
    }
    return state_hash(sim);
  };
  const std::uint64_t hash = go_on();
  trial.reject(sim);
  EXPECT_EQ(compare(snapshot(sim), trial.start()), "");
  EXPECT_EQ(go_on(), hash);
}

/// Largest distance of a grain from its place in another run, by the smallest radius.
double largest_difference(const Simulation& a, const Simulation& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.grains.count(); ++i)
    most = std::max(
        {most, std::abs(a.grains.disc[i].x - b.grains.disc[i].x), std::abs(a.grains.disc[i].y - b.grains.disc[i].y)});
  return most / grains::RadiusSpec{}.min;
}

// Over the first steps, until the packing's chaos shows. Both begin with the same grains at rest.
TEST(SaturatedRun, TendsToTheDryRunAsTheFluidGetsThin) {
  scene::SceneSpec scene = wet();
  scene.contact.precision = grains::Precision::double_;
  scene.fluid->time.tolerance = 1e-11;  // What is left unsolved does not get thin with the fluid.
  const auto difference_after = [&](double density) {
    scene.fluid->density = density;
    Simulation saturated = build(scene, settled(scene.bed), {}), dry = build(scene, settled(scene.bed), {});
    dry.water.reset();
    for (int k = 0; k < 16; ++k) {
      step(saturated);
      step(dry);
    }
    return largest_difference(saturated, dry);
  };
  double last = 1;
  for (const double density : {100.0, 1.0, 1e-2, 1e-4}) {
    const double difference = difference_after(density);
    std::printf("density %g: grains are %.2e smallest radii from where the dry ones are\n", density, difference);
    EXPECT_GT(difference, 0);
    // It is proportional, 0.01 each time, until forces decide which blocks of contacts rest: up to 1e-8 m.
    EXPECT_LT(difference, std::max(0.1 * last, 1e-6));
    last = difference;
  }
}

// Its trial of the grains leaves no trace but in the forces.
TEST(SaturatedRun, PredictorCorrectorIsAnotherSolutionWithTheSamePromises) {
  scene::SceneSpec scene = wet();
  scene.pile->depth = 0.06;
  const Told once = told(scene);
  scene.fluid->coupling.scheme = coupling::Scheme::predictor_corrector;
  const Told twice = told(scene, {}, {}, {}, 61);
  EXPECT_NE(twice.result.state_hash, once.result.state_hash);
  EXPECT_EQ(metric(twice.result, "steps"), metric(once.result, "steps")) << "steps on trial do not count";
  EXPECT_GT(metric(twice.result, "corrections"), metric(once.result, "corrections"));
  EXPECT_LT(metric(twice.result, "volume_error_max"), 1e-8);
  EXPECT_LT(std::abs(metric(twice.result, "energy_error")), 1e-4);
  ASSERT_FALSE(twice.states.empty());
  const auto before = static_cast<std::ptrdiff_t>(twice.records_before[0]);
  const Told rest = told(scene, {2, Simd::best}, twice.states[0],
                         {{twice.records.begin(), twice.records.begin() + before},
                          {twice.flow_records.begin(), twice.flow_records.begin() + before}});
  EXPECT_EQ(rest.result.state_hash, twice.result.state_hash);
}

// A file keeps arrays in groups by the parts of their names.
TEST(SaturatedRun, HasAStateInWhichNoArrayIsTheGroupOfAnother) {
  const scene::SceneSpec scene = wet();
  Simulation sim = build(scene, settled(scene.bed), {});
  step(sim);
  const std::vector<Array> state = snapshot(sim);
  for (const Array& a : state)
    for (const Array& b : state) EXPECT_FALSE(b.info.name.starts_with(a.info.name + "/")) << b.info.name;
}

// In double precision, after the last grains that rolled have stopped. What is measured is 1e-11 radii and 1e-7 m/s.
TEST(SaturatedRun, ABedUnderStillWaterWithThePileAtRestStaysStill) {
  scene::SceneSpec scene = wet();
  scene.bed.grains.count = 150;
  scene.contact.precision = grains::Precision::double_;
  scene.pile->driving = pile::ConstantDriving{0};
  Simulation sim = build(scene, settled(scene.bed), {});
  const auto go_on = [&](int steps) {
    for (int k = 0; k < steps; ++k) ASSERT_EQ(objection(sim, step(sim)).why, "");
  };
  go_on(5000);
  const std::vector<grains::Disc> before(sim.grains.disc.begin(), sim.grains.disc.begin() + 150);
  go_on(10000);  // 1e5 sub-steps
  double creep = 0, current = 0;
  for (std::size_t i = 0; i < before.size(); ++i)
    creep = std::max(
        creep, std::hypot(sim.grains.disc[i].x - before[i].x, sim.grains.disc[i].y - before[i].y) / before[i].radius);
  const std::vector<double>& unknown = sim.water->basin.flow.unknown;
  for (std::size_t v = 0; v < unknown.size() / 3; ++v)
    current = std::max(current, std::hypot(unknown[3 * v], unknown[3 * v + 1]));
  std::printf("creep %.1e radii, currents %.1e m/s\n", creep, current);
  EXPECT_LT(creep, 1e-6);
  EXPECT_LT(current, 1e-6);
}

TEST(SaturatedRun, MeetsTheFirstGrainUnderItsPile) {
  for (const pile::Tip& tip : {pile::Tip{pile::ConicalTip{}}, pile::Tip{pile::FlatTip{}}}) {
    scene::SceneSpec scene = wet();
    scene.pile->tip = tip;
    scene.pile->depth = 0.04;
    // Driven at 0.4 m/s, dry: 5e-3. A grain that the pile's lists had missed was hit 0.3 deep.
    EXPECT_LT(metric(told(scene).result, "overlap_max"), 0.02);
  }
}

TEST(SaturatedRun, BuildsNoWaterForADryScene) {
  scene::SceneSpec scene = wet();
  scene.fluid.reset();
  const Simulation sim = build(scene, settled(scene.bed), {});
  EXPECT_FALSE(sim.water.has_value());
  EXPECT_TRUE(sim.grains.push.empty());
  for (const Part& part : parts(scene)) {
    if (part.name == "mesh" || part.name == "fluid" || part.name == "free_surface" || part.name == "coupling") {
      EXPECT_FALSE(part.built) << part.name;
    }
  }
  for (const Array& array : snapshot(sim)) EXPECT_FALSE(array.info.name.starts_with("water/"));
}

}  // namespace
}  // namespace seapile::simulation
