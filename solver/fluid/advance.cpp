#include "solver/fluid/advance.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace seapile::fluid {
namespace {

/// Differences that Anderson's acceleration looks back to.
constexpr int kMostDifferences = 10;

/// What rounding leaves of the pressure's terms, by their size; ten times what a fluid at rest shows.
constexpr double kRounding = 1e-14;
/// Ten times what rounding leaves of a vertex's height, by that height.
constexpr double kHeightRounding = 1e-15;

/// How residuals are measured.
struct Measure {
  double h;            ///< [m]
  double stiffness;    ///< force on a vertex by its velocity [kg/m/s]
  double mass_weight;  ///< of a mass row, so that it compares with a momentum row [kg/m2/s]
  double film = 0;     ///< force of the films that rounding of their heights makes [kg m/s2]

  Measure(const Flow& flow, double rate) {
    double area = 0;
    for (const auto& t : flow.mesh.triangle)
      area += 0.5 * mesh::doubled_area(flow.mesh.position[t[0]], flow.mesh.position[t[1]], flow.mesh.position[t[2]]);
    h = std::sqrt(area / static_cast<double>(flow.mesh.vertices()));
    stiffness = flow.fluid.density * rate * h * h + flow.fluid.viscosity;
    mass_weight = stiffness / h;
    double square = 0;
    for (const FilmEdge& e : flow.film) {
      const base::Vec2 a = flow.mesh.position[e.from], b = flow.mesh.position[e.to];
      const double dx = std::abs(b.x - a.x),
                   force = kHeightRounding * (e.tension / dx + e.weight * dx) * std::max(std::abs(a.y), std::abs(b.y));
      square += force * force;
    }
    film = std::sqrt(square);
  }
  /// A weighted residual by the size of the velocity's terms; 0 when it is no more than rounding.
  double share(double norm, std::span<const double> unknown) const {
    double velocity = 0, pressure = 0;
    for (std::size_t i = 0; i < unknown.size(); ++i)
      (i % 3 == kPressure ? pressure : velocity) += unknown[i] * unknown[i];
    return norm <= kRounding * h * std::sqrt(pressure) + film ? 0 : norm / (stiffness * std::sqrt(velocity));
  }
  /// The residual with its mass rows weighted.
  Eigen::VectorXd weighted(std::span<const double> residual) const {
    Eigen::VectorXd w(static_cast<Eigen::Index>(residual.size()));
    for (std::size_t i = 0; i < residual.size(); ++i)
      w[static_cast<Eigen::Index>(i)] = i % 3 == kPressure ? mass_weight * residual[i] : residual[i];
    return w;
  }
};

/// The iteration of one step from the state in flow.unknown.
class Iteration {
 public:
  Iteration(Flow& flow, const TimeScheme& scheme, FlowSolver& solver, const FollowFlow& follow, base::Profile& profile)
      : flow_(flow),
        scheme_(scheme),
        solver_(solver),
        follow_(follow),
        profile_(profile),
        in_following_(follow ? profile.index("domain") : 0),
        in_residual_(profile.index("fluid residual")),
        in_solve_(profile.index("fluid solve")),
        measure_(flow, solver.packed.rate),
        size_(static_cast<Eigen::Index>(flow.unknown.size())),
        residual_(flow.unknown.size()),
        direction_(size_) {}

  FlowReport run() {
    FlowReport report;
    Eigen::VectorXd r, last_r, last_direction, last_u;
    Eigen::MatrixXd dr(size_, kMostDifferences), du(size_, kMostDifferences), dd(size_, kMostDifferences);
    Eigen::Map<Eigen::VectorXd> u(flow_.unknown.data(), size_);
    int stored = 0;
    for (;; ++report.iterations) {
      if (!evaluate(r)) return report;
      const double norm = r.norm();
      report.residual = measure_.share(norm, flow_.unknown);
      if (!std::isfinite(norm)) return report;
      if (report.residual <= solver_.tolerance) {
        report.converged = true;
        report.defect.resize(residual_.size() / 3);
        for (std::size_t v = 0; v < report.defect.size(); ++v) report.defect[v] = residual_[3 * v + kPressure];
        return report;
      }
      if (report.iterations == kMostIterations) return report;

      {
        const base::Stopwatch watch(profile_, in_solve_);
        solver_.factor.solve(residual_, {direction_.data(), static_cast<std::size_t>(size_)});
      }
      Eigen::VectorXd step = -direction_;
      if (report.iterations > 0) {
        const int column = stored++ % kMostDifferences;
        dr.col(column) = r - last_r;
        du.col(column) = u - last_u;
        dd.col(column) = step - last_direction;
      }
      last_r = r;
      last_u = u;
      last_direction = step;
      if (const int columns = std::min(stored, kMostDifferences); columns > 0) {
        const Eigen::VectorXd gamma = dr.leftCols(columns).colPivHouseholderQr().solve(r);
        step -= (du.leftCols(columns) + dd.leftCols(columns)) * gamma;
      }
      u += step;
    }
  }

 private:
  /// False when there is no domain for the unknowns.
  bool evaluate(Eigen::VectorXd& weighted) {
    if (follow_) {
      const base::Stopwatch watch(profile_, in_following_);
      if (!std::ranges::all_of(flow_.unknown, [](double u) { return std::isfinite(u); }) || !follow_(flow_))
        return false;
      pack(solver_.packed, flow_, scheme_);
    }
    const base::Stopwatch watch(profile_, in_residual_);
    residual_of(flow_, solver_.packed, flow_.unknown, residual_, solver_.instructions);
    weighted = measure_.weighted(residual_);
    return true;
  }

