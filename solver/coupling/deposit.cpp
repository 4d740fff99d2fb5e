#include "solver/coupling/deposit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "solver/coupling/by_kinks.h"
#include "solver/coupling/disc_in_triangle.h"
#include "solver/coupling/one_edge_kernels.h"
#include "solver/coupling/wedge_kernels.h"
#include "solver/mesh/elements.h"

namespace seapile::coupling {
namespace {

using base::Vec2;
using grains::Disc;
using mesh::TriangleMesh;

constexpr double kMostMoved = 0.1;  // of a bucket's width: farther, and more triangles are looked at than need be

/// Where the grains are looked for.
struct Mesh {
  const TriangleMesh& mesh;
  const Edges& edges;
  const mesh::Buckets& buckets;
  double moved;  ///< farthest way of a vertex since the buckets were made [m]

  /// Those that may overlap a box, by rising number.
  void near(Vec2 low, Vec2 high, std::vector<std::int32_t>& found) const {
    const Vec2 way = {moved, moved};
    buckets.near({low - way, high + way}, found);
  }
};

struct Kernels {
  OneEdgeKernel one_edge;
  WedgeKernel wedges;
};

Kernels kernels_of(base::InstructionSet set) {
#if defined(SEAPILE_X86)
  if (set == base::InstructionSet::avx512) return {kOneEdgeKernel_avx512, kWedgeKernel_avx512};
  if (set == base::InstructionSet::avx2) return {kOneEdgeKernel_avx2, kWedgeKernel_avx2};
#endif
  (void)set;
  return {kOneEdgeKernel_generic, kWedgeKernel_generic};
}

/// Some grains' rows, and what one thread needs to make them.
class Rows {
 public:
  std::vector<std::int32_t> count;  ///< of entries, (grains)
  std::vector<std::int32_t> vertex;
  std::vector<double> volume;

  /// `immersed`: of all grains.
  void make(const Mesh& mesh, const Kernels& kernels, std::vector<std::int32_t>& last, std::span<const Disc> discs,
            Kernel kernel, std::size_t from, std::size_t to, std::vector<double>& immersed) {
    const OneEdgeKernel one_edge = kernels.one_edge;
    count.reserve(to - from);
    ByKinks kinks(mesh.edges, kernels.wedges);
    for (std::size_t i = from; i < to; ++i) {
      if (kernel == Kernel::disc && (i - from) % OneEdge::kDiscs == 0)
        one_edge(mesh.edges.data(), discs.subspan(i, std::min<std::size_t>(to - i, OneEdge::kDiscs)), &last[i], few_);
      const std::size_t before = used_, grains_left = to - i;
      if (used_ + FewEntries::kMost > vertex.size()) grow(5 * grains_left);
      if (kernel == Kernel::hat)
        at_centre(mesh, discs[i], last[i]);
      else if (!write_few(few_, (i - from) % OneEdge::kDiscs))
        over_edges(mesh, one_edge, kinks, discs[i], last[i]);
      count.push_back(static_cast<std::int32_t>(used_ - before));
      double sum = 0;
      for (std::size_t k = before; k < used_; ++k) sum += volume[k];
      immersed[i] = sum;
    }
    vertex.resize(used_);
    volume.resize(used_);
  }

 private:
  void grow(std::size_t more) {
    vertex.resize(used_ + FewEntries::kMost + more);
    volume.resize(vertex.size());
  }

  static bool is_somewhere(const Disc& d) {
    return std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.radius);
  }

  /// The first of the triangles that hold a place, or -1.
  std::int32_t holder(const Mesh& mesh, Vec2 place, std::int32_t guess, View& v) {
    if (guess >= 0) {
      v = view(mesh.edges, guess, place);
      if (v.holds()) return guess;
    }
    mesh.near(place, place, near_);
    for (const std::int32_t t : near_) {
      v = view(mesh.edges, t, place);
      if (v.turned[0] >= 0 && v.turned[1] >= 0 && v.turned[2] >= 0) return t;
    }
    return -1;
  }

  void write(std::int32_t at, double what) {
    vertex[used_] = at;
    volume[used_++] = std::max(what, 0.0);
  }

  void at_centre(const Mesh& mesh, const Disc& disc, std::int32_t& last) {
    if (!is_somewhere(disc)) return;
    View v;
    last = holder(mesh, {disc.x, disc.y}, last, v);
    if (last < 0) return;
    const double all = std::numbers::pi * disc.radius * disc.radius;
    for (int k = 0; k < 3; ++k) write(mesh.edges[3 * last + k].vertex, all * value_at_corner(mesh.edges, last, v, k));
  }

  bool write_few(const OneEdge& rows, std::size_t n) {
    std::ranges::copy(rows.vertex[n], &vertex[used_]);
    std::ranges::copy(rows.volume[n], &volume[used_]);
    used_ += rows.entries[n];
    return rows.entries[n] > 0;
  }

  /// A disc that is not in the triangle `last`, or crosses more edges.
  void over_edges(const Mesh& mesh, OneEdgeKernel one_edge, ByKinks& kinks, const Disc& disc, std::int32_t& last) {
    if (!is_somewhere(disc)) return;
    View v;
    const std::int32_t t = holder(mesh, {disc.x, disc.y}, last, v);
    if (t != std::exchange(last, t)) {
      OneEdge alone;
      one_edge(mesh.edges.data(), {&disc, 1}, &t, alone);
      if (write_few(alone, 0)) return;
    }
    if (t >= 0 && kinks.make(disc, t, v))
      for (int k = 0; k < kinks.sum.count; ++k) write(kinks.sum.entry[k].vertex, kinks.sum.entry[k].volume);
    else
      by_pieces(mesh, disc);
  }

