#include "runner/study/idle.h"

#include <fmt/format.h>

#include <algorithm>

#include "runner/study/resolved.h"

namespace seapile::study {
namespace {

constexpr const char* kNoPile = "is not used: no case of this study has a pile";

/// Where every case is water alone, what the base says of beds and piles is lost, and so is one water beside another.
void report_unused_beside_water(const Grammar& grammar, const Tally& tally, ProblemCollector& collector) {
  if (tally.kinds.contains("")) return;
  const std::string_view first = tally.kinds.begin()->first;
  const std::string all =
      tally.kinds.size() == 1 ? fmt::format("the scene is a {}", first) : "every scene is water alone";
  for (const std::string& part : scene_schema().child_names()) {
    const Value* written = grammar.base.find(part);
    if (tally.kinds.contains(part) || part == "model" || !written || written->kind == Value::Kind::null) continue;
    collector.add({pointer(written->place), fmt::format("is not used: {}", all),
                   fmt::format("nothing here, or {} null", first), ""});
  }
}

/// Of `model`, what is about parts that no case has.
void report_unused_choices(const Grammar& grammar, const Tally& tally, ProblemCollector& collector) {
  const Value* model = grammar.base.find("model");
  if (!model) return;
  for (std::size_t i = 0; i < model->keys.size(); ++i) {
    if (tally.choices.contains(model->keys[i])) continue;
    collector.add({pointer(model->items[i].place), "is not used: no case of this study has such a part",
                   "choices about parts that a case has", ""});
  }
}

/// Beds are prepared by their own solver.
void report_unused_without_pile(const Grammar& grammar, const Tally& tally, ProblemCollector& collector) {
  if (tally.kinds.size() > 1 || !tally.kinds.contains("")) return;
  const auto report = [&](const PlacePtr& place) {
    collector.add({pointer(place), kNoPile, "a pile in the base", ""});
  };
  if (const Value* contact = grammar.base.find("contact")) report(contact->place);
  if (!grammar.fidelity.empty()) report(grammar.fidelity.front().value.place);
}

/// Nothing is recorded where nothing is driven and no basin moves.
void report_unused_record(const Grammar& grammar, const Tally& tally, ProblemCollector& collector) {
  const Value& written = grammar.record_text;
  if (written.items.empty()) return;
  if (tally.drives == 0 && tally.basins == 0) {
    collector.add({pointer(written.place), kNoPile, "a pile in the base", ""});
    return;
  }
  for (std::size_t i = 0; i < written.items.size(); ++i) {
    const bool of_basin = std::ranges::find(kRecordOfABasin, written.keys[i]) != kRecordOfABasin.end();
    if ((of_basin ? tally.basins : tally.drives) > 0) continue;
    collector.add({pointer(written.items[i].place),
                   of_basin ? "is not used: no case of this study is a basin" : kNoPile,
                   of_basin ? "a basin in the base" : "a pile in the base", ""});
  }
}

}  // namespace

void report_idle(const Grammar& grammar, const Tally& tally, std::size_t total, ProblemCollector& collector) {
  if (!collector.empty()) return;
  if (tally.kept == 0) {
    collector.add({"/exclude", fmt::format("leaves none of {} cases", total), "at least one case", ""});
    return;
  }
  report_unused_beside_water(grammar, tally, collector);
  report_unused_choices(grammar, tally, collector);
  for (const Assignment& assignment : grammar.set) {
    if (tally.used_settings.contains(&assignment)) continue;
    collector.add(
        {pointer(assignment.value.place), "has no place in any case of this study", "a path that a case uses", ""});
  }
  if (!grammar.set.empty()) return;
  const auto report = [&](const Match& match) {
    collector.add({pointer(match.place), "matches no case", "values that a case has", ""});
  };
  if (tally.drives == 0) report_unused_without_pile(grammar, tally, collector);
  report_unused_record(grammar, tally, collector);
  for (std::size_t i = 0; i < tally.met.size(); ++i) {
    if (tally.met[i] == 0) report(grammar.when[i].condition);
  }
  for (std::size_t i = 0; i < tally.excluded.size(); ++i) {
    if (tally.excluded[i] == 0) report(grammar.exclude[i]);
  }
}

}  // namespace seapile::study
