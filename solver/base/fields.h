// The one list of a spec's fields, from which everything else is made.
//
// A spec is a plain struct. Beside it stands one function template
//
//   void fields(auto& visit, SameAs<PileSpec> auto& pile) {
//     visit(Field{"radius", "m", positive(), "half-width R"}, pile.radius);
//   }
//
// and the JSON reader, the canonical writer, the query's column names and the documentation all call it with a
// visitor of their own. A member may be: double, std::int64_t, std::uint64_t, bool, std::string, an enum with
// EnumNames, std::vector<double>, std::optional<T>, a std::variant of structs that each have a `kName`, or another
// spec.
#pragma once

#include <concepts>
#include <limits>
#include <string_view>
#include <type_traits>

namespace seapile::base {

/// The values that a number may take: [min, max], an end left out when open.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool open_min = false;
  bool open_max = false;

  /// False for NaN.
  constexpr bool contains(double value) const {
    const bool above = open_min ? value > min : value >= min;
    const bool below = open_max ? value < max : value <= max;
    return above && below;
  }
};

/// (0, max].
constexpr Range positive(double max) { return {0, max, true, false}; }
/// [min, max].
constexpr Range between(double min, double max) { return {min, max, false, false}; }

/// What a field list says of one member.
struct Field {
  std::string_view key;      ///< as the study writes it
  std::string_view unit;     ///< SI unit of the stored number: "m", "m/s", "rad", "-", ...; "" for what is not a number
  Range range;               ///< allowed values, in that unit; for a vector: of each element
  std::string_view meaning;  ///< one line, with the symbol
  /// Added after cases had been stored: left out of the canonical text while it holds its default, which has to be what
  /// was done before, so that old ids stay.
  bool later = false;
};

/// Key and meaning of a member that is no number (a struct, a variant, a string, an enum).
constexpr Field part(std::string_view key, std::string_view meaning) { return {key, "", {}, meaning, false}; }

/// The same field, added after cases had been stored.
constexpr Field later(Field field) {
  field.later = true;
  return field;
}

/// Accepts a spec, const or not.
template <class T, class Spec>
concept SameAs = std::same_as<std::remove_cvref_t<T>, Spec>;

/// The names of an enum's values, in their order; specialised beside each enum as `static constexpr const char* values[]`.
template <class Enum>
struct EnumNames;

}  // namespace seapile::base
