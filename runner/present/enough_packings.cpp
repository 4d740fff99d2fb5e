#include "runner/present/enough_packings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace seapile::present {
namespace {

/// The magnitude of a case's mean over all its metrics.
double level_of(const PackingsOfCase& one) {
  double sum = 0;
  for (const auto& values : one.values) sum += mean_of(values).value;
  return std::abs(sum / static_cast<double>(one.values.size()));
}

}  // namespace

PackingRound next_round(const std::vector<PackingsOfCase>& cases, std::size_t packings, const PackingsAsked& asked) {
  PackingRound round;
  round.packings = round.needed = round.next = packings;
  round.cases = cases.size();
  for (const PackingsOfCase& one : cases) {
    const double level = level_of(one);
    bool wide = false;
    for (const auto& values : one.values) {
      const Interval mean = mean_interval(values);
      if (values.size() < 2) {  // one packing says nothing
        wide = true;
        round.widest = std::numeric_limits<double>::infinity();
        round.widest_case = one.labels;
        continue;
      }
      const double half = (mean.high - mean.low) / 2;
      const double share = half == 0 ? 0 : half / level;  // of a level of nothing any width is too much
      if (share > round.widest) {
        round.widest = share;
        round.widest_case = one.labels;
      }
      if (!(share > asked.half_width)) continue;
      wide = true;
      const double sd = mean_of(values).standard_error * std::sqrt(static_cast<double>(values.size()));
      const auto needed = sample_for_half_width(sd, asked.half_width * level);
      round.needed = std::max(round.needed, needed.value_or(std::numeric_limits<std::size_t>::max()));
    }
    round.wide += wide ? 1 : 0;
  }
  if (round.wide > 0) {
    // Rounding may find that as many as there are would do.
    round.needed = std::max(round.needed, packings + 1);
    round.next = std::max(packings, std::min({round.needed, 2 * packings, asked.at_most}));
  }
  return round;
}

std::string round_text(const PackingRound& round, const PackingsAsked& asked) {
  const double widest = 100 * round.widest;
  const std::string width = widest < 100 ? fmt::format("{:.2g}", widest) : fmt::format("{:.0f}", widest);
  std::string line = fmt::format("{} packings: {} is known within ± {} %", round.packings, asked.metric, width);
  std::string where;
  for (const auto& [path, value] : round.widest_case)
    where += fmt::format("{}{}={}", where.empty() ? "" : ", ", path, value);
  if (!where.empty()) line += fmt::format(" at {}", where);
  line += fmt::format(", {:.4g} % asked for", 100 * asked.half_width);
  if (round.wide == 0) return line + ": enough";
  if (round.cases > 1) line += fmt::format(" ({} of {} cases too wide)", round.wide, round.cases);
  const bool known = round.needed < std::numeric_limits<std::size_t>::max();
  line += known ? fmt::format(": about {} would do", round.needed) : ": more than a million would be needed";
  if (round.next == round.packings) return line + fmt::format(", {} is the most", asked.at_most);
  return line + fmt::format(", {} next", round.next);
}

}  // namespace seapile::present
