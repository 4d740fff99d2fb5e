// The contact kernels for avx512.
#include <immintrin.h>

#include <cmath>
#include <limits>

#include "solver/grains/contact_kernels.h"
#include "solver/grains/contact_kernel_tables.h"

#define SEAPILE_VECTOR_BYTES 64

namespace seapile::grains {
namespace {

inline float root(float a) { return __builtin_sqrtf(a); }
inline double root(double a) { return __builtin_sqrt(a); }

#include "solver/grains/simd_lanes.inl"

#include "solver/grains/contact_kernels.inl"

}  // namespace

extern const ContactKernels<float> kFloatKernels_avx512 = table<float>("avx512");
extern const ContactKernels<double> kDoubleKernels_avx512 = table<double>("avx512");

}  // namespace seapile::grains
