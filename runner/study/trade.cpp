#include "runner/study/trade.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/study/any_quantity.h"
#include "runner/study/field_reader.h"
#include "runner/study/nearest.h"

namespace seapile::study {
namespace {

/// The words of a kind in a study.
struct Words {
  const char *key, *against, *form;
};
constexpr Words kFrontier = {"frontier", "reference", R"({"reference": variant, "of": [metric]})"};
constexpr Words kAblation = {"ablate", "whole", R"({"whole": variant, "of": [metric]})"};

void read_metric(const Value& value, std::vector<std::string>& metrics, base::Problems& problems) {
  std::string name;
  const std::size_t before = problems.size();
  read_words(value, name, problems);
  if (problems.size() > before) return;
  const auto report = [&](const char* what, const char* allowed) {
    problems.push_back({pointer(value.place), what, allowed, ""});
  };
  if (const auto star = name.find('*'); star != std::string::npos && star + 1 < name.size())
    report("has a * that is not at its end", "a name, or its beginning and *");
  else if (std::ranges::find(metrics, name) != metrics.end())
    report("is asked for twice", "each metric once");
  else
    metrics.push_back(std::move(name));
}

}  // namespace

std::optional<Trade> read_trade(const Value& document, const std::vector<std::string>& variants,
                                base::Problems& problems) {
  const Value *frontier = document.find(kFrontier.key), *ablation = document.find(kAblation.key);
  const Value* written = frontier ? frontier : ablation;
  if (!written || written->kind == Value::Kind::unusable) return {};
  const std::size_t before = problems.size();
  const auto report = [&](const PlacePtr& place, std::string what, std::string allowed, std::string near = "") {
    problems.push_back({pointer(place), std::move(what), std::move(allowed), std::move(near)});
  };
  if (frontier && ablation) report(ablation->place, "stands beside frontier", "one of frontier and ablate");
  if (!is_object(*written, problems)) return {};
  const Words& words = frontier ? kFrontier : kAblation;
  if (variants.empty())
    report(written->place, "has nothing to compare: the study has no variants", "\"variants\": [{\"name\": ...}, ...]");

  Trade trade;
  trade.kind = frontier ? TradeKind::frontier : TradeKind::ablation;
  const auto read_variant = [&](const Value& value, std::string& name) {
    read_string(value, name, problems);
    if (value.kind == Value::Kind::string && !variants.empty() && std::ranges::find(variants, name) == variants.end())
      report(value.place, fmt::format("\"{}\" is no variant", name), "the name of a variant", nearest(name, variants));
  };
  std::vector<std::string> keys{words.against, "of"};
  if (frontier) keys.emplace_back("coarser");
  report_unknown_keys(*written, keys, problems);
  if (const Value* against = written->find(words.against))
    read_variant(*against, trade.against);
  else if (!frontier)
    report(written->place, "lacks \"whole\"", words.form);
  if (const Value* coarser = frontier ? written->find("coarser") : nullptr) {
    read_variant(*coarser, trade.coarser);
    if (trade.against.empty() || trade.coarser == trade.against)
      report(coarser->place, "is no other variant than the reference", "beside \"reference\", another variant");
  }
  const Value* of = written->find("of");
  if (!of) {
    report(written->place, "lacks \"of\"", words.form);
  } else if (of->kind == Value::Kind::array) {
    for (const Value& metric : of->items) read_metric(metric, trade.metrics, problems);
    if (of->items.empty()) report(of->place, "names no metric", "at least one");
  } else if (of->kind != Value::Kind::unusable) {
    report(of->place, fmt::format("is {}, not an array of metrics", kind_name(*of)), "an array [...]");
  }
  if (problems.size() > before) return {};
  return trade;
}

}  // namespace seapile::study
