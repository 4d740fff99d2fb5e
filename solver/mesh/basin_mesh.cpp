#include "solver/mesh/basin_mesh.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "solver/mesh/quality.h"

namespace seapile::mesh {
namespace {

constexpr std::int32_t kAxis = -1;  ///< The half's side along x = 0; no side of the whole.

/// The right half, counterclockwise from the origin.
std::vector<Corner> half_of(const BasinOutline& outline) {
  const auto& [width, top, pile] = outline;
  const auto rises = [](const std::vector<base::Vec2>& line) {
    return std::ranges::adjacent_find(line, [](base::Vec2 a, base::Vec2 b) { return !(b.x > a.x); }) == line.end();
  };
  if (top.size() < 2 || !rises(top) || top.back().x != width / 2 || pile.size() == 1 || !rises(pile) ||
      (pile.empty() ? 0 : pile.back().x) != top.front().x ||
      (!pile.empty() && (pile.front().x != 0 || !(pile.front().y > 0) || !(pile.back().y < top.front().y))))
    throw std::logic_error("mesh: top and pile do not bound the right half of a basin");
  std::vector<Corner> corners = {{{0, 0}, kBasinBottom}, {{width / 2, 0}, kBasinRight}};
  for (std::size_t i = top.size() - 1; i > 0; --i) corners.push_back({top[i], kBasinTop, true});
  corners.push_back({top[0], pile.empty() ? kAxis : kPileSleeve});
  for (std::size_t i = pile.size(); i-- > 0;) corners.push_back({pile[i], i == 0 ? kAxis : kPileTip});
  return corners;
}

/// Distance of p from the line between a and b [m].
double distance(base::Vec2 p, base::Vec2 a, base::Vec2 b) {
  const base::Vec2 along = b - a;
  const double share = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return norm(p - a - share * along);
}

/// The size at p, made to fit the sides: away from a side edges grow by at most kGrowth of the way to it, and from a
/// whole side they shrink by at most as much. The axis is a side, so this holds where a tip is close to the bottom.
double fitting(std::span<const Corner> corners, base::Vec2 p, double size) {
  constexpr double kGrowth = 0.15;
  double most = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const base::Vec2 a = corners[i].position, b = corners[(i + 1) % corners.size()].position;
    const double length = norm(b - a), change = kGrowth * distance(p, a, b);
    most = std::min(most, length + change);
    if (corners[i].whole) size = std::max(size, length - change);
  }
  return std::min(size, most);
}

/// With its image in x = 0.
TriangleMesh mirrored(const TriangleMesh& half) {
  TriangleMesh mesh = half;
  std::vector<std::int32_t> image;
  for (std::size_t v = 0; v < half.vertices(); ++v) {
    const base::Vec2 p = half.position[v];
    image.push_back(static_cast<std::int32_t>(p.x == 0 ? v : mesh.vertices()));
    if (p.x != 0) mesh.position.push_back({-p.x, p.y});
  }
  for (const auto& [a, b, c] : half.triangle) mesh.triangle.push_back({image[a], image[c], image[b]});
  mesh.boundary.clear();
  for (const BoundaryEdge& e : half.boundary) {
    if (e.tag == kAxis) continue;
    const auto triangle = e.triangle + static_cast<std::int32_t>(half.triangles());
    mesh.boundary.push_back(e);
    mesh.boundary.push_back({image[e.to], image[e.from], triangle, e.tag == kBasinRight ? kBasinLeft : e.tag});
  }
  return mesh;
}

}  // namespace

TriangleMesh basin_mesh(const BasinOutline& outline, const std::function<double(base::Vec2)>& size, double least_shape,
                        double patience) {
  const std::vector<Corner> corners = half_of(outline);
  std::string why;
  double best = 0;
  for (const double factor : {1.0, 0.95, 1.05, 0.9, 1.1, 0.85, 0.8, 0.7, 0.6})
    for (const int algorithm : {6, 5}) try {
        const TriangleMesh half = generate(corners, [&](base::Vec2 p) { return fitting(corners, p, factor * size(p)); },
                                           {.algorithm = algorithm, .smoothing = 10, .patience = patience});
        best = std::max(best, summary_of(quality_of(half)).lowest_shape);
        if (best < least_shape) continue;
        TriangleMesh mesh = mirrored(half);
        check(mesh);
        return mesh;
      } catch (const NoAnswer&) {  // the other ways may each take as long
        throw;
      } catch (const NoMesh& error) {
        why = error.what();
      }
  if (best == 0) throw NoMesh(why);
  throw NoMesh("mesh: of all meshes of the basin the best has a shape quality of " + std::to_string(best) + " where " +
               std::to_string(least_shape) + " is asked for");
}

}  // namespace seapile::mesh
