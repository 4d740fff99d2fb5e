#include "solver/basin/pile_force.h"

#include <algorithm>
#include <cmath>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/residual.h"
#include "solver/mesh/basin_mesh.h"

namespace seapile::basin {
namespace {

using fluid::kPressure;

/// Integral of (1 - phi) p n over the edges of a tag, n into the pile [N/m].
base::Vec2 on_grains_share(const fluid::Flow& flow, std::int32_t tag) {
  base::Vec2 force;
  for (const mesh::BoundaryEdge& e : flow.mesh.boundary) {
    if (e.tag != tag) continue;
    const base::Vec2 along = flow.mesh.position[e.to] - flow.mesh.position[e.from];
    double pressure = 0;
    for (const double at : fluid::kGauss) {
      const auto here = [&](double from, double to) { return (1 - at) * from + at * to; };
      pressure += 0.5 * (1 - here(flow.porosity[e.from], flow.porosity[e.to])) *
                  here(flow.u(e.from, kPressure), flow.u(e.to, kPressure));
    }
    force = force + pressure * base::Vec2{along.y, -along.x};
  }
  return force;
}

base::Vec2 vector_of(const std::array<double, 2>& force) { return {force[0], force[1]}; }

}  // namespace

void feel_pile(Basin& basin, const fluid::TimeScheme& scheme) {
  const Domain& domain = basin.domain;
  const fluid::Flow& flow = basin.flow;
  const std::vector<double> lack = fluid::lack_of(flow, scheme, domain.at_pile);
  basin.tip_force = vector_of(fluid::force_on(flow, lack, domain.of_tip)) + on_grains_share(flow, mesh::kPileTip);
  basin.sleeve_force =
      vector_of(fluid::force_on(flow, lack, domain.of_sleeve)) + on_grains_share(flow, mesh::kPileSleeve);
}

PorePressure pore_pressure(const Basin& basin) {
  const fluid::Flow& flow = basin.flow;
  const mesh::TriangleMesh& mesh = flow.mesh;
  PorePressure found;
  double length = 0, shoulder = -1e300;
  for (const mesh::BoundaryEdge& e : mesh.boundary) {
    if (e.tag != mesh::kPileTip) continue;
    const double edge = norm(mesh.position[e.to] - mesh.position[e.from]);
    found.face += edge * 0.5 * (flow.u(e.from, kPressure) + flow.u(e.to, kPressure));
    length += edge;
    shoulder = std::max({shoulder, mesh.position[e.from].y, mesh.position[e.to].y});
  }
  found.face /= length;

  const std::vector<std::int32_t>& tip = basin.domain.motion.boundary().tip;
  found.shoulder = 0.5 * (flow.u(tip.front(), kPressure) + flow.u(tip.back(), kPressure));

  const double height = shoulder + 2 * basin.spec.pile->radius;
  double sum = 0;
  int sides = 0;
  for (const mesh::BoundaryEdge& e : mesh.boundary) {
    if (e.tag != mesh::kPileSleeve) continue;
    const double from = mesh.position[e.from].y, to = mesh.position[e.to].y;
    if (height < std::min(from, to) || height >= std::max(from, to)) continue;
    const double at = (height - from) / (to - from);
    sum += (1 - at) * flow.u(e.from, kPressure) + at * flow.u(e.to, kPressure);
    ++sides;
  }
  if (sides > 0) found.sleeve = sum / sides;
  return found;
}

}  // namespace seapile::basin
