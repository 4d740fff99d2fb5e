// The module that brings Gmsh: loaded when the first mesh is asked for (generate.cpp).
#include "solver/mesh/mesher.h"

#include <gmsh.h>

#include <algorithm>
#include <map>
#include <stdexcept>

namespace seapile::mesh {
namespace {

/// Gmsh between two braces.
struct Session {
  explicit Session(const Method& method) {
    gmsh::initialize(0, nullptr, false);
    const std::pair<const char*, double> options[] = {
        {"General.Terminal", 0},
        {"General.NumThreads", 1},
        // Exceptions of its meshers do not get out of their parallel regions: errors are asked for afterwards.
        {"General.AbortOnError", 0},
        // Sizes come from the callback alone.
        {"Mesh.MeshSizeExtendFromBoundary", 0},
        {"Mesh.MeshSizeFromPoints", 0},
        {"Mesh.MeshSizeFromCurvature", 0},
        {"Mesh.Algorithm", method.algorithm},
        {"Mesh.Smoothing", method.smoothing},
        {"Mesh.RandomSeed", method.seed}};
    for (const auto& [name, value] : options) gmsh::option::setNumber(name, value);
    gmsh::model::add("domain");
  }
  ~Session() { gmsh::finalize(); }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;
};

TriangleMesh generated(std::span<const Corner> polygon, const std::function<double(base::Vec2)>& size,
                       const Method& method) {
  const Session session(method);
  const int corners = static_cast<int>(polygon.size());
  std::vector<int> lines;
  for (int i = 0; i < corners; ++i)
    gmsh::model::geo::addPoint(polygon[i].position.x, polygon[i].position.y, 0, 0, i + 1);
  for (int i = 0; i < corners; ++i) lines.push_back(gmsh::model::geo::addLine(i + 1, (i + 1) % corners + 1, i + 1));
  gmsh::model::geo::addPlaneSurface({gmsh::model::geo::addCurveLoop(lines)}, 1);
  gmsh::model::geo::synchronize();
  for (int i = 0; i < corners; ++i)
    if (polygon[i].whole) gmsh::model::mesh::setTransfiniteCurve(i + 1, 2);
  gmsh::model::mesh::setSizeCallback([&](int, int, double x, double y, double) { return size({x, y}); });
  gmsh::model::mesh::generate(2);
  std::string error;
  gmsh::logger::getLastError(error);
  if (!error.empty()) throw NoMesh(error);

  TriangleMesh mesh;
  std::vector<std::size_t> nodes;
  std::vector<double> places, parameters;
  gmsh::model::mesh::getNodes(nodes, places, parameters, -1, -1, false, false);
  std::map<std::size_t, std::int32_t> vertex_of;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    vertex_of[nodes[i]] = static_cast<std::int32_t>(i);
    mesh.position.push_back({places[3 * i], places[3 * i + 1]});
  }
  std::vector<std::size_t> elements, corners_of;
  gmsh::model::mesh::getElementsByType(2, elements, corners_of, 1);
  for (std::size_t t = 0; t < elements.size(); ++t) {
    std::array<std::int32_t, 3> triangle{};
    for (int k = 0; k < 3; ++k) triangle[k] = vertex_of.at(corners_of[3 * t + k]);
    if (doubled_area(mesh.position[triangle[0]], mesh.position[triangle[1]], mesh.position[triangle[2]]) < 0)
      std::swap(triangle[1], triangle[2]);
    mesh.triangle.push_back(triangle);
  }

  // The sides' edges, to tag the boundary and to put their vertices exactly on the line.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> side_of;
  for (int i = 0; i < corners; ++i) {
    std::vector<std::size_t> edges, ends;
    gmsh::model::mesh::getElementsByType(1, edges, ends, i + 1);
    const base::Vec2 from = polygon[i].position, to = polygon[(i + 1) % corners].position;
    for (std::size_t e = 0; e < edges.size(); ++e) {
      const std::int32_t a = vertex_of.at(ends[2 * e]), b = vertex_of.at(ends[2 * e + 1]);
      side_of[std::minmax(a, b)] = polygon[i].side;
      for (const std::int32_t vertex : {a, b}) {
        if (from.x == to.x) mesh.position[vertex].x = from.x;
        if (from.y == to.y) mesh.position[vertex].y = from.y;
      }
    }
  }
  mesh.boundary = boundary_of(mesh.triangle, mesh.position, [](base::Vec2, base::Vec2) { return -1; });
  for (BoundaryEdge& edge : mesh.boundary) edge.tag = side_of.at(std::minmax(edge.from, edge.to));
  return mesh;
}

}  // namespace

}  // namespace seapile::mesh

extern "C" void seapile_generate(std::span<const seapile::mesh::Corner> polygon,
                                 const std::function<double(seapile::base::Vec2)>& size,
                                 const seapile::mesh::Method& method, seapile::mesh::TriangleMesh& mesh,
                                 std::string& error) {
  try {
    mesh = seapile::mesh::generated(polygon, size, method);
  } catch (const std::exception& what) {
    error = what.what();
  }
}
