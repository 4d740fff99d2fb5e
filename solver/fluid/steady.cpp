#include "solver/fluid/steady.h"

#include <Eigen/SparseCore>
#include <Eigen/UmfPackSupport>
#include <algorithm>
#include <cmath>

#include "solver/fluid/boundary_terms.h"
#include "solver/fluid/dual.h"

namespace seapile::fluid {
namespace {

/// Where a vertex's height comes from: two surface heights and their shares.
struct HangsOn {
  std::int32_t from = -1;  ///< -1: a vertex that does not move
  double first = 0, second = 0;
};

/// The equations and their derivatives.
class System {
 public:
  System(const Flow& flow, const FreeSurface* surface) : flow_(flow), surface_(surface), hangs_(flow.mesh.vertices()) {
    size_ = static_cast<int>(flow.unknown.size() + (surface ? surface->height.size() : 0));
    held_.assign(flow.held.begin(), flow.held.end());
    held_.resize(size_, 0);
    residual_ = Eigen::VectorXd::Zero(size_);
    if (!surface) return;
    if (surface->pinned) held_[flow.unknown.size()] = 1;
    for (const mesh::Hanging& h : surface->columns.hanging)
      hangs_[h.vertex] = {h.from, h.share * (1 - h.weight), h.share * h.weight};
  }

  int height(std::int32_t surface_vertex) const { return static_cast<int>(flow_.unknown.size()) + surface_vertex; }
  bool held(int unknown) const { return held_[unknown] != 0; }
  void hold(int unknown) { held_[unknown] = 1; }
  int size() const { return size_; }

  void add(int equation, double value) {
    if (!held_[equation]) residual_[equation] += value;
  }
  void add(int equation, int unknown, double derivative) {
    if (!held_[equation] && !held_[unknown] && derivative != 0) triplets_.emplace_back(equation, unknown, derivative);
  }
  /// Derivative by the height of a vertex of the mesh.
  void add_by_height(int equation, std::int32_t vertex, double derivative) {
    const HangsOn& on = hangs_[vertex];
    if (on.from < 0) return;
    add(equation, height(on.from), derivative * on.first);
    add(equation, height(on.from + 1), derivative * on.second);
  }

  const Eigen::VectorXd& residual() const { return residual_; }
  Eigen::SparseMatrix<double> matrix() {
    for (int i = 0; i < size_; ++i)
      if (held_[i]) triplets_.emplace_back(i, i, 1.0);
    Eigen::SparseMatrix<double> matrix(size_, size_);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    return matrix;
  }

