#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/present/advice.h"
#include "runner/present/work.h"
#include "runner/study/measured_file.h"
#include "runner/study/resolved.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using study::Study;

struct AdviseArguments {
  std::string study, tolerance;
  std::vector<std::string> by;
  study::Options options;
};

/// What a tolerance may be called beside the metric's own name.
const std::map<std::string, std::string> kShort = {
    {"qc", "tip_resistance_mean"}, {"chi", "swell_ratio"}, {"frequency", "frequency_error"}, {"decay", "decay_error"}};

struct Asked {
  std::string metric;
  double tolerance = 0;  ///< relative
};

/// "qc=5%".
Asked asked(const std::string& text) {
  const auto equals = text.find('=');
  const auto refuse = [&](const std::string& why) {
    return UsageError(fmt::format("--tol: {}; allowed: METRIC=SHARE, as in qc=5%", why));
  };
  if (equals == std::string::npos || equals == 0) throw refuse(fmt::format("\"{}\" has no name and value", text));
  const std::string name = text.substr(0, equals);
  std::string value = text.substr(equals + 1);
  const bool percent = value.ends_with('%');
  if (percent) value.pop_back();
  std::size_t end = 0;
  double share = std::nan("");
  try {
    share = std::stod(value, &end);
  } catch (const std::logic_error&) {
  }
  if (!(share > 0) || value.find_first_not_of(' ', end) != std::string::npos)
    throw refuse(fmt::format("\"{}\" is no positive share", text.substr(equals + 1)));
  const auto known = kShort.find(name);
  return {known == kShort.end() ? name : known->second, percent ? share / 100 : share};
}

/// Scenes whose levels mean the same.
std::string class_of(const scene::SceneSpec& scene) {
  if (scene.jet) return "jet";
  if (scene.basin) return scene.basin->pile ? "basin with a pile" : "wave";
  if (!scene.pile) return "bed";
  return std::string(present::is_fast(scene) ? "fast " : "") + (scene.fluid ? "saturated drive" : "dry drive");
}

/// Whether a level is another way to compute, and not another scene.
bool is_way_to_compute(const study::VariantText& variant) {
  return std::ranges::none_of(
      variant.set, [](const auto& one) { return one.first.starts_with("bed.") || one.first.starts_with("pile."); });
}

/// Of several scenes of one frontier a level is as good as in the worst of them.
void add(std::vector<present::MeasuredLevel>& levels, const present::MeasuredLevel& level) {
  const auto known = std::ranges::find(levels, level.name, &present::MeasuredLevel::name);
  if (known == levels.end()) {
    levels.push_back(level);
    return;
  }
  known->cpu_seconds = std::max(known->cpu_seconds, level.cpu_seconds);
  known->runs += level.runs;
  known->asked += level.asked;
  if (std::isnan(known->bound) || known->bound >= level.bound) return;  // NaN: nothing is known there
  known->bound = level.bound;
  known->error = level.error;
}

/// A recorded frontier with the study that it is of.
struct Record {
  Study study;
  present::MeasuredFrontier frontier;
};

Record read_record(const fs::path& file, Study study, const std::string& metric) {
  Record record{std::move(study), {}};
  record.frontier.study = record.study.name;
  record.frontier.work = present::work_of(record.study.cases.front().scene);
  const auto number = [](const study::MeasuredRow& row, const std::string& name) {
    const auto found = row.number.find(name);
    return found == row.number.end() ? std::nan("") : found->second;
  };
  const auto count = [&](const study::MeasuredRow& row, const std::string& name) {
    const double value = number(row, name);
    return value > 0 ? static_cast<std::size_t>(value) : 0;
  };
  for (const study::MeasuredRow& row : study::read_measured(study::measured_path(file, record.study.name))) {
    const present::MeasuredLevel level{row.variant,
                                       number(row, "cpu"),
                                       number(row, "error:" + metric + ".mean") / 100,
                                       number(row, "bound:" + metric) / 100,
                                       count(row, "runs"),
                                       count(row, "asked")};
    add(record.frontier.levels, level);
  }
  return record;
}

/// Frontiers with a record, by the study's folder where none is named.
std::vector<fs::path> candidates(const AdviseArguments& arguments) {
  std::vector<fs::path> files(arguments.by.begin(), arguments.by.end());
  if (!files.empty()) return files;
  const fs::path folder = fs::path(arguments.study).parent_path();
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / "measured", none)) {
    const fs::path study = folder / (entry.path().stem().string() + ".json");
    if (entry.path().extension() == ".csv" && fs::exists(study)) files.push_back(study);
  }
  std::ranges::sort(files);
  return files;
}

/// In what a scene differs from the one that was measured, apart from how it is computed.
std::vector<std::string> differences(const scene::SceneSpec& scene, const scene::SceneSpec& measured) {
  const auto one = study::resolve_used(scene), other = study::resolve_used(measured);
  const std::vector<std::string> computing = {"contact.",   "bed.seed",    "bed.preparation", "fluid.time",
                                              "fluid.mesh", "basin.time.", "basin.mesh",      "jet.lip",
                                              "jet.growth", "jet.largest", "jet.method"};
  std::vector<std::string> paths;
  for (const auto& [path, value] : one) {
    const bool counts = std::ranges::none_of(computing, [&](const auto& start) { return path.starts_with(start); });
    const auto found = other.find(path);
    if (counts && (found == other.end() || found->second != value)) paths.push_back(path);
  }
  return paths;
}

