#pragma once

#include <cstdint>

#include "solver/base/instruction_set.h"

namespace seapile::simulation {

/// Instructions used by the contact kernels. All give the same bits.
enum class Simd { best, generic, avx2, avx512 };

/// How steps are tried (stepping.h); tests alone say otherwise.
struct Trying {
  /// Steps of a stretch; 0: as usual. Where no step is objected to, it changes no bit of the result.
  std::int64_t stretch = 0;
  /// When so many whole steps are done for the first time, the stretch is done again, with steps of the same size; -1:
  /// never. Changes no bit of the result.
  std::int64_t reject_at = -1;
};

/// How a case is executed; changes no bit of the result.
struct Execution {
  int threads = 1;
  Simd simd = Simd::best;
  Trying trying = {};
};

/// The instructions that `simd` means on this machine.
base::InstructionSet instructions_of(Simd simd);
/// Their name: "generic", "avx2" or "avx512".
const char* simd_in_use(Simd simd);

}  // namespace seapile::simulation
