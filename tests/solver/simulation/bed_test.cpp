#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "solver/simulation/build.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using support::metric;
using support::settled;
using support::small_bed;
using support::values;
using testing::HasSubstr;

/// The sentence with which a bed refuses.
std::string refusal(const scene::BedSpec& spec) {
  try {
    prepare_bed(spec, {}, {}, {});
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Bed, IsSettledByDefinition) {
  const Bed& bed = settled(small_bed(300, 0.8));
  // Design README: rms grain speed below 1e-4 m/s, base force equal to the weight within 0.1 %.
  EXPECT_LT(metric(bed.metrics, "rms_speed"), 1e-4);
  EXPECT_LT(metric(bed.metrics, "base_force_error"), 1e-3);
  const Record& last = bed.records.back();
  const auto& radius = values<double>(bed.grains, "grains/radius");
  double weight = 0;
  for (const double r : radius) weight += 1500 * std::numbers::pi * r * r * 9.81;
  EXPECT_NEAR(last.base_force, weight, 1e-3 * weight);
  EXPECT_NEAR(last.left_wall_force, last.right_wall_force, 1e-3 * weight);
  EXPECT_LT(last.overlap_max, 1e-3);
}

TEST(Bed, StaysWhereItSettled) {
  const scene::BedSpec spec = small_bed(300, 0.8);
  Simulation sim = build_bed(spec, grains_of(settled(spec).grains, 1500), 0.5, {});
  for (int k = 0; k < 1000; ++k) step(sim);
  double farthest = 0;
  for (std::size_t i = 0; i < sim.grains.count(); ++i)
    farthest =
        std::max(farthest, std::hypot(sim.grains.disc[i].x - sim.origin[i].x, sim.grains.disc[i].y - sim.origin[i].y));
  // The impulses are not part of a bed and build up anew, in a few sub-steps: less than a hundredth of a radius.
  EXPECT_LT(farthest, 0.01 * 0.0112);
}

TEST(Bed, HoldsEveryGrainWithinItsWallsByRisingId) {
  const scene::BedSpec spec = small_bed(300, 0.8);
  const Bed& bed = settled(spec);
  const auto& id = values<std::int64_t>(bed.grains, "grains/id");
  const auto& position = values<double>(bed.grains, "grains/position");
  const auto& radius = values<double>(bed.grains, "grains/radius");
  ASSERT_EQ(id.size(), 300u);
  for (std::size_t k = 0; k < id.size(); ++k) {
    EXPECT_EQ(id[k], static_cast<std::int64_t>(k));
    EXPECT_LT(std::abs(position[2 * k]) + radius[k], 0.4 + 1e-3 * radius[k]);
    EXPECT_GT(position[2 * k + 1] - radius[k], -1e-3 * radius[k]);
  }
}

TEST(Bed, TheProfileOfThePorosityHoldsAllGrains) {
  const Bed& bed = settled(small_bed(300, 0.8));
  double solid = 0, area = 0;
  for (const double porosity : bed.porosity_profile) solid += (1 - porosity) * bed.profile_spacing * 0.8;
  for (const double r : values<double>(bed.grains, "grains/radius")) area += std::numbers::pi * r * r;
  // All but the caps that reach above the last slice, which begins below the mean surface.
  EXPECT_NEAR(solid, area, 0.02 * area);
}

TEST(Bed, RecordsEveryTenMilliseconds) {
  const Bed& bed = settled(small_bed(300, 0.8));
  ASSERT_GT(bed.records.size(), 20u);
  for (std::size_t k = 0; k < bed.records.size(); ++k) {
    EXPECT_NEAR(bed.records[k].time, 0.01 * static_cast<double>(k + 1), 1e-9);
    EXPECT_NEAR(bed.records[k].span, 0.01, 1e-9);
  }
  EXPECT_NEAR(metric(bed.metrics, "settling_time"), bed.records.back().time, 1e-9);
}

// Discs settled with friction 0.5 have 3 to 4 contacts each and a solid fraction of 0.80-0.82; walls cost a small bed
// some.
TEST(Bed, IsAPackingOfDiscs) {
  const Bed& bed = settled(small_bed(300, 0.8));
  EXPECT_GT(metric(bed.metrics, "coordination_number"), 2.8);
  EXPECT_LT(metric(bed.metrics, "coordination_number"), 4.05);
  EXPECT_GT(metric(bed.metrics, "solid_fraction"), 0.77);
  EXPECT_LT(metric(bed.metrics, "solid_fraction"), 0.85);
  EXPECT_EQ(metric(bed.metrics, "settling_friction"), 0.5);
  EXPECT_EQ(metric(bed.metrics, "trials"), 1);
}

TEST(Bed, ReachesASolidFractionThroughTheFrictionOfSettling) {
  scene::BedSpec spec = small_bed(400, 0.8);
  double last = 10;
  for (const double target : {0.80, 0.825}) {
    spec.preparation.solid_fraction = target;
    spec.preparation.tolerance = 3e-3;
    const Bed bed = prepare_bed(spec, {}, {}, {});
    EXPECT_NEAR(metric(bed.metrics, "solid_fraction"), target, 3e-3);
    EXPECT_LT(metric(bed.metrics, "settling_friction"), last) << "denser with less friction";
    EXPECT_LT(metric(bed.metrics, "rms_speed"), 1e-4) << "at rest with the grains' own friction";
    last = metric(bed.metrics, "settling_friction");
  }
}

TEST(Bed, SaysWhenASolidFractionCannotBeReached) {
  scene::BedSpec spec = small_bed(150, 0.6);
  spec.preparation.solid_fraction = 0.88;
  EXPECT_THAT(refusal(spec), HasSubstr("cannot be made as dense as 0.88"));
  spec.preparation.solid_fraction = 0.75;
  EXPECT_THAT(refusal(spec), HasSubstr("no settling friction gives the solid fraction 0.75"));
}

TEST(Bed, SaysWhenItIsNotAtRestInTime) {
  scene::BedSpec spec = small_bed(150, 0.6);
  spec.preparation.longest = 0.1;
  EXPECT_THAT(refusal(spec), HasSubstr("not at rest after the longest settling time"));
}

TEST(Bed, AnotherSeedIsAnotherBedAndTheSameSeedTheSame) {
  scene::BedSpec spec = small_bed(150, 0.6);
  const Bed first = prepare_bed(spec, {}, {}, {}), again = prepare_bed(spec, {}, {}, {});
  EXPECT_EQ(compare(first.grains, again.grains), "");
  spec.seed = 2;
  const Bed other = prepare_bed(spec, {}, {}, {});
  EXPECT_THAT(compare(first.grains, other.grains), HasSubstr("grains/position[0]"));
  EXPECT_NE(values<double>(first.grains, "grains/radius"), values<double>(other.grains, "grains/radius"));
}

TEST(Bed, GivenGrainsAreSettledWhereTheyAreWhateverTheirOrder) {
  const scene::BedSpec spec = small_bed(100, 0.5);
  // Loosely given, with gaps between the ids.
  std::vector<std::int64_t> id;
  std::vector<double> position, radius;
  for (std::int64_t k = 0; k < 100; ++k) {
    id.push_back(3 * k + 11);
    position.insert(position.end(),
                    {-0.22 + 0.044 * static_cast<double>(k % 11), 0.03 + 0.05 * static_cast<double>(k / 11)});
    radius.push_back(0.012 + 0.00008 * static_cast<double>(k * 37 % 100));
  }
  std::vector<std::size_t> order(100);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto rows = [&] {
    std::vector<std::int64_t> ids;
    std::vector<double> positions, radii;
    for (const std::size_t k : order) {
      ids.push_back(id[k]);
      positions.insert(positions.end(), {position[2 * k], position[2 * k + 1]});
      radii.push_back(radius[k]);
    }
    return std::vector<Array>{{{"grains/id", "-", "", 1, Entity::grain}, ids},
                              {{"grains/position", "m", "", 2, Entity::grain}, positions},
                              {{"grains/radius", "m", "", 1, Entity::grain}, radii}};
  };
  const Bed bed = prepare_bed(spec, rows(), {}, {});
  std::reverse(order.begin(), order.end());
  std::rotate(order.begin(), order.begin() + 41, order.end());
  const Bed shuffled = prepare_bed(spec, rows(), {}, {});
  EXPECT_EQ(compare(bed.grains, shuffled.grains), "");
  EXPECT_EQ(values<std::int64_t>(bed.grains, "grains/id"), id);
  EXPECT_EQ(values<double>(bed.grains, "grains/radius"), radius);
}

TEST(Bed, ProgressRisesFromTheStartToTheEnd) {
  std::vector<Progress> seen;
  prepare_bed(small_bed(100, 0.5), {}, {}, [&](const Progress& p) { seen.push_back(p); });
  ASSERT_GT(seen.size(), 20u);
  EXPECT_LT(seen.front().fraction, 0.1);
  for (std::size_t k = 0; k < seen.size(); ++k) {
    EXPECT_TRUE(std::isnan(seen[k].depth));
    EXPECT_LE(seen[k].fraction, 1);
    EXPECT_GE(seen[k].fraction, k > 0 ? seen[k - 1].fraction : 0);
  }
}

// A coarse settling, because eight threads on two processors wait for each other.
TEST(Bed, HasTheSameBitsForAnyNumberOfThreads) {
  scene::BedSpec spec = small_bed(1600, 1.8);
  spec.preparation.contact.step = 1e-3;
  spec.preparation.contact.substeps = 4;
  const Bed one = prepare_bed(spec, {}, {1, Simd::generic}, {});
  for (const int threads : {2, 3, 4, 8}) {
    const Bed many = prepare_bed(spec, {}, {threads, Simd::best}, {});
    EXPECT_EQ(compare(one.grains, many.grains), "") << threads << " threads";
    ASSERT_EQ(one.records.size(), many.records.size());
    EXPECT_EQ(one.records.back().dissipation, many.records.back().dissipation) << threads << " threads";
  }
}

}  // namespace
}  // namespace seapile::simulation
