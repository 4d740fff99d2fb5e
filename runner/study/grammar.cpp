#include "runner/study/grammar.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "runner/study/fidelity.h"
#include "runner/study/field_reader.h"
#include "runner/study/scene_tree.h"

namespace seapile::study {
namespace {

using base::Problems;
using Kind = Value::Kind;

constexpr std::size_t kLongestName = 64;
const Path kSeed = {"bed", "seed"};

class Reader {
 public:
  Reader(const Value& document, const Options& options, Problems& problems)
      : document_(document), options_(options), problems_(problems) {}

  Grammar read() {
    read_head();
    grammar_.base = section("base");
    grammar_.record_text = section("record");
    scene::SceneSpec unused;
    read_spec(grammar_.base, unused, problems_);
    read_axes();
    read_zip();
    read_variants();
    grammar_.edge = read_edge(document_, problems_);
    if (grammar_.edge && !first_axis(grammar_.edge->path, grammar_.edge->place)) grammar_.edge.reset();
    read_replicates();
    read_exclude();
    read_when();
    read_fidelity();
    if (const Value* checks = member("checks"); checks && checks->kind != Kind::null) {
      const std::vector<Value>& entries = list("checks");
      grammar_.checks = read_checks(entries, problems_);
      grammar_.claims = read_claims(entries, problems_);
    }
    report_unknown_keys(document_,
                        {"study", "question", "base", "axes", "zip", "variants", "exclude", "when", "replicates",
                         "fidelity", "record", "checks", "frontier", "ablate", "edge"},
                        problems_);
    read_command_line();
    check_base_under_axes();
    read_spec(grammar_.record_text, grammar_.record, problems_);
    return std::move(grammar_);
  }

 private:
  void report(const PlacePtr& place, std::string what, std::string allowed, std::string near = "") {
    problems_.push_back({pointer(place), std::move(what), std::move(allowed), std::move(near)});
  }

  /// A member of the document that is usable; null otherwise.
  const Value* member(const char* key) {
    const Value* value = document_.find(key);
    return value && value->kind != Kind::unusable ? value : nullptr;
  }

  /// A member that has to be an object; empty when it is missing or is none.
  Value section(const char* key) {
    const Value* value = member(key);
    if (value && is_object(*value, problems_)) return *value;
    return object_value(place_in(document_.place, key));
  }

  /// A member that has to be an array.
  const std::vector<Value>& list(const char* key) {
    static const std::vector<Value> kNothing;
    const Value* value = member(key);
    if (!value) return kNothing;
    if (value->kind == Kind::array) return value->items;
    report(value->place, fmt::format("is {}, not an array", kind_name(*value)), "an array [...]");
    return kNothing;
  }

  void read_head() {
    constexpr const char* kNameRule = "1 to 64 characters of a-z, 0-9 and _";
    if (!document_.find("study")) {
      report(place_in(document_.place, "study"), "is missing: the study has no name", kNameRule);
    } else if (const Value* name = member("study")) {
      read_string(*name, grammar_.name, problems_);
      const bool good = !grammar_.name.empty() && grammar_.name.size() <= kLongestName &&
                        grammar_.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") == std::string::npos;
      if (name->kind == Kind::string && !good) {
        report(name->place, fmt::format("\"{}\" is no name for a study", grammar_.name.substr(0, 80)), kNameRule);
      }
    }
    if (const Value* question = member("question")) read_string(*question, grammar_.question, problems_);
  }

  /// A path may be varied in one place only.
  bool first_axis(const Path& path, const PlacePtr& place) {
    if (axis_paths_.insert(join_path(path)).second) return true;
    report(place, fmt::format("{} is an axis already", join_path(path)), "each path once in axes, zip and replicates");
    return false;
  }

  /// A path with its values; absent after a report.
  std::optional<Column> read_column(const std::string& dotted, const Value& values) {
    if (values.kind == Kind::unusable) return {};
    const SchemaNode* node = node_at(dotted, values.place, scene_schema(), problems_);
    if (!node) return {};
    Column column{split_path(dotted), node, values.place, {}};
    if (values.kind != Kind::array) {
      report(values.place, fmt::format("is {}, not an array of values", kind_name(values)), "an array [...]");
      return {};
    }
    if (values.items.empty()) {
      report(values.place, "is an empty axis: it makes no case", "at least one value");
      return {};
    }
    if (!first_axis(column.path, values.place)) return {};
    for (const Value& value : values.items) {
      if (value.kind == Kind::unusable) continue;
      check_value(column.path, value, problems_);
      column.values.push_back(value);
    }
    if (column.values.size() < values.items.size()) return {};
    return column;
  }

