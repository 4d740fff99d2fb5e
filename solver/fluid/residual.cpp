#include "solver/fluid/residual.h"

#include <algorithm>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/residual_kernels.h"

namespace seapile::fluid {
namespace {

constexpr int kPadding = 8;  // triangles in the widest vector

ResidualKernel kernel_of(base::InstructionSet set) {
#if defined(SEAPILE_X86)
  if (set == base::InstructionSet::avx512) return kResidualKernel_avx512;
  if (set == base::InstructionSet::avx2) return kResidualKernel_avx2;
#endif
  (void)set;
  return kResidualKernel_generic;
}

void add_boundary(const Flow& flow, std::span<const double> unknown, std::span<double> residual) {
  const auto end = [&](std::int32_t v) {
    return EdgeEnd<double>{flow.mesh.position[v].x, flow.mesh.position[v].y, unknown[3 * v], unknown[3 * v + 1]};
  };
  const auto add = [&](std::int32_t from, std::int32_t to, const EdgeForces<double>& force) {
    for (int c = 0; c < 2; ++c) {
      residual[3 * from + c] += force[0][c];
      residual[3 * to + c] += force[1][c];
    }
  };
  const Geometry geometry = flow.fluid.geometry;
  for (const OpenEdge& e : flow.open)
    add(e.from, e.to,
        pressure_force<double>(geometry, {end(e.from), end(e.to)}, porosity_at(flow, e.from, e.to), e.pressure));
  for (const SlipEdge& e : flow.slip)
    add(e.from, e.to,
        slip_force<double>(geometry, {end(e.from), end(e.to)}, porosity_at(flow, e.from, e.to), e.friction, e.wall));
  for (const FilmEdge& e : flow.film)
    add(e.from, e.to,
        surface_force<double>(geometry, {end(e.from), end(e.to)}, porosity_at(flow, e.from, e.to), e.tension, 0));
}

/// Of one triangle, from the flow itself.
std::array<double, kUnknowns> residual_of(const Flow& flow, const TimeScheme& scheme, std::span<const double> unknown,
                                          std::size_t triangle) {
  const auto& vertex = flow.mesh.triangle[triangle];
  std::array<double, 3> x, y;
  std::array<double, kUnknowns> u;
  for (int i = 0; i < 3; ++i) {
    x[i] = flow.mesh.position[vertex[i]].x;
    y[i] = flow.mesh.position[vertex[i]].y;
    for (int c = 0; c < 3; ++c) u[3 * i + c] = unknown[3 * vertex[i] + c];
  }
  return element_residual(flow.fluid, input_of(flow, scheme, triangle), x, y, u);
}

void close(const Flow& flow, std::span<const double> unknown, std::span<double> residual) {
  add_boundary(flow, unknown, residual);
  for (std::size_t i = 0; i < residual.size(); ++i)
    if (flow.held[i]) residual[i] = 0;
}

}  // namespace

void pack(PackedFlow& packed, const Flow& flow, const TimeScheme& scheme) {
  const std::size_t vertices = flow.mesh.vertices(), triangles = flow.mesh.triangles();
  packed.rate = scheme.rate;
  packed.unsteadiness = scheme.unsteadiness;
  packed.vertex.resize(vertices);
  for (std::size_t v = 0; v < vertices; ++v) {
    const base::Vec2 history = scheme.history.empty() ? base::Vec2{} : scheme.history[v];
    packed.vertex[v] = {flow.mesh.position[v].x, flow.mesh.position[v].y, flow.porosity[v], flow.porosity_rate[v],
                        flow.mesh_velocity[v].x, flow.mesh_velocity[v].y, history.x,        history.y,
                        flow.source[v].x,        flow.source[v].y,        flow.drag[v],     flow.carried[v].x,
                        flow.carried[v].y,       flow.mobility[v],        flow.response[v], {}};
  }
  packed.triangles = static_cast<std::int32_t>(triangles);
  packed.corner.resize(3 * ((triangles + kPadding - 1) / kPadding * kPadding));
  for (std::size_t t = 0; 3 * t < packed.corner.size(); ++t)
    for (int i = 0; i < 3; ++i) packed.corner[3 * t + i] = flow.mesh.triangle[std::min(t, triangles - 1)][i];
}

void residual_of(const Flow& flow, const PackedFlow& packed, std::span<const double> unknown,
                 std::span<double> residual, base::InstructionSet instructions) {
  std::ranges::fill(residual, 0.0);
  kernel_of(instructions)(flow.fluid, packed, unknown.data(), residual.data());
  close(flow, unknown, residual);
}

void residual_of(const Flow& flow, const TimeScheme& scheme, std::span<const double> unknown,
                 std::span<double> residual) {
  std::ranges::fill(residual, 0.0);
  for (std::size_t t = 0; t < flow.mesh.triangles(); ++t) {
    const auto& vertex = flow.mesh.triangle[t];
    const auto part = residual_of(flow, scheme, unknown, t);
    for (int row = 0; row < kUnknowns; ++row) residual[3 * vertex[row / 3] + row % 3] += part[row];
  }
  close(flow, unknown, residual);
}

std::vector<double> lack_of(const Flow& flow, const TimeScheme& scheme, std::span<const std::int32_t> triangles) {
  std::vector<double> residual(flow.unknown.size(), 0);
  for (const std::int32_t t : triangles) {
    const auto part = residual_of(flow, scheme, flow.unknown, static_cast<std::size_t>(t));
    for (int row = 0; row < kUnknowns; ++row) residual[3 * flow.mesh.triangle[t][row / 3] + row % 3] += part[row];
  }
  add_boundary(flow, flow.unknown, residual);
  return residual;
}

std::array<double, 2> force_on(const Flow& flow, std::span<const double> lack, std::span<const std::uint8_t> of_body) {
  std::array<double, 2> force{};
  for (std::size_t v = 0; v < of_body.size(); ++v)
    for (int c = 0; c < 2; ++c)
      if (of_body[v] && flow.held[3 * v + c]) force[c] -= lack[3 * v + c];
  return force;
}

}  // namespace seapile::fluid