  /// Whether a disc is beyond the line of an edge of t.
  static bool is_beside(const Edges& edges, double radius, std::int32_t t, const View& v) {
    return v.turned[0] * edges[3 * t].per_length <= -radius || v.turned[1] * edges[3 * t + 1].per_length <= -radius ||
           v.turned[2] * edges[3 * t + 2].per_length <= -radius;
  }

  /// Any disc: triangle by triangle, by rising number.
  void by_pieces(const Mesh& mesh, const Disc& disc) {
    const Vec2 centre = {disc.x, disc.y}, reach = {disc.radius, disc.radius};
    mesh.near(centre - reach, centre + reach, near_);
    pieces_.clear();
    for (const std::int32_t t : near_) {
      const auto& corners = mesh.mesh.triangle[t];
      const View v = view(mesh.edges, t, centre);
      if (is_beside(mesh.edges, disc.radius, t, v)) continue;
      const Moments part = disc_in_triangle(disc.radius, v.corner[0], v.corner[1], v.corner[2]);
      if (!(part.area > 0)) continue;
      const Vec2 b = v.corner[1] - v.corner[0], c = v.corner[2] - v.corner[0];
      const double doubled = cross(b, c);
      // N_j is linear: its value at the centre times the area, and its slope times the first moment.
      const double at_b = (v.turned[2] * part.area + dot(perpendicular(c), -1 * part.first)) / doubled,
                   at_c = (v.turned[0] * part.area + dot(perpendicular(b), part.first)) / doubled;
      pieces_.push_back({corners[0], part.area - at_b - at_c});
      pieces_.push_back({corners[1], at_b});
      pieces_.push_back({corners[2], at_c});
    }
    std::ranges::stable_sort(pieces_, {}, &Entry::vertex);
    if (used_ + pieces_.size() > vertex.size()) grow(pieces_.size());
    for (auto at = pieces_.begin(); at != pieces_.end();) {
      const std::int32_t here = at->vertex;
      double sum = 0;
      for (; at != pieces_.end() && at->vertex == here; ++at) sum += at->volume;
      write(here, sum);
    }
  }

  OneEdge few_;
  std::size_t used_ = 0;
  std::vector<std::int32_t> near_;
  std::vector<Entry> pieces_;
};

/// The farthest way of a vertex since the buckets were made, which are made again when it is too long.
double follow(const TriangleMesh& mesh, Location& location) {
  double moved = 0;
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    const Vec2 way = mesh.position[v] - location.position[v];
    moved = std::max(moved, std::max(std::abs(way.x), std::abs(way.y)));
  }
  if (moved <= kMostMoved * location.buckets.cell_size()) return moved;
  location.buckets = mesh::Buckets(mesh);
  location.position = mesh.position;
  return 0;
}

}  // namespace

Location::Location(const TriangleMesh& mesh)
    : triangle(mesh.triangle), edges(mesh.triangle), buckets(mesh), position(mesh.position) {}

Deposit deposit(const TriangleMesh& mesh, Location& location, std::span<const Disc> discs, Kernel kernel,
                base::Crew* crew, base::InstructionSet instructions) {
  if (location.triangle != mesh.triangle) throw std::logic_error("coupling: grains were located in another mesh");
  if (location.last.size() != discs.size()) location.last.assign(discs.size(), -1);
  const Mesh here{mesh, location.edges, location.buckets, follow(mesh, location)};
  if (location.measured != mesh.position) {
    base::together(crew, [&](int me, int threads) { location.edges.measure(mesh, me, threads); });
    location.measured = mesh.position;
  }

  // Blocks of grains, which do not depend on the number of threads; without a crew a single one.
  const std::size_t size = crew != nullptr ? 512 : std::max<std::size_t>(discs.size(), 1);
  std::vector<Rows> blocks((discs.size() + size - 1) / size);
  Deposit result;
  if (!location.spare.empty()) {
    result = std::move(location.spare.back());
    location.spare.pop_back();
  }
  if (blocks.size() == 1) {
    blocks[0].vertex = std::move(result.vertex);
    blocks[0].volume = std::move(result.volume);
  }
  result.first.clear();
  result.vertex.clear();
  result.volume.clear();
  result.immersed.resize(discs.size());
  base::together(crew, [&](int me, int threads) {
    for (std::size_t b = me; b < blocks.size(); b += threads)
      blocks[b].make(here, kernels_of(instructions), location.last, discs, kernel, b * size,
                     std::min((b + 1) * size, discs.size()), result.immersed);
  });

  result.first.reserve(discs.size() + 1);
  result.first.push_back(0);
  std::int32_t sum = 0;
  for (const Rows& rows : blocks)
    for (const std::int32_t count : rows.count) result.first.push_back(sum += count);
  if (blocks.size() == 1) {
    result.vertex = std::move(blocks[0].vertex);
    result.volume = std::move(blocks[0].volume);
  } else {
    result.vertex.reserve(sum);
    result.volume.reserve(sum);
    for (const Rows& rows : blocks) {
      result.vertex.insert(result.vertex.end(), rows.vertex.begin(), rows.vertex.end());
      result.volume.insert(result.volume.end(), rows.volume.begin(), rows.volume.end());
    }
  }
  return result;
}

std::vector<double> solid_volume(const Deposit& deposit, std::size_t vertices) {
  std::vector<double> sum(vertices);
  for (std::size_t k = 0; k < deposit.vertex.size(); ++k) sum[deposit.vertex[k]] += deposit.volume[k];
  return sum;
}

}  // namespace seapile::coupling
