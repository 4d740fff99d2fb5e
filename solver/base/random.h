// Counter-based random numbers: the n-th number of a stream is a function of (seed, stream, n) alone, so it depends on
// no order of calls. Philox4x32-10 (Salmon et al. 2011) from Random123; the distribution is our own, because the
// standard library's differ between implementations.
#pragma once

#include <Random123/philox.h>

#include <cstdint>

namespace seapile::base {

/// Uniform in [0, 1): the upper 53 bits of two words.
inline double uniform(std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  const r123::Philox4x32::ctr_type counter = {
      {static_cast<std::uint32_t>(index), static_cast<std::uint32_t>(index >> 32), stream, 0}};
  const r123::Philox4x32::key_type key = {{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto word = r123::Philox4x32{}(counter, key);
  const std::uint64_t bits = (static_cast<std::uint64_t>(word[0]) << 32) | word[1];
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// Uniform in [min, max).
inline double uniform(double min, double max, std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  return min + (max - min) * uniform(seed, stream, index);
}

}  // namespace seapile::base
