#include "solver/coupling/by_kinks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seapile::coupling {

using base::Vec2;

bool ByKinks::make(const grains::Disc& disc, std::int32_t t, const View& v) {
  centre_ = {disc.x, disc.y};
  r_ = crossed_.radius = disc.radius;
  crossed_.count = 0;
  int held = -1;
  for (int k = 0; k < 3; ++k) {
    if (outside(v.corner[k])) continue;
    if (held >= 0) return false;
    held = k;
  }
  if (!(held < 0 ? whole(t, v) : around(t, v, held))) return false;
  for (int n = 0; n < crossed_.count; ++n)
    if (!cross_over(crossed_.edge[n])) return false;
  return true;
}

bool ByKinks::whole(std::int32_t t, const View& v) {
  const double doubled = v.doubled(), share = std::numbers::pi * r_ * r_ / doubled;
  sum.count = 3;
  for (int k = 0; k < 3; ++k) {
    const int l = (k + 1) % 3, m = (k + 2) % 3;
    sum.entry[k] = {mesh_.triangle[t][k], share * v.turned[l]};
    if (!crossed_.look({3 * t + k, {k, l, m}, {v.corner[k], v.corner[l], v.corner[m]}, v.turned[k], doubled}))
      return false;
  }
  return true;
}

bool ByKinks::around(std::int32_t t, const View& v, int k) {
  constexpr int kMost = FewEntries::kMost - FewCrossed::kMost - 1;
  const Vec2 hub = v.corner[k];
  std::array<Vec2, kMost> rim;
  std::array<std::int32_t, kMost> edge;  // from rim[m] to rim[m + 1]
  const auto& first = mesh_.triangle[t];
  sum.entry[0] = {first[k], 0};
  sum.entry[1] = {first[(k + 1) % 3], 0};
  rim[0] = v.corner[(k + 1) % 3];
  int count = 0;
  for (std::int32_t triangle = t, hub_at = k;;) {
    edge[count++] = 3 * triangle + (hub_at + 1) % 3;
    const std::int32_t next = mesh_.triangle[triangle][(hub_at + 2) % 3];
    if (next == first[(k + 1) % 3]) break;
    if (count == kMost) return false;
    rim[count] = mesh_.position[next] - centre_;
    if (!outside(rim[count])) return false;
    sum.entry[1 + count] = {next, 0};
    const std::int32_t over = location_.across[3 * triangle + (hub_at + 2) % 3];
    if (over < 0) return false;
    triangle = over / 3;
    hub_at = over % 3;
  }
  sum.count = 1 + count;

  // About the centre: triangles to where the spokes leave the disc, and the arcs between these places.
  std::array<Vec2, kMost + 1> leaves, moment;
  std::array<double, kMost + 1> area;
  for (int m = 0; m < count; ++m) {
    const Vec2 along = rim[m] - hub;
    const double square = dot(along, along), on = dot(hub, along);
    leaves[m] = hub + ((std::sqrt(on * on + square * (r_ * r_ - dot(hub, hub))) - on) / square) * along;
    area[m] = 0.5 * cross(hub, leaves[m]);
    moment[m] = (area[m] / 3) * (hub + leaves[m]);
  }
  leaves[count] = leaves[0];
  area[count] = area[0];
  moment[count] = moment[0];
  // Only the first triangle holds the centre, so that only its arc may be longer than half the circle.
  double left = 2 * std::numbers::pi;
  for (int m = count - 1; m >= 0; --m) {
    double arc = left;
    if (m > 0) {
      arc = std::atan2(cross(leaves[m], leaves[m + 1]), dot(leaves[m], leaves[m + 1]));
      left -= arc;
    }
    const double part = area[m] - area[m + 1] + 0.5 * r_ * r_ * arc;
    const Vec2 first_moment = moment[m] - moment[m + 1] - (r_ * r_ / 3) * perpendicular(leaves[m + 1] - leaves[m]);
    const int after = m + 1 < count ? m + 1 : 0;
    const Vec2 p = rim[m], q = rim[after];
    const double doubled = cross(p - hub, q - hub);
    const double at_p = (cross(q, hub) * part + dot(perpendicular(hub - q), first_moment)) / doubled,
                 at_q = (cross(hub, p) * part + dot(perpendicular(p - hub), first_moment)) / doubled;
    sum.entry[0].volume += part - at_p - at_q;
    sum.entry[1 + m].volume += at_p;
    sum.entry[1 + after].volume += at_q;
    if (!crossed_.look({edge[m], {1 + m, 1 + after, 0}, {p, q, hub}, cross(p, q), doubled})) return false;
  }
  return true;
}

bool ByKinks::cross_over(const Crossed& c) {
  const std::int32_t edge = location_.across[c.edge];
  if (edge < 0) return false;
  const std::int32_t beyond = edge / 3, k = edge % 3;
  const std::int32_t far = mesh_.triangle[beyond][(k + 2) % 3];
  const Vec2 a = c.corner[0], b = c.corner[1], w = mesh_.position[far] - centre_, along = b - a;
  if (!outside(w)) return false;
  const double from_b = cross(w, b), to_a = cross(a, w), doubled = to_a + from_b - c.turned;

  // Kinks at the edge. They keep linear functions: the sums of kink_j and of kink_j x_j are 0.
  const double square = dot(along, along), length = std::sqrt(square);
  const double integral = beyond_line(r_, std::max(c.turned, 0.0) / (length * r_));
  const double near = integral * length / c.doubled, other = integral * length / doubled;
  const double to_b = (near * dot(c.corner[2] - a, along) + other * dot(w - a, along)) / square;
  const int place = sum.place_of(far);
  sum.entry[c.place[2]].volume += near;
  sum.entry[place].volume += other;
  sum.entry[c.place[1]].volume -= to_b;
  sum.entry[c.place[0]].volume -= near + other - to_b;

  // The neighbour's corners are b, a, w.
  const auto [at_a, at_b, at_opposite] = c.place;
  return crossed_.look({3 * beyond + (k + 1) % 3, {at_a, place, at_b}, {a, w, b}, to_a, doubled}) &&
         crossed_.look({3 * beyond + (k + 2) % 3, {place, at_b, at_a}, {w, b, a}, from_b, doubled});
}

}  // namespace seapile::coupling