std::string level_line(const study::VariantText& variant) {
  std::string line;
  for (const auto& [path, value] : variant.set) line += fmt::format(" --set \"{}={}\"", path, value);
  if (!variant.fidelity.empty()) line += " --fidelity " + variant.fidelity;
  return line;
}

/// Of one class of the study's scenes; false when nothing that was measured holds.
bool tell(const std::string& name, const std::vector<const study::Case*>& cases, const std::vector<Record>& records,
          const Asked& asked, const std::string& file) {
  std::vector<present::MeasuredFrontier> frontiers;
  const Record* first = nullptr;
  for (const Record& record : records) {
    if (class_of(record.study.cases.front().scene) != name) continue;
    if (!std::ranges::any_of(record.frontier.levels, [](const auto& level) { return !std::isnan(level.bound); }))
      continue;
    // The one with the most levels is chosen from; the others check it.
    const bool better = !first || record.frontier.levels.size() > first->frontier.levels.size();
    frontiers.insert(better ? frontiers.begin() : frontiers.end(), record.frontier);
    if (better) first = &record;
  }
  fmt::print("{}, {} case{}: {} within {:g} %\n", name, cases.size(), cases.size() == 1 ? "" : "s", asked.metric,
             100 * asked.tolerance);
  if (!first) {
    fmt::print("  no frontier of such scenes is recorded with this metric: nothing is known\n");
    return false;
  }
  std::vector<bool> may_use;
  for (const present::MeasuredLevel& level : frontiers.front().levels) {
    const auto variant = std::ranges::find(first->study.variants, level.name, &study::VariantText::name);
    may_use.push_back(variant != first->study.variants.end() && is_way_to_compute(*variant));
  }
  double work = 0;
  for (const study::Case* one : cases) work += present::work_of(one->scene);
  const present::Advice advice = present::advise(frontiers, may_use, asked.tolerance, work);
  std::string from;
  for (const present::MeasuredFrontier& one : frontiers) from += (from.empty() ? "" : ", ") + one.study;
  if (!advice.level) {
    fmt::print("  none of those measured holds ({})", from);
    if (advice.closest)
      fmt::print("; the closest, \"{}\", is known within {:.2g} %", frontiers.front().levels[*advice.closest].name,
                 100 * advice.closest_bound);
    fmt::print("\n");
    return false;
  }
  const present::MeasuredLevel& level = frontiers.front().levels[*advice.level];
  const auto variant = std::ranges::find(first->study.variants, level.name, &study::VariantText::name);
  fmt::print("  \"{}\": error {:+.2g} %, at most {:.2g} % (95 %), {} run{} of {}\n", level.name, 100 * level.error,
             100 * advice.bound, level.runs, level.runs == 1 ? "" : "s", fmt::join(advice.measured_in, ", "));
  if (!advice.lacking_in.empty())
    fmt::print("  not measured in {}; of what was measured everywhere none holds\n",
               fmt::join(advice.lacking_in, ", "));
  fmt::print("  about {:.3g} CPU s in all, scaled from {:.3g} CPU s of the scene that was measured\n",
             advice.cpu_seconds, level.cpu_seconds);
  fmt::print("  runner run {}{}\n", file, level_line(*variant));
  std::set<std::string> apart;
  for (const study::Case* one : cases)
    for (std::string& path : differences(one->scene, first->study.cases.front().scene)) apart.insert(std::move(path));
  if (!apart.empty()) fmt::print("  not measured: other values of {}\n", fmt::join(apart, ", "));
  return true;
}

int advise(const AdviseArguments& arguments) {
  const Asked wanted = asked(arguments.tolerance);
  const Study study = study::read(arguments.study, arguments.options);
  std::vector<Record> records;
  for (const fs::path& file : candidates(arguments)) {
    Study one = study::read(file);
    // What a part does is no level of anything.
    if (one.trade && one.trade->kind == study::TradeKind::frontier)
      records.push_back(read_record(file, std::move(one), wanted.metric));
  }
  std::map<std::string, std::vector<const study::Case*>> by_class;
  for (const study::Case& one : study.cases) by_class[class_of(one.scene)].push_back(&one);
  bool all = true;
  for (const auto& [name, cases] : by_class) all = tell(name, cases, records, wanted, arguments.study) && all;
  return all ? execute::kDone : execute::kNothingMatched;
}

}  // namespace

void add_advise(CLI::App& app, Call& call) {
  static AdviseArguments arguments;
  CLI::App* command = app.add_subcommand("advise", "Name the cheapest way to compute that was measured to be as close");
  command->add_option("STUDY", arguments.study, "Study file")->required();
  command->add_option("--tol", arguments.tolerance, "Metric and relative error: qc=5%, frequency=0.1%")
      ->type_name("METRIC=SHARE")
      ->required();
  command->add_option("--by", arguments.by, "Frontier to go by; default: all that are recorded beside the study")
      ->type_name("STUDY");
  add_study_options(*command, arguments.options);
  command->footer("Example:\n  runner advise studies/tip_shape.json --tol qc=5%");
  command->callback([&call] { call = [] { return advise(arguments); }; });
}

}  // namespace seapile::commands
