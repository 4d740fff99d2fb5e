// The kernel of discs with one edge for any processor.
#include <algorithm>
#include <numbers>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/one_edge_kernels.h"

namespace seapile::coupling {
namespace {

#include "solver/coupling/one_edge_kernel.inl"

}  // namespace

extern const OneEdgeKernel kOneEdgeKernel_generic = by_one_edge;

}  // namespace seapile::coupling
