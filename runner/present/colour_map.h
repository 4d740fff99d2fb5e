// Numbers as colours that look equally far apart where the numbers are.
#pragma once

namespace seapile::present {

/// Red, green and blue, each from 0 to 1 (sRGB).
struct Colour {
  double red = 0, green = 0, blue = 0;
  friend bool operator==(const Colour&, const Colour&) = default;
};

/// Perceptually uniform, readable by the colour-blind and in grey: pale for 0, dark for 1, as ink on white paper. What
/// lies outside [0, 1] gets the colour of the nearer end; not a number: grey.
Colour colour_of(double share);

}  // namespace seapile::present