  void read_axes() {
    const Value axes = section("axes");
    for (std::size_t i = 0; i < axes.items.size(); ++i) {
      if (auto column = read_column(axes.keys[i], axes.items[i])) grammar_.axes.push_back({{*std::move(column)}});
    }
  }

  void read_zip() {
    const Value zip = section("zip");
    Axis together;
    for (std::size_t i = 0; i < zip.items.size(); ++i) {
      auto column = read_column(zip.keys[i], zip.items[i]);
      if (!column) continue;
      if (!together.columns.empty() && column->values.size() != together.size()) {
        report(column->place,
               fmt::format("has {} values, but {} has {}", column->values.size(),
                           join_path(together.columns.front().path), together.size()),
               "as many values in every array of zip");
        continue;
      }
      together.columns.push_back(*std::move(column));
    }
    if (!together.columns.empty()) grammar_.axes.push_back(std::move(together));
  }

  void read_variants() {
    std::set<std::string> names;
    for (const Value& one : list("variants")) {
      if (one.kind == Kind::unusable || !is_object(one, problems_)) continue;
      report_unknown_keys(one, {"name", "set", "fidelity"}, problems_);
      Variant variant;
      variant.place = one.place;
      const Value* name = one.find("name");
      if (!name) {
        report(one.place, "lacks \"name\"", "{\"name\": text, \"set\": {path: value}, \"fidelity\": level}");
        continue;
      }
      read_string(*name, variant.name, problems_);
      if (name->kind == Kind::string && (variant.name.empty() || variant.name.size() > kLongestName))
        report(name->place, "is no name for a variant", "1 to 64 characters");
      if (!names.insert(variant.name).second)
        report(name->place, fmt::format("\"{}\" is a variant already", variant.name), "each name once");
      if (const Value* set = one.find("set")) variant.set = read_assignments(*set, problems_);
      for (const Assignment& assignment : variant.set) check_value(assignment.path, assignment.value, problems_);
      if (const Value* level = one.find("fidelity"))
        if (const auto index = read_choice(*level, fidelity_names(), problems_)) {
          variant.level = fidelity_names()[*index];
          variant.fidelity = filled_by_fidelity(*index, level->place);
        }
      grammar_.variants.push_back(std::move(variant));
    }
    grammar_.trade = read_trade(document_, {names.begin(), names.end()}, problems_);
  }

  /// bed.seed = 1..count.
  void add_seeds(std::int64_t count, const PlacePtr& place) {
    if (!first_axis(kSeed, place)) return;
    Column column{kSeed, node_at("bed.seed", place, scene_schema(), problems_), place, {}};
    for (std::int64_t seed = 1; seed <= count; ++seed) {
      column.values.push_back(number_value(static_cast<double>(seed), place));
    }
    grammar_.axes.push_back({{std::move(column)}});
  }

  void read_replicates() {
    const Value* replicates = member("replicates");
    if (!replicates || !is_object(*replicates, problems_)) return;
    if (is_packing_rule(*replicates)) {
      read_rule(*replicates);
      return;
    }
    report_unknown_keys(*replicates, {"seed", "seeds"}, problems_);
    const Value* seed = replicates->find("seed");
    const Value* seeds = replicates->find("seeds");
    if ((seed != nullptr) == (seeds != nullptr)) {
      report(replicates->place, seed ? "has both seed and seeds" : "has neither seed nor seeds",
             R"({"seed": [1, 2, 3]} or {"seeds": 3}, or a rule with at_least and at_most)");
      return;
    }
    if (options_.seeds) return;
    if (seed) {
      if (auto column = read_column("bed.seed", *seed)) grammar_.axes.push_back({{*std::move(column)}});
    } else if (seeds->kind != Kind::unusable) {
      std::int64_t count = 0;
      const std::size_t before = problems_.size();
      read_integer(*seeds, seeds_field(), count, problems_);
      if (problems_.size() == before) add_seeds(count, seeds->place);
    }
  }

  /// The packings that the rule has come to so far.
  void read_rule(const Value& replicates) {
    const auto rule = read_packing_rule(replicates, problems_);
    if (rule && grammar_.edge)
      report(replicates.find("at_least")->place, "stands beside edge, whose packings are not asked for by results",
             R"({"seed": [1, 2, 3]} or {"seeds": 3})");
    if (!rule || options_.seeds) return;
    const std::int64_t count = std::clamp(options_.packings.value_or(rule->at_least), rule->at_least, rule->at_most);
    add_seeds(count, replicates.find("at_least")->place);
    grammar_.packing_rule = *rule;
  }

