#include "runner/execute/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <numeric>

#include "runner/execute/tint.h"

namespace seapile::execute {
namespace {

constexpr double kLeastFraction = 0.005;  // of a case, before its speed is believed
constexpr std::chrono::milliseconds kRedraw{200};

/// Wall time of a whole case, by what has been computed of it.
std::optional<double> projected(const Going& going) {
  const double done = going.fraction - going.start_fraction;
  return done < kLeastFraction ? std::nullopt : std::optional(going.elapsed / done);
}

std::optional<double> mean(const std::vector<double>& values) {
  if (values.empty()) return std::nullopt;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

int columns_of(std::FILE* stream) {
  winsize size = {};
  return ::ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

/// The first `width` characters of UTF-8 text.
std::string shortened(const std::string& text, int width) {
  int count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins_character = (static_cast<unsigned char>(text[i]) & 0xC0) != 0x80;
    if (begins_character && ++count > width) return text.substr(0, i);
  }
  return text;
}

}  // namespace

std::optional<double> seconds_left(const Outlook& outlook) {
  double total = 0, longest = 0;
  std::vector<double> beds = outlook.finished_beds, drives = outlook.finished_drives;
  for (const Going& going : outlook.going) {
    const auto whole = projected(going);
    if (!whole) return std::nullopt;
    (going.kind == Kind::bed ? beds : drives).push_back(*whole);
    const double left = *whole * std::max(0.0, 1 - going.fraction);
    total += left;
    longest = std::max(longest, left);
  }
  for (const auto& [waiting, known] :
       {std::pair(outlook.waiting_beds, mean(beds)), std::pair(outlook.waiting_drives, mean(drives))}) {
    if (waiting > 0 && !known) return std::nullopt;
    if (waiting > 0) total += waiting * *known;
  }
  return std::max(longest, total / std::max(1, outlook.at_a_time));
}

std::string clock_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::max(0.0, seconds)));
  const long long hours = whole / 3600, minutes = whole / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, whole % 60)
                   : fmt::format("{}:{:02}", minutes, whole % 60);
}

std::string duration_text(double seconds) {
  return seconds < 60 ? fmt::format("{:.1f} s", seconds) : clock_text(seconds);
}

Display::Display(const Plan& plan, std::FILE* stream, bool terminal)
    : plan_(plan), stream_(stream), terminal_(terminal), rows_(plan.tasks.size()) {}

Display::~Display() {
  if (terminal_) fmt::print(stream_, "\r\x1b[K");
  std::fflush(stream_);
}

Watch Display::watch() {
  Watch watch;
  watch.started = [this](std::size_t task, int threads) {
    Row& row = rows_[task];
    row = {State::running, -1, 0, Clock::now(), std::nullopt};
    event("started", task,
          fmt::format(" ({} thread{}): {}", threads, threads == 1 ? "" : "s", plan_.tasks[task].decision.reason));
  };
  watch.advanced = [this](std::size_t task, double fraction) {
    Row& row = rows_[task];
    // The first report of a resumed case says where it began; one that started from nothing began at 0.
    if (row.start_fraction < 0) {
      const bool resumed = plan_.tasks[task].decision.action == Action::resume;
      row.start_fraction = resumed ? fraction : 0;
      if (resumed) row.since = Clock::now();
    }
    row.fraction = fraction;
  };
  watch.changed = [this](std::size_t task, State state, const std::string& why) {
    Row& row = rows_[task];
    row.state = state;
    const double seconds = std::chrono::duration<double>(Clock::now() - row.since).count();
    switch (state) {
      case State::completed:
        if (why.empty()) row.seconds = seconds;
        event("completed", task, why.empty() ? fmt::format(" in {}", duration_text(seconds)) : " " + why);
        break;
      case State::elsewhere:
        event("waiting", task, ": " + why);
        break;
      case State::diverged:
        event("FAILED", task, ": " + why);
        break;
      case State::failed:
        event("FAILED", task, ": " + why);
        break;
      case State::blocked:
        event("NOT RUN", task, ": " + why);
        break;
      case State::stopped:
        event("stopped", task, ": " + why);
        break;
      case State::fresh:
      case State::waiting:
      case State::ready:
      case State::running:
        break;
    }
  };
  watch.retried = [this](std::size_t task, const std::string& why) { event("again", task, ": it was " + why); };
  watch.signalled = [this](int signal) {
    if (terminal_) fmt::print(stream_, "\r\x1b[K");
    fmt::print(stream_, "{}: the running cases seal a checkpoint; the same command continues them\n",
               signal == SIGINT ? "interrupted" : "asked to stop");
    std::fflush(stream_);
  };
  watch.tick = [this] {
    if (terminal_ && Clock::now() - drawn_ >= kRedraw) redraw();
  };
  return watch;
}

void Display::event(const std::string& verb, std::size_t task, const std::string& more) {
  if (terminal_) fmt::print(stream_, "\r\x1b[K");
  fmt::print(stream_, "{}\n", tinted(fmt::format("{:<9}  {}{}", verb, plan_.tasks[task].name, more), stream_));
  std::fflush(stream_);
  if (terminal_) redraw();
}

void Display::redraw() {
  fmt::print(stream_, "\r\x1b[K{}", shortened(status(), columns_of(stream_) - 1));
  std::fflush(stream_);
  drawn_ = Clock::now();
}

std::string Display::status() const {
  Outlook outlook;
  int done = 0, all = 0;
  std::vector<std::string> running;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& row = rows_[i];
    const Task& task = plan_.tasks[i];
    if (task.decision.action == Action::fresh && row.state == State::waiting) continue;
    ++all;
    const bool bed = task.kind == Kind::bed;
    if (row.seconds) (bed ? outlook.finished_beds : outlook.finished_drives).push_back(*row.seconds);
    if (row.state == State::running) {
      const double elapsed = std::chrono::duration<double>(Clock::now() - row.since).count();
      outlook.going.push_back({task.kind, std::max(0.0, row.start_fraction), row.fraction, elapsed});
      running.push_back(fmt::format("{} {:.0f} %", task.name, 100 * row.fraction));
    } else if (row.state == State::waiting || row.state == State::ready || row.state == State::elsewhere) {
      ++(bed ? outlook.waiting_beds : outlook.waiting_drives);
    } else {
      ++done;
    }
  }
  outlook.at_a_time = std::max<int>(1, static_cast<int>(outlook.going.size()));
  std::string line = fmt::format("{} of {} done", done, all);
  if (const auto left = seconds_left(outlook)) line += fmt::format(" · about {} left", clock_text(*left));
  if (!running.empty()) line += fmt::format(" · {}", fmt::join(running, " · "));
  const int waiting = outlook.waiting_beds + outlook.waiting_drives;
  if (waiting > 0) line += fmt::format(" · {} waiting", waiting);
  return line;
}

}  // namespace seapile::execute
