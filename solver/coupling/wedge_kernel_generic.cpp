// The kernel of discs with one edge for any processor.
#include <algorithm>
#include <numbers>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/wedge_kernels.h"

namespace seapile::coupling {
namespace {

#include "solver/coupling/wedge_kernel.inl"

}  // namespace

extern const WedgeKernel kWedgeKernel_generic = by_rays;

}  // namespace seapile::coupling