  static base::Field seeds_field() {
    return {"seeds", "-", base::between(1, static_cast<double>(kMostCases)), "number of seeds"};
  }

  void read_exclude() {
    for (const Value& object : list("exclude")) grammar_.exclude.push_back(read_match(object, problems_));
  }

  void read_when() {
    for (const Value& rule : list("when")) {
      if (rule.kind == Kind::unusable || !is_object(rule, problems_)) continue;
      report_unknown_keys(rule, {"if", "set"}, problems_);
      const Value* condition = rule.find("if");
      const Value* set = rule.find("set");
      if (!condition || !set) {
        report(rule.place, condition ? "lacks \"set\"" : "lacks \"if\"",
               "{\"if\": {path: value}, \"set\": {path: value}}");
        continue;
      }
      When when{read_match(*condition, problems_), read_assignments(*set, problems_)};
      if (set->kind == Kind::object && set->items.empty())
        report(set->place, "is empty: it sets nothing", "at least one path");
      for (const Assignment& assignment : when.set) check_value(assignment.path, assignment.value, problems_);
      grammar_.when.push_back(std::move(when));
    }
  }

  void read_fidelity() {
    const auto fill = [&](const Value& value) {
      if (const auto index = read_choice(value, fidelity_names(), problems_))
        grammar_.fidelity = filled_by_fidelity(*index, value.place);
    };
    if (const Value* value = member("fidelity")) fill(*value);
    if (!options_.fidelity.empty()) fill(string_value(options_.fidelity, root_place("--fidelity")));
  }

  void read_command_line() {
    for (const std::string& text : options_.set) {
      if (auto setting = read_setting(text, problems_)) add_setting(*std::move(setting));
    }
    if (!options_.seeds) return;
    const PlacePtr place = root_place("--seeds");
    std::int64_t count = 0;
    const std::size_t before = problems_.size();
    read_integer(number_value(static_cast<double>(*options_.seeds), place), seeds_field(), count, problems_);
    if (problems_.size() > before) return;
    if (settings_.contains("scene.bed.seed")) {
      report(place, "bed.seed is given by --set as well", "one of --seeds and --set bed.seed");
      return;
    }
    add_seeds(count, place);
  }

  void add_setting(Assignment setting) {
    if (!settings_.insert(join_path(setting.path)).second) {
      report(setting.value.place, "is set twice", "each path once");
      return;
    }
    const bool record = setting.path.front() == "record";
    setting.path.erase(setting.path.begin());
    if (record) {
      assign(grammar_.record_text, record_schema(), setting.path, setting.value);
      return;
    }
    check_value(setting.path, setting.value, problems_);
    replace_axis(setting.path);
    if (setting.path == kSeed) grammar_.packing_rule.reset();
    grammar_.set.push_back(std::move(setting));
  }

  /// What the command line sets is no longer varied.
  void replace_axis(const Path& path) {
    for (Axis& axis : grammar_.axes) {
      std::erase_if(axis.columns, [&](const Column& column) { return column.path == path; });
    }
    std::erase_if(grammar_.axes, [](const Axis& axis) { return axis.columns.empty(); });
    axis_paths_.erase(join_path(path));
  }

  /// A value of an axis takes the place of all that the base says there; what would be lost is said instead.
  void check_base_under_axes() {
    for (const Axis& axis : grammar_.axes) {
      for (const Column& column : axis.columns) {
        const Value* at = &grammar_.base;
        for (const std::string& key : column.path) at = at && at->kind == Kind::object ? at->find(key) : nullptr;
        if (!at || at->kind != Kind::object || at->items.empty()) continue;
        report(at->place, fmt::format("is replaced in every case by the axis {}", join_path(column.path)),
               "nothing here: write it into the values of the axis");
      }
    }
  }

  const Value& document_;
  const Options& options_;
  Problems& problems_;
  Grammar grammar_;
  std::set<std::string> axis_paths_;
  std::set<std::string> settings_;  ///< paths of the command line, with "scene." or "record." before them
};

}  // namespace

Grammar read_grammar(const Value& document, const Options& options, Problems& problems) {
  return Reader(document, options, problems).read();
}

double combination_count(const Grammar& grammar) {
  double count = 1;
  for (const Axis& axis : grammar.axes) count *= static_cast<double>(axis.size());
  return count * static_cast<double>(std::max<std::size_t>(1, grammar.variants.size()));
}

double most_combinations(const Grammar& grammar) {
  const double count = combination_count(grammar);
  if (!grammar.packing_rule) return count;
  return count / static_cast<double>(grammar.axes.back().size()) * static_cast<double>(grammar.packing_rule->at_most);
}

}  // namespace seapile::study
