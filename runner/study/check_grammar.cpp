#include "runner/study/check_grammar.h"

#include <fmt/format.h>

#include "runner/study/any_quantity.h"
#include "runner/study/check.h"
#include "runner/study/claim_grammar.h"
#include "runner/study/field_reader.h"

namespace seapile::study {
namespace {

using base::Problems;
using Kind = Value::Kind;

constexpr const char* kForms =
    R"({"metric": name, "reference": "reference/name.csv"} or )"
    R"({"metric": name, "value": 1, "tolerance": 0.1, "source": text} or {"metric": name, "at_most": 1})";

class EntryReader {
 public:
  EntryReader(const Value& entry, Problems& problems) : entry_(entry), problems_(problems) {}

  CheckText read() {
    text_.place = entry_.place;
    text_.drift = kDrift;
    report_unknown_keys(
        entry_, {"metric", "reference", "value", "tolerance", "at_least", "at_most", "source", "if", "drift", "claim"},
        problems_);
    if (const Value* metric = member("metric")) {
      read_words(*metric, text_.metric, problems_);
    } else if (!entry_.find("metric")) {
      report(entry_.place, "lacks \"metric\"", kForms);
    }
    read_form();
    if (const Value* which = member("if")) text_.which = read_match(*which, problems_);
    if (const Value* drift = member("drift"))
      read_number(*drift, {"drift", "-", base::between(0, 1), "relative change that is no drift"}, text_.drift,
                  problems_);
    return std::move(text_);
  }

 private:
  void report(const PlacePtr& place, std::string what, std::string allowed) {
    problems_.push_back({pointer(place), std::move(what), std::move(allowed), ""});
  }

  const Value* member(const char* key) {
    const Value* value = entry_.find(key);
    return value && value->kind != Kind::unusable ? value : nullptr;
  }

  /// The value is in a file, in the study, or there are bounds: one of the three.
  void read_form() {
    const bool in_file = has("reference"), here = has("value"), bounds = has("at_least") || has("at_most");
    if (in_file + here + bounds != 1) {
      report(entry_.place,
             in_file + here + bounds == 0 ? "has no \"reference\", no \"value\" and no bound"
                                          : "has more than one of \"reference\", \"value\" and bounds",
             kForms);
      return;
    }
    for (const char* key : {"tolerance", "source"}) {
      const Value* value = entry_.find(key);
      if (in_file && value) report(value->place, "is said by the reference's file", "nothing here");
      if (here && !value) report(entry_.place, fmt::format("lacks \"{}\"", key), kForms);
    }
    if (in_file) {
      if (const Value* file = member("reference")) read_words(*file, text_.file, problems_);
      return;
    }
    if (const Value* source = member("source")) read_words(*source, text_.source, problems_);
    if (bounds) {
      read_bounds();
    } else if (const Value* value = member("value"), *tolerance = member("tolerance"); value && tolerance) {
      read_value(*value, *tolerance);
    }
  }

  bool has(const char* key) const { return entry_.find(key) != nullptr; }

  void read_value(const Value& value, const Value& tolerance) {
    constexpr const char* kPositive = "a number, more than 0, with the unit that the value has";
    const auto pair = read_pair(value, "the value", tolerance, kPositive, problems_);
    if (!pair) return;
    text_.value = pair->first;
    text_.tolerance = pair->second;
    text_.unit = pair->unit;
    if (!(text_.tolerance > 0)) report(tolerance.place, out_of_range(text_.tolerance), kPositive);
  }

  void read_bounds() {
    if (const Value* tolerance = entry_.find("tolerance"))
      report(tolerance->place, "has no place beside a bound", "nothing here");
    const Value *least = member("at_least"), *most = member("at_most");
    double low = 0, high = 0;
    if (least && most) {
      const auto pair = read_pair(*least, "at_least", *most, kAnyNumber, problems_);
      if (!pair) return;
      low = pair->first;
      high = pair->second;
      text_.unit = pair->unit;
      if (high < low) report(most->place, "is less than at_least", "at_least or more");
    } else if (const Value* one = least ? least : most) {
      Quantity quantity;
      read_any_quantity(*one, kAnyNumber, quantity, problems_);
      text_.unit = quantity.unit;
      low = high = quantity.value;
    }
    if (least) text_.at_least = low;
    if (most) text_.at_most = high;
  }

  const Value& entry_;
  Problems& problems_;
  CheckText text_;
};

}  // namespace

std::vector<CheckText> read_checks(const std::vector<Value>& list, Problems& problems) {
  std::vector<CheckText> texts;
  for (const Value& entry : list) {
    if (entry.kind == Kind::unusable || is_claim(entry)) continue;
    const std::size_t before = problems.size();
    if (!is_object(entry, problems)) continue;
    CheckText text = EntryReader(entry, problems).read();
    if (problems.size() == before) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace seapile::study