  Flow& flow_;
  const TimeScheme& scheme_;
  FlowSolver& solver_;
  const FollowFlow& follow_;
  base::Profile& profile_;
  std::size_t in_following_, in_residual_, in_solve_;
  Measure measure_;
  Eigen::Index size_;
  std::vector<double> residual_;
  Eigen::VectorXd direction_;
};

}  // namespace

TimeScheme scheme_of(const Past& past, const FlowSolver& solver) {
  TimeScheme scheme;
  scheme.unsteadiness = solver.unsteadiness.value_or(0);
  if (past.level.empty()) return scheme;
  const auto& newest = past.level[0].interstitial;
  scheme.history.resize(newest.size());
  const double inverse = 1 / past.dt;
  if (solver.order == TimeOrder::first || past.level.size() < 2) {
    scheme.rate = inverse;
    for (std::size_t v = 0; v < newest.size(); ++v) scheme.history[v] = -inverse * newest[v];
  } else {
    const auto& older = past.level[1].interstitial;
    scheme.rate = 1.5 * inverse;
    for (std::size_t v = 0; v < newest.size(); ++v)
      scheme.history[v] = (-2 * inverse) * newest[v] + (0.5 * inverse) * older[v];
  }
  scheme.unsteadiness = solver.unsteadiness.value_or(scheme.rate);
  return scheme;
}

base::Objection objection(const FlowReport& report, const Past& past) {
  if (report.converged) return {};
  if (std::ranges::all_of(past.level[0].unknown, [](double v) { return std::isfinite(v); }))
    return {base::Cause::flow, report.reason};
  return {base::Cause::not_finite, "the flow was not finite"};
}

void remember(Past& past, const Flow& flow, double dt) {
  if (dt != past.dt) past.level.clear();
  past.dt = dt;
  if (past.level.size() == 2) past.level.pop_back();
  TimeLevel level{flow.unknown, {}, flow.mesh.position, flow.porosity};
  level.interstitial.resize(flow.mesh.vertices());
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v)
    level.interstitial[v] = (1 / flow.porosity[v]) * base::Vec2{flow.unknown[3 * v], flow.unknown[3 * v + 1]};
  past.level.insert(past.level.begin(), std::move(level));
}

void set_rates(Flow& flow, const Past& past, TimeOrder order) {
  const double inverse = 1 / past.dt;
  const bool second = order == TimeOrder::second && past.level.size() == 2;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) {
    const base::Vec2 moved = flow.mesh.position[v] - past.level[0].position[v];
    const double swelled = flow.porosity[v] - past.level[0].porosity[v];
    if (second) {
      // (3 a - 4 b + c)/2 = (3 (a - b) - (b - c))/2: exact for what does not move.
      const base::Vec2 moved_before = past.level[0].position[v] - past.level[1].position[v];
      const double swelled_before = past.level[0].porosity[v] - past.level[1].porosity[v];
      flow.mesh_velocity[v] = inverse * (1.5 * moved - 0.5 * moved_before);
      flow.porosity_rate[v] = inverse * (1.5 * swelled - 0.5 * swelled_before);
    } else {
      flow.mesh_velocity[v] = inverse * moved;
      flow.porosity_rate[v] = inverse * swelled;
    }
  }
}

FlowReport advance(Flow& flow, const Past& past, FlowSolver& solver, base::Profile& profile, const FollowFlow& follow) {
  const std::size_t in_packing = profile.index("fluid packing"), in_factor = profile.index("fluid factor");
  const std::vector<double> given = flow.unknown;
  const TimeScheme scheme = scheme_of(past, solver);
  {
    const base::Stopwatch watch(profile, in_packing);
    pack(solver.packed, flow, scheme);
  }
  const auto predict = [&] {
    const bool two = past.level.size() == 2;
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (flow.held[i])
        flow.unknown[i] = given[i];
      else if (!past.level.empty())
        flow.unknown[i] = two ? 2 * past.level[0].unknown[i] - past.level[1].unknown[i] : past.level[0].unknown[i];
    }
  };
  bool fresh = false;
  const auto refactor = [&] {
    const base::Stopwatch watch(profile, in_factor);
    fresh = true;
    ++solver.refactorisations;
    solver.factor_rate = scheme.rate;
    return solver.factor.factorise(jacobian(flow, scheme));
  };

  predict();
  FlowReport report;
  const bool stale = solver.factor.empty() || solver.factor_rate != scheme.rate ||
                     solver.last_iterations > kManyIterations || solver.excess_iterations >= kFactorWorth ||
                     solver.factor.matrix().rows() != static_cast<Eigen::Index>(given.size());
  if (!stale || refactor()) report = Iteration(flow, scheme, solver, follow, profile).run();
  if (!report.converged && !fresh) {
    predict();
    if (refactor()) report = Iteration(flow, scheme, solver, follow, profile).run();
  }
  report.refactored = fresh;
  solver.last_iterations = report.iterations;
  if (fresh) {
    solver.first_iterations = report.iterations;
    solver.excess_iterations = 0;
  } else {
    solver.excess_iterations += std::max(0, report.iterations - solver.first_iterations);
  }
  if (!report.converged) {
    report.reason = solver.factor.empty() ? "the flow's matrix is singular"
                                          : "the flow's equations were not solved within " +
                                                std::to_string(kMostIterations) + " iterations";
    flow.unknown = given;
  }
  return report;
}

}  // namespace seapile::fluid
