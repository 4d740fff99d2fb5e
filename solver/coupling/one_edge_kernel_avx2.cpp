// The kernel of discs with one edge for avx2.
#include <algorithm>
#include <numbers>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/one_edge_kernels.h"

namespace seapile::coupling {
namespace {

#include "solver/coupling/one_edge_kernel.inl"

}  // namespace

extern const OneEdgeKernel kOneEdgeKernel_avx2 = by_one_edge;

}  // namespace seapile::coupling
