#include "solver/coupling/deposit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

#include "solver/coupling/disc_in_triangle.h"
#include "solver/mesh/elements.h"

namespace seapile::coupling {
namespace {

using base::Vec2;
using grains::Disc;
using mesh::TriangleMesh;

/// Turned the other way it is the same number with the other sign, bit for bit: of two triangles at an edge one holds a
/// place, or both do, when it is on the edge.
inline double cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }

/// A triangle as a disc's centre sees it.
struct View {
  std::array<Vec2, 3> corner;    ///< relative to the centre [m]
  std::array<double, 3> turned;  ///< twice the area of the centre and the edge from corner k [m2]

  double doubled() const { return turned[0] + turned[1] + turned[2]; }
};

inline View view(const TriangleMesh& mesh, std::int32_t triangle, Vec2 centre) {
  const auto& t = mesh.triangle[triangle];
  View v{{mesh.position[t[0]] - centre, mesh.position[t[1]] - centre, mesh.position[t[2]] - centre}, {}};
  for (int k = 0; k < 3; ++k) v.turned[k] = cross(v.corner[k], v.corner[(k + 1) % 3]);
  return v;
}

struct Entry {
  std::int32_t vertex;
  double volume;
};

/// A few vertices, in the order in which they were met.
struct FewEntries {
  static constexpr int kMost = 20;
  std::array<Entry, kMost> entry;
  int count = 0;

  int place_of(std::int32_t vertex) {
    for (int k = 0; k < count; ++k)
      if (entry[k].vertex == vertex) return k;
    entry[count] = {vertex, 0};
    return count++;
  }
};

/// An edge that the disc crosses, seen from the triangle on the centre's side.
struct Crossed {
  std::int32_t edge;           ///< as in Location::across
  std::array<int, 3> place;    ///< in FewEntries: of the edge's ends and of the corner opposite to it
  std::array<Vec2, 3> corner;  ///< in the same order
  double turned, doubled;      ///< of the edge and of the triangle
};

/// The edges that a disc crosses, in the order in which they were met.
struct FewCrossed {
  static constexpr int kMost = 8;
  double radius = 0;
  std::array<Crossed, kMost> edge;
  int count = 0;

  /// Takes the edge up if the disc crosses it; false when it is one too many. The disc holds neither end.
  bool look(const Crossed& c) {
    const Vec2 along = c.corner[1] - c.corner[0];
    if (c.turned * c.turned >= radius * radius * dot(along, along)) return true;
    if (dot(c.corner[0], along) >= 0 || dot(c.corner[1], along) <= 0) return true;  // it passes beside the ends
    if (count == kMost) return false;
    edge[count++] = c;
    return true;
  }
};

/// A disc that holds at most one vertex, of the triangle that holds its centre, and that stays in the mesh. The other
/// edges that it crosses cut it into caps, which do not overlap. N_j goes on beyond an edge as it was before it, but
/// for kink_j s, s the distance beyond the edge's line. So V_ij is the integral of the linear functions of the centre's
/// triangle, or of those around the vertex, plus kink_j times the integral of s over each cap.
class ByKinks {
 public:
  ByKinks(const TriangleMesh& mesh, const Location& location) : mesh_(mesh), location_(location) {}

  /// False when the disc is none of these. `v`: how its centre sees t, which holds it.
  bool make(const Disc& disc, std::int32_t t, const View& v) {
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

  FewEntries sum;

 private:
  bool outside(Vec2 p) const { return dot(p, p) > r_ * r_; }

  bool whole(std::int32_t t, const View& v) {
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

  /// The disc, as if the triangles around the vertex at corner k of t went on beyond their third edges.
  bool around(std::int32_t t, const View& v, int k) {
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

  bool cross_over(const Crossed& c) {
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

  const TriangleMesh& mesh_;
  const Location& location_;
  Vec2 centre_;
  double r_ = 0;
  FewCrossed crossed_;
};

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
    return result;
  }
  result.vertex.reserve(result.first.back());
  result.volume.reserve(result.first.back());
  for (const Rows& rows : blocks) {
    result.vertex.insert(result.vertex.end(), rows.vertex.begin(), rows.vertex.end());
    result.volume.insert(result.volume.end(), rows.volume.begin(), rows.volume.end());
  }
  return result;
}

std::vector<double> solid_volume(const Deposit& deposit, std::size_t vertices) {
  std::vector<double> sum(vertices);
  for (std::size_t k = 0; k < deposit.vertex.size(); ++k) sum[deposit.vertex[k]] += deposit.volume[k];
  return sum;
}

}  // namespace seapile::coupling
