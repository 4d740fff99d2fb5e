#include "solver/simulation/objection.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "solver/grains/neighbours.h"
#include "solver/simulation/bounds.h"

namespace seapile::simulation {
namespace {

/// Whether all are: what is finite is 0 times itself.
bool all_finite(std::span<const double> values) {
  double sum = 0;
  for (const double v : values) sum += 0 * v;
  return sum == 0;
}

double smallest_radius(const Simulation& sim) {
  return std::visit([](const auto& system) { return system.smallest_radius; }, sim.contacts);
}

Objection porosity_objection(const Simulation& sim) {
  const coupling::Porosity& porosity = sim.water->expected.porosity;
  double area = 0;
  for (std::size_t i = 0; i < sim.grains.count(); ++i)
    area += std::numbers::pi * sim.grains.disc[i].radius * sim.grains.disc[i].radius;
  if (!std::isfinite(porosity.lowest)) return {Cause::porosity, "a porosity is not a number"};
  if (!(porosity.clipped <= kClippedShare * area))
    return {Cause::porosity, "the mesh has no room for " + std::to_string(100 * porosity.clipped / area) +
                                 " % of the grains: make it coarser"};
  return {};
}

}  // namespace

Objection objection(const Simulation& sim, const StepReport& report) {
  if (!report.water.empty()) return report.water;
  const double smallest = smallest_radius(sim);
  if (!report.contact.finite) return {Cause::not_finite, "a grain's place is not a number"};
  if (!(report.contact.longest_path <= kLongestPath * smallest))
    return {Cause::path, "a grain moved by more than the smallest radius within a step: reduce the step"};
  if (!(report.contact.residual * sim.law.step <= bounds_of(sim.law).residual * smallest))
    return {Cause::residual, "the contacts are unsolved by " + std::to_string(report.contact.residual) + " m/s"};
  if (!report.flowed) return {};
  if (Objection why = objection(sim.water->basin); !why.empty()) return why;
  return porosity_objection(sim);
}

Objection objection(const basin::Basin& basin) {
  if (!all_finite(basin.flow.unknown)) return {Cause::not_finite, "the flow is not finite"};
  if (!all_finite(basin.top.height)) return {Cause::not_finite, "the surface's height is not finite"};
  const std::optional<basin::SurfaceSpec>& surface = basin.spec.surface;
  if (!surface || surface->scheme != basin::SurfaceScheme::conservative) return {};
  const double change = basin::volume_of(basin.flow.mesh) / basin.volume_at_start - 1;
  if (!(std::abs(change) <= kVolumeChange))
    return {Cause::volume, "the volume below the surface has changed by " + std::to_string(100 * change) + " %"};
  return {};
}

Objection objection(const fluid::Jet& jet) {
  if (!all_finite(jet.flow.unknown)) return {Cause::not_finite, "the flow is not finite"};
  return fluid::objection(jet.surface);
}

Objection overlap_objection(const Simulation& sim, double overlap) {
  if (overlap <= bounds_of(sim.law).overlap) return {};
  return {Cause::overlap, "two bodies overlap by " + std::to_string(overlap) + " of the smaller radius"};
}

EnergyLevel energy_level(const Simulation& sim) {
  return std::visit(
      [&](const auto& system) {
        const grains::Energy e = energy(system, sim.grains, sim.law.gravity, sim.box.base, sim.team.crew.get());
        return EnergyLevel{e.kinetic, e.potential, sim.totals.body_work, sim.totals.push_work, sim.totals.dissipation};
      },
      sim.contacts);
}

Objection motion_objection(const EnergyLevel& now) {
  // Every one is in it.
  if (!std::isfinite(now.kinetic)) return {Cause::not_finite, "a grain's motion is not a number"};
  return {};
}

double elastic_energy(const Simulation& sim, const std::vector<Array>& state) {
  if (sim.law.nonsmooth) return 0;
  const auto found = std::ranges::find(state, "grains/position", [](const Array& array) { return array.info.name; });
  const auto& place = std::get<std::vector<double>>(found->values);
  std::vector<grains::Disc> discs(sim.grains.disc.begin(),
                                  sim.grains.disc.begin() + static_cast<std::ptrdiff_t>(sim.grains.count()));
  for (std::size_t i = 0; i < discs.size(); ++i) discs[i].x = place[2 * i], discs[i].y = place[2 * i + 1];
  const double omega = 2 * std::numbers::pi * sim.law.stiffness * sim.law.substeps / sim.law.step;
  double sum = 0;
  for (const auto [i, j] : grains::neighbour_pairs(discs, 0)) {
    const double overlap =
        discs[i].radius + discs[j].radius - std::hypot(discs[j].x - discs[i].x, discs[j].y - discs[i].y);
    sum += overlap * overlap / (1 / sim.grains.mass[i] + 1 / sim.grains.mass[j]);
  }
  return 0.5 * omega * omega * sum;
}

Objection stretch_objection(const Simulation& sim, const EnergyLevel& before, const std::vector<Array>& start) {
  const EnergyLevel now = energy_level(sim);
  if (Objection why = motion_objection(now); !why.empty()) return why;
  const double overlap = std::visit(
      [&](const auto& system) {
        return overlaps(system, sim.grains, sim.pile ? &sim.pile->body : nullptr, sim.team.crew.get()).max;
      },
      sim.contacts);
  if (Objection why = overlap_objection(sim, overlap); !why.empty()) return why;

  const double work = now.work - before.work, pushed = now.push_work - before.push_work,
               change = now.dissipation - before.dissipation;
  // Soft contacts take; what they make nothing gave, but for what they held. Non-smooth ones put apart what overlaps.
  const double taken = !sim.law.nonsmooth && change < 0 ? 0 : change;
  const double gained = now.kinetic - before.kinetic + now.potential - before.potential - work - pushed + taken;
  double weight = 0;
  for (const double m : sim.grains.mass) weight += m * sim.law.gravity;
  const double known = before.kinetic + std::abs(work) + std::abs(pushed) + std::abs(taken);
  const double most = kGainedEnergy * known + kGainedRise * weight * smallest_radius(sim);
  if (!(gained <= most) && !(gained <= most + elastic_energy(sim, start)))
    return {Cause::energy, "the grains have gained " + std::to_string(gained) + " J/m that nothing gave them"};
  return {};
}

}  // namespace seapile::simulation
