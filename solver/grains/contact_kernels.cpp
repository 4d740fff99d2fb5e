#include "solver/grains/contact_kernels.h"

#include <stdexcept>

#include "solver/grains/contact_kernel_tables.h"

namespace seapile::grains {

bool available(InstructionSet set) {
#if defined(SEAPILE_X86)
  switch (set) {
    case InstructionSet::generic: return true;
    case InstructionSet::avx2: return __builtin_cpu_supports("avx2");
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
  }
#endif
  return set == InstructionSet::generic;
}

InstructionSet fastest() {
#if defined(SEAPILE_X86)
  // AMD's family 19h: Zen 3, which has no AVX-512, and Zen 4.
  if (available(InstructionSet::avx512) && !__builtin_cpu_is("amdfam19h")) return InstructionSet::avx512;
  if (available(InstructionSet::avx2)) return InstructionSet::avx2;
#endif
  return InstructionSet::generic;
}

template <>
const ContactKernels<float>& contact_kernels<float>(InstructionSet set) {
  if (!available(set)) throw std::invalid_argument("the processor lacks the instructions asked for");
#if defined(SEAPILE_X86)
  if (set == InstructionSet::avx512) return kFloatKernels_avx512;
  if (set == InstructionSet::avx2) return kFloatKernels_avx2;
#endif
  return kFloatKernels_generic;
}

template <>
const ContactKernels<double>& contact_kernels<double>(InstructionSet set) {
  if (!available(set)) throw std::invalid_argument("the processor lacks the instructions asked for");
#if defined(SEAPILE_X86)
  if (set == InstructionSet::avx512) return kDoubleKernels_avx512;
  if (set == InstructionSet::avx2) return kDoubleKernels_avx2;
#endif
  return kDoubleKernels_generic;
}

}  // namespace seapile::grains
