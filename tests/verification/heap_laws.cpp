// Beds at rest between frictionless walls: the base carries all of them, and pressure grows linearly with depth.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/verification/law.h"
#include "tests/verification/measure.h"

namespace seapile::verification {
namespace {

/// A settled heap, and the forces in it.
struct Heap {
  std::unique_ptr<Running> run;
  Forces forces;
  double weight = 0, width = 0;
  bool rests = false;
};

Heap settle(const Solver& solver, int count, int columns, std::uint64_t seed) {
  Setup setup;
  setup.discs = support::jittered_lattice(count, columns, 0.012, 0.02, seed);
  setup.box = {0, columns * 2.04 * 0.02, 0};
  Heap heap{solver.start(setup), {}, 0, setup.box.right};
  heap.rests = come_to_rest(*heap.run, 1e-4, 8);
  heap.forces = mean_forces(*heap.run, 0.1);
  heap.weight = weight(*heap.run);
  return heap;
}

/// Of the grains whose centres are above a level.
double weight_above(Running& run, double level) {
  double mass = 0;
  for (int i = 0; i < run.count(); ++i)
    if (run.disc(i).y > level) mass += run.mass(i);
  return mass * run.law().gravity;
}

/// What the grains with centres above a level lean on those below, upwards [N/m].
double carried_across(const Heap& heap, double level) {
  double sum = 0;
  for (const auto& [bodies, f] : heap.forces) {
    const bool first = heap.run->disc(f.first).y > level;
    const bool second = f.second >= 0 ? heap.run->disc(f.second).y > level : f.second != -3 && first;
    if (first == second) continue;
    sum += (first ? -1 : 1) * force(f).y;
  }
  return sum;
}

/// Push on both side walls by grains above a level [N/m].
double wall_push_above(const Heap& heap, double level) {
  double sum = 0;
  for (const auto& [bodies, f] : heap.forces)
    if ((f.second == -1 || f.second == -2) && f.y > level) sum += f.normal;
  return sum;
}

double height_of(const Running& run) {
  double top = 0;
  for (int i = 0; i < run.count(); ++i) top = std::max(top, run.disc(i).y + run.disc(i).radius);
  return top;
}

std::vector<Row> weight_on_the_base(const Solver& solver, Size) {
  Worst carried, level;
  int resting = 0;
  constexpr int kHeaps = 3;
  for (std::uint64_t seed = 1; seed <= kHeaps; ++seed) {
    const Heap heap = settle(solver, solver.fast ? 300 : solver.slow ? 15 : 30, solver.fast ? 14 : solver.slow ? 4 : 6, seed);
    resting += heap.rests;
    carried.add(fmt::format("packing {}", seed), base_force(heap.forces) / heap.weight, 1, 1e-3);
    const double height = height_of(*heap.run);
    for (const double share : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9})
      level.add(fmt::format("packing {}, at {} of the height", seed, share),
                carried_across(heap, share * height) / heap.weight,
                weight_above(*heap.run, share * height) / heap.weight, 1e-3);
  }
  return {
      {"heaps whose rms speed falls below 1e-4 m/s in 8 s", "-", "", static_cast<double>(resting), kHeaps, 0, "all"},
      carried.row("force on the base over the weight", "-", "0.1 %: a settled bed"),
      level.row("force across a level over the heap's weight", "-", "0.1 % of the whole weight")};
}

// Frictionless walls take no weight: sigma_yy = (weight above) / width, and where sigma_xx / sigma_yy is the same at
// all depths, the push on a wall above a depth grows with the square of the weight above it. Walls that took weight
// would bend it down (Janssen).
std::vector<Row> linear_pressure(const Solver& solver, Size size) {
  const int packings = size == Size::large ? 40 : 6, count = 600;
  std::vector<double> exponents, slopes;
  double vertical = 0;
  for (int seed = 1; seed <= packings; ++seed) {
    const Heap heap = settle(solver, count, 20, static_cast<std::uint64_t>(seed));
    const double height = height_of(*heap.run);
    std::vector<double> x, y;
    for (double share = 0.1; share <= 0.8; share += 0.05) {
      x.push_back(std::log(weight_above(*heap.run, share * height)));
      y.push_back(std::log(wall_push_above(heap, share * height)));
    }
    exponents.push_back(line_through(x, y).slope);

    std::vector<grains::ContactForce> contacts;
    for (const auto& [bodies, f] : heap.forces) {
      contacts.push_back(f);
      if (f.second == -1 || f.second == -2) vertical = std::max(vertical, std::abs(f.tangential));
    }
    std::vector<grains::Disc> discs;
    for (int i = 0; i < heap.run->count(); ++i) discs.push_back(heap.run->disc(i));
    constexpr double kSpacing = 0.02;
    const double margin = grains::kStressRadius;
    grains::Grid grid{margin, margin, kSpacing, static_cast<int>((heap.width - 2 * margin) / kSpacing),
                      static_cast<int>((height - 2.5 * margin) / kSpacing)};
    const auto stress = grains::stress_on_grid(contacts, discs, heap.run->box(), grid);
    std::vector<double> above, mean;
    for (int row = 0; row < grid.ny; ++row) {
      double sum = 0;
      for (int column = 0; column < grid.nx; ++column) sum += stress[row * grid.nx + column].yy / grid.nx;
      mean.push_back(sum);
      above.push_back(weight_above(*heap.run, grid.y0 + (row + 0.5) * kSpacing) / heap.width);
    }
    slopes.push_back(line_through(above, mean).slope);
  }
  const Mean exponent = mean_of(exponents), slope = mean_of(slopes);
  const std::string where = fmt::format("{} packings of {} grains", packings, count);
  return {
      {"vertical force on the side walls", "N/m", where, vertical, 0, 0, "no friction: not a bit"},
      {"exponent of the walls' push in the weight above", "-",
       fmt::format("{}, standard error {:.3f}", where, exponent.error), exponent.value, 2, 3 * exponent.error + 0.06,
       "three standard errors, and 0.06 by which the stress locked in near the surface lowers it in 40 packings"},
      {"vertical stress over the weight above per width, slope", "-",
       fmt::format("{}, standard error {:.3f}", where, slope.error), slope.value, 1, 3 * slope.error,
       "three standard errors"}};
}

}  // namespace

std::vector<Law> heap_laws() {
  return {{"TheBaseCarriesTheWeight", weight_on_the_base},
          {"PressureIsLinearInDepthBetweenSmoothWalls", linear_pressure, true}};
}

}  // namespace seapile::verification
