// JSON as the user wrote it, with the place of every value, read strictly.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/problem.h"

namespace seapile::study {

/// Where a value stands: a chain of keys and indices up to the root, which names a document ("" or "--set pile.depth").
struct Place {
  std::shared_ptr<const Place> up;  ///< null at the root
  std::string token;
};
using PlacePtr = std::shared_ptr<const Place>;

PlacePtr root_place(std::string name);
PlacePtr place_in(PlacePtr up, std::string token);

/// The root's name followed by the JSON pointer (RFC 6901) below it.
std::string pointer(const PlacePtr& place);

struct Value {
  /// `unusable`: was already reported as a problem; nobody looks at it again.
  enum class Kind { null, boolean, number, string, array, object, unusable };

  Kind kind = Kind::null;
  bool truth = false;
  double number = 0;
  std::string text;
  std::vector<std::string> keys;  ///< of an object, in the order written; one per item
  std::vector<Value> items;       ///< of an array or an object
  PlacePtr place;

  /// The member of an object; null when there is none.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  /// Inserts or replaces a member.
  Value& put(std::string key, Value value);
};

Value number_value(double number, PlacePtr place);
Value string_value(std::string text, PlacePtr place);
Value truth_value(bool truth, PlacePtr place);
Value object_value(PlacePtr place);  ///< without members

/// What a value is, with its article: "a string", "true", "null".
std::string kind_name(const Value& value);

inline constexpr std::size_t kMostBytes = 16 * 1024 * 1024;
inline constexpr std::size_t kDeepest = 32;
inline constexpr std::size_t kMostValues = 200'000;

/// Reads one JSON text. Refused are: a byte order mark, ill-formed UTF-8, control characters, comments, anything after
/// the end, nesting beyond kDeepest, more than kMostValues, duplicate keys, numbers that overflow, numbers that become
/// 0 without being 0, and integers beyond 2^53, where doubles have gaps. `root` names the document in pointers.
/// Kind::unusable when the text cannot be taken apart; the problems say why.
Value read_json(std::string_view bytes, const std::string& root, base::Problems& problems);

}  // namespace seapile::study