 private:
  const Flow& flow_;
  const FreeSurface* surface_;
  std::vector<HangsOn> hangs_;
  std::vector<std::uint8_t> held_;
  int size_;
  Eigen::VectorXd residual_;
  std::vector<Eigen::Triplet<double>> triplets_;
};

constexpr int kElementVariables = kUnknowns + 3;  // and the heights of its vertices

void add_triangles(System& system, const Flow& flow) {
  using D = Dual<kElementVariables>;
  const TimeScheme steady;
  for (std::size_t t = 0; t < flow.mesh.triangles(); ++t) {
    const auto& vertex = flow.mesh.triangle[t];
    std::array<D, 3> x, y;
    std::array<D, kUnknowns> u;
    for (int i = 0; i < 3; ++i) {
      x[i] = constant<kElementVariables>(flow.mesh.position[vertex[i]].x);
      y[i] = variable<kElementVariables>(flow.mesh.position[vertex[i]].y, kUnknowns + i);
      for (int c = 0; c < 3; ++c)
        u[3 * i + c] = variable<kElementVariables>(flow.unknown[3 * vertex[i] + c], 3 * i + c);
    }
    const auto residual = element_residual(flow.fluid, input_of(flow, steady, t), x, y, u);
    for (int row = 0; row < kUnknowns; ++row) {
      const int equation = 3 * vertex[row / 3] + row % 3;
      system.add(equation, residual[row].value());
      const auto& derivative = residual[row].derivatives();
      for (int column = 0; column < kUnknowns; ++column)
        system.add(equation, 3 * vertex[column / 3] + column % 3, derivative[column]);
      for (int i = 0; i < 3; ++i) system.add_by_height(equation, vertex[i], derivative[kUnknowns + i]);
    }
  }
}

/// Edges: u and y of both ends are the variables.
constexpr int kEdgeVariables = 6;
using EdgeDual = Dual<kEdgeVariables>;
std::array<EdgeEnd<EdgeDual>, 2> ends_of(const Flow& flow, std::int32_t from, std::int32_t to) {
  std::array<EdgeEnd<EdgeDual>, 2> ends;
  const std::int32_t vertex[] = {from, to};
  for (int i = 0; i < 2; ++i)
    ends[i] = {constant<kEdgeVariables>(flow.mesh.position[vertex[i]].x),
               variable<kEdgeVariables>(flow.mesh.position[vertex[i]].y, 3 * i + 2),
               variable<kEdgeVariables>(flow.u(vertex[i], kVelocityX), 3 * i),
               variable<kEdgeVariables>(flow.u(vertex[i], kVelocityY), 3 * i + 1)};
  return ends;
}
void add_edge(System& system, int equation, std::int32_t from, std::int32_t to, const EdgeDual& residual) {
  system.add(equation, residual.value());
  const std::int32_t vertex[] = {from, to};
  for (int i = 0; i < 2; ++i) {
    for (int c = 0; c < 2; ++c) system.add(equation, 3 * vertex[i] + c, residual.derivatives()[3 * i + c]);
    system.add_by_height(equation, vertex[i], residual.derivatives()[3 * i + 2]);
  }
}

void add_boundary(System& system, const Flow& flow) {
  const Geometry geometry = flow.fluid.geometry;
  const auto add = [&](std::int32_t from, std::int32_t to, const std::array<std::array<EdgeDual, 2>, 2>& force) {
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 2; ++c) add_edge(system, 3 * (i == 0 ? from : to) + c, from, to, force[i][c]);
  };
  for (const OpenEdge& e : flow.open)
    add(e.from, e.to,
        pressure_force(geometry, ends_of(flow, e.from, e.to), porosity_at(flow, e.from, e.to), e.pressure));
  for (const SlipEdge& e : flow.slip)
    add(e.from, e.to,
        slip_force(geometry, ends_of(flow, e.from, e.to), porosity_at(flow, e.from, e.to), e.friction, e.wall));
}

void add_surface(System& system, const Flow& flow, const FreeSurface& surface, const std::vector<double>& before,
                 double pseudo_rate) {
  const Geometry geometry = flow.fluid.geometry;
  const std::size_t count = surface.vertex.size();
  for (std::size_t s = 0; s + 1 < count; ++s) {
    // The domain lies to the left of an edge from the right to the left.
    const std::int32_t left = surface.vertex[s], right = surface.vertex[s + 1];
    const auto edge = ends_of(flow, right, left);
    const auto force =
        surface_force(geometry, edge, porosity_at(flow, right, left), surface.tension, surface.outside_pressure);
    for (int i = 0; i < 2; ++i)
      for (int c = 0; c < 2; ++c) add_edge(system, 3 * (i == 0 ? right : left) + c, right, left, force[i][c]);

    const auto along = ends_of(flow, left, right);
    const auto kinematic =
        kinematic_residual(along, {pseudo_rate, pseudo_rate}, {before[s], before[s + 1]}, surface.upwinding);
    for (int i = 0; i < 2; ++i)
      add_edge(system, system.height(static_cast<std::int32_t>(s) + i), left, right, kinematic[i]);
  }
  // A plug's hoop tension, gamma/h of the last vertex.
  if (geometry == Geometry::axisymmetric && surface.tension > 0) {
    const double h = surface.height.back(), pressure = surface.tension / h;
    const int height = system.height(static_cast<std::int32_t>(count) - 1);
    for (const auto& [from, to] : surface.outflow) {
      const auto force =
          pressure_force(geometry, ends_of(flow, from, to), porosity_at(flow, from, to), {pressure, pressure});
      for (int i = 0; i < 2; ++i)
        for (int c = 0; c < 2; ++c) {
          const int equation = 3 * (i == 0 ? from : to) + c;
          add_edge(system, equation, from, to, force[i][c]);
          system.add(equation, height, -force[i][c].value() / h);
        }
    }
  }
  // The film's pull at its two ends, where velocity is not held.
  const auto first = ends_of(flow, surface.vertex[0], surface.vertex[1]);
  const auto last = ends_of(flow, surface.vertex[count - 2], surface.vertex[count - 1]);
  const auto pull_first = film_pull(geometry, first[0], first[1], surface.tension),
             pull_last = film_pull(geometry, last[1], last[0], surface.tension);
  for (int c = 0; c < 2; ++c) {
    add_edge(system, 3 * surface.vertex[0] + c, surface.vertex[0], surface.vertex[1], pull_first[c]);
    add_edge(system, 3 * surface.vertex[count - 1] + c, surface.vertex[count - 2], surface.vertex[count - 1],
             pull_last[c]);
  }
}

}  // namespace

