// Fills a spec from JSON by walking its field list. Members that are not written keep their defaults; nothing is
// converted silently; every problem of the whole value is collected.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "runner/study/json_value.h"
#include "solver/base/fields.h"
#include "solver/base/problem.h"

namespace seapile::study {

/// Each reads one member; on a problem it is reported and the member keeps what it had.
void read_number(const Value& value, const base::Field& field, double& member, base::Problems& problems);
void read_integer(const Value& value, const base::Field& field, std::int64_t& member, base::Problems& problems);
void read_boolean(const Value& value, bool& member, base::Problems& problems);
void read_string(const Value& value, std::string& member, base::Problems& problems);
void read_numbers(const Value& value, const base::Field& field, std::vector<double>& member, base::Problems& problems);
/// The index of a name written as a string.
std::optional<std::size_t> read_choice(const Value& value, const std::vector<std::string>& names,
                                       base::Problems& problems);
/// The index of an alternative written as "name" or {"name": {...}}; `inside`: what stands in the braces, or null.
std::optional<std::size_t> read_alternative(const Value& value, const std::vector<std::string>& names,
                                            const Value*& inside, base::Problems& problems);
/// False, and a problem, when the value is no object.
bool is_object(const Value& value, base::Problems& problems);
/// One problem for each key that is not among the known ones.
void report_unknown_keys(const Value& object, const std::vector<std::string>& known, base::Problems& problems);

/// "from 0 to 10", "more than 0, at most 100 m": what a number may be.
std::string range_text(const base::Field& field);

template <class Spec>
void read_spec(const Value& value, Spec& spec, base::Problems& problems);

template <class T>
inline constexpr bool kIsOptional = false;
template <class T>
inline constexpr bool kIsOptional<std::optional<T>> = true;
template <class T>
inline constexpr bool kIsVariant = false;
template <class... Ts>
inline constexpr bool kIsVariant<std::variant<Ts...>> = true;

/// The names of a variant's alternatives.
template <class... Ts>
std::vector<std::string> alternative_names(const std::variant<Ts...>&) {
  return {Ts::kName...};
}

/// The names of an enum's values.
template <class Enum>
std::vector<std::string> enum_names() {
  return {std::begin(base::EnumNames<Enum>::values), std::end(base::EnumNames<Enum>::values)};
}

/// Makes the variant hold its alternative number `index`, default-constructed.
template <std::size_t I = 0, class Variant>
void emplace_alternative(Variant& variant, std::size_t index) {
  if constexpr (I < std::variant_size_v<Variant>) {
    if (index == I) {
      variant.template emplace<I>();
    } else {
      emplace_alternative<I + 1>(variant, index);
    }
  }
}

template <class T>
void read_member(const Value& value, const base::Field& field, T& member, base::Problems& problems) {
  if (value.kind == Value::Kind::unusable) return;
  if constexpr (std::is_same_v<T, double>) {
    read_number(value, field, member, problems);
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    read_integer(value, field, member, problems);
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    auto number = static_cast<std::int64_t>(member);
    read_integer(value, field, number, problems);
    member = static_cast<std::uint64_t>(number);
  } else if constexpr (std::is_same_v<T, bool>) {
    read_boolean(value, member, problems);
  } else if constexpr (std::is_same_v<T, std::string>) {
    read_string(value, member, problems);
  } else if constexpr (std::is_enum_v<T>) {
    if (const auto index = read_choice(value, enum_names<T>(), problems)) member = static_cast<T>(*index);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    read_numbers(value, field, member, problems);
  } else if constexpr (kIsOptional<T>) {
    if (value.kind == Value::Kind::null) {
      member.reset();
    } else {
      if (!member) member.emplace();
      read_member(value, field, *member, problems);
    }
  } else if constexpr (kIsVariant<T>) {
    const Value* inside = nullptr;
    if (const auto index = read_alternative(value, alternative_names(member), inside, problems)) {
      emplace_alternative(member, *index);
      if (inside) std::visit([&](auto& alternative) { read_spec(*inside, alternative, problems); }, member);
    }
  } else {
    read_spec(value, member, problems);
  }
}

template <class Spec>
void read_spec(const Value& value, Spec& spec, base::Problems& problems) {
  if (value.kind == Value::Kind::unusable || !is_object(value, problems)) return;
  std::vector<std::string> known;
  const auto visit = [&](const base::Field& field, auto& member) {
    known.emplace_back(field.key);
    if (const Value* written = value.find(field.key)) read_member(*written, field, member, problems);
  };
  fields(visit, spec);
  report_unknown_keys(value, known, problems);
}

}  // namespace seapile::study
