// The contact kernels for any processor (16-byte vectors).

#include <cmath>
#include <limits>

#include "solver/grains/contact_kernels.h"
#include "solver/grains/contact_kernel_tables.h"

#define SEAPILE_VECTOR_BYTES 16

namespace seapile::grains {
namespace {

inline float root(float a) { return __builtin_sqrtf(a); }
inline double root(double a) { return __builtin_sqrt(a); }

#include "solver/grains/simd_lanes.inl"

#include "solver/grains/contact_kernels.inl"

}  // namespace

extern const ContactKernels<float> kFloatKernels_generic = table<float>("generic");
extern const ContactKernels<double> kDoubleKernels_generic = table<double>("generic");

}  // namespace seapile::grains