NewtonReport solve_steady(Flow& flow, FreeSurface* surface, const NewtonLimits& limits) {
  // dh/dt of a pseudo-time in the first iterations [U/H]: a flat jet is far from the solution.
  constexpr double kFirstRate = 0.5, kRateFactor = 0.05, kNoRate = 0.01;
  NewtonReport report;
  const std::size_t flow_unknowns = flow.unknown.size();
  double pseudo_rate = kFirstRate;
  if (surface) mesh::regularise(flow.mesh, surface->columns, surface->height);
  Eigen::UmfPackLU<Eigen::SparseMatrix<double>> factor;
  factor.umfpackControl()(UMFPACK_IRSTEP) = 0;

  for (report.iterations = 0; report.iterations < limits.most_iterations; ++report.iterations) {
    System system(flow, surface);
    const bool flow_alone = surface && report.iterations == 0;  // a flow first, for the surface as it is
    if (flow_alone)
      for (std::size_t s = 0; s < surface->height.size(); ++s) system.hold(system.height(static_cast<std::int32_t>(s)));
    add_triangles(system, flow);
    add_boundary(system, flow);
    if (surface) add_surface(system, flow, *surface, surface->height, pseudo_rate);
    report.residual = system.residual().lpNorm<Eigen::Infinity>();

    factor.compute(system.matrix());
    if (factor.info() != Eigen::Success) {
      report.reason = "the matrix of the steady flow is singular";
      return report;
    }
    Eigen::VectorXd change = -factor.solve(system.residual());
    if (!change.allFinite()) {
      report.reason = "the steady flow is not finite";
      return report;
    }

    double rise = 0;
    if (surface)
      for (std::size_t s = 0; s < surface->height.size(); ++s)
        rise = std::max(rise, std::abs(change[system.height(static_cast<std::int32_t>(s))]) / surface->height[s]);
    if (rise > limits.largest_rise) change *= limits.largest_rise / rise;

    double largest = 0, largest_change = 0;
    for (std::size_t i = 0; i < flow_unknowns; ++i) {
      flow.unknown[i] += change[static_cast<Eigen::Index>(i)];
      if (i % 3 == kPressure) continue;
      largest = std::max(largest, std::abs(flow.unknown[i]));
      largest_change = std::max(largest_change, std::abs(change[static_cast<Eigen::Index>(i)]));
    }
    report.change = largest > 0 ? largest_change / largest : 0;
    if (surface) {
      for (std::size_t s = 0; s < surface->height.size(); ++s)
        surface->height[s] += change[system.height(static_cast<std::int32_t>(s))];
      if (report.reason = objection(*surface).why; !report.reason.empty()) return report;
      mesh::regularise(flow.mesh, surface->columns, surface->height);
      report.change = std::max(report.change, rise);
    }
    if (report.change < limits.tolerance && (!surface || pseudo_rate == 0)) {
      report.converged = true;
      ++report.iterations;
      return report;
    }
    if (!flow_alone) pseudo_rate = pseudo_rate * kRateFactor < kNoRate ? 0 : pseudo_rate * kRateFactor;
  }
  report.reason = "Newton's method has not converged";
  return report;
}

}  // namespace seapile::fluid
