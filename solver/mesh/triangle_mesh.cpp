#include "solver/mesh/triangle_mesh.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

namespace seapile::mesh {

std::vector<BoundaryEdge> boundary_of(std::span<const std::array<std::int32_t, 3>> triangles,
                                      std::span<const base::Vec2> position,
                                      const std::function<std::int32_t(base::Vec2, base::Vec2)>& tag_of) {
  // Edges as they turn in their triangle, sorted by their ends: the two sides of an inner edge follow one another.
  struct Side {
    std::int32_t low, high, from, triangle;
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const std::int32_t a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), a, static_cast<std::int32_t>(t)});
    }
  std::ranges::sort(sides, [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });

  std::vector<BoundaryEdge> boundary;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    const auto between = [&] {
      return "between vertices " + std::to_string(sides[i].low) + " and " + std::to_string(sides[i].high);
    };
    if (end - i > 2) throw std::logic_error("mesh: the edge " + between() + " has more than two triangles");
    if (end - i == 2 && sides[i].from == sides[i + 1].from)
      throw std::logic_error("mesh: the triangles at the edge " + between() + " lie over each other");
    if (end - i == 1) {
      const std::int32_t from = sides[i].from, to = from == sides[i].low ? sides[i].high : sides[i].low;
      boundary.push_back({from, to, sides[i].triangle, tag_of(position[from], position[to])});
    }
    i = end;
  }
  return boundary;
}

void check(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices(), false);
  for (std::size_t t = 0; t < mesh.triangles(); ++t) {
    const auto& v = mesh.triangle[t];
    for (const std::int32_t vertex : v) {
      if (vertex < 0 || static_cast<std::size_t>(vertex) >= mesh.vertices())
        throw std::logic_error("mesh: triangle " + std::to_string(t) + " has a vertex that is not there");
      used[vertex] = true;
    }
    if (!(doubled_area(mesh.position[v[0]], mesh.position[v[1]], mesh.position[v[2]]) > 0))
      throw std::logic_error("mesh: triangle " + std::to_string(t) + " does not turn counterclockwise");
  }
  if (const auto it = std::ranges::find(used, false); it != used.end())
    throw std::logic_error("mesh: vertex " + std::to_string(it - used.begin()) + " belongs to no triangle");

  const auto edges = boundary_of(mesh.triangle, mesh.position, [](base::Vec2, base::Vec2) { return 0; });
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> given;
  for (const BoundaryEdge& e : mesh.boundary) given.emplace(std::pair{e.from, e.to}, e.triangle);
  if (given.size() != mesh.boundary.size() || edges.size() != mesh.boundary.size())
    throw std::logic_error("mesh: its boundary is not that of its triangles");
  for (const BoundaryEdge& e : edges)
    if (const auto it = given.find({e.from, e.to}); it == given.end() || it->second != e.triangle)
      throw std::logic_error("mesh: its boundary is not that of its triangles");
}

std::vector<std::int32_t> chain(const TriangleMesh& mesh, std::int32_t tag) {
  std::map<std::int32_t, std::int32_t> next;
  std::map<std::int32_t, int> entered;
  for (const BoundaryEdge& e : mesh.boundary) {
    if (e.tag != tag) continue;
    if (!next.emplace(e.from, e.to).second) throw std::logic_error("mesh: a boundary forks");
    ++entered[e.to];
  }
  if (next.empty()) return {};
  const auto first = std::ranges::find_if(next, [&](const auto& edge) { return !entered.contains(edge.first); });
  if (first == next.end()) throw std::logic_error("mesh: a boundary is closed where an open one is asked for");
  std::vector<std::int32_t> vertices{first->first};
  for (auto it = first; it != next.end(); it = next.find(it->second)) vertices.push_back(it->second);
  if (vertices.size() != next.size() + 1)
    throw std::logic_error("mesh: a boundary is in pieces where one is asked for");
  return vertices;
}

}  // namespace seapile::mesh
