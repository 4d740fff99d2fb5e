// The residual kernels of all instruction sets; residual.h is what the solver calls.
#pragma once

#include "solver/fluid/residual.h"

namespace seapile::fluid {

/// Adds the residuals of all triangles.
using ResidualKernel = void (*)(const Properties& fluid, const PackedFlow& packed, const double* unknown,
                                double* residual);

extern const ResidualKernel kResidualKernel_generic, kResidualKernel_avx2, kResidualKernel_avx512;

}  // namespace seapile::fluid
