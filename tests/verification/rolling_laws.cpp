// A disc that slides and rolls: it resists rolling on a surface with a third of its mass, which gives the thresholds 3
// mu.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tests/verification/law.h"

namespace seapile::verification {
namespace {

constexpr double kRadius = 0.02;

/// A half plane that falls to the right by an angle, and a disc that lies on it in the origin.
Setup incline(double angle, double friction) {
  const base::Vec2 down{std::cos(angle), -std::sin(angle)}, up = perpendicular(down);
  Setup setup{{{kRadius * up.x, kRadius * up.y, kRadius, 0}}};
  setup.box.base = -support::kFar;
  setup.body.emplace();
  setup.body->outline = {{100 * down, -100.0 * down, 0}};
  setup.body->friction = friction;
  return setup;
}

std::vector<Row> disc_on_an_incline(const Solver& solver, Size) {
  constexpr double kTime = 0.4;
  std::vector<Row> rows;
  for (const double mu : {0.1, 0.2, 0.5}) {
    Worst acceleration, angular, leaving;
    for (const double share : {0.05, 0.5, 0.97, 1.03, 2.0, 5.0}) {
      const double tangent = share * 3 * mu, angle = std::atan(tangent);
      const auto run = solver.start(incline(angle, mu));
      run->run(kTime);
      const double g = run->law().gravity, pull = g * std::sin(angle), press = g * std::cos(angle);
      const bool rolls = share < 1;
      const double expected = rolls ? 2.0 / 3 * pull : pull - mu * press;
      const base::Vec2 v = run->velocity(0);
      const std::string where = fmt::format("tan = {:.3f}", tangent);
      // The contact must be pressed before it can rub.
      const double late = 3 * run->substep() / kTime * pull;
      acceleration.add(where, norm(v) / kTime, expected, late + 1e3 * solver.rounding * pull);
      angular.add(where, -run->surface_speed(0) / kTime / kRadius, (rolls ? expected : 2 * mu * press) / kRadius,
                  (2 * late + 1e3 * solver.rounding * pull) / kRadius);
      const base::Vec2 up{std::sin(angle), std::cos(angle)};
      leaving.add(where, dot(v, up), 0, g * run->substep());
    }
    const std::string of = fmt::format(", mu = {}", mu);
    rows.push_back(acceleration.row("acceleration" + of, "m/s2", "friction may begin three sub-steps late"));
    rows.push_back(angular.row("angular acceleration" + of, "rad/s2", "twice that of the acceleration"));
    rows.push_back(leaving.row("velocity away from the plane" + of, "m/s", "one sub-step of free fall, g h"));
  }
  return rows;
}

// With a spin u0 at the start, in the sense of rolling, a disc ends with (2 v0 + u0) / 3.
std::vector<Row> sliding_disc(const Solver& solver, Size) {
  Worst sliding, start, end, spin;
  for (const double mu : {0.1, 0.2, 0.5, 2.0})
    for (const double u0 : {0.0, -0.5, 2.5}) {
      Setup setup{{{0, kRadius, kRadius, 0}}};
      setup.law.friction_wall = mu;
      setup.velocities = {{1, 0}};
      setup.surface_speeds = {-u0};
      const auto run = solver.start(setup);
      const double g = run->law().gravity, dt = run->law().step, h = run->substep();
      const double slip = 1 - u0, stop = std::abs(slip) / (3 * mu * g), rolling = (2 + u0) / 3;
      const std::string where = fmt::format("mu = {}, u0 = {} m/s", mu, u0);
      const int half = static_cast<int>(stop / 2 / dt);
      for (int k = 0; k < half; ++k) run->step();
      sliding.add(where, run->velocity(0).x, 1 - std::copysign(mu * g * half * dt, slip),
                  3 * mu * g * h + half * dt / h * solver.rounding);
      // In single precision every sub-step of sliding rounds what it takes off the speed.
      const double rounded = stop / h * solver.rounding * std::max(1.0, std::abs(u0));
      double time = half * dt;
      while (std::abs(run->velocity(0).x + run->surface_speed(0)) > 1e-4 && time < 2 * stop + 0.1)
        run->step(), time += dt;
      start.add(where, time, stop, dt + 3 * h + rounded / (mu * g));
      run->run(0.5);
      end.add(where, run->velocity(0).x, rolling, 1e-5 + rounded);
      spin.add(where, -run->surface_speed(0) / kRadius, rolling / kRadius, (1e-5 + rounded) / kRadius);
    }
  return {sliding.row("velocity half-way to rolling", "m/s", "friction may begin three sub-steps late"),
          start.row("time at which it rolls", "s", "seen at the end of a step, three sub-steps late, and rounding"),
          end.row("velocity 0.5 s later", "m/s", "1e-5 of v0, and one rounding per sub-step of sliding"),
          spin.row("spin 0.5 s later", "rad/s", "that of the velocity")};
}

}  // namespace

std::vector<Law> rolling_laws() {
  return {{"ADiscOnAnInclineRollsUpToTanEquals3Mu", disc_on_an_incline},
          {"ASlidingDiscRollsWithTwoThirdsOfItsSpeed", sliding_disc}};
}

}  // namespace seapile::verification
