#include "solver/simulation/water_metrics.h"

#include <algorithm>
#include <cmath>

#include "solver/simulation/headline.h"

namespace seapile::simulation {
namespace {

/// Mean over the records' time of a column, where it is a number and the depth lies in the headline's range; NaN where
/// there is none.
double mean_of(std::span<const Record> records, std::span<const FlowRecord> flow, double FlowRecord::*column) {
  double sum = 0, time = 0;
  for (std::size_t k = 0; k < flow.size(); ++k) {
    const double value = flow[k].*column;
    if (!is_in_headline(records[k]) || !std::isfinite(value)) continue;
    sum += records[k].span * value;
    time += records[k].span;
  }
  return time > 0 ? sum / time : FlowRecord::kAbsent;
}

/// Standard deviation of a column about its mean, over the same records.
double deviation_of(std::span<const Record> records, std::span<const FlowRecord> flow, double FlowRecord::*column) {
  const double mean = mean_of(records, flow, column);
  double sum = 0, time = 0;
  for (std::size_t k = 0; k < flow.size(); ++k) {
    const double value = flow[k].*column;
    if (!is_in_headline(records[k]) || !std::isfinite(value)) continue;
    sum += records[k].span * (value - mean) * (value - mean);
    time += records[k].span;
  }
  return time > 0 ? std::sqrt(sum / time) : FlowRecord::kAbsent;
}

/// The largest |value| of a column.
double largest(std::span<const FlowRecord> flow, double FlowRecord::*column) {
  double most = 0;
  for (const FlowRecord& r : flow)
    if (std::isfinite(r.*column)) most = std::max(most, std::abs(r.*column));
  return most;
}

double smallest(std::span<const FlowRecord> flow, double FlowRecord::*column) {
  double least = FlowRecord::kAbsent;
  for (const FlowRecord& r : flow)
    if (std::isfinite(r.*column)) least = std::fmin(least, r.*column);
  return least;
}

}  // namespace

std::vector<Metric> water_metrics(std::span<const Record> records, std::span<const FlowRecord> flow,
                                  const Water& water) {
  std::vector<Metric> metrics;
  const auto add = [&](const char* name, double value, const char* unit, const char* meaning) {
    if (std::isfinite(value)) metrics.push_back({name, value, unit, meaning});
  };
  const auto mean = [&](double FlowRecord::*column) { return mean_of(records, flow, column); };
  add("fluid_tip_force_mean", mean(&FlowRecord::tip_force_y), "N/m", "mean force of the fluid on the tip, 0.2-1.2 m");
  add("fluid_sleeve_force_mean", mean(&FlowRecord::sleeve_force_y), "N/m",
      "mean force of the fluid on the sleeve, 0.2-1.2 m");
  add("face_pressure_mean", mean(&FlowRecord::face_pressure), "Pa", "mean excess pore pressure u1, 0.2-1.2 m");
  add("face_pressure_fluctuation", deviation_of(records, flow, &FlowRecord::face_pressure), "Pa",
      "standard deviation of the records' u1, 0.2-1.2 m");
  add("shoulder_pressure_mean", mean(&FlowRecord::shoulder_pressure), "Pa", "mean excess pore pressure u2, 0.2-1.2 m");
  add("sleeve_pressure_mean", mean(&FlowRecord::sleeve_pressure), "Pa", "mean excess pore pressure u3, 0.2-1.2 m");
  add("grain_force_mean", mean(&FlowRecord::grain_force_y), "N/m",
      "mean force of the fluid on all grains without buoyancy, 0.2-1.2 m");
  add("lowest_porosity", smallest(flow, &FlowRecord::lowest_porosity), "-", "smallest porosity before it is cut off");
  add("clipped_volume_max", largest(flow, &FlowRecord::clipped_volume), "m2", "largest area that it is cut off by");
  if (water.basin.spec.surface)  // below an open top water flows in and out
    add("volume_error_max", largest(flow, &FlowRecord::volume_error), "-", "largest change of the mixture's volume");
  add("element_ratio_min", smallest(flow, &FlowRecord::element_ratio), "-",
      "shortest edge of the mesh over the largest diameter of a grain");
  add("lowest_shape", smallest(flow, &FlowRecord::lowest_shape), "-", "smallest shape quality at a record");
  add("cfl_max", largest(flow, &FlowRecord::cfl), "-",
      "largest |v - w| dt/h at a record, h a triangle's shortest edge");
  add("vertices_min", smallest(flow, &FlowRecord::vertices), "-", "fewest vertices of the mesh at a record");
  add("vertices_max", largest(flow, &FlowRecord::vertices), "-", "most vertices of the mesh at a record");
  if (!flow.empty()) {
    add("meshes", flow.back().meshes, "-", "meshes made, the first one included");
    add("vertices", flow.back().vertices, "-", "vertices of the last mesh");
    add("rise", flow.back().rise, "m", "mean height of the surface above the rest level at the end");
  }
  add("grain_steps", water.grain_steps, "-", "steps of the grains in a step of the fluid");
  add("corrections", static_cast<double>(water.basin.iterations), "-", "corrections of the flow's equations");
  add("factorisations", static_cast<double>(water.basin.solver.refactorisations), "-",
      "factorisations of their matrix");
  return metrics;
}

double energy_error(std::span<const Record> records, std::span<const FlowRecord> flow) {
  const Record &first = records.front(), &last = records.back();
  const double pushed = flow.empty() ? 0 : flow.back().grain_work - flow.front().grain_work;
  return (last.kinetic_energy + last.potential_energy - first.kinetic_energy - first.potential_energy -
          (last.pile_work - first.pile_work) - pushed + (last.dissipation - first.dissipation)) /
         std::max(std::abs(last.pile_work), 1e-12);
}

}  // namespace seapile::simulation
