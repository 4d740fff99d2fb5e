#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace seapile::base {

/// Named stopwatches. What they show is part of a result; it never steers one.
class Profile {
 public:
  struct Entry {
    std::string part;
    double seconds = 0;
    std::int64_t calls = 0;
  };

  /// Index of a part, created when new.
  std::size_t index(std::string_view part) {
    for (std::size_t k = 0; k < entries_.size(); ++k)
      if (entries_[k].part == part) return k;
    entries_.push_back({std::string(part), 0, 0});
    return entries_.size() - 1;
  }
  void add(std::size_t part, double seconds) {
    entries_[part].seconds += seconds;
    ++entries_[part].calls;
  }
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  std::vector<Entry> entries_;
};

/// Adds the time from its construction to its end to one part.
class Stopwatch {
 public:
  Stopwatch(Profile& profile, std::size_t part) : profile_(profile), part_(part), start_(Clock::now()) {}
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;
  ~Stopwatch() { profile_.add(part_, std::chrono::duration<double>(Clock::now() - start_).count()); }

 private:
  using Clock = std::chrono::steady_clock;
  Profile& profile_;
  std::size_t part_;
  Clock::time_point start_;
};

}  // namespace seapile::base
