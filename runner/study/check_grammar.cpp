#include "runner/study/check_grammar.h"

#include <fmt/format.h>

#include "runner/study/check.h"
#include "runner/study/csv.h"
#include "runner/study/field_reader.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

using base::Problems;
using Kind = Value::Kind;

constexpr const char* kTwoForms =
    R"({"metric": name, "reference": "reference/name.csv"} or )"
    R"({"metric": name, "value": 1, "tolerance": 0.1, "source": text})";

/// A text that says something.
void read_words(const Value& value, std::string& words, Problems& problems) {
  read_string(value, words, problems);
  if (value.kind == Kind::string && trimmed(value.text).empty())
    problems.push_back({pointer(value.place), "is empty", "a text", ""});
}

/// A number, in SI units or with its unit: the unit of a metric is known only once it has been computed.
void read_any_quantity(const Value& value, const std::string& allowed, Quantity& quantity, Problems& problems) {
  if (value.kind == Kind::number) {
    quantity = {value.number == 0 ? 0.0 : value.number, ""};
  } else if (value.kind == Kind::string) {
    const UnitResult result = read_quantity(value.text, quantity);
    if (result.problem.empty()) return;
    problems.push_back({pointer(value.place), fmt::format("\"{}\" {}", value.text.substr(0, 60), result.problem),
                        allowed, result.nearest});
  } else {
    problems.push_back({pointer(value.place), fmt::format("is {}, not a number", kind_name(value)), allowed, ""});
  }
}

class EntryReader {
 public:
  EntryReader(const Value& entry, Problems& problems) : entry_(entry), problems_(problems) {}

  CheckText read() {
    text_.place = entry_.place;
    text_.drift = kDrift;
    report_unknown_keys(entry_, {"metric", "reference", "value", "tolerance", "source", "if", "drift"}, problems_);
    if (const Value* metric = member("metric")) {
      read_words(*metric, text_.metric, problems_);
    } else if (!entry_.find("metric")) {
      report(entry_.place, "lacks \"metric\"", kTwoForms);
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

  /// The value is in a file or in the study, not in both.
  void read_form() {
    const bool in_file = entry_.find("reference") != nullptr, here = entry_.find("value") != nullptr;
    if (in_file == here) {
      report(entry_.place, in_file ? "has both \"reference\" and \"value\"" : "has neither \"reference\" nor \"value\"",
             kTwoForms);
      return;
    }
    for (const char* key : {"tolerance", "source"}) {
      const Value* value = entry_.find(key);
      if (in_file && value) report(value->place, "is said by the reference's file", "nothing here");
      if (here && !value) report(entry_.place, fmt::format("lacks \"{}\"", key), kTwoForms);
    }
    if (in_file) {
      if (const Value* file = member("reference")) read_words(*file, text_.file, problems_);
      return;
    }
    if (const Value* source = member("source")) read_words(*source, text_.source, problems_);
    const Value *value = member("value"), *tolerance = member("tolerance");
    if (value && tolerance) read_value(*value, *tolerance);
  }

  void read_value(const Value& value, const Value& tolerance) {
    constexpr const char* kAnyNumber = "a number, in SI units or with its unit";
    constexpr const char* kPositive = "a number, more than 0, with the unit that the value has";
    const std::size_t before = problems_.size();
    Quantity number, width;
    read_any_quantity(value, kAnyNumber, number, problems_);
    read_any_quantity(tolerance, kPositive, width, problems_);
    if (problems_.size() > before) return;
    text_.value = number.value;
    text_.unit = number.unit;
    if (number.unit.empty() != width.unit.empty()) {
      report(tolerance.place,
             width.unit.empty() ? "has no unit, but the value has one" : "has a unit, but the value has none",
             kPositive);
      return;
    }
    const UnitResult in_unit = convert(width, number.unit);
    text_.tolerance = in_unit.value;
    if (!in_unit.problem.empty()) {
      report(tolerance.place, in_unit.problem, kPositive);
    } else if (!(text_.tolerance > 0)) {
      report(tolerance.place, fmt::format("{} is out of range", number_text(width.value)), kPositive);
    }
  }

  const Value& entry_;
  Problems& problems_;
  CheckText text_;
};

}  // namespace

std::vector<CheckText> read_checks(const std::vector<Value>& list, Problems& problems) {
  std::vector<CheckText> texts;
  for (const Value& entry : list) {
    if (entry.kind == Kind::unusable) continue;
    const std::size_t before = problems.size();
    if (!is_object(entry, problems)) continue;
    CheckText text = EntryReader(entry, problems).read();
    if (problems.size() == before) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace seapile::study
