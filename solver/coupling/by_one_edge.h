// A disc's share at each vertex where it crosses one edge or none: six of seven discs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numbers>
#include <span>

#include "solver/coupling/by_kinks.h"

namespace seapile::coupling {

/// As ByKinks, of a disc whose centre t holds, that crosses no edge or one, and that reaches the lines of none of the
/// others of t and of the neighbour. Writes four entries, of which as many count as are returned; 0: it is not so.
/// Whether a disc reaches its nearest edge is as good as random: both go the same way, without a branch.
inline int by_one_edge(const Edges& edges, const grains::Disc& disc, std::int32_t t, std::int32_t* vertex,
                       double* volume) {
  if (t < 0) return 0;
  const double radius = disc.radius;
  const base::Vec2 centre = {disc.x, disc.y};
  const View v = view(edges, t, centre);
  const Edge* const side = &edges[3 * t];
  const double distance[3] = {v.turned[0] * side[0].per_length, v.turned[1] * side[1].per_length,
                              v.turned[2] * side[2].per_length};
  const int second = distance[1] < distance[0], third = distance[2] < std::min(distance[0], distance[1]);
  const int k = 2 * third + (second & ~third);
  constexpr int kNext[] = {1, 2, 0, 1};
  const int l = kNext[k], m = kNext[k + 1];
  const Edge& edge = side[k];
  const bool crosses = distance[k] < radius, inside = edge.from_far >= 0;
  const Edge &to_far = edges[inside ? edge.to_far : 0], &from_far = edges[inside ? edge.from_far : 0];
  const base::Vec2 far = from_far.from - centre;
  const double beside_a = cross(v.corner[k], far) * to_far.per_length,
               beside_b = cross(far, v.corner[l]) * from_far.per_length;
  const bool free = (distance[l] >= radius) & (distance[m] >= radius),
             alone = inside & (beside_a >= radius) & (beside_b >= radius);
  if (!(v.holds() & free & (alone | !crosses))) return 0;

  const double all = std::numbers::pi * radius * radius, integral = beyond_line(radius, distance[k] / radius);
  const double at_a = integral * edge.kink_from, opposite = integral * edge.kink_opposite,
               at_far = integral * edge.kink_far;
  vertex[0] = edge.vertex;
  vertex[1] = side[l].vertex;
  vertex[2] = side[m].vertex;
  vertex[3] = from_far.vertex;
  volume[0] = std::max(all * (distance[l] * side[l].kink_opposite) + at_a, 0.0);
  volume[1] = std::max(all * (distance[m] * side[m].kink_opposite) - (at_a + opposite + at_far), 0.0);
  volume[2] = std::max(all * (distance[k] * edge.kink_opposite) + opposite, 0.0);
  volume[3] = std::max(at_far, 0.0);
  return 3 + (crosses ? 1 : 0);
}

}  // namespace seapile::coupling
