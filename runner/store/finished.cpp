#include "runner/store/finished.h"

#include <algorithm>

#include "runner/store/catalogue.h"
#include "runner/store/durable.h"
#include "runner/store/layout.h"

namespace seapile::store {

const simulation::Metric* FinishedCase::metric(const std::string& name) const {
  const bool of_bed = name.starts_with(kOfBed);
  const auto& metrics = of_bed ? bed_metrics : manifest.result.metrics;
  const auto found = std::ranges::find(metrics, of_bed ? name.substr(kOfBed.size()) : name, &simulation::Metric::name);
  return found == metrics.end() ? nullptr : &*found;
}

std::vector<std::string> FinishedCase::metric_names() const {
  std::vector<std::string> names;
  for (const simulation::Metric& metric : manifest.result.metrics) names.push_back(metric.name);
  for (const simulation::Metric& metric : bed_metrics) names.push_back(std::string(kOfBed) + metric.name);
  return names;
}

bool means(const std::string& name, const std::string& metric) {
  return name.ends_with('*') ? metric.starts_with(std::string_view(name).substr(0, name.size() - 1)) : metric == name;
}

std::optional<FinishedCase> read_finished(const std::filesystem::path& root, const std::string& case_id,
                                          bool with_bed) {
  const std::filesystem::path run = newest_run(root, case_id);
  if (run.empty()) return {};
  FinishedCase finished{read_manifest(run), {}};
  if (finished.manifest.result.outcome != simulation::Outcome::completed) return {};
  const RunHeader& header = finished.manifest.header;
  if (with_bed && !header.bed_id.empty()) {
    const std::filesystem::path bed = bed_run_folder(root, header);
    if (is_there(bed / kManifestFile)) finished.bed_metrics = read_manifest(bed).result.metrics;
  }
  return finished;
}

}  // namespace seapile::store
