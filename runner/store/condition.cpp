#include "runner/store/condition.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace seapile::store {

namespace {

using Op = Condition::Op;

// The longer ones first: "<=" begins like "<".
constexpr std::array<std::pair<std::string_view, Op>, 6> kOps = {{{"!=", Op::not_equal},
                                                                  {"<=", Op::less_equal},
                                                                  {">=", Op::greater_equal},
                                                                  {"=", Op::equal},
                                                                  {"<", Op::less},
                                                                  {">", Op::greater}}};

constexpr std::string_view kOpCharacters = "=!<>";
constexpr std::string_view kNotInPath = " \t\"'";

[[noreturn]] void refuse(const std::string& text, const std::string& why) {
  throw std::invalid_argument("\"" + text + "\" is no condition: " + why);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Whether it begins as a number does: "0.2 m/s". What it means, a reader who knows units finds out.
bool may_be_quantity(const decltype(Condition::value)& value) {
  const auto* text = std::get_if<std::string>(&value);
  return text != nullptr && text->find_first_of("0123456789") <= text->find_first_not_of("+-.");
}

bool is_bare(std::string_view word) { return word.find_first_of("\"'=<>!") == word.npos; }

decltype(Condition::value) parse_value(const std::string& text, std::string_view value) {
  if (value.empty()) refuse(text, "a value is missing");
  if (value == "null") return std::monostate{};
  const char quote = value.front();
  if (quote == '"' || quote == '\'') {
    const std::string_view inside = value.substr(1, value.size() - 2);
    if (value.size() < 2 || value.back() != quote || inside.find(quote) != inside.npos) {
      refuse(text, "the quotes do not match");
    }
    return std::string(inside);
  }
  double number = 0;
  const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
  if (error == std::errc{} && end == value.data() + value.size() && std::isfinite(number)) return number;
  if (!is_bare(value)) refuse(text, "put the text between quotes");
  return std::string(value);
}

}  // namespace

const char* sql(Op op) {
  static constexpr const char* kSql[] = {"=", "<>", "<", "<=", ">", ">="};
  return kSql[static_cast<int>(op)];
}

Condition parse_condition(const std::string& text) {
  const std::string_view whole = text;
  std::string_view rest = whole.substr(std::min(whole.find_first_of(kOpCharacters), whole.size()));
  Condition condition;
  condition.path = trimmed(whole.substr(0, whole.size() - rest.size()));
  if (condition.path.empty() || condition.path.find_first_of(kNotInPath) != std::string::npos) {
    refuse(text, "it should read path op value, as in pile.tip = flat");
  }
  std::size_t length = 0;
  for (const auto& [sign, op] : kOps) {
    if (length == 0 && rest.starts_with(sign)) {
      condition.op = op;
      length = sign.size();
    }
  }
  if (length == 0) refuse(text, "after the path comes one of = != < <= > >=");
  condition.value = parse_value(text, trimmed(rest.substr(length)));
  if (std::holds_alternative<double>(condition.value)) condition.written = trimmed(rest.substr(length));
  const bool ordered = condition.op != Op::equal && condition.op != Op::not_equal;
  const bool is_number = std::holds_alternative<double>(condition.value) || may_be_quantity(condition.value);
  if (ordered && !is_number) refuse(text, "only numbers have an order");
  return condition;
}

}  // namespace seapile::store
