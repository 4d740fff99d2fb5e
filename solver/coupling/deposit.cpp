#include "solver/coupling/deposit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "solver/coupling/by_kinks.h"
#include "solver/coupling/disc_in_triangle.h"
#include "solver/mesh/elements.h"

namespace seapile::coupling {
namespace {

using base::Vec2;
using grains::Disc;
using mesh::TriangleMesh;

/// Some grains' rows, and what one thread needs to make them.
class Rows {
 public:
  std::vector<std::int32_t> count;  ///< of entries, (grains)
  std::vector<std::int32_t> vertex;
  std::vector<double> volume;

  void make(const TriangleMesh& mesh, const mesh::Buckets& buckets, Location& location, std::span<const Disc> discs,
            Kernel kernel, std::size_t from, std::size_t to) {
    count.reserve(to - from);
    ByKinks kinks(mesh, location);
    for (std::size_t i = from; i < to; ++i) {
      const std::size_t before = used_, grains_left = to - i;
      if (used_ + FewEntries::kMost > vertex.size()) grow(5 * grains_left);
      const Disc& disc = discs[i];
      if (std::isfinite(disc.x) && std::isfinite(disc.y) && std::isfinite(disc.radius)) {
        View v;
        const std::int32_t t = location.last[i] = holder(mesh, buckets, {disc.x, disc.y}, location.last[i], v);
        if (kernel == Kernel::hat) {
          if (t >= 0) at_centre(mesh, disc, t, v);
        } else {
          if (t >= 0 && kinks.make(disc, t, v))
            write({kinks.sum.entry.data(), static_cast<std::size_t>(kinks.sum.count)});
          else
            by_pieces(mesh, buckets, disc);
        }
      }
      count.push_back(static_cast<std::int32_t>(used_ - before));
    }
    vertex.resize(used_);
    volume.resize(used_);
  }

 private:
  void grow(std::size_t more) {
    vertex.resize(used_ + FewEntries::kMost + more);
    volume.resize(vertex.size());
  }

  /// The first of the triangles that hold a place, or -1. A triangle that holds it off its edges is the only one.
  static std::int32_t holder(const TriangleMesh& mesh, const mesh::Buckets& buckets, Vec2 place, std::int32_t guess,
                             View& v) {
    if (guess >= 0) {
      v = view(mesh, guess, place);
      if (v.turned[0] > 0 && v.turned[1] > 0 && v.turned[2] > 0) return guess;
    }
    for (const std::int32_t t : buckets.at(place)) {
      v = view(mesh, t, place);
      if (v.turned[0] >= 0 && v.turned[1] >= 0 && v.turned[2] >= 0) return t;
    }
    return -1;
  }

  /// A few entries of different vertices, for which there is room.
  void write(std::span<const Entry> entries) {
    for (const Entry& e : entries) {
      // By counting, without branches: which of two is the higher is as good as random.
      std::size_t at = used_;
      for (const Entry& other : entries) at += other.vertex < e.vertex ? 1 : 0;
      vertex[at] = e.vertex;
      volume[at] = std::max(e.volume, 0.0);
    }
    used_ += entries.size();
  }

  void at_centre(const TriangleMesh& mesh, const Disc& disc, std::int32_t t, const View& v) {
    const double share = std::numbers::pi * disc.radius * disc.radius / v.doubled();
    std::array<Entry, 3> entries;
    for (int k = 0; k < 3; ++k) entries[k] = {mesh.triangle[t][k], share * v.turned[(k + 1) % 3]};
    write(entries);
  }

  /// Any disc: triangle by triangle, by rising number.
  void by_pieces(const TriangleMesh& mesh, const mesh::Buckets& buckets, const Disc& disc) {
    const Vec2 centre = {disc.x, disc.y}, reach = {disc.radius, disc.radius};
    buckets.near({centre - reach, centre + reach}, near_);
    pieces_.clear();
    for (const std::int32_t t : near_) {
      const auto& corners = mesh.triangle[t];
      const View v = view(mesh, t, centre);
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
    const std::size_t begin = used_;
    for (const Entry& e : pieces_) {
      if (used_ == begin || vertex[used_ - 1] != e.vertex) {
        vertex[used_] = e.vertex;
        volume[used_++] = 0;
      }
      volume[used_ - 1] += e.volume;
    }
    for (std::size_t k = begin; k < used_; ++k) volume[k] = std::max(volume[k], 0.0);
  }

  std::size_t used_ = 0;
  std::vector<std::int32_t> near_;
  std::vector<Entry> pieces_;
};

}  // namespace

Location::Location(const TriangleMesh& mesh) : triangle(mesh.triangle), across(3 * mesh.triangles(), -1) {
  using Edge = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // lower and higher vertex, place in `across`
  std::vector<Edge> edges;
  edges.reserve(across.size());
  for (std::size_t t = 0; t < mesh.triangles(); ++t)
    for (int k = 0; k < 3; ++k) {
      const auto [low, high] = std::minmax({mesh.triangle[t][k], mesh.triangle[t][(k + 1) % 3]});
      edges.emplace_back(low, high, static_cast<std::int32_t>(3 * t + k));
    }
  std::ranges::sort(edges);
  for (std::size_t n = 1; n < edges.size(); ++n) {
    const auto& [low, high, one] = edges[n - 1];
    const auto& [next_low, next_high, other] = edges[n];
    if (low != next_low || high != next_high) continue;
    across[one] = other;
    across[other] = one;
  }
}

Deposit deposit(const TriangleMesh& mesh, Location& location, std::span<const Disc> discs, Kernel kernel,
                base::Crew* crew) {
  if (location.triangle != mesh.triangle) throw std::logic_error("coupling: grains were located in another mesh");
  if (location.last.size() != discs.size()) location.last.assign(discs.size(), -1);
  const mesh::Buckets buckets(mesh);

  // Blocks of grains, which do not depend on the number of threads; without a crew a single one.
  const std::size_t size = crew != nullptr ? 512 : std::max<std::size_t>(discs.size(), 1);
  std::vector<Rows> blocks((discs.size() + size - 1) / size);
  base::together(crew, [&](int me, int threads) {
    for (std::size_t b = me; b < blocks.size(); b += threads)
      blocks[b].make(mesh, buckets, location, discs, kernel, b * size, std::min((b + 1) * size, discs.size()));
  });

  Deposit result;
  result.first.reserve(discs.size() + 1);
  result.first.push_back(0);
  for (const Rows& rows : blocks)
    for (const std::int32_t count : rows.count) result.first.push_back(result.first.back() + count);
  if (blocks.size() == 1) {
    result.vertex = std::move(blocks[0].vertex);
    result.volume = std::move(blocks[0].volume);
  } else {
    result.vertex.reserve(result.first.back());
    result.volume.reserve(result.first.back());
    for (const Rows& rows : blocks) {
      result.vertex.insert(result.vertex.end(), rows.vertex.begin(), rows.vertex.end());
      result.volume.insert(result.volume.end(), rows.volume.begin(), rows.volume.end());
    }
  }
  result.immersed.resize(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (std::int32_t k = result.first[i]; k < result.first[i + 1]; ++k) result.immersed[i] += result.volume[k];
  return result;
}

std::vector<double> solid_volume(const Deposit& deposit, std::size_t vertices) {
  std::vector<double> sum(vertices);
  for (std::size_t k = 0; k < deposit.vertex.size(); ++k) sum[deposit.vertex[k]] += deposit.volume[k];
  return sum;
}

}  // namespace seapile::coupling
