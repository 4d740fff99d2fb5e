// The residual kernel for avx2.
#include <algorithm>

#include "solver/fluid/residual_kernels.h"

#define SEAPILE_VECTOR_BYTES 32

namespace seapile::fluid {
namespace {

#include "solver/fluid/residual_kernel.inl"

}  // namespace

extern const ResidualKernel kResidualKernel_avx2 = add_triangles;

}  // namespace seapile::fluid
