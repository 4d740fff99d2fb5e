#include "runner/present/run_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runner/present/table.h"
#include "solver/scene/warnings.h"

namespace seapile::present {
namespace {

using nlohmann::ordered_json;

/// "pile.tip.conical.apex_angle  1.047", for every value of the scene.
void add_values(std::string& text, const ordered_json& value, const std::string& path) {
  if (!value.is_object()) {
    text += fmt::format("  {:<44} {}\n", path, value.dump());
    return;
  }
  if (value.empty()) text += fmt::format("  {}\n", path);
  for (const auto& [key, inner] : value.items()) add_values(text, inner, path.empty() ? key : path + "." + key);
}

std::string outcome_line(const simulation::RunResult& result, bool drive) {
  const char* outcome = result.outcome == simulation::Outcome::completed  ? "completed"
                        : result.outcome == simulation::Outcome::diverged ? "diverged"
                                                                          : "stopped";
  std::string line = fmt::format("{} at t = {:.6g} s", outcome, result.time);
  if (drive) line += fmt::format(", d = {:.6g} m", result.depth);
  return result.reason.empty() ? line : line + ": " + result.reason;
}

std::string indented(const store::Table& table) {
  std::string result;
  for (std::size_t at = 0; const char c : text(table, Format::table)) {
    if (at++ == 0) result += "  ";
    result += c;
    if (c == '\n') at = 0;
  }
  return result;
}

std::string metrics_text(const simulation::RunResult& result) {
  std::string text;
  for (const simulation::Metric& metric : result.metrics) {
    text += fmt::format("  {:<28} {:>12.6g} {:<5} {}\n", metric.name, metric.value, metric.unit, metric.meaning);
  }
  return text;
}

std::string provenance_text(const store::Provenance& made) {
  std::string text;
  const auto line = [&](const char* what, const std::string& value) {
    if (!value.empty()) text += fmt::format("  {:<14} {}\n", what, value);
  };
  line("seapile", fmt::format("{} commit {}{}", made.version, made.commit, made.dirty ? " with changes" : ""));
  line("compiler", made.compiler);
  line("flags", fmt::format("{} ({})", made.flags, made.build_type));
  line("libraries", made.libraries);
  line("processor",
       fmt::format("{}, {} cores, {} threads used, {}", made.host_cpu, made.cores, made.threads, made.simd));
  line("cost",
       fmt::format("{:.2f} CPU s, {:.2f} s, {:.0f} MB", made.cpu_seconds, made.wall_seconds, made.peak_memory_mb));
  line("attempts", fmt::format("{}", made.attempts));
  return text;
}

/// The lines that `lines_of` a scene says, each once, with how many of the scenes it is said of.
std::vector<std::string> each_once(const std::vector<scene::SceneSpec>& scenes, auto&& lines_of) {
  std::vector<std::string> lines;
  std::vector<std::size_t> cases;
  for (const scene::SceneSpec& scene : scenes)
    for (const std::string& line : lines_of(scene)) {
      const auto known = std::ranges::find(lines, line);
      if (known == lines.end()) {
        lines.push_back(line);
        cases.push_back(1);
      } else {
        ++cases[static_cast<std::size_t>(known - lines.begin())];
      }
    }
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (cases[i] < scenes.size()) lines[i] = fmt::format("{} ({} of {} cases)", lines[i], cases[i], scenes.size());
  return lines;
}

}  // namespace

std::string run_text(const store::Manifest& manifest, const std::filesystem::path& run_folder,
                     const std::string& command) {
  const store::RunHeader& header = manifest.header;
  const bool drive = header.kind == "drive";
  std::string text;
  const auto line = [&](const char* what, const std::string& value) { text += fmt::format("{:<12}{}\n", what, value); };
  line("case", header.case_id);
  line("run", fmt::format("{} in {}", manifest.run, run_folder.string()));
  line("kind", header.kind);
  line("outcome", outcome_line(manifest.result, drive));
  line("state hash", fmt::format("{:016x}", manifest.result.state_hash));
  if (drive) line("bed", fmt::format("{} run {}", header.bed_id, header.bed_run));
  line("again with", command);

  text += "\nparts\n";
  for (const scene::Decision& part : header.parts) text += "  " + part_line(part) + "\n";
  text += "\nmetrics\n" + metrics_text(manifest.result);
  text += "\nparameters (SI)\n";
  add_values(text, ordered_json::parse(header.scene_json), "");
  if (!header.record_json.empty()) add_values(text, ordered_json::parse(header.record_json), "record");

  store::Table files{{"file", "bytes", "sha256"}, {"", "", ""}, {}};
  for (const store::FileEntry& file : manifest.files) {
    files.rows.push_back({file.path, fmt::format("{}", file.bytes), file.sha256});
  }
  text += "\nfiles\n" + indented(files);
  for (const std::string& path : manifest.dropped) text += fmt::format("  {} was dropped to save space\n", path);
  text += "\ntime went into\n";
  for (const simulation::ProfileEntry& entry : manifest.result.profile) {
    text += fmt::format("  {:<28} {:>10.3f} s {:>12} calls\n", entry.part, entry.seconds, entry.calls);
  }
  text += "\nnumerics\n";
  for (const auto& [module, version] : header.numerics) text += fmt::format("  {:<14} {}\n", module, version);
  return text + "\nmade with\n" + provenance_text(manifest.provenance);
}

std::string part_line(const scene::Decision& part) {
  std::string line = fmt::format("{:<15} {:<9} {}", part.name, part.built ? "built" : "left out", part.reason);
  if (part.criterion && part.criterion->bound < 1)
    line += fmt::format("; without it: at most {:.2g} of {}", part.criterion->bound, part.criterion->answer);
  return line;
}

std::vector<std::string> decision_lines(const std::vector<scene::SceneSpec>& scenes) {
  return each_once(scenes, [](const scene::SceneSpec& scene) {
    std::vector<std::string> lines;
    for (const scene::Decision& part : scene::decisions(scene))
      if (part.criterion || part.by == scene::By::asked) lines.push_back(part_line(part));
    return lines;
  });
}

std::vector<std::string> warning_lines(const std::vector<scene::SceneSpec>& scenes) {
  return each_once(scenes, scene::warnings);
}

std::string study_text(const store::Manifest& manifest) {
  const store::RunHeader& header = manifest.header;
  ordered_json study = {{"study", "case_" + header.case_id.substr(0, 10)},
                        {"question", "One case once more: " + header.case_id.substr(0, 10) + "."},
                        {"base", ordered_json::parse(header.scene_json)}};
  if (!header.record_json.empty()) study["record"] = ordered_json::parse(header.record_json);
  return study.dump(2) + "\n";
}

}  // namespace seapile::present
