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

/// Reads a number with a unit and converts it to `unit`, one of the units of the field lists ("m/s", "rad", "-").
/// Powers of ten are shifted in the decimal text, so "19.2 mm" is the same double as 0.0192.
UnitResult read_quantity(std::string_view text, std::string_view unit);

/// How a value in this unit may be written, for messages: "0.06 m/s".
std::string unit_example(std::string_view unit);

/// The shortest decimal text that reads back as the same double: 0.0005, 1500, 1e-07.
std::string number_text(double number);

}  // namespace seapile::study
