// What the user sees of a running study, on standard error: one line per event, and on a terminal a last line that
// keeps changing. Standard output is for data.
#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "runner/execute/pool.h"

namespace seapile::execute {

/// A case that is being computed.
struct Going {
  Kind kind = Kind::drive;
  double start_fraction = 0;  ///< where this attempt began
  double fraction = 0;
  double elapsed = 0;  ///< [s] of this attempt
};

/// Wall time [s] that is left; absent while nothing is known of one of the cases. `waiting_beds` and `waiting_drives`
/// have not been started; `finished_beds` and `finished_drives` are the wall times of those that have ended.
struct Outlook {
  std::vector<Going> going;
  int waiting_beds = 0, waiting_drives = 0;
  std::vector<double> finished_beds, finished_drives;
  int at_a_time = 1;  ///< cases
};
std::optional<double> seconds_left(const Outlook& outlook);

/// "0:42", "12:03", "1:02:03".
std::string clock_text(double seconds);

/// "6.5 s" up to a minute, then as a clock.
std::string duration_text(double seconds);

class Display {
 public:
  /// Writes to `stream`; with a line that keeps changing when `terminal`.
  Display(const Plan& plan, std::FILE* stream, bool terminal);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  /// Callbacks for the pool, which refer to this object.
  Watch watch();

 private:
  using Clock = std::chrono::steady_clock;
  struct Row {
    State state = State::waiting;
    double start_fraction = -1;  ///< below 0: not yet told
    double fraction = 0;
    Clock::time_point since;
    std::optional<double> seconds;  ///< when completed
  };

  void event(const std::string& verb, std::size_t task, const std::string& more);
  void redraw();
  std::string status() const;

  const Plan& plan_;
  std::FILE* stream_;
  bool terminal_;
  std::vector<Row> rows_;
  Clock::time_point drawn_;
};

}  // namespace seapile::execute
