#include "solver/simulation/settle.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>

#include "solver/simulation/objection.h"
#include "solver/simulation/observe.h"
#include "solver/simulation/step.h"

namespace seapile::simulation {
namespace {

constexpr std::int64_t kStretch = 20;    // steps between two states to go back to: about a record's time
constexpr double kRecordTime = 0.01;     // [s] between two records
constexpr double kRestTime = 0.05;       // [s] over which a bed must be at rest
constexpr double kRestSpeed = 1e-4;      // [m/s] rms
constexpr double kRestBaseError = 1e-3;  // of the weight

double rms_speed(const Simulation& sim) {
  double sum = 0;
  for (const base::Vec2 v : velocities_of(sim)) sum += dot(v, v);
  return std::sqrt(sum / static_cast<double>(sim.grains.count()));
}

double weight(const Simulation& sim) {
  double mass = 0;
  for (const double m : sim.grains.mass) mass += m;
  return mass * sim.law.gravity;
}

/// A bed on its way to rest, from a simulation's present state.
class Settling {
 public:
  Settling(Simulation& sim, double longest, const Trying& trying, std::vector<Record>& records,
           const std::function<void(double)>& progress, const std::optional<Easing>& easing)
      : sim_(sim),
        longest_(longest),
        stretch_(trying.stretch > 0 ? trying.stretch : kStretch),
        reject_at_(trying.reject_at),
        records_(records),
        progress_(progress),
        easing_(easing),
        stiffness_(std::ldexp(sim.law.stiffness, sim.clock.halvings)),
        start_time_(sim.clock.time()),
        weight_(weight(sim)) {}

  Settled run() {
    now_.until = start_time_ + kRecordTime;
    begin_stretch();
    for (;;) {
      if (!at_rest() && steps_ < stretch_) {
        advance();
      } else if (const Objection why = motion_objection(energy_level(sim_)); !why.empty()) {
        reject(why);
      } else {
        if (at_rest()) return now_.settled;
        begin_stretch();
      }
    }
  }

 private:
  /// Where the loop stands beside the simulation's state.
  struct Place {
    double until = 0;  ///< of the present record [s]
    int at_rest = 0;   ///< records at rest, one after the other
    Settled settled;
  };

  bool at_rest() const { return now_.at_rest >= std::lround(kRestTime / kRecordTime); }

  void begin_stretch() {
    trial_.emplace(sim_);
    attempts_ = Attempts(sim_.clock.halvings);
    start_ = now_;
    start_records_ = records_.size();
    steps_ = 0;
  }

  /// Gives the contacts the stiffness that they have by now, k by (f h)^2.
  void ease() {
    if (!easing_) return;
    const double share = std::min(1.0, (sim_.clock.time() + sim_.clock.size() - start_time_) / easing_->time);
    const double from = 1 / (easing_->from * easing_->from), to = 1 / (stiffness_ * stiffness_);
    const double whole = share < 1 ? 1 / std::sqrt(from + share * (to - from)) : stiffness_;
    sim_.law.stiffness = std::ldexp(whole, -sim_.clock.halvings);
  }

  void advance() {
    if (!attempts_.rejected() && may_grow(sim_.stepping, sim_.clock, 1)) set_halvings(sim_, sim_.clock.halvings - 1);
    ease();
    const StepReport report = step(sim_);
    if (const Objection why = objection(sim_, report); !why.empty()) return reject(why);
    gather(sim_, report);
    ++steps_;
    count_accepted(sim_.stepping, sim_.clock);
    if (sim_.clock.step == reject_at_) {
      reject_at_ = -1;
      return go_back();
    }
    if (sim_.clock.time() >= now_.until - 0.5 * sim_.clock.size()) take();
  }

  /// Takes a record and looks whether the bed is at rest.
  void take() {
    records_.push_back(take_record(sim_));
    Settled& settled = now_.settled;
    settled = {sim_.clock.time() - start_time_, std::abs(records_.back().base_force / weight_ - 1), rms_speed(sim_)};
    const bool eased = !easing_ || settled.time >= easing_->time;
    const bool rests = eased && settled.rms_speed < kRestSpeed && settled.base_error < kRestBaseError;
    now_.at_rest = rests ? now_.at_rest + 1 : 0;
    now_.until = sim_.clock.time() + kRecordTime;
    progress_(settled.time);
    if (settled.time > longest_)
      throw std::runtime_error("the bed is not at rest after the longest settling time: rms speed " +
                               std::to_string(settled.rms_speed) + " m/s, base force off by " +
                               std::to_string(100 * settled.base_error) + " %");
  }

  /// Everything returns to the stretch's start.
  void go_back() {
    Stepping known = sim_.stepping;
    trial_->reject(sim_);
    known.calm = sim_.stepping.calm;
    sim_.stepping = known;
    set_halvings(sim_, attempts_.halvings());
    now_ = start_;
    records_.resize(start_records_);
    steps_ = 0;
  }

  void reject(const Objection& why) {
    ++sim_.stepping.rejected[static_cast<std::size_t>(why.cause)];
    const Remedy remedy = attempts_.after(sim_.clock.halvings, false);
    go_back();
    if (remedy == Remedy::stop) throw std::runtime_error("the bed does not settle: " + why.why);
  }

  Simulation& sim_;
  double longest_;
  std::int64_t stretch_, reject_at_;
  std::vector<Record>& records_;
  const std::function<void(double)>& progress_;
  const std::optional<Easing>& easing_;
  double stiffness_;  ///< f h of a whole step, at the end of the easing [-]
  double start_time_, weight_;
  Place now_;

  // Of the stretch.
  std::optional<Trial> trial_;
  Attempts attempts_{0};
  Place start_;
  std::size_t start_records_ = 0;
  std::int64_t steps_ = 0;
};

}  // namespace

Settled settle(Simulation& sim, double longest, const Trying& trying, std::vector<Record>& records,
               const std::function<void(double)>& progress, const std::optional<Easing>& easing) {
  return Settling(sim, longest, trying, records, progress, easing).run();
}

}  // namespace seapile::simulation
