// A scene mirrored in x moves as the mirrored scene: to the last bit, as signs round nothing and the order of contacts
// follows the grains' numbers and gaps, which a mirror leaves alone. Where a mirror swaps things that have an order,
// the left wall and the right one, only the statistics are the same (ACollapsePrefersNoSide). A scene that stands far
// away moves as the near one, but for the rounding of its places.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/law.h"

namespace seapile::verification {
namespace {

Setup mirrored(Setup setup) {
  for (grains::Disc& d : setup.discs) d.x = -d.x;
  for (base::Vec2& v : setup.velocities) v.x = -v.x;
  for (double& u : setup.surface_speeds) u = -u;
  std::swap(setup.box.left, setup.box.right);
  setup.box.left = -setup.box.left, setup.box.right = -setup.box.right;
  if (!setup.body) return setup;
  setup.body->position.x = -setup.body->position.x;
  for (base::Segment& edge : setup.body->outline)
    edge = {{-edge.to.x, edge.to.y}, {-edge.from.x, edge.from.y}, edge.feature};
  std::reverse(setup.body->outline.begin(), setup.body->outline.end());
  return setup;
}

/// Largest difference of a scene and its mirror image's mirror image: places, velocities and spins.
double asymmetry(const Solver& solver, const Setup& setup, int steps) {
  const auto one = solver.start(setup), other = solver.start(mirrored(setup));
  double largest = 0;
  for (int k = 0; k < steps; ++k) {
    one->step();
    other->step();
    for (int i = 0; i < one->count(); ++i) {
      const base::Vec2 v = one->velocity(i), w = other->velocity(i);
      largest = std::max({largest, std::abs(one->disc(i).x + other->disc(i).x),
                          std::abs(one->disc(i).y - other->disc(i).y), std::abs(v.x + w.x), std::abs(v.y - w.y),
                          std::abs(one->surface_speed(i) + other->surface_speed(i))});
    }
  }
  return largest;
}

/// Two discs that meet obliquely in free flight.
Setup pair() {
  Setup setup{{{-0.03, 1, 0.02, 0}, {0.03, 1.013, 0.027, 0}}};
  setup.velocities = {{1.1, 0.2}, {-0.3, 0.05}};
  setup.surface_speeds = {0.4, -0.1};
  return setup;
}

/// One disc that slides down a slope.
Setup slope() {
  Setup setup{{{0.3, 0.2, 0.02, 0}}};
  setup.body.emplace();
  setup.body->outline = {{{20, -10}, {-20, 10}, 0}};
  setup.body->friction = 0.1;
  setup.box.base = -support::kFar;
  return setup;
}

/// A bent chain of twelve discs that falls on the base and folds.
Setup chain() {
  Setup setup;
  double x = 0, y = 0.02;
  for (int k = 0; k < 12; ++k) {
    setup.discs.push_back({x, y, 0.02, 0});
    const double angle = 0.3 * std::sin(static_cast<double>(k));
    x += 0.04 * std::sin(angle), y += 0.04 * std::cos(angle);
  }
  setup.law.friction_wall = 0.4;
  return setup;
}

/// A lattice of grains, without walls, that becomes a heap.
Setup pile() {
  Setup setup;
  setup.discs = support::jittered_lattice(60, 6, 0.012, 0.02, 1);
  setup.law.friction_wall = 0.5;
  return setup;
}

std::vector<Row> mirror(const Solver& solver, Size) {
  const char* const why = "bit by bit";
  std::vector<Row> rows = {
      {"difference from the mirror image", "SI", "two discs that meet", asymmetry(solver, pair(), 400), 0, 0, why},
      {"difference from the mirror image", "SI", "a disc that slides down a slope", asymmetry(solver, slope(), 800), 0,
       slope().law.gravity * slope().law.step / slope().law.substeps,
       "the foot is reckoned from an edge's first end, which a mirror swaps; that bit may close a contact a sub-step "
       "late: g h"},
      {"difference from the mirror image", "SI", "a chain of 12 that folds", asymmetry(solver, chain(), 1500), 0, 0,
       why},
      {"difference from the mirror image", "SI", "60 grains that become a heap", asymmetry(solver, pile(), 1500), 0, 0,
       why}};
  return rows;
}

constexpr double kAway = 1 << 20;  // [m]: a place there is rounded to 1.2e-10 m

Setup far(Setup setup) {
  for (grains::Disc& d : setup.discs) d.x += kAway;
  setup.box.left += kAway, setup.box.right += kAway;
  if (!setup.body) return setup;
  setup.body->position.x += kAway;
  return setup;
}

/// Largest difference of places [m], of a scene and the same scene far away.
double drift(const Solver& solver, const Setup& setup, int steps) {
  const auto near = solver.start(setup), away = solver.start(far(setup));
  double largest = 0;
  for (int k = 0; k < steps; ++k) {
    near->step();
    away->step();
    for (int i = 0; i < near->count(); ++i)
      largest = std::max(
          {largest, std::abs(away->disc(i).x - kAway - near->disc(i).x), std::abs(away->disc(i).y - near->disc(i).y)});
  }
  return largest;
}

std::vector<Row> translation(const Solver& solver, Size) {
  return {{"difference from the near scene", "m", "two discs that meet", drift(solver, pair(), 400), 0, 1e-6,
           "a place's rounding over a sub-step's way, of all that follows"},
          {"difference from the near scene", "m", "a disc that slides down a slope", drift(solver, slope(), 800), 0,
           1e-5, "likewise; that bit may close its contact a sub-step late"}};
}

}  // namespace

std::vector<Law> symmetry_laws() {
  return {{"AMirroredSceneMovesAsTheMirrorImage", mirror}, {"AFarSceneMovesAsANearOne", translation}};
}

}  // namespace seapile::verification
