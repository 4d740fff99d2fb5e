#include "runner/execute/repetition.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "runner/store/build_values.h"
#include "runner/study/grain_file.h"
#include "solver/scene/validate.h"

namespace seapile::execute {
namespace {

/// The bed takes from its file what a study would have it take; the height of the highest grain [m].
double take_grains(scene::BedSpec& bed, const std::filesystem::path& grains, base::Problems& problems) {
  const std::string content = bed.file_content;
  const study::GrainFile file =
      study::find_grains(grains.parent_path(), grains.filename().string(), bed.domain, problems);
  if (problems.empty() && file.content != content)
    problems.push_back({"", "holds other grains than its name says", "", ""});
  for (base::Problem& problem : problems) problem.pointer = "/scene/bed/file";
  bed.file = file.path.string();
  bed.grains.count = file.count;
  bed.grains.radius = {file.smallest, file.largest};
  return file.top;
}

/// What a study with this one case would be refused for. A frame that the case does not reach may be there for others.
base::Problems problems_of(const scene::SceneSpec& scene, const scene::RecordSpec& record,
                           std::optional<double> bed_height) {
  base::Problems problems = scene::validate(scene, bed_height);
  for (base::Problem& problem : problems) problem.pointer = "/scene" + problem.pointer;
  if (!is_recorded(scene)) return problems;
  for (base::Problem& problem : scene::validate(record, scene)) {
    if (problem.pointer.starts_with("/frames/") || problem.pointer.starts_with("/times/")) continue;
    problem.pointer = "/record" + problem.pointer;
    problems.push_back(std::move(problem));
  }
  return problems;
}

}  // namespace

study::Study repetition_of(const store::Manifest& manifest, const std::filesystem::path& grains,
                           const std::string& where) {
  const store::RunHeader& header = manifest.header;
  study::Study study;
  scene::SceneSpec scene;
  try {
    scene = study::scene_from_json(header.scene_json);
    if (!header.record_json.empty()) study.record = study::record_from_json(header.record_json);
  } catch (study::BadInput& error) {
    for (base::Problem& problem : error.problems) problem.pointer = "/" + error.file + problem.pointer;
    throw study::BadInput(where, std::move(error.problems));
  }
  base::Problems problems;
  std::optional<double> bed_height;
  if (scene.bed.file.empty() != grains.empty()) {
    problems.push_back(
        {"/scene/bed/file", grains.empty() ? "is not in the bundle" : "is none, but the bundle has one", "", ""});
  } else if (!grains.empty()) {
    bed_height = take_grains(scene.bed, grains, problems);
  }
  if (problems.empty()) problems = problems_of(scene, study.record, bed_height);
  if (problems.empty()) {
    study.cases.push_back(study::case_of(scene));
    if (study.cases.front().id != header.case_id)
      problems.push_back({"/case", "is not the id of its scene", study.cases.front().id, ""});
    const std::string& bed = study.cases.front().bed_id;
    if (!header.bed_id.empty() && bed != header.bed_id)
      problems.push_back({"/bed/case", "is not the id of the scene's bed", bed, ""});
  }
  if (!problems.empty()) throw study::BadInput(where, std::move(problems));
  study.name = "case_" + header.case_id.substr(0, 10);
  study.question = fmt::format("One case once more: {}.", header.case_id.substr(0, 10));
  study.file_sha256 = manifest.seal;
  return study;
}

std::vector<std::string> differences(const store::Provenance& a, const store::Provenance& b) {
  std::vector<std::string> names;
  const auto of_a = store::build_values(a), of_b = store::build_values(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) {
    if (of_a[i].second != of_b[i].second) names.push_back(of_a[i].first);
  }
  if (a.host_cpu != b.host_cpu) names.emplace_back("processor");
  return names;
}

std::string why_no_repetition(const store::Manifest& run, const store::Manifest& bundled,
                              const store::Provenance& today) {
  if (run.seal == bundled.seal) return "it is the bundled run itself";
  if (const auto names = differences(run.provenance, today); !names.empty())
    return fmt::format("it was made otherwise ({})", fmt::join(names, ", "));
  if (today.dirty) return "it was made by a program with changes that no commit names";
  if (today.commit == "unknown") return "it was made by a program of which no commit is known";
  return "";
}

}  // namespace seapile::execute
