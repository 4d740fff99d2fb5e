#include "solver/fluid/jet.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solver/fluid/boundary_terms.h"
#include "solver/mesh/generate.h"

namespace seapile::fluid {
namespace {

mesh::TriangleMesh mesh_of(const JetSpec& spec) {
  const mesh::Corner outline[] = {{{-spec.upstream, 0}, kAxis},
                                  {{spec.downstream, 0}, kOutflow},
                                  {{spec.downstream, 1}, kJetSurface},
                                  {{0, 1}, kDieWall},
                                  {{-spec.upstream, 1}, kInflow}};
  return mesh::generate(outline, [&](base::Vec2 p) {
    return std::min(spec.largest_size, spec.lip_size + spec.growth * std::hypot(p.x, p.y - 1));
  });
}

}  // namespace

double developed(Geometry geometry, double y) { return (geometry == Geometry::axisymmetric ? 2 : 1.5) * (1 - y * y); }

double flux_through(const Flow& flow, std::int32_t side) {
  double flux = 0;
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary) {
    if (e.tag != side) continue;
    const base::Vec2 a = flow.mesh.position[e.from], b = flow.mesh.position[e.to];
    for (const double at : kGauss) {
      const double ux = (1 - at) * flow.u(e.from, kVelocityX) + at * flow.u(e.to, kVelocityX);
      const double uy = (1 - at) * flow.u(e.from, kVelocityY) + at * flow.u(e.to, kVelocityY);
      const double r = flow.fluid.geometry == Geometry::axisymmetric ? (1 - at) * a.y + at * b.y : 1;
      flux += 0.5 * r * (ux * (b.y - a.y) - uy * (b.x - a.x));
    }
  }
  return flux;
}

Jet flat_jet(const JetSpec& spec) {
  Jet jet{at_rest(mesh_of(spec), {spec.reynolds / 2, 1, spec.geometry, spec.convection}), {}};
  Flow& flow = jet.flow;
  // What is written later wins: the wall, at the corner that it shares with the inflow.
  for (const JetSide side : {kAxis, kOutflow, kInflow, kDieWall})
    for (const mesh::BoundaryEdge& edge : flow.mesh.boundary) {
      if (edge.tag != side) continue;
      for (const std::int32_t v : {edge.from, edge.to}) {
        if (side == kInflow) hold(flow, v, kVelocityX, developed(spec.geometry, flow.mesh.position[v].y));
        if (side == kDieWall) hold(flow, v, kVelocityX, 0);
        hold(flow, v, kVelocityY, 0);
      }
    }
  // The flux through the die is that of the profile, not of the polygon between its values.
  const double scale = die_flux(spec) / std::abs(flux_through(flow, kInflow));
  for (const std::int32_t v : mesh::chain(flow.mesh, kInflow)) flow.u(v, kVelocityX) *= scale;
  jet.surface = surface_along(flow.mesh, kJetSurface, 0);
  jet.surface.pinned = true;
  if (spec.capillary) jet.surface.tension = 1 / *spec.capillary;
  if (spec.geometry == Geometry::axisymmetric && spec.capillary)
    for (const mesh::BoundaryEdge& edge : flow.mesh.boundary)
      if (edge.tag == kOutflow) jet.surface.outflow.push_back({edge.from, edge.to});
  return jet;
}

double die_flux(const JetSpec& spec) { return spec.geometry == Geometry::axisymmetric ? 0.5 : 1; }

}  // namespace seapile::fluid
