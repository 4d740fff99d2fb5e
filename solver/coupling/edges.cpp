#include "solver/coupling/edges.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace seapile::coupling {

using base::Vec2;

Edges::Edges(std::span<const std::array<std::int32_t, 3>> triangles) : edge_(3 * triangles.size()) {
  using Ends = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // lower and higher vertex, edge
  std::vector<Ends> ends;
  ends.reserve(edge_.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      edge_[3 * t + k].vertex = triangles[t][k];
      const auto [low, high] = std::minmax({triangles[t][k], triangles[t][(k + 1) % 3]});
      ends.emplace_back(low, high, static_cast<std::int32_t>(3 * t + k));
    }
  std::ranges::sort(ends);
  for (std::size_t n = 0; n < ends.size(); ++n) {
    const auto [low, high, one] = ends[n];
    Sides sides = {one, -1, {edge_[one].vertex, edge_[next(one)].vertex, edge_[previous(one)].vertex, -1}};
    if (n + 1 < ends.size() && std::get<0>(ends[n + 1]) == low && std::get<1>(ends[n + 1]) == high) {
      const std::int32_t other = std::get<2>(ends[++n]);
      sides.other = other;
      sides.vertex[3] = edge_[previous(other)].vertex;
      edge_[one].to_far = next(other);
      edge_[one].from_far = previous(other);
      edge_[other].to_far = next(one);
      edge_[other].from_far = previous(one);
    }
    sides_.push_back(sides);
  }
  std::ranges::sort(sides_, {}, &Sides::one);  // as they are in memory
}

void Edges::measure(const mesh::TriangleMesh& mesh, int me, int threads) {
  for (std::size_t n = sides_.size() * me / threads; n < sides_.size() * (me + 1) / threads; ++n) {
    const Sides& sides = sides_[n];
    const auto [at_a, at_b, at_c, at_w] = sides.vertex;
    const Vec2 a = mesh.position[at_a], b = mesh.position[at_b], c = mesh.position[at_c], along = b - a;
    const double length = norm(along), per_length = 1 / length, opposite = length / mesh::doubled_area(a, b, c);
    Edge& one = edge_[sides.one];
    one.from = a;
    one.per_length = per_length;
    one.kink_opposite = opposite;
    if (sides.other < 0) continue;

    // A linear function's kink is 0: those of N_j sum to 0, and so do those of N_j x_j.
    const Vec2 w = mesh.position[at_w];
    const double far = length / mesh::doubled_area(b, a, w);
    const double to_b = (opposite * dot(c - a, along) + far * dot(w - a, along)) * per_length * per_length;
    one.kink_from = to_b - opposite - far;
    one.kink_far = far;
    Edge& other = edge_[sides.other];
    other.from = b;
    other.per_length = per_length;
    other.kink_from = -to_b;
    other.kink_opposite = far;
    other.kink_far = opposite;
  }
}

}  // namespace seapile::coupling
