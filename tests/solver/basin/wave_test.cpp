// Small waves against the exact ones of linear theory (solver/basin/small_wave.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "solver/basin/small_wave.h"
#include "tests/solver/basin/scenes.h"

namespace seapile::basin {
namespace {

using support::filled;

SmallWave exact_of(const BasinSpec& spec) {
  return {.wavenumber = std::numbers::pi / spec.width,
          .depth = spec.depth,
          .gravity = spec.gravity,
          .tension = spec.surface->tension,
          .density = spec.density,
          .viscosity = spec.viscosity,
          .bottom = spec.bottom};
}

/// Largest difference of the surface's amplitude from the exact one, by the amplitude at the start.
double error_of(const BasinSpec& spec, double duration) {
  Basin basin = filled(spec);
  base::Profile profile;
  const double a0 = std::get<CosineSurface>(spec.surface->initial).amplitude;
  double largest = 0;
  while (time_of(basin) < duration - 1e-9) {
    const std::string why = step(basin, profile).why;
    EXPECT_EQ(why, "");
    if (!why.empty()) return 1;
    // The mode's share in the heights, by the trapezium rule: exact for cosines on an even grid.
    double sum = 0;
    const std::size_t last = basin.top.x.size() - 1;
    for (std::size_t s = 0; s <= last; ++s)
      sum += (s == 0 || s == last ? 1 : 2) * (basin.top.height[s] - spec.depth) *
             std::cos(std::numbers::pi * (basin.top.x[s] / spec.width + 0.5));
    const double a = sum / static_cast<double>(last);
    largest = std::max(largest, std::abs(a / a0 - amplitude(exact_of(spec), time_of(basin))));
  }
  return largest;
}

TEST(Wave, IsTheExactOneOverASlipBottom) { EXPECT_LT(error_of(support::wave(32, 16, 0.02), 8), 4e-3); }

TEST(Wave, IsTheExactOneOverABottomThatItSticksTo) {
  BasinSpec spec = support::wave(32, 16, 0.02);
  spec.bottom = WallKind::no_slip;
  std::get<StructuredMesh>(spec.mesh.pattern).bottom_row = 0.3;
  EXPECT_LT(error_of(spec, 8), 5e-3);
}

TEST(Wave, IsTheExactOneUnderTension) {
  BasinSpec spec = support::wave(32, 16, 0.02);
  spec.gravity = 0;
  spec.surface->tension = 1000 / (std::numbers::pi * std::numbers::pi);  // as fast as with g = 1
  EXPECT_LT(error_of(spec, 8), 5e-3);
}

TEST(Wave, IsOfSecondOrderInSpace) {
  // A step so small that its error does not show.
  const double coarse = error_of(support::wave(16, 8, 0.005), 2), fine = error_of(support::wave(32, 16, 0.005), 2);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

/// Difference of the amplitude between two runs of one mesh: error in time alone.
double amplitude_at(const BasinSpec& spec, double duration) {
  Basin basin = filled(spec);
  EXPECT_EQ(support::run(basin, static_cast<int>(std::lround(duration / spec.time.step))), "");
  return basin.top.height.front() - spec.depth;
}

TEST(Wave, IsOfTheClaimedOrderInTime) {
  for (const bool iterated : {true, false})
    for (const int order : {1, 2}) {
      std::vector<double> a;
      for (const double dt : {0.08, 0.04, 0.02}) {
        BasinSpec spec = support::wave(16, 8, dt);
        spec.time.order = order;
        spec.time.iterated = iterated;
        spec.time.rate = 20;  // the stabilisation must not change with the step
        a.push_back(amplitude_at(spec, 2.4));
      }
      EXPECT_GT(std::log2(std::abs((a[0] - a[1]) / (a[1] - a[2]))), order - 0.35) << order << iterated;
    }
}

}  // namespace
}  // namespace seapile::basin
