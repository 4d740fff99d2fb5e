#include "runner/present/report_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "runner/present/replicates.h"

namespace seapile::present {
namespace {

using store::Cell;
using store::Table;

constexpr std::size_t kShownDigits = 10;  // of a case id

/// What tells how steady a run was, in the order of the columns.
constexpr std::string_view kMonitors[] = {"steps",        "steps_rejected", "step_smallest", "overlap_max",
                                          "residual_max", "energy_error",   "volume_drift",  "mass_defect",
                                          "surface_leak", "lowest_shape",   "meshes",        "iterations_per_step"};

const simulation::Metric* metric_of(const ReportRun& run, std::string_view name) {
  const auto& metrics = run.manifest.result.metrics;
  const auto found = std::ranges::find(metrics, name, &simulation::Metric::name);
  return found == metrics.end() ? nullptr : &*found;
}

std::string short_id(const std::string& id) { return id.substr(0, kShownDigits); }

/// "case", the labels, and room for further cells.
Table head_of(const std::vector<ReportRun>& runs) {
  std::vector<Labels> labels;
  for (const ReportRun& run : runs) labels.push_back(run.labels);
  Table table = label_table(labels);
  table.columns.insert(table.columns.begin(), "case");
  table.units.insert(table.units.begin(), "");
  for (std::size_t i = 0; i < runs.size(); ++i)
    table.rows[i].insert(table.rows[i].begin(), short_id(runs[i].manifest.header.case_id));
  return table;
}

void add_column(Table& table, const std::vector<ReportRun>& runs, std::string_view name, std::string_view unit,
                const std::function<Cell(const ReportRun&)>& cell) {
  table.columns.emplace_back(name);
  table.units.emplace_back(unit);
  for (std::size_t i = 0; i < runs.size(); ++i) table.rows[i].push_back(cell(runs[i]));
}

double cpu_of(const std::vector<ReportRun>& runs) {
  double total = 0;
  for (const ReportRun& run : runs) total += run.manifest.provenance.cpu_seconds;
  return total;
}

std::string value_text(const store::Parameter& parameter) {
  if (parameter.number) return fmt::format("{}", *parameter.number);
  return parameter.text ? (parameter.text->empty() ? "\"\"" : *parameter.text) : "none";
}

std::string unit_of(const std::string& path) {
  const auto found = store::parameter_units().find(path);
  return found == store::parameter_units().end() || found->second == "-" ? "" : found->second;
}

const store::Parameter* find(const ReportScene& scene, const std::string& path) {
  const auto found = std::ranges::find(scene.parameters, path, &store::Parameter::path);
  return found == scene.parameters.end() ? nullptr : &*found;
}

/// A path that some cases have.
struct Path {
  std::string name;
  const store::Parameter* first = nullptr;
  std::size_t cases = 0;  ///< that have it
  bool same = true;       ///< in all of these
};

/// In the order of first occurrence.
std::vector<Path> paths_of(const std::vector<ReportScene>& scenes) {
  std::vector<Path> paths;
  std::map<std::string, std::size_t> places;
  for (const ReportScene& scene : scenes) {
    for (const store::Parameter& one : scene.parameters) {
      const auto [place, is_new] = places.try_emplace(one.path, paths.size());
      if (is_new) paths.push_back({one.path, &one});
      Path& path = paths[place->second];
      ++path.cases;
      path.same &= *path.first == one;
    }
  }
  return paths;
}

std::string numerics_of(const store::RunHeader& header) {
  std::string text;
  for (const auto& [module, version] : header.numerics)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", module, version);
  return text;
}

using Facts = std::vector<std::pair<std::string, std::string>>;

Facts facts_of(const ReportRun& run) {
  const store::Provenance& made = run.manifest.provenance;
  return {{"seapile", made.version},
          {"commit", made.commit},
          {"changes beside the commit", made.dirty ? "yes" : "no"},
          {"compiler", made.compiler},
          {"flags", made.flags},
          {"build type", made.build_type},
          {"libraries", made.libraries},
          {"processor", made.host_cpu},
          {"instruction set", made.simd},
          {"cores", fmt::format("{}", made.cores)},
          {"threads", fmt::format("{}", made.threads)},
          {"numerics", numerics_of(run.manifest.header)}};
}

}  // namespace

ReportTable cost_table(const std::vector<ReportRun>& runs, const std::vector<ReportRun>& beds) {
  ReportTable cost{"Cost and stability of each run", head_of(runs)};
  Table& table = cost.table;
  add_column(table, runs, "state", "", [](const ReportRun& run) { return Cell{run.state}; });
  const auto add = [&](const char* name, const char* unit, double store::Provenance::*member) {
    add_column(table, runs, name, unit, [&](const ReportRun& run) { return Cell{run.manifest.provenance.*member}; });
  };
  add("CPU", "s", &store::Provenance::cpu_seconds);
  add("wall", "s", &store::Provenance::wall_seconds);
  add("memory", "MB", &store::Provenance::peak_memory_mb);
  for (const std::string_view name : kMonitors) {
    const auto first =
        std::ranges::find_if(runs, [&](const ReportRun& run) { return metric_of(run, name) != nullptr; });
    if (first == runs.end()) continue;
    const simulation::Metric& known = *metric_of(*first, name);
    add_column(table, runs, name, known.unit == "-" ? "" : known.unit, [&](const ReportRun& run) {
      const simulation::Metric* metric = metric_of(run, name);
      return metric ? Cell{metric->value} : Cell{};
    });
    cost.notes.push_back(fmt::format("{}: {}.", name, known.meaning));
  }
  cost.notes.insert(cost.notes.begin(),
                    fmt::format("{} run{} took {:.4g} CPU s{}.", runs.size(), runs.size() == 1 ? "" : "s", cpu_of(runs),
                                beds.empty() ? ""
                                             : fmt::format(", and {} bed{} below them {:.4g} CPU s", beds.size(),
                                                           beds.size() == 1 ? "" : "s", cpu_of(beds))));
  return cost;
}

ReportBars cost_bars(const std::vector<ReportRun>& runs) {
  ReportBars bars{"CPU time of each run", {"CPU time", "s"}, {}, {}};
  for (const ReportRun& run : runs) {
    std::string label = legend_text(run.labels);
    for (const auto& [path, value] : run.labels) {
      if (path == kSeed) label += fmt::format("{}seed {}", label.empty() ? "" : ", ", value);
    }
    bars.labels.push_back(label.empty() ? short_id(run.manifest.header.case_id) : label);
    bars.values.push_back(run.manifest.provenance.cpu_seconds);
  }
  return bars;
}

ReportTable common_parameters(const std::vector<ReportScene>& scenes) {
  ReportTable common{"What all cases share, as far as they have it",
                     {{"parameter", "value", "unit", "cases"}, {"", "", "", ""}, {}}};
  for (const Path& path : paths_of(scenes)) {
    if (!path.same) continue;
    common.table.rows.push_back(
        {path.name, value_text(*path.first), unit_of(path.name),
         path.cases == scenes.size() ? "all" : fmt::format("{} of {}", path.cases, scenes.size())});
  }
  return common;
}

ReportTable differing_parameters(const std::vector<ReportScene>& scenes) {
  ReportTable apart{"What sets the cases apart", {{"case"}, {""}, {}}};
  for (const ReportScene& scene : scenes) apart.table.rows.push_back({short_id(scene.case_id)});
  for (const Path& path : paths_of(scenes)) {
    // A part that only some cases have: its name tells who lacks it, its members stand in the other table.
    const bool is_absence = !path.first->number && !path.first->text && path.cases < scenes.size();
    if (path.same && !is_absence) continue;
    apart.table.columns.push_back(path.name);
    apart.table.units.push_back(unit_of(path.name));
    for (std::size_t i = 0; i < scenes.size(); ++i) {
      const store::Parameter* one = find(scenes[i], path.name);
      const Cell words = one ? Cell{value_text(*one)} : path.same ? Cell{"there"} : Cell{};
      apart.table.rows[i].push_back(one && one->number ? Cell{*one->number} : words);
    }
  }
  return apart;
}

ReportTable provenance_table(const std::vector<ReportRun>& runs) {
  std::vector<std::pair<Facts, std::size_t>> ways;
  for (const ReportRun& run : runs) {
    Facts facts = facts_of(run);
    const auto known = std::ranges::find(ways, facts, &std::pair<Facts, std::size_t>::first);
    if (known == ways.end()) {
      ways.emplace_back(std::move(facts), 1);
    } else {
      ++known->second;
    }
  }
  ReportTable made{"How the runs and their beds were made", {{""}, {""}, {}}};
  for (const auto& [facts, count] : ways) {
    made.table.columns.push_back(fmt::format("{} run{}", count, count == 1 ? "" : "s"));
    made.table.units.emplace_back();
    for (std::size_t i = 0; i < facts.size(); ++i) {
      if (made.table.rows.size() == i) made.table.rows.push_back({facts[i].first});
      made.table.rows[i].push_back(facts[i].second);
    }
  }
  return made;
}

ReportTable seal_table(const std::vector<ReportRun>& runs) {
  ReportTable seals{"Seals of the runs' manifests",
                    {{"case", "run", "kind", "state hash", "seal"}, {"", "", "", "", ""}, {}}};
  for (const ReportRun& run : runs) {
    const store::Manifest& manifest = run.manifest;
    seals.table.rows.push_back({manifest.header.case_id, manifest.run, manifest.header.kind,
                                fmt::format("{:016x}", manifest.result.state_hash), manifest.seal});
  }
  seals.notes.push_back("`runner verify` compares every sealed file with the manifest that its seal is of.");
  return seals;
}

}  // namespace seapile::present
