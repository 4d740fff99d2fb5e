#include "runner/study/field_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runner/study/nearest.h"
#include "runner/study/unit.h"

namespace seapile::study {
namespace {

using base::Field;
using base::Problems;
using Kind = Value::Kind;

void report(const Value& value, std::string what, std::string allowed, Problems& problems, std::string near = "") {
  problems.push_back({pointer(value.place), std::move(what), std::move(allowed), std::move(near)});
}

std::string quoted(const std::string& text) { return fmt::format("\"{}\"", text.substr(0, 60)); }

std::string listed(const std::vector<std::string>& names) { return fmt::format("{}", fmt::join(names, ", ")); }

/// A bound as a person would write it: angles in degrees.
std::string bound_text(double bound, std::string_view unit) {
  if (unit == "rad") return fmt::format("{:.6g} deg", bound * 180 / std::numbers::pi);
  return unit == "-" ? number_text(bound) : fmt::format("{} {}", number_text(bound), unit);
}

/// The value in the field's unit, in range; absent after a report.
std::optional<double> number_in_range(const Value& value, const Field& field, Problems& problems) {
  double number = value.number;
  if (value.kind == Kind::string) {
    const UnitResult result = read_quantity(value.text, field.unit);
    if (!result.problem.empty()) {
      report(value, fmt::format("{} {}", quoted(value.text), result.problem), range_text(field), problems,
             result.nearest);
      return {};
    }
    number = result.value;
  } else if (value.kind != Kind::number) {
    report(value, fmt::format("is {}, not a number", kind_name(value)), range_text(field), problems);
    return {};
  }
  if (!field.range.contains(number)) {
    const bool degrees = field.unit == "rad" && value.kind == Kind::number && number > std::numbers::pi;
    report(
        value,
        degrees
            ? fmt::format("{} rad is more than pi: an angle in degrees is written with its unit", number_text(number))
            : fmt::format("{} is out of range", value.kind == Kind::string ? quoted(value.text) : number_text(number)),
        range_text(field), problems, degrees ? fmt::format("{} deg", number_text(number)) : "");
    return {};
  }
  return number == 0 ? 0.0 : number;  // -0 is 0.
}

}  // namespace

std::string range_text(const Field& field) {
  const auto& [min, max, open_min, open_max] = field.range;
  const std::string low = bound_text(min, field.unit), high = bound_text(max, field.unit);
  const bool has_min = std::isfinite(min), has_max = std::isfinite(max);
  if (!has_min && !has_max) return field.unit == "-" ? "a number" : fmt::format("a number in {}", field.unit);
  if (has_min && has_max && !open_min && !open_max) return fmt::format("from {} to {}", low, high);
  std::string text;
  if (has_min) text = fmt::format("{} {}", open_min ? "more than" : "at least", low);
  if (has_min && has_max) text += ", ";
  if (has_max) text += fmt::format("{} {}", open_max ? "less than" : "at most", high);
  return text;
}

void read_number(const Value& value, const Field& field, double& member, Problems& problems) {
  if (const auto number = number_in_range(value, field, problems)) member = *number;
}

void read_integer(const Value& value, const Field& field, std::int64_t& member, Problems& problems) {
  const std::string allowed = "a whole number " + range_text(field);
  if (value.kind != Kind::number) {
    report(value, fmt::format("is {}, not a whole number", kind_name(value)), allowed, problems);
  } else if (value.number != std::floor(value.number)) {
    report(value, fmt::format("{} is not a whole number", number_text(value.number)), allowed, problems);
  } else if (!field.range.contains(value.number)) {
    report(value, fmt::format("{} is out of range", number_text(value.number)), allowed, problems);
  } else {
    member = static_cast<std::int64_t>(value.number);
  }
}

void read_boolean(const Value& value, bool& member, Problems& problems) {
  if (value.kind == Kind::boolean) {
    member = value.truth;
  } else {
    report(value, fmt::format("is {}, not true or false", kind_name(value)), "true, false", problems);
  }
}

void read_string(const Value& value, std::string& member, Problems& problems) {
  if (value.kind == Kind::string) {
    member = value.text;
  } else {
    report(value, fmt::format("is {}, not a string", kind_name(value)), "a string", problems);
  }
}

void read_numbers(const Value& value, const Field& field, std::vector<double>& member, Problems& problems) {
  if (value.kind != Kind::array) {
    report(value, fmt::format("is {}, not an array of numbers", kind_name(value)), range_text(field) + ", each",
           problems);
    return;
  }
  std::vector<double> numbers;
  for (const Value& item : value.items) {
    if (item.kind == Kind::unusable) continue;
    if (const auto number = number_in_range(item, field, problems)) numbers.push_back(*number);
  }
  // A list with a problem in it is not used: its other elements would be counted from a wrong start.
  if (numbers.size() == value.items.size()) member = std::move(numbers);
}

std::optional<std::size_t> read_choice(const Value& value, const std::vector<std::string>& names, Problems& problems) {
  if (value.kind != Kind::string) {
    report(value, fmt::format("is {}, not one of the names", kind_name(value)), listed(names), problems);
    return {};
  }
  const auto found = std::find(names.begin(), names.end(), value.text);
  if (found == names.end()) {
    report(value, fmt::format("{} is unknown", quoted(value.text)), listed(names), problems,
           nearest(value.text, names));
    return {};
  }
  return static_cast<std::size_t>(found - names.begin());
}

std::optional<std::size_t> read_alternative(const Value& value, const std::vector<std::string>& names,
                                            const Value*& inside, Problems& problems) {
  inside = nullptr;
  if (value.kind == Kind::string) return read_choice(value, names, problems);
  if (value.kind != Kind::object || value.items.size() != 1) {
    const std::string found = value.kind == Kind::object
                                  ? fmt::format("has {} names, not exactly one", value.items.size())
                                  : fmt::format("is {}, not one of the names", kind_name(value));
    report(value, found, fmt::format("{}; as \"name\" or {{\"name\": {{...}}}}", listed(names)), problems);
    return {};
  }
  const std::string& name = value.keys.front();
  const auto known = std::find(names.begin(), names.end(), name);
  if (known == names.end()) {
    report(value.items.front(), fmt::format("{} is unknown", quoted(name)), listed(names), problems,
           nearest(name, names));
    return {};
  }
  inside = &value.items.front();
  return static_cast<std::size_t>(known - names.begin());
}

bool is_object(const Value& value, Problems& problems) {
  if (value.kind == Kind::object) return true;
  report(value, fmt::format("is {}, not an object", kind_name(value)), "an object {...}", problems);
  return false;
}

void report_unknown_keys(const Value& object, const std::vector<std::string>& known, Problems& problems) {
  for (std::size_t i = 0; i < object.keys.size(); ++i) {
    const std::string& key = object.keys[i];
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    report(object.items[i], "is an unknown key", known.empty() ? "no keys here" : listed(known), problems,
           nearest(key, known));
  }
}

}  // namespace seapile::study
