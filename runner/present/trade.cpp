#include "runner/present/trade.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace seapile::present {
namespace {

using Rows = std::vector<std::vector<double>>;  // pairs x bins

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostFlipped = 20;  // 2^20 choices of signs

double median(std::vector<double> values) {
  if (values.empty()) return kNone;
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<double> mean_of_rows(const Rows& rows) {
  std::vector<double> mean(rows.front().size(), 0);
  for (const auto& row : rows)
    for (std::size_t b = 0; b < mean.size(); ++b) mean[b] += row[b] / static_cast<double>(rows.size());
  return mean;
}

double norm(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum);
}

/// Norms of the mean of the rows under all choices of signs. The first sign is kept: turning all of them changes none.
std::vector<double> flipped_norms(const Rows& rows) {
  const std::size_t n = rows.size(), bins = rows.front().size();
  std::vector<double> norms;
  if (n > kMostFlipped) return norms;
  for (std::uint64_t signs = 0; signs < (std::uint64_t{1} << (n - 1)); ++signs) {
    std::vector<double> mean(bins, 0);
    for (std::size_t s = 0; s < n; ++s) {
      const double sign = s > 0 && ((signs >> (s - 1)) & 1) != 0 ? -1 : 1;
      for (std::size_t b = 0; b < bins; ++b) mean[b] += sign * rows[s][b] / static_cast<double>(n);
    }
    norms.push_back(norm(mean));
  }
  return norms;
}

/// The differences of pairs, each over the size of the reference; empty when nothing pairs. A value that is already an
/// error is its own difference.
Rows differences(const TradedVariant& variant, const TradedVariant* against, std::size_t metric) {
  Rows rows, references;
  for (const VariantRun& run : variant.runs) {
    if (!run.failure.empty() || run.value[metric].empty()) continue;
    if (!against) {
      rows.push_back(run.value[metric]);
      continue;
    }
    const auto other = std::ranges::find(against->runs, run.packing, &VariantRun::packing);
    if (other == against->runs.end() || !other->failure.empty()) continue;
    const std::vector<double>& reference = other->value[metric];
    if (reference.size() != run.value[metric].size()) continue;
    std::vector<double> row(reference.size());
    for (std::size_t b = 0; b < row.size(); ++b) row[b] = run.value[metric][b] - reference[b];
    rows.push_back(std::move(row));
    references.push_back(reference);
  }
  if (!against || rows.empty()) return rows;
  const double size = norm(mean_of_rows(references));
  for (auto& row : rows)
    for (double& value : row) value /= size;
  return rows;
}

TradeError error_of_number(const Rows& rows) {
  std::vector<double> values;
  for (const auto& row : rows) values.push_back(row.front());
  TradeError error;
  error.n = values.size();
  error.error = mean_interval(values);
  error.bound = std::max(std::abs(error.error.low), std::abs(error.error.high));
  return error;
}

TradeError error_of_curve(const Rows& rows) {
  TradeError error;
  error.n = rows.size();
  const std::vector<double> mean = mean_of_rows(rows);
  error.error = {rows.size(), norm(mean), kNone, kNone};
  if (rows.size() < 2) return error;
  // What is left of each pair without the mean, stretched to the sample's deviation, has the scatter of the mean.
  const auto n = static_cast<double>(rows.size());
  Rows rest = rows;
  for (auto& row : rest)
    for (std::size_t b = 0; b < mean.size(); ++b) row[b] = (row[b] - mean[b]) * std::sqrt(n / (n - 1));
  std::vector<double> norms = flipped_norms(rest);
  if (norms.empty()) return error;
  std::ranges::sort(norms);
  const double quantile = norms[static_cast<std::size_t>(std::ceil(kLevel * static_cast<double>(norms.size()))) - 1];
  error.error.low = std::max(0.0, error.error.mean - quantile);
  error.error.high = error.bound = error.error.mean + quantile;
  return error;
}

TradeError error_of(const Rows& rows, bool exact) {
  if (rows.empty()) return {};
  TradeError error = rows.front().size() == 1 ? error_of_number(rows) : error_of_curve(rows);
  if (rows.size() > 1) error.chance = sign_flip_chance(rows);
  if (exact && rows.size() == 1) error.bound = std::abs(error.error.mean);
  return error;
}

void cost_of(TradeLevel& level, const TradedVariant& variant, const TradedVariant* against) {
  std::vector<double> seconds, steps, ratios;
  for (const VariantRun& run : variant.runs) {
    ++level.asked;
    if (!run.failure.empty()) {
      if (std::ranges::find(level.failures, run.failure) == level.failures.end()) level.failures.push_back(run.failure);
      continue;
    }
    ++level.completed;
    seconds.push_back(run.cpu_seconds);
    steps.push_back(run.steps);
    level.peak_memory_mb = std::max(level.peak_memory_mb, run.peak_memory_mb);
    if (!against) continue;
    const auto other = std::ranges::find(against->runs, run.packing, &VariantRun::packing);
    if (other != against->runs.end() && other->failure.empty() && other->cpu_seconds > 0)
      ratios.push_back(run.cpu_seconds / other->cpu_seconds);
  }
  level.cpu_seconds = median(seconds);
  level.steps = median(steps);
  level.cost = median(ratios);
}

/// The reference is off as well, by what separates it from the coarser variant at most.
void add_own_error(std::vector<TradeLevel>& levels, const std::string& coarser) {
  const auto found = std::ranges::find(levels, coarser, &TradeLevel::name);
  if (found == levels.end()) return;
  const std::vector<TradeError> own = found->errors;
  for (TradeLevel& level : levels)
    for (std::size_t m = 0; m < level.errors.size(); ++m) level.errors[m].bound += std::abs(own[m].error.mean);
}

}  // namespace

