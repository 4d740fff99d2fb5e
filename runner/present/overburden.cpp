#include "runner/present/overburden.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "runner/present/arrays.h"
#include "runner/present/scene_numbers.h"
#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;

double metric(const store::Manifest& bed, const fs::path& folder, const std::string& name) {
  const auto& metrics = bed.result.metrics;
  const auto found = std::ranges::find(metrics, name, &simulation::Metric::name);
  if (found != metrics.end()) return found->value;
  throw store::StoreError(store::StoreError::Kind::damaged, fmt::format("{} has no {}", folder.string(), name));
}

}  // namespace

double effective_stress(const Overburden& ground, double depth) {
  return ground.unit_weight * depth - ground.uplift * std::max(0.0, depth - ground.water_depth);
}

Overburden overburden_of(const fs::path& run_folder, const fs::path& bed_folder) {
  const SceneNumbers scene(run_folder);
  const store::Manifest bed = store::read_manifest(bed_folder);
  const double solid = metric(bed, bed_folder, "solid_fraction"), gravity = scene.at("bed.domain.gravity");
  Overburden ground;
  ground.unit_weight = solid * scene.at("bed.grains.density") * gravity;
  ground.width = 2 * scene.at("pile.radius");
  if (scene.has("fluid.density")) {
    ground.uplift = solid * scene.at("fluid.density") * gravity;
    ground.water_depth = std::max(0.0, metric(bed, bed_folder, "surface") - scene.at("fluid.depth"));
  }
  return ground;
}

double median_diameter(const fs::path& bed_folder) {
  const simulation::Bed bed = store::read_bed(bed_folder);
  std::vector<double> radii = values<double>(bed.grains, "grains/radius");
  std::ranges::sort(radii);
  double area = 0, half = 0;  // In units of pi; discs of one density have masses in proportion to their areas.
  for (const double radius : radii) half += radius * radius / 2;
  for (const double radius : radii) {
    area += radius * radius;
    if (area >= half) return 2 * radius;
  }
  throw store::StoreError(store::StoreError::Kind::damaged, bed_folder.string() + " has no grains");
}

}  // namespace seapile::present
