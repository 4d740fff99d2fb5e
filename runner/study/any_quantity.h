// Words and numbers of a study that belong to no field of a scene: what it says of metrics, whose units are known only
// once they have been computed.
#pragma once

#include <optional>
#include <string>

#include "runner/study/json_value.h"
#include "runner/study/unit.h"

namespace seapile::study {

inline constexpr const char* kAnyNumber = "a number, in SI units or with its unit";

/// A text that says something.
void read_words(const Value& value, std::string& words, base::Problems& problems);

/// A number, in SI units or with its unit.
void read_any_quantity(const Value& value, const std::string& allowed, Quantity& quantity, base::Problems& problems);

/// Two numbers in the unit of the first; "": both are in SI units.
struct QuantityPair {
  double first = 0, second = 0;
  std::string unit;
};

/// `name`: what the first is called where the second does not fit to it. Absent after a problem.
std::optional<QuantityPair> read_pair(const Value& first, const char* name, const Value& second,
                                      const std::string& second_allowed, base::Problems& problems);

/// "3 is out of range".
std::string out_of_range(double number);

}  // namespace seapile::study
