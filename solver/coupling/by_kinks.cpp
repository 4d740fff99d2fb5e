#include "solver/coupling/by_kinks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seapile::coupling {

using base::Vec2;

namespace {

/// Discs overlap walls by less than this, of r. Behind a deeper cap there may be water again.
constexpr double kDeepest = 0.01;

}  // namespace

bool ByKinks::make(const grains::Disc& disc, std::int32_t t, const View& v) {
  centre_ = {disc.x, disc.y};
  r_ = disc.radius;
  crosses_ = 0;
  sum.count = 3;
  const double all = std::numbers::pi * r_ * r_;
  int held = -1;
  for (int k = 0; k < 3; ++k) {
    sum.entry[k] = {edges_[3 * t + k].vertex, all * value_at_corner(edges_, t, v, k)};
    if (outside(v.corner[k])) continue;
    if (held >= 0) return false;
    held = k;
  }
  if (held >= 0) {
    if (!around(t, held)) return false;
  } else {
    for (int k = 0; k < 3; ++k) {
      const int l = (k + 1) % 3, m = (k + 2) % 3;
      if (!look(3 * t + k, {k, l, m}, v.corner[k], v.corner[l])) return false;
    }
  }
  for (int n = 0; n < crosses_; ++n)
    if (!cross_over(crossed_[n])) return false;
  return true;
}

bool ByKinks::look(std::int32_t edge, std::array<int, 3> place, Vec2 a, Vec2 b) {
  const double distance = cross(a, b) * edges_[edge].per_length;
  if (std::abs(distance) >= r_) return true;
  if (dot(a, b - a) >= 0 || dot(b, b - a) <= 0) return true;  // it passes beside the ends
  if (crosses_ == kMostCrossed) return false;
  crossed_[crosses_++] = {edge, place, distance};
  return true;
}

bool ByKinks::around(std::int32_t t, int k) {
  constexpr int kMost = FewEntries::kMost - kMostCrossed - 1;
  static_assert(kMost <= Rays::kMost);
  std::array<std::int32_t, kMost> spoke;  // from the hub, counterclockwise; the first two are of t
  std::array<Vec2, kMost + 1> rim;        // where they end
  std::array<int, kMost + 1> place;
  int count = 0;
  for (std::int32_t edge = 3 * t + k; count == 0 || edge != spoke[0];) {
    if (count == kMost) return false;
    spoke[count] = edge;
    rim[count] = from(next(edge));
    place[count] = count < 2 ? (k + 1 + count) % 3 : sum.count++;
    if (count >= 2) {
      if (!outside(rim[count])) return false;
      sum.entry[place[count]] = {edges_[next(edge)].vertex, 0};
    }
    ++count;
    edge = across(edges_[previous(edge)]);
    if (edge < 0) return false;
  }
  rim[count] = rim[0];
  place[count] = place[0];

  const Vec2 hub = from(spoke[0]);
  const double away = norm(hub);
  // On the vertex any ray will do that leaves t on the other side.
  const Vec2 axis = away > 0 ? (1 / away) * hub : edges_[spoke[0]].per_length * (hub - rim[0]);
  rays_.count = count;
  for (int m = 0; m < count; ++m) {
    const Vec2 ray = edges_[spoke[m]].per_length * (rim[m] - hub);
    rays_.x[m] = dot(axis, ray);
    rays_.y[m] = std::min(std::abs(cross(axis, ray)), 1.0);
  }
  wedges_(r_, away / r_, rays_);
  for (int m = 0, before = count - 1; m < count; before = m++) {
    add(edges_[spoke[m]], {k, place[m], place[m + 1], place[before]}, rays_.beyond[m]);
    if (!look(next(spoke[m]), {place[m], place[m + 1], k}, rim[m], rim[m + 1])) return false;
  }
  return true;
}

bool ByKinks::cross_over(const Crossed& c) {
  const Edge& edge = edges_[c.edge];
  if (edge.from_far < 0) return cut_off(c);
  const Vec2 a = from(c.edge), b = from(next(c.edge)), far = from(edge.from_far);
  if (!outside(far)) return false;
  const auto [at_a, at_b, opposite] = c.place;
  const int place = sum.place_of(edges_[edge.from_far].vertex);
  add(edge, {at_a, at_b, opposite, place}, beyond_line(r_, std::max(c.distance, 0.0) / r_));
  return look(edge.to_far, {at_a, place, at_b}, a, far) && look(edge.from_far, {place, at_b, at_a}, far, b);
}

bool ByKinks::cut_off(const Crossed& c) {
  if (!(c.distance > (1 - kDeepest) * r_)) return false;
  const double half_chord2 = (r_ - c.distance) * (r_ + c.distance),
               moment = 2.0 / 3 * half_chord2 * std::sqrt(half_chord2),
               area = (moment - beyond_line(r_, c.distance / r_)) / c.distance;
  // Outwards N of the opposite corner falls by the inverse height, those of the ends take its share.
  const Vec2 a = from(c.edge), along = from(next(c.edge)) - a, up = from(previous(c.edge)) - a;
  const double falls = edges_[c.edge].kink_opposite, at_to = falls * dot(up, along) / dot(along, along);
  const std::array<double, 3> slope = {falls - at_to, at_to, -falls};
  const std::int32_t t = c.edge / 3;
  const View v = view(edges_, t, centre_);
  for (int n = 0; n < 3; ++n)
    sum.entry[c.place[n]].volume -= value_at_corner(edges_, t, v, (c.edge + n) % 3) * area + slope[n] * moment;
  return true;
}

}  // namespace seapile::coupling
