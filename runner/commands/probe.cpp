#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "runner/commands/command.h"
#include "runner/commands/probed.h"
#include "runner/execute/campaign.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/provenance.h"
#include "runner/store/equivalence.h"

namespace seapile::commands {
namespace {

using store::Cell;

struct ProbeArguments {
  std::vector<std::string> studies;
  std::string root = "results";
  double tolerance = 1e-6;
  execute::Sharing sharing;
  present::Format format = present::Format::table;
};

store::Equivalence equivalence_of(const ProbeGroup& group, const ProbeResult& result, double tolerance) {
  const present::RunComparison& comparison = result.comparison;
  const store::Provenance made = execute::provenance();
  const char* likeness = comparison.likeness == present::Likeness::identical  ? "identical"
                         : comparison.likeness == present::Likeness::rounding ? "rounding"
                                                                              : "tolerance";
  return {group.kind,
          group.before,
          group.now,
          comparison.case_a,
          comparison.run_a,
          comparison.state_a,
          comparison.state_b,
          likeness,
          result.largest,
          result.largest_of,
          tolerance,
          fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))),
          made.version,
          made.commit,
          made.dirty,
          "",
          ""};
}

/// One row per group.
store::Table table_of(const std::vector<ProbeGroup>& groups, const std::vector<ProbeResult>& results) {
  store::Table table;
  table.columns = {"kind", "moved", "cases", "probed case", "distance", "of", "verdict", "reason"};
  table.units.resize(table.columns.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const ProbeGroup& group = groups[i];
    const ProbeResult& result = results[i];
    const bool compared = !std::isnan(result.largest);
    table.rows.push_back({group.kind, store::moved_text(group.before, group.now), static_cast<double>(group.cases),
                          group.hindrance.empty() ? Cell{execute::short_id(group.task.id)} : Cell{},
                          compared ? Cell{result.largest} : Cell{},
                          result.largest_of.empty() ? Cell{} : Cell{result.largest_of}, name(result.probed),
                          result.reason});
  }
  return table;
}

int code_of(const std::vector<ProbeResult>& results) {
  const auto any = [&](Probed probed) {
    return std::ranges::find(results, probed, &ProbeResult::probed) != results.end();
  };
  if (any(Probed::failed)) return execute::kSomeCasesFailed;
  return any(Probed::stale) ? execute::kCheckFailed : execute::kDone;
}

/// Whether the catalogue lists what is declared now; if not, says so: the declarations count all the same.
bool is_listed(const std::filesystem::path& root) {
  try {
    store::Catalogue::open(root).refresh_equivalences();
    return true;
  } catch (const store::StoreError& error) {
    fmt::print(stderr, "{}\nThe declarations count all the same; `runner ingest` lists them.\n", error.what());
    return false;
  }
}

int probe(const ProbeArguments& arguments) {
  if (!std::isfinite(arguments.tolerance))
    throw UsageError("--tolerance: is no number; a relative distance from 0 up, such as 1e-9");
  const execute::Sharing sharing = execute::on_this_machine(arguments.sharing);
  if (const auto objection = execute::objection(sharing); !objection.empty()) throw UsageError(objection);
  const std::filesystem::path root = arguments.root;
  const std::vector<ProbeGroup> groups = probe_groups(arguments.studies, root);
  if (groups.empty()) {
    fmt::print(stderr, "nothing is stale by its numerics alone\n");
    return execute::kNothingMatched;
  }
  const auto [results, stopped] = probe(groups, root, sharing, arguments.tolerance);
  std::size_t fresh = 0, stale = 0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const bool equivalent = results[i].probed == Probed::equivalent;
    if (equivalent) store::declare(root, equivalence_of(groups[i], results[i], arguments.tolerance));
    (equivalent ? fresh : stale) += groups[i].cases;
  }
  fmt::print("{}", present::text(table_of(groups, results), arguments.format));
  fmt::print(stderr, "{} case{} equivalent and no longer stale, {} stale as before\n", fresh, fresh == 1 ? "" : "s",
             stale);
  const bool listed = fresh == 0 || is_listed(root);
  if (stopped) return *stopped;
  const int code = code_of(results);
  return code == execute::kDone && !listed ? execute::kStoreUnusable : code;
}

}  // namespace

void add_probe(CLI::App& app, Call& call) {
  static ProbeArguments arguments;
  CLI::App* command =
      app.add_subcommand("probe", "After a change of the numerics: measure whether older results can stand");
  command->add_option("STUDY", arguments.studies, "Study files")->required()->type_name("");
  command
      ->add_option("--tolerance", arguments.tolerance,
                   "Largest relative distance of a metric or curve; 0: identical to the last bit")
      ->capture_default_str()
      ->check(from_up(0))
      ->type_name("TOL");
  add_sharing_options(*command, arguments.sharing);
  add_format_option(*command, arguments.format);
  add_store_option(*command, arguments.root);
  command->footer(
      "Results that are stale by their numerics alone are put into groups of the same kind and the same versions of "
      "all\n"
      "modules, before and now. Of each group the cheapest case is computed again, beside the store, a drive on the "
      "very\n"
      "bed that it had. Where every metric and curve is within the tolerance, the group is declared equivalent in\n"
      "equivalents/ of the store, and its results are fresh; what a declaration says of 1 -> 2 and 2 -> 3 says nothing "
      "of\n"
      "1 -> 3. To withdraw one, remove its file. Exit code 0: all groups are equivalent; 3: one is not; 1: one could "
      "not\n"
      "be probed; 4: nothing is stale by its numerics alone.\n\n"
      "Examples:\n"
      "  runner probe studies/tip_shape.json\n"
      "  runner probe studies/*.json --tolerance 1e-9 -j 2\n"
      "  runner probe studies/chapter_6.json --format json");
  command->callback([&call] { call = [] { return probe(arguments); }; });
}

}  // namespace seapile::commands
