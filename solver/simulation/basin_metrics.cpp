#include "solver/simulation/basin_metrics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "solver/basin/decay_fit.h"
#include "solver/basin/small_wave.h"

namespace seapile::simulation {
namespace {

using Records = std::vector<FlowRecord>;

double largest(const Records& records, const std::function<double(const FlowRecord&)>& of) {
  double result = 0;
  for (const FlowRecord& r : records) result = std::max(result, of(r));
  return result;
}

void add_quality(std::vector<Metric>& metrics, const basin::Basin& basin, const Records& records) {
  double shape = 1, angle = std::numbers::pi / 3;
  for (const FlowRecord& r : records) {
    shape = std::min(shape, r.lowest_shape);
    angle = std::min(angle, r.smallest_angle);
  }
  metrics.push_back({"lowest_shape", shape, "-", "smallest shape quality q of a triangle in any record"});
  metrics.push_back({"smallest_angle", angle, "rad", "smallest angle of a triangle in any record"});
  metrics.push_back({"largest_share_below_half", largest(records, [](const FlowRecord& r) { return r.below_half; }),
                     "-", "largest share of triangles with q < 0.5 in a record"});
  metrics.push_back({"largest_share_small_angles", largest(records, [](const FlowRecord& r) { return r.small_angles; }),
                     "-", "largest share of triangles with an angle below 30 degrees in a record"});
  metrics.push_back({"meshes", static_cast<double>(1 + basin.remeshes.size()), "-", "meshes made"});
  if (basin.remeshes.empty()) return;
  double after = 1, difference = 0, energy = 0, momentum = 0;
  for (const basin::RemeshReport& r : basin.remeshes) {
    after = std::min(after, r.after.lowest_shape);
    difference = std::max(difference, r.velocity_difference);
    energy = std::max(energy, std::abs(r.energy_change));
    momentum = std::max(momentum, r.momentum_change);
  }
  metrics.push_back({"lowest_shape_after_remesh", after, "-", "smallest q of a triangle right after a remesh"});
  metrics.push_back(
      {"transfer_difference", difference, "-", "largest change of the velocity in a remesh, L2, relative"});
  metrics.push_back({"transfer_energy", energy, "-", "largest change of the kinetic energy in a remesh, relative"});
  metrics.push_back({"transfer_momentum", momentum, "-",
                     "largest change of the velocity's integral in a remesh, by its L2 norm and the root of the area"});
}

void add_pile(std::vector<Metric>& metrics, const basin::Basin& basin, const Records& records) {
  const auto deepest = std::ranges::max_element(records, {}, [](const FlowRecord& r) { return r.pile_depth; });
  const basin::BasinPileSpec& pile = *basin.spec.pile;
  metrics.push_back({"deepest", deepest->pile_depth, "m", "largest depth of the tip below the rest level in a record"});
  metrics.push_back({"small_angles_at_deepest", deepest->small_angles, "-",
                     "share of triangles with an angle below 30 degrees at the deepest record"});
  metrics.push_back({"below_half_at_deepest", deepest->below_half, "-", "share of triangles with q < 0.5 there"});
  if (!basin.spec.surface) return;
  metrics.push_back({"rise_at_deepest", deepest->rise, "m", "mean rise of the surface at the deepest record"});
  metrics.push_back({"displaced_rise",
                     2 * pile.radius * (deepest->pile_depth - pile.start) / (basin.spec.width - 2 * pile.radius), "m",
                     "rise that the pile's stroke displaces"});
}

/// How the wave's oscillation compares with the exact one of a small wave.
void add_wave(std::vector<Metric>& metrics, const basin::Basin& basin, const Records& records) {
  const basin::BasinSpec& spec = basin.spec;
  const auto& cosine = std::get<basin::CosineSurface>(spec.surface->initial);
  const auto mode = basin::slowest_mode({.wavenumber = static_cast<double>(cosine.mode) * std::numbers::pi / spec.width,
                                         .depth = spec.depth,
                                         .gravity = spec.gravity,
                                         .tension = spec.surface->tension,
                                         .density = spec.density,
                                         .viscosity = spec.viscosity,
                                         .bottom = spec.bottom});
  if (!mode) return;
  metrics.push_back({"exact_frequency", mode->frequency, "rad/s", "frequency of the exact small wave"});
  metrics.push_back({"exact_decay_rate", mode->decay_rate, "1/s", "decay rate of the exact small wave"});
  const auto [begin, end] = basin::window_of(*mode);
  std::vector<double> time, amplitude;
  for (const FlowRecord& r : records)
    if (r.time >= begin && r.time <= end) {
      time.push_back(r.time);
      amplitude.push_back(r.wave);
    }
  const auto found = basin::fitted(time, amplitude);
  if (!found) return;
  metrics.push_back({"fitted_periods", (time.back() - time.front()) * found->frequency / (2 * std::numbers::pi), "-",
                     "periods that were fitted, of ten or those of two e-foldings"});
  metrics.push_back({"frequency", found->frequency, "rad/s", "frequency of the wave, fitted"});
  metrics.push_back({"decay_rate", found->decay_rate, "1/s", "decay rate of the wave, fitted"});
  metrics.push_back(
      {"frequency_error", found->frequency / mode->frequency - 1, "-", "frequency over the exact one, less 1"});
  if (mode->decay_rate > 0)
    metrics.push_back(
        {"decay_error", found->decay_rate / mode->decay_rate - 1, "-", "decay rate over the exact one, less 1"});
}

}  // namespace

std::vector<Metric> metrics_of(const basin::Basin& basin, const Records& records) {
  const double steps = static_cast<double>(std::max<std::int64_t>(basin.clock.step, 1));
  std::vector<Metric> metrics{
      {"reached", basin::time_of(basin), "s", "time of the last good state"},
      {"steps", static_cast<double>(basin.clock.step), "-", "steps done"},
      {"iterations_per_step", static_cast<double>(basin.iterations) / steps, "-", "corrections of a step, mean"},
      {"refactorisations", static_cast<double>(basin.solver.refactorisations), "-", "factors made"},
      {"vertices", static_cast<double>(basin.flow.mesh.vertices()), "-", "vertices of the last mesh"},
      {"triangles", static_cast<double>(basin.flow.mesh.triangles()), "-", "triangles of the last mesh"}};
  if (records.empty()) return metrics;
  if (basin.spec.surface) {
    metrics.push_back({"volume_drift", largest(records, [](const FlowRecord& r) { return std::abs(r.volume_error); }),
                       "-", "largest change of the water's volume in a record, relative"});
    metrics.push_back({"highest", largest(records, [](const FlowRecord& r) { return r.highest; }), "m",
                       "highest point of the surface above the rest level in a record"});
    metrics.push_back({"largest_asymmetry", largest(records, [](const FlowRecord& r) { return r.asymmetry; }), "m",
                       "largest difference of heights that should be mirror images in a record"});
  }
  if (basin.spec.surface && std::holds_alternative<basin::CosineSurface>(basin.spec.surface->initial))
    add_wave(metrics, basin, records);
  if (basin.spec.pile) add_pile(metrics, basin, records);
  add_quality(metrics, basin, records);
  return metrics;
}

}  // namespace seapile::simulation
