// x^(-1/5), of which the drag laws' powers of the porosity are made: in a loop over grains it becomes vector
// instructions, and has the same bits with all C libraries, which std::pow does not.
#pragma once

#include <bit>
#include <cstdint>

namespace seapile::coupling {

/// z = x^(-1/5) for 1e-30 <= x <= 1e30, within 3e-16 of it. From the logarithm that the bits of a float are, within 3.2
/// %, twice with the first four terms of z (1 - e)^(-1/5), e = 1 - x z^5.
[[gnu::always_inline]] inline double inverse_fifth_root(double x) {
  // 1.2 (127 - 0.05) 2^23: the logarithm of 1 in the bits of a float, and what their line is off by in the mean.
  constexpr float kOne = 1.2F * (127 - 0.05F) * 8388608.0F;
  const auto logarithm = static_cast<float>(std::bit_cast<std::int32_t>(static_cast<float>(x)));
  double z = std::bit_cast<float>(static_cast<std::int32_t>(kOne - 0.2F * logarithm));
  for (int k = 0; k < 2; ++k) {
    const double z2 = z * z, e = 1 - x * z * (z2 * z2);
    z += z * e * (0.2 + e * (0.12 + e * 0.088));
  }
  return z;
}

/// x^-4.8, within 2e-15 of it.
[[gnu::always_inline]] inline double power_minus_4_8(double x) {
  const double x2 = x * x;
  return 1 / (x * (x2 * x2) * inverse_fifth_root(x));
}

}  // namespace seapile::coupling
