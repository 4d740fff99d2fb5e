// The kernel of wedges for avx2.
#include <algorithm>
#include <numbers>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/wedge_kernels.h"

namespace seapile::coupling {
namespace {

#include "solver/coupling/wedge_kernel.inl"

}  // namespace

extern const WedgeKernel kWedgeKernel_avx2 = by_rays;

}  // namespace seapile::coupling
