// The residual kernel for any processor (16-byte vectors).
#include <algorithm>

#include "solver/fluid/residual_kernels.h"

#define SEAPILE_VECTOR_BYTES 16

namespace seapile::fluid {
namespace {

#include "solver/fluid/residual_kernel.inl"

}  // namespace

extern const ResidualKernel kResidualKernel_generic = add_triangles;

}  // namespace seapile::fluid
