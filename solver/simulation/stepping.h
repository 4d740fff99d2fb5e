// What becomes of a stretch of steps of which one cannot be accepted, and what a result says of it.
//
// A run goes on in stretches. Where a step is objected to, the whole state returns to the stretch's start and the
// stretch is tried again: with steps of half the size, of the grains and of the fluid together, up to kMostHalvings
// times; then, where the scene lets its mesh be made anew, on a new mesh, once; then the run has diverged. After
// kCalmSteps accepted steps the size doubles again, where the larger step begins. What a stretch hands out is held back
// until it is accepted.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/base/clock.h"
#include "solver/base/objection.h"
#include "solver/simulation/array.h"

namespace seapile::simulation {

struct Metric;

using base::Cause;
using base::Objection;

/// Accepted steps before the size doubles again.
inline constexpr std::int64_t kCalmSteps = 20;

/// A run's rejected steps; part of the state, so that a resumed run says the same.
struct Stepping {
  std::int64_t calm = 0;  ///< steps since their size has changed; 0 while they are whole
  int smallest = 0;       ///< halvings of the smallest step tried
  std::array<std::int64_t, base::kCauses> rejected = {};  ///< steps objected to, by cause
  friend bool operator==(const Stepping&, const Stepping&) = default;
};

/// As an array called `name`. The state of a run of which no step was rejected has none: it is what it would be
/// without.
Array as_array(const Stepping& stepping, const char* name);
/// What the array was made of; nothing rejected where there is none. Throws std::invalid_argument when it does not fit.
Stepping stepping_of(const std::vector<Array>& state, const char* name);

/// steps_rejected, step_smallest, and steps_rejected_<cause> for each cause there was. `dt`: of a whole step, in
/// `unit`, or in what `scale` says of it.
std::vector<Metric> metrics_of(const Stepping& stepping, double dt, const char* unit = "s", const char* scale = "");

/// Counts an accepted step.
void count_accepted(Stepping& stepping, const base::Clock& clock);

/// Whether the size may double now; a step of a fluid has `count` of the clock's.
bool may_grow(const Stepping& stepping, const base::Clock& clock, int count);

/// How a stretch is tried again.
enum class Remedy { halve, remesh, stop };

/// The attempts at one stretch.
class Attempts {
 public:
  /// `halvings`: of the steps at its start.
  explicit Attempts(int halvings) : start_(halvings), halvings_(halvings) {}
  /// After an objection to a step of so many halvings.
  Remedy after(int halvings, bool can_remesh);
  /// Of the steps of the next attempt.
  int halvings() const { return halvings_; }
  /// Once a stretch has been rejected its steps keep their size.
  bool rejected() const { return rejected_; }
  bool remeshed() const { return remeshed_; }

 private:
  int start_, halvings_;
  bool rejected_ = false, remeshed_ = false;
};

}  // namespace seapile::simulation
