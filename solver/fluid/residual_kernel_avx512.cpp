// The residual kernel for avx512.
#include <algorithm>

#include "solver/fluid/residual_kernels.h"

#define SEAPILE_VECTOR_BYTES 64

namespace seapile::fluid {
namespace {

#include "solver/fluid/residual_kernel.inl"

}  // namespace

extern const ResidualKernel kResidualKernel_avx512 = add_triangles;

}  // namespace seapile::fluid
