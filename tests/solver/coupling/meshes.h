// Meshes to lay grains on, and the obvious twin of their deposit.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "solver/base/random.h"
#include "solver/grains/grains.h"
#include "solver/mesh/rectangle.h"
#include "solver/mesh/triangle_mesh.h"

namespace seapile::coupling {

/// [0, width] x [0, height] in cells of about 0.1, whose inner vertices are shaken by up to `shake`.
inline mesh::TriangleMesh shaken(double width, double height, double shake = 0.02) {
  const auto cells = [](double length) { return static_cast<int>(std::lround(length / 0.1)); };
  mesh::TriangleMesh mesh = mesh::rectangle(mesh::even(0, width, cells(width)), mesh::even(0, height, cells(height)));
  for (std::size_t v = 0; v < mesh.vertices(); ++v) {
    base::Vec2& p = mesh.position[v];
    if (p.x > 0 && p.x < width) p.x += base::uniform(-shake, shake, 1, 0, v) * (p.y > 0 && p.y < height);
    if (p.y > 0 && p.y < height) p.y += base::uniform(-shake, shake, 1, 1, v) * (p.x < width && p.x > 0);
  }
  return mesh;
}

/// The triangles whose centroids `keep` likes.
inline mesh::TriangleMesh part_of(const mesh::TriangleMesh& mesh, const std::function<bool(base::Vec2)>& keep) {
  mesh::TriangleMesh part;
  std::vector<std::int32_t> name(mesh.vertices(), -1);
  for (auto t : mesh.triangle) {
    const base::Vec2 sum = mesh.position[t[0]] + mesh.position[t[1]] + mesh.position[t[2]];
    if (!keep((1.0 / 3) * sum)) continue;
    for (std::int32_t& v : t) {
      if (name[v] < 0) {
        name[v] = static_cast<std::int32_t>(part.position.size());
        part.position.push_back(mesh.position[v]);
      }
      v = name[v];
    }
    part.triangle.push_back(t);
  }
  part.boundary = mesh::boundary_of(part.triangle, part.position, [](base::Vec2, base::Vec2) { return 0; });
  return part;
}

/// So many triangles around one vertex, at (0.5, 0.5).
inline mesh::TriangleMesh fan(int triangles) {
  mesh::TriangleMesh mesh;
  mesh.position.push_back({0.5, 0.5});
  for (std::int32_t k = 0; k < triangles; ++k) {
    const double angle = 2 * std::numbers::pi / triangles * (k + base::uniform(-0.2, 0.2, 8, triangles, k));
    mesh.position.push_back({0.5 + 0.3 * std::cos(angle), 0.5 + 0.3 * std::sin(angle)});
    mesh.triangle.push_back({0, k + 1, (k + 1) % triangles + 1});
  }
  mesh.boundary = mesh::boundary_of(mesh.triangle, mesh.position, [](base::Vec2, base::Vec2) { return 0; });
  return mesh;
}

/// Every triangle cut into four, and of each new vertex the two old ones between which it lies.
struct Refined {
  mesh::TriangleMesh mesh;
  std::vector<std::array<std::int32_t, 2>> between;

  /// What a sum over the new vertices' linear functions is on the old ones'.
  std::vector<double> gathered(const std::vector<double>& fine, std::size_t old_vertices) const {
    std::vector<double> coarse(old_vertices);
    for (std::size_t v = 0; v < fine.size(); ++v)
      for (const std::int32_t end : between[v]) coarse[end] += fine[v] / 2;
    return coarse;
  }
};

inline Refined refined(const mesh::TriangleMesh& mesh) {
  Refined result;
  result.mesh.position = mesh.position;
  for (std::size_t v = 0; v < mesh.vertices(); ++v)
    result.between.push_back({static_cast<std::int32_t>(v), static_cast<std::int32_t>(v)});
  std::map<std::array<std::int32_t, 2>, std::int32_t> middle;
  const auto between = [&](std::int32_t a, std::int32_t b) {
    const auto [place, fresh] = middle.try_emplace({std::min(a, b), std::max(a, b)}, result.mesh.vertices());
    if (fresh) {
      result.mesh.position.push_back(0.5 * (mesh.position[a] + mesh.position[b]));
      result.between.push_back({a, b});
    }
    return place->second;
  };
  for (const auto& [a, b, c] : mesh.triangle) {
    const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
    for (const auto& t : {std::array{a, ab, ca}, std::array{ab, b, bc}, std::array{ca, bc, c}, std::array{ab, bc, ca}})
      result.mesh.triangle.push_back(t);
  }
  return result;
}

/// V_ij of one disc, (vertices): every triangle cut out of a polygon of 4000 corners that has the disc's area. Good to
/// about 1e-6 of it.
inline std::vector<double> twin(const mesh::TriangleMesh& mesh, const grains::Disc& disc) {
  using base::Vec2;
  constexpr int kCorners = 4000;
  const double step = 2 * std::numbers::pi / kCorners, r = disc.radius * std::sqrt(step / std::sin(step));
  std::vector<Vec2> circle, polygon, left;
  for (int k = 0; k < kCorners; ++k) circle.push_back({r * std::cos(k * step), r * std::sin(k * step)});
  std::vector<double> volume(mesh.vertices());
  for (const auto& t : mesh.triangle) {
    std::array<Vec2, 3> corner;
    for (int k = 0; k < 3; ++k) corner[k] = mesh.position[t[k]] - Vec2{disc.x, disc.y};
    polygon = circle;
    for (int k = 0; k < 3 && !polygon.empty(); ++k) {
      left.clear();
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
        const double at_p = mesh::doubled_area(corner[k], corner[(k + 1) % 3], p),
                     at_q = mesh::doubled_area(corner[k], corner[(k + 1) % 3], q);
        if (at_p >= 0) left.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) left.push_back(p + (at_p / (at_p - at_q)) * (q - p));
      }
      std::swap(polygon, left);
    }
    const double all = mesh::doubled_area(corner[0], corner[1], corner[2]);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
      const double area = mesh::doubled_area(polygon[0], polygon[i], polygon[i + 1]) / 2;
      const Vec2 centre = (1.0 / 3) * (polygon[0] + polygon[i] + polygon[i + 1]);
      for (int k = 0; k < 3; ++k)
        volume[t[k]] += area * mesh::doubled_area(centre, corner[(k + 1) % 3], corner[(k + 2) % 3]) / all;
    }
  }
  return volume;
}

}  // namespace seapile::coupling
