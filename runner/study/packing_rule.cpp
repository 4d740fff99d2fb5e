#include "runner/study/packing_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runner/study/any_quantity.h"
#include "runner/study/field_reader.h"
#include "runner/study/study.h"

namespace seapile::study {
namespace {

constexpr std::array kKeys = {"at_least", "at_most", "metric", "half_width"};
constexpr const char* kForm = R"({"at_least": 4, "at_most": 24, "metric": name, "half_width": 0.05})";

}  // namespace

bool is_packing_rule(const Value& replicates) {
  return std::ranges::any_of(kKeys, [&](const char* key) { return replicates.find(key) != nullptr; });
}

std::optional<PackingRule> read_packing_rule(const Value& replicates, base::Problems& problems) {
  const std::size_t before = problems.size();
  report_unknown_keys(replicates, {kKeys.begin(), kKeys.end()}, problems);
  const auto member = [&](const char* key) -> const Value* {
    const Value* value = replicates.find(key);
    if (!value) problems.push_back({pointer(replicates.place), fmt::format("lacks \"{}\"", key), kForm, ""});
    return value && value->kind != Value::Kind::unusable ? value : nullptr;
  };
  PackingRule rule;
  const auto most = static_cast<double>(kMostCases);
  const Value *least = member("at_least"), *cap = member("at_most");
  // One packing has no interval.
  if (least) read_integer(*least, {"at_least", "-", base::between(2, most), "packings"}, rule.at_least, problems);
  if (cap) read_integer(*cap, {"at_most", "-", base::between(2, most), "packings"}, rule.at_most, problems);
  if (cap && rule.at_most > 0 && rule.at_most < rule.at_least)
    problems.push_back({pointer(cap->place), "is less than at_least", "at_least or more", ""});
  if (const Value* metric = member("metric")) {
    read_words(*metric, rule.metric, problems);
    if (const auto star = rule.metric.find('*'); star != std::string::npos && star + 1 < rule.metric.size())
      problems.push_back(
          {pointer(metric->place), "has a * that is not at its end", "a name, or its beginning and *", ""});
  }
  if (const Value* width = member("half_width"))
    read_number(*width, {"half_width", "-", base::positive(1), "share of the mean"}, rule.half_width, problems);
  if (problems.size() > before) return {};
  return rule;
}

}  // namespace seapile::study
