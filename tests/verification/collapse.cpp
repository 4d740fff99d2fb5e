#include "tests/verification/collapse.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <vector>

#include "solver/grains/neighbours.h"
#include "tests/verification/measure.h"

namespace seapile::verification {
namespace {

constexpr double kSmallest = 0.008, kLargest = 0.012;  // radii [m]
constexpr double kMean = 0.5 * (kSmallest + kLargest);
constexpr double kPitch = 2.04 * kLargest;  // of the lattice of jittered_lattice()
constexpr double kSolidFraction = 0.8;      // about; a is measured

/// A settled column of a number of grains between smooth walls.
std::unique_ptr<Running> settled_column(const Solver& solver, double aspect, double friction, int count,
                                        std::uint64_t seed) {
  const double area = count * std::numbers::pi * kMean * kMean / kSolidFraction;
  const int columns = std::max(1, static_cast<int>(std::sqrt(2 * area / aspect) / kPitch + 0.5));
  Setup setup;
  setup.discs = support::jittered_lattice(count, columns, kSmallest, kLargest, seed);
  const double half = 0.5 * columns * kPitch;
  for (grains::Disc& d : setup.discs) d.x -= half;
  setup.box = {-half, half, 0};
  setup.law.friction_grain = friction;
  auto run = solver.start(setup);
  come_to_rest(*run, 0.01, 4);
  return run;
}

/// The largest set of grains that hang together by gaps below a tenth of a radius.
std::vector<int> main_heap(const Running& run) {
  std::vector<grains::Disc> discs;
  for (int i = 0; i < run.count(); ++i) discs.push_back(run.disc(i));
  std::vector<int> parent(discs.size());
  for (std::size_t i = 0; i < parent.size(); ++i) parent[i] = static_cast<int>(i);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  for (const grains::Pair& p : grains::neighbour_pairs(discs, 0.1 * kMean)) parent[root(p.i)] = root(p.j);
  std::map<int, std::vector<int>> sets;
  for (int i = 0; i < run.count(); ++i) sets[root(i)].push_back(i);
  return std::max_element(sets.begin(), sets.end(),
                          [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); })
      ->second;
}

/// Tops of columns four mean radii wide between two places: their middles and heights.
struct Surface {
  std::vector<double> x, y;
};
Surface surface_between(const Running& run, const std::vector<int>& grains, double from, double to) {
  const double width = 4 * kMean;
  std::map<int, double> top;
  for (const int i : grains) {
    const grains::Disc d = run.disc(i);
    if (d.x < from || d.x >= to) continue;
    double& t = top[static_cast<int>(std::floor(d.x / width))];
    t = std::max(t, d.y + d.radius);
  }
  Surface surface;
  for (const auto& [column, t] : top) surface.x.push_back((column + 0.5) * width), surface.y.push_back(t);
  return surface;
}

Collapse computed(const Solver& solver, double aspect, double friction, int count, std::uint64_t seed) {
  const auto run = settled_column(solver, aspect, friction, count, seed);
  Collapse result;
  result.half_width = run->box().right;
  double mass = 0, moment = 0;
  for (int i = 0; i < run->count(); ++i) mass += run->mass(i), moment += run->mass(i) * run->disc(i).y;
  const double height = 2 * moment / mass, centre = centre_of_mass_x(*run);
  result.aspect = height / result.half_width;

  run->box() = {-support::kFar, support::kFar, 0};
  run->law().friction_wall = friction;
  // Grains that roll off never come to rest, so the end is set by the time of the fall: the heaps stand after three to
  // six of them.
  run->run(8 * std::sqrt(2 * height / run->law().gravity));

  const std::vector<int> heap = main_heap(*run);
  double left = 0, right = 0;
  for (const int i : heap) {
    const grains::Disc d = run->disc(i);
    left = std::min(left, d.x - d.radius);
    right = std::max(right, d.x + d.radius);
    result.kinetic += 0.5 * run->mass(i) * dot(run->velocity(i), run->velocity(i)) / (run->law().gravity * moment);
  }
  result.half_length = 0.5 * (right - left);
  result.centre_shift = centre_of_mass_x(*run) - centre;
  result.tip_shift = 0.5 * (right + left);
  // The middle six tenths of each flank: neither the round top nor the thin foot.
  const double middle = result.tip_shift, length = result.half_length;
  const Surface a = surface_between(*run, heap, middle - 0.8 * length, middle - 0.2 * length);
  const Surface b = surface_between(*run, heap, middle + 0.2 * length, middle + 0.8 * length);
  result.angle = 0.5 * (std::atan(line_through(a.x, a.y).slope) - std::atan(line_through(b.x, b.y).slope));
  return result;
}

}  // namespace

const Collapse& collapse(const Solver& solver, double aspect, double friction, int count, std::uint64_t seed) {
  static std::map<std::tuple<std::string, double, double, int, std::uint64_t>, Collapse> known;
  const auto key = std::tuple{solver.name, aspect, friction, count, seed};
  const auto found = known.find(key);
  if (found != known.end()) return found->second;
  return known[key] = computed(solver, aspect, friction, count, seed);
}

double frictionless_slope(const Solver& solver, int count, std::uint64_t seed) {
  const auto run = settled_column(solver, 1, 0, count, seed);
  const double half = 3 * run->box().right;
  run->box() = {-half, half, 0};
  run->run(4);
  std::vector<int> all;
  for (int i = 0; i < run->count(); ++i) all.push_back(i);
  const Surface surface = surface_between(*run, all, -half, half);
  return std::atan(line_through(surface.x, surface.y).slope);
}

}  // namespace seapile::verification
