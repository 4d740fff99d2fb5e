// What is measured of a running scene.
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/grains/fields_on_grid.h"
#include "tests/verification/solver_under_test.h"

namespace seapile::verification {

/// What a closed soft contact hands back of a speed v that it is hit with: it takes all but 1 / (1 + a2) of it in the
/// first sub-step, and pushes the overlap of v h / (1 + a2) apart with the rate b (formulation.md 2.2).
inline double soft_push(Running& run) {
  const grains::ContactLaw& law = run.law();
  const double omega_h = 2 * std::numbers::pi * law.stiffness, a1 = 2 * law.damping + omega_h, a2 = omega_h * a1;
  return omega_h / a1 / (1 + a2);
}

inline double weight(Running& run) {
  double mass = 0;
  for (int i = 0; i < run.count(); ++i) mass += run.mass(i);
  return mass * run.law().gravity;
}

inline double kinetic_energy(const Running& run) {
  double sum = 0;
  for (int i = 0; i < run.count(); ++i) {
    const base::Vec2 v = run.velocity(i);
    const double u = run.surface_speed(i);
    sum += 0.5 * run.mass(i) * (dot(v, v) + 0.5 * u * u);
  }
  return sum;
}

inline double potential_energy(Running& run) {
  double sum = 0;
  for (int i = 0; i < run.count(); ++i) sum += run.mass(i) * run.law().gravity * run.disc(i).y;
  return sum;
}

inline base::Vec2 momentum(const Running& run) {
  base::Vec2 sum;
  for (int i = 0; i < run.count(); ++i) sum = sum + run.mass(i) * run.velocity(i);
  return sum;
}

/// About the origin, spins included [kg m/s].
inline double angular_momentum(const Running& run) {
  double sum = 0;
  for (int i = 0; i < run.count(); ++i) {
    const grains::Disc d = run.disc(i);
    const base::Vec2 v = run.velocity(i);
    sum += run.mass(i) * (d.x * v.y - d.y * v.x + 0.5 * d.radius * run.surface_speed(i));
  }
  return sum;
}

inline double centre_of_mass_x(const Running& run) {
  double mass = 0, sum = 0;
  for (int i = 0; i < run.count(); ++i) mass += run.mass(i), sum += run.mass(i) * run.disc(i).x;
  return sum / mass;
}

/// Root mean square of the grains' speeds [m/s].
inline double rms_speed(const Running& run) {
  double sum = 0;
  for (int i = 0; i < run.count(); ++i) sum += dot(run.velocity(i), run.velocity(i));
  return std::sqrt(sum / run.count());
}

/// Runs until the rms speed is below `speed` [m/s], looking every 0.05 s, or for a time [s]. True when it is.
inline bool come_to_rest(Running& run, double speed, double longest) {
  for (double time = 0; time < longest; time += 0.05) {
    run.run(0.05);
    if (rms_speed(run) < speed) return true;
  }
  return false;
}

using Forces = std::map<std::pair<int, int>, grains::ContactForce>;

/// Contact forces between bodies, as means over a time [s]; single steps are no physics.
inline Forces mean_forces(Running& run, double time) {
  Forces forces;
  const int steps = static_cast<int>(time / run.law().step + 0.5);
  for (int k = 0; k < steps; ++k) {
    run.step();
    for (const grains::TouchingContact& c : run.contacts()) {
      grains::ContactForce& f = forces[{c.first, c.second}];
      f = {c.first, c.second, c.x, c.y, c.nx, c.ny, f.normal + c.pn, f.tangential + c.pt};
    }
  }
  for (auto& [bodies, f] : forces) f.normal /= steps * run.law().step, f.tangential /= steps * run.law().step;
  return forces;
}

/// Force on the second body [N/m].
inline base::Vec2 force(const grains::ContactForce& f) {
  return {f.normal * f.nx - f.tangential * f.ny, f.normal * f.ny + f.tangential * f.nx};
}

/// Downward force on the base [N/m].
inline double base_force(const Forces& forces) {
  double sum = 0;
  for (const auto& [bodies, f] : forces)
    if (bodies.second == -3) sum -= force(f).y;
  return sum;
}

/// Mean and its standard error.
struct Mean {
  double value = 0, error = 0;
};
inline Mean mean_of(const std::vector<double>& sample) {
  Mean mean;
  const double n = static_cast<double>(sample.size());
  for (const double s : sample) mean.value += s / n;
  double square = 0;
  for (const double s : sample) square += (s - mean.value) * (s - mean.value);
  mean.error = std::sqrt(square / (n * (n - 1)));
  return mean;
}

/// Straight line y = intercept + slope x by least squares, with the slope's standard error.
struct Line {
  double slope = 0, intercept = 0, slope_error = 0;
};
inline Line line_through(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mx = 0, my = 0, xx = 0, xy = 0, rest = 0;
  for (std::size_t k = 0; k < x.size(); ++k) mx += x[k] / n, my += y[k] / n;
  for (std::size_t k = 0; k < x.size(); ++k) xx += (x[k] - mx) * (x[k] - mx), xy += (x[k] - mx) * (y[k] - my);
  Line line{xy / xx, my - xy / xx * mx, 0};
  for (std::size_t k = 0; k < x.size(); ++k) {
    const double off = y[k] - line.intercept - line.slope * x[k];
    rest += off * off;
  }
  line.slope_error = std::sqrt(rest / ((n - 2) * xx));
  return line;
}

}  // namespace seapile::verification
