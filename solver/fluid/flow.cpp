#include "solver/fluid/flow.h"

namespace seapile::fluid {

Flow at_rest(mesh::TriangleMesh mesh, const Properties& fluid) {
  const std::size_t vertices = mesh.vertices();
  Flow flow;
  flow.mesh = std::move(mesh);
  flow.fluid = fluid;
  flow.unknown.assign(3 * vertices, 0);
  flow.held.assign(3 * vertices, 0);
  flow.porosity.assign(vertices, 1);
  flow.porosity_rate.assign(vertices, 0);
  flow.mesh_velocity.assign(vertices, {});
  flow.source.assign(vertices, {});
  flow.drag.assign(vertices, 0);
  flow.carried.assign(vertices, {});
  flow.mobility.assign(vertices, 0);
  flow.response.assign(vertices, 0);
  return flow;
}

void hold(Flow& flow, std::int32_t vertex, Component component, double value) {
  flow.u(vertex, component) = value;
  flow.held[3 * vertex + component] = 1;
}

ElementInput<double> input_of(const Flow& flow, const TimeScheme& scheme, std::size_t triangle) {
  ElementInput<double> in{};
  in.rate = scheme.rate;
  in.unsteadiness = scheme.unsteadiness;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t v = flow.mesh.triangle[triangle][i];
    in.porosity[i] = flow.porosity[v];
    in.porosity_rate[i] = flow.porosity_rate[v];
    in.mesh_velocity[i] = {flow.mesh_velocity[v].x, flow.mesh_velocity[v].y};
    in.source[i] = {flow.source[v].x, flow.source[v].y};
    in.drag[i] = flow.drag[v];
    in.carried[i] = {flow.carried[v].x, flow.carried[v].y};
    in.mobility[i] = flow.mobility[v];
    in.response[i] = flow.response[v];
    if (!scheme.history.empty()) in.history[i] = {scheme.history[v].x, scheme.history[v].y};
  }
  return in;
}

}  // namespace seapile::fluid
