#pragma once

#include "solver/grains/contact_kernels.h"

namespace seapile::grains {

extern const ContactKernels<float> kFloatKernels_generic, kFloatKernels_avx2, kFloatKernels_avx512;
extern const ContactKernels<double> kDoubleKernels_generic, kDoubleKernels_avx2, kDoubleKernels_avx512;

}  // namespace seapile::grains
