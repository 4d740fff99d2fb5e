#pragma once

#include "solver/base/instruction_set.h"

namespace seapile::simulation {

/// Instructions used by the contact kernels. All give the same bits.
enum class Simd { best, generic, avx2, avx512 };

/// How a case is executed; changes no bit of the result.
struct Execution {
  int threads = 1;
  Simd simd = Simd::best;
};

/// The instructions that `simd` means on this machine.
base::InstructionSet instructions_of(Simd simd);
/// Their name: "generic", "avx2" or "avx512".
const char* simd_in_use(Simd simd);

}  // namespace seapile::simulation
