#include "runner/study/any_quantity.h"

#include <fmt/format.h>

#include "runner/study/csv.h"
#include "runner/study/field_reader.h"

namespace seapile::study {

using Kind = Value::Kind;

void read_words(const Value& value, std::string& words, base::Problems& problems) {
  read_string(value, words, problems);
  if (value.kind == Kind::string && trimmed(value.text).empty())
    problems.push_back({pointer(value.place), "is empty", "a text", ""});
}

void read_any_quantity(const Value& value, const std::string& allowed, Quantity& quantity, base::Problems& problems) {
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

std::optional<QuantityPair> read_pair(const Value& first, const char* name, const Value& second,
                                      const std::string& second_allowed, base::Problems& problems) {
  const std::size_t before = problems.size();
  Quantity leading, following;
  read_any_quantity(first, kAnyNumber, leading, problems);
  read_any_quantity(second, second_allowed, following, problems);
  if (problems.size() > before) return {};
  const auto report = [&](std::string what) {
    problems.push_back({pointer(second.place), std::move(what), second_allowed, ""});
    return std::nullopt;
  };
  if (leading.unit.empty() != following.unit.empty()) {
    return report(following.unit.empty() ? fmt::format("has no unit, but {} has one", name)
                                         : fmt::format("has a unit, but {} has none", name));
  }
  const UnitResult in_unit = convert(following, leading.unit);
  if (!in_unit.problem.empty()) return report(in_unit.problem);
  return QuantityPair{leading.value, in_unit.value, leading.unit};
}

std::string out_of_range(double number) { return fmt::format("{} is out of range", number_text(number)); }

}  // namespace seapile::study
