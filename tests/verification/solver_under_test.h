// The one door between the laws and the contact solvers: a law describes a scene, a solver runs it. A solver joins the
// verification by a line in solvers().
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/contact_scene.h"
#include "tests/support/reference_solver.h"

namespace seapile::verification {

/// A scene at its start.
struct Setup {
  std::vector<grains::Disc> discs;
  std::vector<double> masses = {};          ///< [kg/m], (discs); empty: of density support::kDensity
  std::vector<base::Vec2> velocities = {};  ///< [m/s], (discs); empty: at rest
  std::vector<double> surface_speeds = {};  ///< u = r omega [m/s], (discs); empty: no spin
  grains::Box box = {-support::kFar, support::kFar, 0};
  grains::ContactLaw law = {};
  std::optional<grains::RigidBody> body = {};  ///< stands still
};

/// A scene that some solver moves on, step by step.
class Running {
 public:
  Running() = default;
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;
  virtual ~Running() = default;

  virtual void step() = 0;
  virtual grains::ContactLaw& law() = 0;
  virtual grains::Box& box() = 0;
  virtual int count() const = 0;
  virtual grains::Disc disc(int i) const = 0;
  virtual double mass(int i) const = 0;           ///< [kg/m]
  virtual base::Vec2 velocity(int i) const = 0;   ///< [m/s]
  virtual double surface_speed(int i) const = 0;  ///< u = r omega, anticlockwise [m/s]
  /// With the impulses of the last step.
  virtual std::vector<grains::TouchingContact> contacts() const = 0;

  /// Steps over a time, rounded to whole steps [s].
  void run(double time) {
    for (int k = static_cast<int>(time / law().step + 0.5); k > 0; --k) step();
  }
  /// Length of a sub-step [s].
  double substep() { return law().step / law().substeps; }
};

/// The production solver in one number format.
template <class Real>
class ProductionRun final : public Running {
 public:
  explicit ProductionRun(const Setup& setup) : scene_(setup.discs, setup.masses) {
    scene_.box = setup.box;
    scene_.law = setup.law;
    scene_.body = setup.body;
    scene_.team.instructions = grains::fastest();
    for (int i = 0; i < count(); ++i) {
      if (!setup.velocities.empty()) scene_.set_velocity(i, setup.velocities[i]);
      if (!setup.surface_speeds.empty()) scene_.system.motion(i).u = static_cast<Real>(setup.surface_speeds[i]);
    }
  }
  void step() override { scene_.step(); }
  grains::ContactLaw& law() override { return scene_.law; }
  grains::Box& box() override { return scene_.box; }
  int count() const override { return static_cast<int>(scene_.grains.count()); }
  grains::Disc disc(int i) const override { return scene_.disc(i); }
  double mass(int i) const override { return scene_.grains.mass[i]; }
  base::Vec2 velocity(int i) const override { return scene_.velocity(i); }
  double surface_speed(int i) const override { return static_cast<double>(scene_.system.motion(i).u); }
  std::vector<grains::TouchingContact> contacts() const override { return scene_.touching(); }

 private:
  support::ContactScene<Real> scene_;
};

/// The brute-force solver of tests/support. It keeps the impulses of the last sub-step only: right at rest.
class ReferenceRun final : public Running {
 public:
  explicit ReferenceRun(const Setup& setup) {
    const grains::Grains made = support::grains_from(setup.discs, setup.masses);
    for (std::size_t i = 0; i < setup.discs.size(); ++i) {
      const base::Vec2 v = setup.velocities.empty() ? base::Vec2{} : setup.velocities[i];
      const double u = setup.surface_speeds.empty() ? 0 : setup.surface_speeds[i];
      solver_.grain.push_back({setup.discs[i], made.mass[i], v.x, v.y, u});
    }
    solver_.box = setup.box;
    solver_.law = setup.law;
    solver_.body = setup.body;
  }
  void step() override { solver_.step(); }
  grains::ContactLaw& law() override { return solver_.law; }
  grains::Box& box() override { return solver_.box; }
  int count() const override { return static_cast<int>(solver_.grain.size()); }
  grains::Disc disc(int i) const override { return solver_.grain[i].disc; }
  double mass(int i) const override { return solver_.grain[i].mass; }
  base::Vec2 velocity(int i) const override { return {solver_.grain[i].vx, solver_.grain[i].vy}; }
  double surface_speed(int i) const override { return solver_.grain[i].u; }
  std::vector<grains::TouchingContact> contacts() const override {
    std::vector<grains::TouchingContact> touching;
    for (const auto& [bodies, p] : solver_.impulse) {
      if (!(p.first > 0)) continue;
      const auto [i, j] = bodies;
      const grains::Disc& d = solver_.grain[i].disc;
      double nx = 0, ny = 0, distance = 0, size = d.radius;
      if (j >= 0) {
        const grains::Disc& other = solver_.grain[j].disc;
        const double length = std::hypot(other.x - d.x, other.y - d.y);
        nx = (other.x - d.x) / length, ny = (other.y - d.y) / length;
        distance = length - other.radius;
        size = std::min(size, other.radius);
      } else if (j == support::ReferenceSolver::kBody) {
        const grains::NearestPlace place = nearest_place(*solver_.body, {d.x, d.y});
        nx = place.nx, ny = place.ny, distance = place.distance;
      } else if (j == support::ReferenceSolver::kBase) {
        ny = -1, distance = d.y - solver_.box.base;
      } else {
        const bool left = j == support::ReferenceSolver::kLeft;
        nx = left ? -1 : 1, distance = left ? d.x - solver_.box.left : solver_.box.right - d.x;
      }
      const double substeps = solver_.law.substeps, gap = distance - d.radius;
      touching.push_back({i, j, d.x + nx * (d.radius + 0.5 * gap), d.y + ny * (d.radius + 0.5 * gap), nx, ny,
                          -gap / size, p.first * substeps, p.second * substeps});
    }
    return touching;
  }

 private:
  support::ReferenceSolver solver_;
};

/// How a solver treats a contact. A law may ask for another tolerance by it.
enum class Method { soft };

struct Solver {
  std::string name;  ///< letters, digits and underscores
  Method method = Method::soft;
  double rounding = 0;   ///< of one operation on a velocity, as a share
  bool rebounds = true;  ///< knows restitution
  bool fast = true;      ///< may be asked for hundreds of grains
  std::function<std::unique_ptr<Running>(const Setup&)> start;
};

template <class Run>
std::unique_ptr<Running> start(const Setup& setup) {
  return std::make_unique<Run>(setup);
}

/// All that is verified.
inline const std::vector<Solver>& solvers() {
  static const std::vector<Solver> all = {
      {"production_single", Method::soft, std::numeric_limits<float>::epsilon(), true, true,
       start<ProductionRun<float>>},
      {"production_double", Method::soft, std::numeric_limits<double>::epsilon(), true, true,
       start<ProductionRun<double>>},
      {"reference", Method::soft, std::numeric_limits<double>::epsilon(), false, false, start<ReferenceRun>},
  };
  return all;
}

}  // namespace seapile::verification
