#include "solver/grains/contact_kernels.h"

#include <stdexcept>

#include "solver/grains/contact_kernel_tables.h"

namespace seapile::grains {

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
