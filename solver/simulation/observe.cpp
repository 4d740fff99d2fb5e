#include "solver/simulation/observe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "solver/pile/pile.h"
#include "solver/simulation/headline.h"
#include "solver/simulation/water_metrics.h"

namespace seapile::simulation {
namespace {

const grains::RigidBody* body_of(const Simulation& sim) { return sim.pile ? &sim.pile->body : nullptr; }

/// Row k of a frame shows grain order[k]: by rising id.
std::vector<std::size_t> order_of_ids(const grains::Grains& grains) {
  std::vector<std::size_t> order(grains.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return grains.id[a] < grains.id[b]; });
  return order;
}

void add_grains(const Simulation& sim, Frame& frame) {
  std::vector<std::int64_t> id;
  std::vector<double> position, radius, velocity, spin, displacement;
  for (const std::size_t k : order_of_ids(sim.grains)) {
    const grains::Disc& d = sim.grains.disc[k];
    id.push_back(sim.grains.id[k]);
    position.insert(position.end(), {d.x, d.y});
    radius.push_back(d.radius);
    displacement.insert(displacement.end(), {d.x - sim.origin[k].x, d.y - sim.origin[k].y});
    std::visit(
        [&](const auto& system) {
          const auto& m = system.motion(static_cast<std::int32_t>(k));
          velocity.insert(velocity.end(), {static_cast<double>(m.vx), static_cast<double>(m.vy)});
          spin.push_back(static_cast<double>(m.u) / d.radius);
        },
        sim.contacts);
  }
  frame.grains = {{{"grains/id", "-", "name of the grain", 1, Entity::grain}, std::move(id)},
                  {{"grains/position", "m", "place of the centre", 2, Entity::grain}, std::move(position)},
                  {{"grains/radius", "m", "radius", 1, Entity::grain}, std::move(radius)},
                  {{"grains/velocity", "m/s", "velocity of the centre", 2, Entity::grain}, std::move(velocity)},
                  {{"grains/spin", "rad/s", "spin, anticlockwise", 1, Entity::grain}, std::move(spin)},
                  {{"grains/displacement", "m", "displacement since the start", 2, Entity::grain}, std::move(displacement)}};
}

/// Mean over the records' travel of f, for records whose depth lies in [from, to).
template <class F>
double mean_over_depth(std::span<const Record> records, double from, double to, F&& f) {
  double sum = 0, weight = 0;
  for (const Record& r : records)
    if (r.depth >= from && r.depth < to) {
      const double travel = std::abs(r.speed) * r.span;
      sum += travel * f(r);
      weight += travel;
    }
  return weight > 0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double depth(const Simulation& sim) {
  return sim.pile ? sim.surface - sim.pile->body.position.y : std::numeric_limits<double>::quiet_NaN();
}

void gather(Simulation& sim, const StepReport& report) {
  Gathering& g = sim.gathering;
  g.residual += report.contact.residual * report.contact.residual;
  ++g.steps;
}

Record take_record(Simulation& sim) {
  Gathering& g = sim.gathering;
  Record r;
  r.time = sim.clock.time();
  r.span = r.time - g.time;
  if (sim.pile) {
    r.depth = depth(sim);
    r.travel = sim.pile->travel;
    r.speed = (g.position - sim.pile->body.position.y) / r.span;
    r.tip_force_x = sim.totals.feature[pile::kTip].x / r.span;
    r.tip_force_y = sim.totals.feature[pile::kTip].y / r.span;
    r.sleeve_force_x = sim.totals.feature[pile::kSleeve].x / r.span;
    r.sleeve_force_y = sim.totals.feature[pile::kSleeve].y / r.span;
    r.tip_resistance = r.tip_force_y / (2 * sim.pile->spec.radius);
    r.tip_resistance_thesis = r.tip_force_y / sim.pile->spec.radius;
  }
  r.left_wall_force = -sim.totals.left.x / r.span;
  r.right_wall_force = sim.totals.right.x / r.span;
  r.base_force = -sim.totals.base.y / r.span;

  std::visit(
      [&](const auto& system) {
        const grains::OverlapStatistics o = overlaps(system, sim.grains, body_of(sim), sim.team.crew.get());
        r.overlap_max = o.max;
        r.overlap_p999 = o.p999;
        r.overlap_mean = o.mean;
        r.contacts = static_cast<double>(o.touching);
        const grains::Energy e = energy(system, sim.grains, sim.law.gravity, sim.box.base, sim.team.crew.get());
        r.kinetic_energy = e.kinetic;
        r.potential_energy = e.potential;
      },
      sim.contacts);
  r.residual = g.steps > 0 ? std::sqrt(g.residual / static_cast<double>(g.steps)) : 0;
  r.pile_work = sim.totals.body_work;
  r.dissipation = sim.totals.dissipation;

  g = {r.time, r.travel, sim.pile ? sim.pile->body.position.y : 0, 0, 0};
  sim.totals.left = sim.totals.right = sim.totals.base = {};
  for (grains::Impulse& f : sim.totals.feature) f = {};
  return r;
}

void ForceWindow::add(const Simulation& sim) {
  time_ += sim.clock.size();
  std::visit(
      [&](const auto& system) {
        for (const grains::TouchingContact& c : touching_contacts(system, sim.grains, body_of(sim))) {
          Sum& s = sum_[{c.first, c.second}];
          s.normal += c.pn;
          s.tangential += c.pt;
          s.nx = c.nx, s.ny = c.ny, s.x = c.x, s.y = c.y;
        }
      },
      sim.contacts);
}

std::vector<grains::ContactForce> ForceWindow::forces() const {
  std::vector<grains::ContactForce> forces;
  for (const auto& [who, s] : sum_)
    forces.push_back({who.first, who.second, s.x, s.y, s.nx, s.ny, s.normal / time_, s.tangential / time_});
  return forces;
}

Frame ForceWindow::frame(const Simulation& sim, double spacing, double height) const {
  Frame frame;
  frame.time = sim.clock.time();
  frame.depth = depth(sim);
  frame.asked = asked_;
  add_grains(sim, frame);

  const std::vector<grains::ContactForce> means = forces();
  std::vector<std::int64_t> bodies;
  std::vector<double> position, normal, force;
  for (const grains::ContactForce& c : means) {
    bodies.insert(bodies.end(), {sim.grains.id[c.first], c.second >= 0 ? sim.grains.id[c.second] : c.second});
    position.insert(position.end(), {c.x, c.y});
    normal.insert(normal.end(), {c.nx, c.ny});
    force.insert(force.end(), {c.normal, c.tangential});
  }
  frame.contacts = {{{"contacts/grain", "-", "ids of both; -1 left, -2 right wall, -3 base, -4 tip, -5 sleeve", 2, Entity::contact}, std::move(bodies)},
                    {{"contacts/position", "m", "point of contact", 2, Entity::contact}, std::move(position)},
                    {{"contacts/normal", "-", "unit normal from the first to the second", 2, Entity::contact}, std::move(normal)},
                    {{"contacts/force", "N/m", "normal and tangential force, means over the window", 2, Entity::contact}, std::move(force)}};

  const grains::Grid grid{sim.box.left, sim.box.base, spacing,
                          static_cast<int>(std::ceil((sim.box.right - sim.box.left) / spacing - 1e-9)),
                          static_cast<int>(std::ceil(height / spacing - 1e-9))};
  frame.grid = {grid.x0, grid.y0, grid.spacing, grid.nx, grid.ny};
  const std::span<const grains::Disc> discs(sim.grains.disc.data(), sim.grains.count());
  std::vector<double> stress, values, direction;
  for (const grains::Stress& s : grains::stress_on_grid(means, discs, sim.box, grid)) {
    const grains::PrincipalStress p = principal(s);
    stress.insert(stress.end(), {s.xx, s.yy, s.xy});
    values.insert(values.end(), {p.major, p.minor});
    direction.push_back(p.direction);
  }
  frame.cells = {{{"cells/porosity", "-", "share of the cell that no grain fills", 1, Entity::cell}, grains::porosity_on_grid(discs, grid)},
                 {{"cells/stress", "Pa", "xx, yy, xy of the stress, compression positive", 3, Entity::cell}, std::move(stress)},
                 {{"cells/principal_stress", "Pa", "major and minor principal stress", 2, Entity::cell}, std::move(values)},
                 {{"cells/principal_direction", "rad", "angle of the major principal stress from x", 1, Entity::cell}, std::move(direction)}};
  return frame;
}

PlacesBefore places_of(const Simulation& sim) {
  PlacesBefore places{sim.pile->body.position.y, {}};
  for (std::size_t i = 0; i < sim.grains.count(); ++i)
    places.grain.push_back({sim.grains.disc[i].x, sim.grains.disc[i].y});
  return places;
}

TipMeasures measures_of(const Simulation& sim, const ForceWindow& window, const PlacesBefore* before) {
  const std::span<const grains::Disc> discs(sim.grains.disc.data(), sim.grains.count());
  const TipPlace tip{sim.pile->body.position, sim.pile->spec.radius};
  TipMeasures measures;
  measures.asked = window.asked();
  if (before) measure_motion(measures, discs, *before, tip);
  measure_forces(measures, window.forces(), discs, sim.box, tip);
  return measures;
}

std::vector<Metric> drive_metrics(std::span<const Record> records, std::span<const FlowRecord> flow_records,
                                  const pile::PileSpec& pile) {
  constexpr double kBin = 0.05;  // [m]: docs/formulation.md 3
  std::vector<Metric> metrics;
  const auto add = [&](std::string name, double value, const char* unit, const char* meaning) {
    if (std::isfinite(value)) metrics.push_back({std::move(name), value, unit, meaning});
  };
  const auto tip = [](const Record& r) { return r.tip_resistance; };
  const double mean = mean_over_depth(records, kHeadlineFrom, kHeadlineEnd, tip);
  add("tip_resistance_mean", mean, "Pa", "headline: mean q_c over 0.2-1.2 m, as far as reached");
  add("tip_force_mean", mean * 2 * pile.radius, "N/m", "mean vertical force on the tip over 0.2-1.2 m");
  add("pile_force_mean",
      mean_over_depth(records, 0, kHeadlineEnd, [](const Record& r) { return r.tip_force_y + r.sleeve_force_y; }),
      "N/m", "mean vertical force on tip and sleeve over 0-1.2 m");

  // Fluctuation: standard deviation of q_c about its straight line over depth, records weighted by their travel.
  double w = 0, sd = 0, sq = 0;
  for (const Record& r : records)
    if (is_in_headline(r)) {
      const double t = std::abs(r.speed) * r.span;
      w += t, sd += t * r.depth, sq += t * r.tip_resistance;
    }
  if (w > 0) {
    const double d0 = sd / w, q0 = sq / w;
    double dd = 0, dq = 0, rest = 0;
    for (const Record& r : records)
      if (is_in_headline(r)) {
        const double t = std::abs(r.speed) * r.span;
        dd += t * (r.depth - d0) * (r.depth - d0);
        dq += t * (r.depth - d0) * (r.tip_resistance - q0);
      }
    const double slope = dd > 0 ? dq / dd : 0;
    for (const Record& r : records)
      if (is_in_headline(r)) {
        const double e = r.tip_resistance - q0 - slope * (r.depth - d0);
        rest += std::abs(r.speed) * r.span * e * e;
      }
    add("tip_resistance_fluctuation", std::sqrt(rest / w), "Pa", "standard deviation of detrended q_c over 0.2-1.2 m");
    add("tip_resistance_slope", slope, "Pa/m", "slope of q_c over depth, 0.2-1.2 m");
  }

  double overlap = 0, p999 = 0, residual = 0;
  for (const Record& r : records) {
    overlap = std::max(overlap, r.overlap_max);
    p999 = std::max(p999, r.overlap_p999);
    residual = std::max(residual, r.residual);
  }
  add("overlap_max", overlap, "-", "largest overlap at a record, share of the smaller radius");
  add("overlap_p999_max", p999, "-", "largest 99.9th percentile of the overlaps");
  add("residual_max", residual, "m/s", "largest residual of a record");
  if (!records.empty()) {
    add("depth_reached", records.back().depth, "m", "depth at the end");
    add("pile_work", records.back().pile_work, "J/m", "work of the pile on the grains");
    add("dissipation", records.back().dissipation, "J/m", "energy taken out by the contacts, summed per contact");
    add("energy_error", energy_error(records, flow_records), "-", "energy that the balance lacks, share of the pile's work");
  }
  for (int k = 0; k * kBin < kHeadlineTo - 1e-9; ++k)
    add("tip_resistance_bin_" + depth_text(k * kBin), mean_over_depth(records, k * kBin, (k + 1) * kBin, tip), "Pa",
        "mean q_c over a depth bin of 0.05 m from this depth");
  return metrics;
}

}  // namespace seapile::simulation
