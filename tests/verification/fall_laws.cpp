// One disc above the base: MFiX-DEM's cases DEM01 and DEM02.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/verification/law.h"

namespace seapile::verification {
namespace {

constexpr double kRadius = 0.1, kHeight = 0.5;  // of the centre at the start [m]

/// The particle of MFiX-DEM's cases, at rest.
Setup particle() {
  Setup setup{{{0, kHeight, kRadius, 0}}};
  setup.masses = {2600 * std::numbers::pi * kRadius * kRadius};
  return setup;
}

std::vector<Row> free_fall(const Solver& solver, Size) {
  const auto run = solver.start(particle());
  const double g = run->law().gravity, time = 0.25, h = run->substep();
  run->run(time);
  const double steps = time / h;
  return {{"height of the centre after 0.25 s", "m", "h0 = 0.5 m", run->disc(0).y, kHeight - 0.5 * g * time * time,
           0.5 * g * h * time + 100 * solver.rounding, "velocity first, then place: the fall is longer by g h t / 2"},
          {"velocity after 0.25 s", "m/s", "h0 = 0.5 m", run->velocity(0).y, -g * time,
           steps * g * time * solver.rounding, "one rounding per sub-step"}};
}

std::vector<Row> bounces(const Solver& solver, Size) {
  std::vector<Row> rows;
  for (const double e : {0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
    Setup setup = particle();
    setup.law.restitution = e;
    const auto run = solver.start(setup);
    const double g = run->law().gravity, drop = kHeight - kRadius, dt = run->law().step;
    const double speed = std::sqrt(2 * g * drop);
    Worst worst;
    bool rising = false;
    double top = 0, longest = 2 * speed / g;  // of the fall and five bounces, with a margin [s]
    for (int k = 1; k <= 5; ++k) longest += 3 * std::pow(e, k) * speed / g;
    int bounce = 0;
    const auto landed = [&] {
      const double share = std::pow(e, bounce), v = share * speed;
      worst.add(fmt::format("e = {}, bounce {}", e, bounce), top, kRadius + drop * share * share, bounce * v * dt);
    };
    for (double time = 0; time < longest && bounce <= 5; time += dt) {
      run->step();
      const double vy = run->velocity(0).y;
      if (!rising && vy > 0) rising = true, ++bounce, top = 0;
      if (!rising || bounce > 5) continue;
      top = std::max(top, run->disc(0).y);
      if (vy <= 0) rising = false, landed();
    }
    // A disc that stays on the base before its fifth bounce has a height of zero there.
    for (top = kRadius; bounce < 5;) ++bounce, landed();
    rows.push_back(worst.row(fmt::format("height after bounces of e = {}", e), "m",
                             "each rebound takes the speed of the start of its step, which lacks up to g dt"));
  }
  return rows;
}

}  // namespace

std::vector<Law> fall_laws() {
  return {{"AFreeDiscFalls", free_fall}, {"ABouncingDiscReachesEToThe2kOfItsHeight", bounces}};
}

}  // namespace seapile::verification
