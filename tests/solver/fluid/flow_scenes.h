// Small flows for tests: meshes without symmetry, states at random, sides to hold or to open.
#pragma once

#include <concepts>
#include <cstdint>
#include <vector>

#include "solver/base/random.h"
#include "solver/fluid/flow.h"
#include "solver/mesh/rectangle.h"

namespace seapile::fluid::support {

/// Numbers of one stream, one after the other.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : seed_(seed) {}
  double operator()(double min, double max) { return base::uniform(min, max, seed_, 0, drawn_++); }
  base::Vec2 vector(double most) {
    const double x = (*this)(-most, most), y = (*this)(-most, most);
    return {x, y};
  }

 private:
  std::uint64_t seed_, drawn_ = 0;
};

/// 1: the vertex lies on the boundary.
inline std::vector<std::uint8_t> on_boundary(const mesh::TriangleMesh& mesh) {
  std::vector<std::uint8_t> on(mesh.vertices(), 0);
  for (const mesh::BoundaryEdge& e : mesh.boundary) on[e.from] = on[e.to] = 1;
  return on;
}

/// Moves the inner vertices at random, by up to `most` in x and y [m].
inline void scatter(mesh::TriangleMesh& mesh, double most, Draw& draw) {
  const auto outer = on_boundary(mesh);
  for (std::size_t v = 0; v < mesh.vertices(); ++v)
    if (!outer[v]) mesh.position[v] = mesh.position[v] + draw.vector(most);
}

/// A graded grid over [0, 2] x [0, 1] with scattered inner vertices: smallest cells 1/4 of the largest ones.
inline mesh::TriangleMesh uneven_mesh(int columns, int rows, std::uint64_t seed) {
  const auto graded = [](double last, int count) {
    std::vector<double> values = mesh::even(0, 1, count);
    for (double& s : values) s = last * (0.4 * s + 0.6 * s * s);
    return values;
  };
  mesh::TriangleMesh mesh = mesh::rectangle(graded(2, columns), graded(1, rows));
  Draw draw(seed);
  scatter(mesh, 0.08 / rows, draw);
  mesh::check(mesh);
  return mesh;
}

/// Holds a component of the velocity at the vertices of a side, at the value that `value` says for a place.
template <std::invocable<base::Vec2> Value>
void hold_side(Flow& flow, std::int32_t side, Component component, Value&& value) {
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == side)
      for (const std::int32_t v : {e.from, e.to}) hold(flow, v, component, value(flow.mesh.position[v]));
}
inline void hold_side(Flow& flow, std::int32_t side, Component component, double value) {
  hold_side(flow, side, component, [value](base::Vec2) { return value; });
}

/// Lets the pressure that `pressure` says for a place act on a side from outside.
template <class Pressure>
void open_side(Flow& flow, std::int32_t side, Pressure&& pressure) {
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary)
    if (e.tag == side)
      flow.open.push_back({e.from, e.to, {pressure(flow.mesh.position[e.from]), pressure(flow.mesh.position[e.to])}});
}

/// A flow that uses everything, at random: porosity, moving mesh, history, source, drag, slip, open and held vertices.
struct RandomFlow {
  Flow flow;
  TimeScheme scheme;
};
inline RandomFlow random_flow(mesh::TriangleMesh mesh, const Properties& fluid, std::uint64_t seed) {
  RandomFlow random{at_rest(std::move(mesh), fluid), {}};
  Flow& flow = random.flow;
  Draw draw(seed);
  random.scheme.rate = draw(0, 20);
  random.scheme.unsteadiness = draw(0, 20);
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    for (int c = 0; c < 3; ++c) {
      flow.unknown[3 * v + c] = draw(-1, 1);
      flow.held[3 * v + c] = draw(0, 1) < 0.15;
    }
    flow.porosity[v] = draw(0.2, 1);
    flow.porosity_rate[v] = draw(-1, 1);
    flow.mesh_velocity[v] = draw.vector(1);
    flow.source[v] = draw.vector(5);
    flow.drag[v] = draw(0, 10);
    flow.carried[v] = {draw(-1, 1), draw(-1, 1)};
    flow.mobility[v] = draw(0, 0.1);
    flow.response[v] = draw(0, 0.5);
    random.scheme.history.push_back(draw.vector(20));
  }
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary) {
    if (e.tag == mesh::kRight) flow.open.push_back({e.from, e.to, {draw(-1, 1), draw(-1, 1)}});
    if (e.tag == mesh::kTop) flow.slip.push_back({e.from, e.to, draw(0, 3), draw.vector(1)});
  }
  return random;
}

}  // namespace seapile::fluid::support
