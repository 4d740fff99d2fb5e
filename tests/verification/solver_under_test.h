// The one door between the laws and the contact solvers: a law describes a scene, a solver runs it. A solver joins the
// verification by a line in solvers().
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "tests/support/contact_scene.h"

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
  double substep() { return law().step / substeps(law()); }
};

/// A solver of the product. `Solver`: float or double for blocks, or AllPairs.
template <class Solver>
class SceneRun final : public Running {
 public:
  SceneRun(const Setup& setup, const std::optional<grains::NonSmooth>& nonsmooth) : scene_(setup.discs, setup.masses) {
    scene_.box = setup.box;
    scene_.law = setup.law;
    if (nonsmooth) {
      scene_.law.nonsmooth = nonsmooth;
      scene_.law.step = setup.law.step / kNonSmoothSteps;
    }
    scene_.body = setup.body;
    scene_.team.instructions = grains::fastest();
    for (int i = 0; i < count(); ++i) {
      if (!setup.velocities.empty()) scene_.set_velocity(i, setup.velocities[i]);
      auto& u = scene_.system.motion(i).u;
      if (!setup.surface_speeds.empty()) u = static_cast<std::remove_reference_t<decltype(u)>>(setup.surface_speeds[i]);
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
  static constexpr int kNonSmoothSteps = 5;  ///< per step of the soft method: 1e-4 s, the thesis' step
  support::ContactScene<Solver> scene_;
};

/// How a solver treats a contact. A law may ask for another tolerance by it.
enum class Method { soft, nonsmooth };

struct Solver {
  std::string name;  ///< letters, digits and underscores
  Method method = Method::soft;
  double rounding = 0;  ///< of one operation on a velocity, as a share
  bool fast = true;     ///< may be asked for hundreds of grains, again and again
  bool slow = false;    ///< compares all with all
  std::function<std::unique_ptr<Running>(const Setup&)> start;
};

template <class Real>
Solver solver(std::string name, bool fast, const std::optional<grains::NonSmooth>& nonsmooth = {}) {
  const double rounding = std::is_same_v<Real, float> ? std::numeric_limits<float>::epsilon()
                                                      : std::numeric_limits<double>::epsilon();
  return {std::move(name), nonsmooth ? Method::nonsmooth : Method::soft, rounding, fast, std::is_same_v<Real, grains::AllPairs>,
          [nonsmooth](const Setup& setup) { return std::make_unique<SceneRun<Real>>(setup, nonsmooth); }};
}

/// All that is verified. The non-smooth solvers go far enough that their residual is not what a law sees.
inline const std::vector<Solver>& solvers() {
  static const grains::NonSmooth converged{5000, 1e-9, 1e-3};
  static const std::vector<Solver> all = {solver<float>("production_single", true),
                                          solver<double>("production_double", true),
                                          solver<double>("nonsmooth", false, converged),
                                          solver<grains::AllPairs>("brute_force", false),
                                          solver<grains::AllPairs>("brute_force_nonsmooth", false, converged)};
  return all;
}

}  // namespace seapile::verification
