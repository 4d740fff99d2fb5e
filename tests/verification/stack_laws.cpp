// Few discs at rest: what every contact carries is known, and what a soft contact gives way by.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/law.h"
#include "tests/verification/measure.h"

namespace seapile::verification {
namespace {

constexpr double kRadius = 0.02;

/// Overlap of a soft contact of effective mass m under a force F: F / (m omega^2) [m].
double give(Running& run, double force, double mass) {
  const double omega = 2 * std::numbers::pi * run.law().stiffness / run.substep();
  return force / (mass * omega * omega);
}

// DEM03 has two particles squeezed between two walls, which rigid ones cannot be; here the lid is missing.
std::vector<Row> two_stacked(const Solver& solver, Size) {
  Setup setup{{{0, kRadius, kRadius, 0}, {0, 3 * kRadius, kRadius, 0}}};
  const double area = std::numbers::pi * kRadius * kRadius;
  setup.masses = {2000 * area, 1000 * area};
  const auto run = solver.start(setup);
  run->run(1);
  const Forces forces = mean_forces(*run, 0.1);
  const double lower = run->mass(0), upper = run->mass(1), g = run->law().gravity;
  const double rounded = 1e-6 + 100 * solver.rounding;
  const auto at = [&](int i, int j) { return forces.contains({i, j}) ? forces.at({i, j}).normal : 0.0; };
  const char* const why = "1e-6 of the weight, and rounding";
  return {{"force between the discs over the upper one's weight", "-", "", at(0, 1) / (upper * g), 1, rounded, why},
          {"force on the base over both weights", "-", "", at(0, -3) / ((lower + upper) * g), 1, rounded, why}};
}

// Of 100 discs; fewer for a slower solver. With walls 1 % of a radius away on either side and a little disorder, a column
// leans from wall to wall; without, it has no reason to bend.
std::vector<Row> column(const Solver& solver, Size) {
  const int count = solver.fast ? 100 : solver.slow ? 12 : 30;
  std::vector<Row> rows;
  for (const bool straight : {true, false}) {
    Setup setup;
    const double room = straight ? 0 : 0.01 * kRadius;
    for (int k = 0; k < count; ++k)
      setup.discs.push_back(
          {base::uniform(-room, room, 1, 0, static_cast<std::uint64_t>(k)), (2 * k + 1) * kRadius, kRadius, 0});
    setup.box = {-kRadius - room, kRadius + room, 0};
    setup.law.friction_grain = 0;
    const auto run = solver.start(setup);
    run->run(2);
    const Forces forces = mean_forces(*run, 0.1);
    const double one = run->mass(0) * run->law().gravity;
    Worst carried;
    for (int k = 0; k < count; ++k) {
      const auto found = k == 0 ? forces.find({0, -3}) : forces.find({k - 1, k});
      const double up = found == forces.end() ? 0 : std::abs(force(found->second).y);
      carried.add(fmt::format("below disc {} of {}", k, count), up / one, count - k, 1e-3 * count);
    }
    const std::string of = straight ? ", straight" : ", leaning";
    rows.push_back(carried.row("force over one weight" + of, "-", "0.1 % of the whole, as for a settled bed"));
    if (!straight) break;
    double sideways = 0, overlap = 0, lowest_pair = 0;
    for (int k = 0; k < count; ++k) sideways = std::max(sideways, std::abs(run->disc(k).x));
    for (const grains::TouchingContact& c : run->contacts()) {
      overlap = std::max(overlap, c.overlap);
      if (c.first == 0 && c.second == 1) lowest_pair = c.overlap;
    }
    rows.push_back({"sideways place", "m", "straight", sideways, 0, 0, "nothing pushes sideways: not a bit"});
    if (solver.method == Method::soft) {
      const double expected = give(*run, (count - 1) * one, 0.5 * run->mass(0)) / kRadius;
      rows.push_back({"overlap of the lowest pair", "radii", "straight", lowest_pair, expected, 0.02 * expected + 1e-6,
                      "2 % of it, and rounding of the gap in single precision"});
    }
    rows.push_back({"largest overlap", "radii", "straight", overlap, 0, 1e-3,
                    "a tenth of what the solver may correct in a step, and what a user would call rigid",
                    Relation::at_most});
  }
  return rows;
}

std::vector<Row> heavy_on_light(const Solver& solver, Size) {
  Setup setup{{{0, kRadius, kRadius, 0}, {0, 3 * kRadius, kRadius, 0}}};
  const double light = support::kDensity * std::numbers::pi * kRadius * kRadius, heavy = 1000 * light;
  setup.masses = {light, heavy};
  const auto run = solver.start(setup);
  double deepest = 0;
  for (int k = static_cast<int>(2 / run->law().step); k > 0; --k) {
    run->step();
    deepest = std::max({deepest, 1 - run->disc(0).y / kRadius, 2 - (run->disc(1).y - run->disc(0).y) / kRadius});
  }
  const Forces forces = mean_forces(*run, 0.1);
  std::vector<Row> rows = {
      {"force on the base over both weights", "-", "1000 times heavier, after 2 s", base_force(forces) / weight(*run),
       1, 1e-3, "0.1 %, as for a settled bed"},
      {"speed of the heavy disc", "m/s", "after 2 s", norm(run->velocity(1)), 0, 1e-4, "that of a settled bed"}};
  if (solver.method == Method::soft) {
    const double expected = give(*run, weight(*run), light) / kRadius;
    rows.push_back({"largest overlap at any time", "radii", "first 2 s", deepest, 2 * expected, 0.1 * expected,
                    "twice that of rest, as on any spring that is loaded at once", Relation::at_most});
    for (const grains::TouchingContact& c : run->contacts())
      if (c.second == -3)
        rows.push_back({"overlap of the light disc and the base", "radii", "after 2 s", c.overlap, expected,
                        0.02 * expected, "2 % of F / (m omega^2), with m that of the light one"});
  }
  return rows;
}

// Statics: the upper contacts need mu >= tan 15 deg = 0.268, the floor 0.0893 when it carries a weight and a half.
std::vector<Row> pyramid(const Solver& solver, Size) {
  struct Case {
    double grain, floor;
    bool stands;
  };
  std::vector<Row> rows;
  for (const Case& c : {Case{0.27, 10, true},
                        {0.26, 10, false},
                        {10, 0.091, true},
                        {10, 0.10, true},
                        {10, 0.087, false},
                        {10, 0.08, false},
                        {0.27, 0.091, true},
                        {0, 0, false}}) {
    constexpr double kUp = 1 + std::numbers::sqrt3;
    Setup setup{{{-kRadius, kRadius, kRadius, 0}, {kRadius, kRadius, kRadius, 0}, {0, kUp * kRadius, kRadius, 0}}};
    setup.law.friction_grain = c.grain;
    setup.law.friction_wall = c.floor;
    const auto run = solver.start(setup);
    run->run(3);
    const double sunk = kUp - run->disc(2).y / kRadius;
    const std::string where = fmt::format("mu {} between discs, {} on the floor", c.grain, c.floor);
    if (c.stands)
      rows.push_back({"sinking of the upper disc in 3 s, stands", "radii", where, sunk, 0, 1e-3,
                      "a thousandth of a radius: it stands", Relation::at_most});
    else
      rows.push_back({"sinking of the upper disc in 3 s, falls", "radii", where, sunk, 0.5, 0,
                      "half a radius on its way to the floor", Relation::at_least});
  }
  return rows;
}

}  // namespace

std::vector<Law> stack_laws() {
  return {{"TwoStackedDiscsCarryTheirWeights", two_stacked},
          {"AColumnOfDiscsCarriesWhatStandsAbove", column},
          {"AHeavyDiscRestsOnALightOne", heavy_on_light},
          {"APyramidOfThreeStandsFromTan15Degrees", pyramid}};
}

}  // namespace seapile::verification