double sign_flip_chance(const std::vector<std::vector<double>>& pairs) {
  const std::vector<double> norms = flipped_norms(pairs);
  if (norms.empty()) return kNone;
  const double seen = norms.front() * (1 - 1e-12);  // rounding must not tell it from itself
  return static_cast<double>(std::ranges::count_if(norms, [&](double one) { return one >= seen; })) /
         static_cast<double>(norms.size());
}

std::vector<TradeLevel> judge(const TradedGroup& group) {
  const auto found = std::ranges::find(group.variants, group.against, &TradedVariant::name);
  const TradedVariant* against = group.against.empty() || found == group.variants.end() ? nullptr : &*found;
  std::vector<TradeLevel> levels;
  for (const TradedVariant& variant : group.variants) {
    TradeLevel& level = levels.emplace_back();
    level.name = variant.name;
    cost_of(level, variant, against);
    level.errors.resize(group.metrics.size());
    level.on_frontier.assign(group.metrics.size(), false);
    if (&variant == against) continue;
    for (std::size_t m = 0; m < group.metrics.size(); ++m)
      level.errors[m] = error_of(differences(variant, against, m), group.against.empty() || !group.by_chance);
  }
  if (!group.by_chance) add_own_error(levels, group.coarser);
  for (std::size_t m = 0; m < group.metrics.size(); ++m) {
    // What is known of the error; a mean near 0 may be luck.
    const auto size = [&](const TradeLevel& level) {
      const TradeError& error = level.errors[m];
      return std::isnan(error.bound) ? std::abs(error.error.mean) : error.bound;
    };
    for (TradeLevel& level : levels) {
      if (std::isnan(size(level)) || level.completed < level.asked) continue;
      level.on_frontier[m] = std::ranges::none_of(levels, [&](const TradeLevel& other) {
        return other.completed == other.asked && other.cpu_seconds < level.cpu_seconds && size(other) <= size(level);
      });
    }
  }
  return levels;
}

}  // namespace seapile::present
