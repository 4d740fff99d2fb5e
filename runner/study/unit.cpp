#include "runner/study/unit.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "runner/study/nearest.h"

namespace seapile::study {
namespace {

/// A unit as powers of the base units times a factor `10^decimal * numerator / denominator`.
struct Unit {
  int length = 0, mass = 0, time = 0, angle = 0;
  int decimal = 0;
  double numerator = 1, denominator = 1;

  bool same_dimension(const Unit& other) const {
    return length == other.length && mass == other.mass && time == other.time && angle == other.angle;
  }
};

struct Symbol {
  std::string_view name;
  Unit unit;
};

constexpr std::array kSymbols = {
    Symbol{"m", {.length = 1}},
    Symbol{"km", {.length = 1, .decimal = 3}},
    Symbol{"cm", {.length = 1, .decimal = -2}},
    Symbol{"mm", {.length = 1, .decimal = -3}},
    Symbol{"um", {.length = 1, .decimal = -6}},
    Symbol{"s", {.time = 1}},
    Symbol{"ms", {.time = 1, .decimal = -3}},
    Symbol{"us", {.time = 1, .decimal = -6}},
    Symbol{"min", {.time = 1, .numerator = 60}},
    Symbol{"h", {.time = 1, .numerator = 3600}},
    Symbol{"kg", {.mass = 1}},
    Symbol{"g", {.mass = 1, .decimal = -3}},
    Symbol{"t", {.mass = 1, .decimal = 3}},
    Symbol{"Hz", {.time = -1}},
    Symbol{"kHz", {.time = -1, .decimal = 3}},
    Symbol{"rad", {.angle = 1}},
    Symbol{"deg", {.angle = 1, .numerator = std::numbers::pi, .denominator = 180}},
    Symbol{"N", {.length = 1, .mass = 1, .time = -2}},
    Symbol{"kN", {.length = 1, .mass = 1, .time = -2, .decimal = 3}},
    Symbol{"MN", {.length = 1, .mass = 1, .time = -2, .decimal = 6}},
    Symbol{"J", {.length = 2, .mass = 1, .time = -2}},
    Symbol{"kJ", {.length = 2, .mass = 1, .time = -2, .decimal = 3}},
    Symbol{"Pa", {.length = -1, .mass = 1, .time = -2}},
    Symbol{"kPa", {.length = -1, .mass = 1, .time = -2, .decimal = 3}},
    Symbol{"MPa", {.length = -1, .mass = 1, .time = -2, .decimal = 6}},
    Symbol{"cSt", {.length = 2, .time = -1, .decimal = -6}},
    Symbol{"%", {.decimal = -2}},
};

/// `unit` times `other` to the power `exponent`.
void multiply(Unit& unit, const Unit& other, int exponent) {
  unit.length += exponent * other.length;
  unit.mass += exponent * other.mass;
  unit.time += exponent * other.time;
  unit.angle += exponent * other.angle;
  unit.decimal += exponent * other.decimal;
  for (int i = 0; i < std::abs(exponent); ++i) {
    unit.numerator *= exponent > 0 ? other.numerator : other.denominator;
    unit.denominator *= exponent > 0 ? other.denominator : other.numerator;
  }
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// A text without the spaces at its ends.
std::string_view stripped(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

struct UnitText {
  std::optional<Unit> unit;
  std::string unknown;  ///< the symbol that is none
};

/// Takes a unit apart: "kg/m3", "m s^-2", "m/s²", "1/s". Symbols with whole exponents, multiplied by a space, "*" or
/// "."; what follows the one "/" divides.
class UnitParser {
 public:
  explicit UnitParser(std::string_view written) : text_(written) {
    for (const auto& [from, to] : {std::pair{"²", "2"}, {"³", "3"}, {"°", "deg"}, {"µ", "u"}}) {
      text_ = replaced(text_, from, to);
    }
  }

  UnitText parse() {
    if (text_ == "-") return {Unit{}, ""};
    Unit unit;
    int sign = 1;
    if (text_.compare(0, 1, "1") == 0) ++at_;  // "1/s"
    if (at_ < text_.size() && (at_ > 0 || text_[0] == '/')) {
      if (text_[at_] != '/') return {{}, text_};
    } else if (!term(unit, sign)) {
      return unknown();
    }
    while (skip_spaces(), at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '/') {
        if (sign < 0) return {{}, text_};  // "a/b/c" can be read in two ways.
        sign = -1;
      }
      if (c == '/' || c == '*' || c == '.') ++at_;
      skip_spaces();
      if (!term(unit, sign)) return unknown();
    }
    return {unit, ""};
  }

 private:
  void skip_spaces() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  /// One symbol with its exponent.
  bool term(Unit& unit, int sign) {
    const std::size_t end = std::min(text_.find_first_of(" *./^-0123456789", at_), text_.size());
    symbol_ = text_.substr(at_, end - at_);
    const auto* known =
        std::find_if(kSymbols.begin(), kSymbols.end(), [&](const Symbol& s) { return s.name == symbol_; });
    if (known == kSymbols.end()) return false;
    at_ = end;
    const bool caret = at_ < text_.size() && text_[at_] == '^';
    if (caret) ++at_;
    const bool minus = at_ < text_.size() && text_[at_] == '-';
    if (minus) ++at_;
    int exponent = 1;
    if (at_ < text_.size() && text_[at_] >= '1' && text_[at_] <= '9') {
      exponent = text_[at_++] - '0';
    } else if (caret || minus) {
      symbol_ = text_;
      return false;
    }
    multiply(unit, known->unit, minus ? -sign * exponent : sign * exponent);
    return true;
  }

  UnitText unknown() const { return {{}, symbol_.empty() ? text_ : symbol_}; }

  std::string text_;
  std::size_t at_ = 0;
  std::string symbol_;  ///< the last one read
};

UnitText read_unit(std::string_view written) { return UnitParser(written).parse(); }

/// Length of the number at the start of a text, by JSON's grammar; 0 when there is none. `exponent_at`: where its "e"
/// is.
std::size_t number_length(std::string_view text, std::size_t& exponent_at) {
  const auto digits = [&](std::size_t from) {
    std::size_t to = from;
    while (to < text.size() && text[to] >= '0' && text[to] <= '9') ++to;
    return to;
  };
  const std::size_t start = !text.empty() && text[0] == '-' ? 1 : 0;
  std::size_t end = digits(start);
  if (end == start || (text[start] == '0' && end > start + 1)) return 0;
  if (end < text.size() && text[end] == '.') {
    const std::size_t fraction = digits(end + 1);
    if (fraction == end + 1) return 0;
    end = fraction;
  }
  exponent_at = end;
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    std::size_t exponent = end + 1;
    if (exponent < text.size() && (text[exponent] == '+' || text[exponent] == '-')) ++exponent;
    if (digits(exponent) > exponent) end = digits(exponent);
  }
  return end;
}

}  // namespace

std::string number_text(double number) { return fmt::format("{}", number == 0 ? 0.0 : number); }

std::string unit_example(std::string_view unit) {
  if (unit == "m") return "12 mm";
  if (unit == "m/s") return "0.06 m/s";
  if (unit == "m/s2") return "9.81 m/s2";
  if (unit == "s") return "5 ms";
  if (unit == "Hz") return "20 Hz";
  if (unit == "rad") return "60 deg";
  if (unit == "kg/m3") return "1.5 t/m3";
  if (unit == "m2/s") return "1 mm2/s";
  if (unit == "kN/m3") return "18 kN/m3";
  if (unit == "mm") return "35.7 mm";
  return fmt::format("1 {}", unit);
}

UnitResult check_unit(std::string_view unit) {
  const UnitText text = read_unit(unit);
  if (text.unit) return {};
  std::vector<std::string> names;
  for (const Symbol& symbol : kSymbols) names.emplace_back(symbol.name);
  const std::string near = nearest(text.unknown, names);
  return {0, fmt::format("has an unknown unit \"{}\"", text.unknown),
          near.empty() ? "" : replaced(std::string(unit), text.unknown, near)};
}

UnitResult read_quantity(std::string_view text, Quantity& quantity) {
  text = stripped(text);
  std::size_t exponent_at = 0;
  const std::string_view unit = stripped(text.substr(number_length(text, exponent_at)));
  const std::string_view number = text.substr(0, text.size() - unit.size());
  // Without number or unit it is wrong as a plain number would be.
  if (number.empty() || unit.empty()) return read_quantity(text, "-");
  if (UnitResult known = check_unit(unit); !known.problem.empty()) {
    if (!known.nearest.empty()) known.nearest = fmt::format("{} {}", stripped(number), known.nearest);
    return known;
  }
  const UnitResult plain = read_quantity(fmt::format("{} -", stripped(number)), "-");
  if (plain.problem.empty()) quantity = {plain.value, std::string(unit)};
  return plain;
}

UnitResult convert(const Quantity& quantity, std::string_view unit) {
  if (quantity.unit.empty() || quantity.unit == unit) return {quantity.value, "", ""};
  if (UnitResult known = check_unit(unit); !known.problem.empty()) return known;
  return read_quantity(fmt::format("{} {}", number_text(quantity.value), quantity.unit), unit);
}

UnitResult read_quantity(std::string_view text, std::string_view unit) {
  const Unit target = read_unit(unit).unit.value();  // A unit of ours that is none is our bug.
  text = stripped(text);

  std::size_t exponent_at = 0;
  const std::size_t length = number_length(text, exponent_at);
  if (length == 0) return {0, "is a string without a number", unit == "-" ? "" : unit_example(unit)};
  const std::string number(text.substr(0, length));
  const std::string_view rest = stripped(text.substr(length));

  if (rest.empty()) {
    if (unit == "-") return {0, "is a number in quotes", number};
    return {0, "has no unit", fmt::format("{} {}", number, unit == "rad" ? "deg" : unit)};
  }
  const UnitText source = read_unit(rest);
  if (!source.unit) {
    UnitResult unknown = check_unit(rest);
    unknown.nearest = unknown.nearest.empty() ? unit_example(unit) : fmt::format("{} {}", number, unknown.nearest);
    return unknown;
  }
  if (!source.unit->same_dimension(target)) {
    if (unit == "-") return {0, fmt::format("is in {}, but this is a plain number", rest), number};
    return {0, fmt::format("is in {}, which is not a unit for {}", rest, unit), unit_example(unit)};
  }

  const std::string mantissa = number.substr(0, exponent_at);
  long exponent = source.unit->decimal - target.decimal;
  if (exponent_at < length) {
    const std::string written = number.substr(exponent_at + 1);
    if (written.size() > 5) return {0, "overflows or is too small", ""};
    exponent += std::stol(written);
  }
  const std::string shifted = fmt::format("{}e{}", mantissa, exponent);
  double value = 0;
  const auto parsed = std::from_chars(shifted.data(), shifted.data() + shifted.size(), value);
  value = value * source.unit->numerator / source.unit->denominator;
  value = value * target.denominator / target.numerator;
  const bool zero = mantissa.find_first_of("123456789") == std::string::npos;
  if (parsed.ec != std::errc() || !std::isfinite(value) || (value == 0 && !zero)) {
    return {0, "overflows or is too small", ""};
  }
  return {value, "", ""};
}

}  // namespace seapile::study
