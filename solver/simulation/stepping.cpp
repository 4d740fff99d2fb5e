#include "solver/simulation/stepping.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

#include "solver/simulation/run.h"

namespace seapile::simulation {

Array as_array(const Stepping& stepping, const char* name) {
  std::vector<std::int64_t> values{stepping.calm, stepping.smallest};
  values.insert(values.end(), stepping.rejected.begin(), stepping.rejected.end());
  return {{name, "-", "steps since their size changed, most halvings, steps rejected by cause", 1, Entity::run},
          std::move(values)};
}

Stepping stepping_of(const std::vector<Array>& state, const char* name) {
  Stepping stepping;
  for (const Array& array : state) {
    if (array.info.name != name) continue;
    const auto* values = std::get_if<std::vector<std::int64_t>>(&array.values);
    if (!values || values->size() != 2 + stepping.rejected.size())
      throw std::invalid_argument("state: " + array.info.name + ": of another length or type");
    stepping.calm = (*values)[0];
    stepping.smallest = static_cast<int>((*values)[1]);
    std::copy(values->begin() + 2, values->end(), stepping.rejected.begin());
  }
  return stepping;
}

std::vector<Metric> metrics_of(const Stepping& stepping, double dt, const char* unit, const char* scale) {
  const auto& rejected = stepping.rejected;
  const std::int64_t all = std::accumulate(rejected.begin(), rejected.end(), std::int64_t{0});
  std::vector<Metric> metrics{
      {"steps_rejected", static_cast<double>(all), "-", "steps objected to, whose stretch was done again"},
      {"step_smallest", std::ldexp(dt, -stepping.smallest), unit, std::string("smallest step tried") + scale}};
  for (std::size_t c = 0; c < rejected.size(); ++c)
    if (rejected[c] > 0)
      metrics.push_back({std::string("steps_rejected_") + base::kCauseTexts[c].name, static_cast<double>(rejected[c]),
                         "-", base::kCauseTexts[c].meaning});
  return metrics;
}

void count_accepted(Stepping& stepping, const base::Clock& clock) {
  if (clock.halvings > 0) ++stepping.calm;
}

bool may_grow(const Stepping& stepping, const base::Clock& clock, int count) {
  return clock.halvings > 0 && stepping.calm >= kCalmSteps && clock.begins(count, clock.halvings - 1);
}

Remedy Attempts::after(int halvings, bool can_remesh) {
  rejected_ = true;
  if (halvings < base::kMostHalvings) {
    halvings_ = std::max(start_, halvings + 1);
    return Remedy::halve;
  }
  if (!can_remesh || remeshed_) return Remedy::stop;
  remeshed_ = true;
  halvings_ = start_;
  return Remedy::remesh;
}

}  // namespace seapile::simulation
