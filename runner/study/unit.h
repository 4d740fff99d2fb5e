// Numbers with units: "0.06 m/s", "60 deg", "12 mm", "1.5 t/m3".
#pragma once

#include <string>
#include <string_view>

namespace seapile::study {

struct UnitResult {
  double value = 0;     ///< in the unit asked for, when `problem` is empty
  std::string problem;  ///< one clause
  std::string nearest;  ///< what was probably meant; "" when nothing is near
};

/// Reads a number with a unit and converts it to `unit`, which has to be one ("m/s", "rad", "-").
/// Powers of ten are shifted in the decimal text, so "19.2 mm" is the same double as 0.0192.
UnitResult read_quantity(std::string_view text, std::string_view unit);

/// A number as it was written, and its unit; "" when it was written without one.
struct Quantity {
  double value = 0;
  std::string unit;
};

/// Reads a number with a unit of any kind and leaves it in that unit.
UnitResult read_quantity(std::string_view text, Quantity& quantity);

/// The quantity in another unit; one without a unit is in that unit already.
UnitResult convert(const Quantity& quantity, std::string_view unit);

/// What is wrong with the text of a unit, and the nearest unit; its value means nothing.
UnitResult check_unit(std::string_view unit);

/// How a value in this unit may be written, for messages: "0.06 m/s".
std::string unit_example(std::string_view unit);

/// The shortest decimal text that reads back as the same double: 0.0005, 1500, 1e-07.
std::string number_text(double number);

}  // namespace seapile::study
