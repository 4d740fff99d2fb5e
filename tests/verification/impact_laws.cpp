// Impacts: head on, oblique on a wall, oblique between two discs (Chung and Ooi 2011, tests 3 and 4, in disc form).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/law.h"
#include "tests/verification/measure.h"

namespace seapile::verification {
namespace {

using std::numbers::pi;

constexpr double kSphere = 0.0025;    // radius of Chung and Ooi's sphere [m]
constexpr double kImpactSpeed = 3.9;  // [m/s]

/// Detected as often as such a small grain needs it: it moves by a sixth of its radius in a step.
grains::ContactLaw impact_law(double e) {
  grains::ContactLaw law;
  law.step = 1e-4;
  law.gravity = 0;
  law.restitution = e;
  return law;
}

const char* const kSoft =
    "what a soft contact hands back of the speed (formulation.md 2.2), and a ten-thousandth of it";

std::vector<Row> head_on(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const double e : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
    Setup wall{{{0, 0.02, kSphere, 0}}};
    wall.law = impact_law(e);
    wall.velocities = {{0, -kImpactSpeed}};
    const auto run = solver.start(wall);
    run->run(0.02);
    rows.push_back({"rebound over approach, on the base", "-", fmt::format("e = {}", e),
                    run->velocity(0).y / kImpactSpeed, e, soft_push(*run) + 1e-4, kSoft});
  }
  for (const double e : {0.0, 0.5, 1.0}) {
    Worst worst;
    for (const double speed : {0.05, 1.5, 8.0}) {
      Setup pair{{{-0.03, 1, 0.02, 0}, {0.03, 1, 0.03, 0}}};
      pair.law.gravity = 0;
      pair.law.restitution = e;
      pair.velocities = {{speed, 0}, {0, 0}};
      const auto run = solver.start(pair);
      run->run(0.04 / speed);
      worst.add(fmt::format("{} m/s", speed), (run->velocity(1).x - run->velocity(0).x) / speed, e,
                soft_push(*run) + 1e-4);
    }
    rows.push_back(worst.row(fmt::format("relative speed after over before, two discs, e = {}", e), "-", kSoft));
  }
  return rows;
}

std::vector<Row> oblique_on_a_wall(const Solver& solver, Size) {
  constexpr double kMu = 0.092;
  std::vector<Row> rows;
  for (const double e : {0.0, 0.5, 0.98, 1.0}) {
    const double threshold = std::atan(3 * kMu * (1 + e)) * 180 / pi;
    std::vector<double> incidences = {threshold - 0.5, threshold + 0.5};
    for (double degrees = 5; degrees <= 85; degrees += 5) incidences.push_back(degrees);
    Worst tangential, spin, normal;
    for (const double degrees : incidences) {
      const double theta = degrees * pi / 180, vn = kImpactSpeed * std::cos(theta), vt = kImpactSpeed * std::sin(theta);
      Setup setup{{{0, 0.01, kSphere, 0}}};
      setup.law = impact_law(e);
      setup.law.friction_wall = kMu;
      setup.velocities = {{vt, -vn}};
      const auto run = solver.start(setup);
      run->run(0.01 / vn + 0.005);
      const bool slides = std::tan(theta) >= 3 * kMu * (1 + e);
      const std::string where = fmt::format("{:.1f} deg", degrees);
      tangential.add(where, run->velocity(0).x / vt, slides ? 1 - kMu * (1 + e) / std::tan(theta) : 2.0 / 3, 1e-3);
      spin.add(where, run->surface_speed(0) / kSphere, (slides ? -2 * kMu * (1 + e) * vn : -2.0 / 3 * vt) / kSphere,
               1e-3 * kImpactSpeed / kSphere);
      normal.add(where, run->velocity(0).y / vn, e, soft_push(*run) + 1e-4);
    }
    const std::string of = fmt::format(", e = {}", e);
    rows.push_back(tangential.row("tangential restitution" + of, "-", "a thousandth of the speed"));
    rows.push_back(spin.row("spin" + of, "rad/s", "a thousandth of the speed at the surface"));
    rows.push_back(normal.row("normal restitution" + of, "-", kSoft));
  }
  return rows;
}

// The second disc rests, off the first one's line. With vn, vt of the approach along and across the line of centres and
// the effective mass m = m1 m2 / (m1 + m2): p_n = m (1 + e) vn, p_t = min(mu p_n, m vt / 3).
std::vector<Row> oblique_between_discs(const Solver& solver, Size) {
  constexpr double kMu = 0.2, kSpeed = 2, kR1 = 0.02, kR2 = 0.03;
  std::vector<Row> rows;
  for (const double e : {0.0, 0.5, 1.0}) {
    Worst velocity, spin;
    for (double degrees = 5; degrees <= 85; degrees += 5) {
      const double theta = degrees * pi / 180, vn = kSpeed * std::cos(theta), vt = kSpeed * std::sin(theta);
      // At the instant of contact the line of centres is along x; the first disc comes from below left.
      const double ahead = 0.0101;  // [s] before contact, not a whole number of steps
      Setup setup{{{-(kR1 + kR2) - vn * ahead, 1 - vt * ahead, kR1, 0}, {0, 1, kR2, 0}}};
      setup.law.gravity = 0;
      setup.law.friction_grain = kMu;
      setup.law.restitution = e;
      setup.velocities = {{vn, vt}, {0, 0}};
      const auto run = solver.start(setup);
      const double m1 = run->mass(0), m2 = run->mass(1), m = m1 * m2 / (m1 + m2);
      run->run(0.02);
      const double pn = m * (1 + e) * vn, pt = std::min(kMu * pn, m * vt / 3);
      const std::string where = fmt::format("{:.0f} deg", degrees);
      const base::Vec2 first = run->velocity(0), second = run->velocity(1);
      // Normals stay within a step, in which the line of centres turns by up to vt dt / (r1 + r2): so much of v is taken for
      // normal speed, and given back with 1 + e.
      const double turn =
          (1 + e) * kSpeed * std::sin(theta) * run->law().step / (kR1 + kR2) * kSpeed + 1e-3 * kSpeed;
      velocity.add(where + ", first, x", first.x, vn - pn / m1, turn);
      velocity.add(where + ", first, y", first.y, vt - pt / m1, turn);
      velocity.add(where + ", second, x", second.x, pn / m2, turn);
      velocity.add(where + ", second, y", second.y, pt / m2, turn);
      spin.add(where + ", first", run->surface_speed(0), -2 * pt / m1, 2 * turn);
      spin.add(where + ", second", run->surface_speed(1), -2 * pt / m2, 2 * turn);
    }
    rows.push_back(
        velocity.row(fmt::format("velocities after, e = {}", e), "m/s",
                     "the normal is that of the start of the step: (1 + e) v^2 sin(theta) dt / (r1 + r2) + 0.1 % of v"));
    rows.push_back(spin.row(fmt::format("surface speeds after, e = {}", e), "m/s", "twice that of the velocities"));
  }
  return rows;
}

// A step is accepted up to a path of one radius. Nothing may pass unseen until then: with v the speed, a soft contact
// leaves an overlap of v h / (1 + a2), which is 0.5 % of the radius here.
std::vector<Row> fast_disc(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const bool onto_disc : {false, true}) {
    Worst overlap;
    for (const double share : {0.3, 0.6, 0.9})
      for (int phase = 0; phase < 10; ++phase) {
        Setup setup{{{0, 0.05, kSphere, 0}}};
        setup.law.gravity = 0;
        setup.discs[0].y += 1e-4 * phase;
        if (onto_disc) setup.discs.push_back({0, kSphere, kSphere, 0}), setup.box.base = -support::kFar;
        setup.velocities = {{0, -share * kSphere / setup.law.step}};
        setup.velocities.resize(setup.discs.size());
        const auto run = solver.start(setup);
        double deepest = 0;
        for (int k = 0; k < 100; ++k) {
          run->step();
          deepest = std::max(
              deepest,
              (onto_disc ? 2 * kSphere - (run->disc(0).y - run->disc(1).y) : kSphere - run->disc(0).y) / kSphere);
        }
        overlap.add(fmt::format("{} radii per step, phase {}", share, phase), deepest, 0, 0.01);
      }
    rows.push_back(overlap.row(onto_disc ? "largest overlap, on a disc at rest" : "largest overlap, on the base",
                               "radii", "1 %, twice what a soft contact leaves of the fastest"));
  }
  return rows;
}

}  // namespace

std::vector<Law> impact_laws() {
  return {{"AFastDiscIsStopped", fast_disc},
          {"AHeadOnImpactReturnsE", head_on},
          {"AnObliqueImpactSlidesFromTanEquals3MuTimes1PlusE", oblique_on_a_wall},
          {"TwoDiscsThatMeetObliquelyExchangeWhatTheConeAllows", oblique_between_discs}};
}

}  // namespace seapile::verification
