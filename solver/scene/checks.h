// What the checks of all kinds of scenes share: bounds, words, and what a pile does in a time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "solver/base/problem.h"
#include "solver/pile/pile_spec.h"

namespace seapile::scene {

inline constexpr double kMostSteps = 1e9;
inline constexpr double kMostRecords = 1e6;
inline constexpr std::size_t kMostFrames = 10'000;

/// Six digits, and the unit.
std::string text(double number);
std::string text(double number, const char* unit);

/// What a drive does in a time, each bounded from above.
struct Motion {
  double down;  ///< deepest displacement [m]
  double up;    ///< highest displacement [m]
  double path;  ///< length of the way up and down [m]
};
Motion motion(const pile::Driving& driving, double time);

/// Duration of a run as far as its scene tells it [s]; infinite when it never ends.
double duration(const pile::PileSpec& pile);

/// Speed averaged over a period [m/s]; a sine by itself goes nowhere.
double mean_speed(const pile::Driving& driving);

/// Largest speed [m/s].
double largest_speed(const pile::Driving& driving);

/// R/tan(alpha/2), from the apex to the shoulder; 0 for a flat tip [m].
double tip_height(double radius, const pile::Tip& tip);

/// "/pile/driving/constant/speed": where a member of the driving at `pointer` stands.
std::string driving_pointer(const std::string& pointer, const pile::Driving& driving, const char* key);

/// A vibration needs its steps in each period. `pointer`: of the driving.
void check_period(const pile::Driving& driving, double step, const std::string& pointer, base::Problems& problems);

/// The words for a list of places at which frames are kept.
struct FrameWords {
  const char* key;       ///< "frames"
  const char* singular;  ///< "depth"
  const char* beyond;    ///< said of a place that is not reached
  const char* unit;
};
/// Few enough, each once, none beyond `most`.
void check_frames(const std::vector<double>& frames, double most, const FrameWords& words, base::Problems& problems);

}  // namespace seapile::scene
