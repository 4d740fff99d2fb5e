#include "runner/commands/repeat.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <vector>

#include "runner/commands/command.h"
#include "runner/execute/exit_codes.h"
#include "runner/execute/provenance.h"
#include "runner/execute/repetition.h"
#include "runner/execute/tint.h"
#include "runner/present/run_comparison.h"
#include "runner/store/bundle.h"
#include "runner/store/durable.h"
#include "runner/store/manifest.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using present::FinishedRun;
using present::RunComparison;

/// A folder for what a bundle holds, gone at the end.
class Unpacked {
 public:
  Unpacked() : folder_((fs::temp_directory_path() / "seapile-bundle-XXXXXX").string()) {
    if (::mkdtemp(folder_.data()) == nullptr)
      throw store::system_error(store::StoreError::Kind::io, "create the folder", folder_);
  }
  ~Unpacked() {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  Unpacked(const Unpacked&) = delete;
  Unpacked& operator=(const Unpacked&) = delete;

  const std::string& folder() const { return folder_; }

 private:
  std::string folder_;
};

FinishedRun run_in(const fs::path& folder) { return {folder, store::read_manifest(folder)}; }

FinishedRun bed_of(const FinishedRun& run, const fs::path& root) {
  return run_in(store::bed_run_folder(root, run.manifest.header));
}

/// Runs that are there already are taken for a repetition only where this program made them.
void require_repetition(const execute::Plan& plan, const store::Bundle& bundle, const fs::path& root) {
  const store::Provenance today = execute::provenance();
  const auto require = [&](const FinishedRun& run, const store::Manifest& bundled) {
    const auto why = execute::why_no_repetition(run.manifest, bundled, today);
    if (!why.empty())
      throw UsageError(
          fmt::format("{} cannot stand for a repetition: {}; name another store by --store", run.folder.string(), why));
  };
  for (const execute::Task& task : plan.tasks) {
    if (task.decision.action != execute::Action::fresh) continue;
    const FinishedRun run = run_in(store::case_folder(root, task.id) / task.decision.run);
    const bool is_bed = bundle.bed && task.kind == execute::Kind::bed;
    require(run, is_bed ? bundle.bed->manifest : bundle.run.manifest);
    if (bundle.bed && !is_bed) require(bed_of(run, root), bundle.bed->manifest);
  }
}

/// Equal final states and nothing else that says otherwise. A metric that only one program knows is no difference.
bool is_same(const RunComparison& comparison) {
  return !comparison.state_a.empty() && comparison.state_a == comparison.state_b && comparison.largest == 0 &&
         comparison.differ_alone.empty();
}

/// What is known of how the two were made and is not the same: "numerics of grains, compiler, threads".
std::string known_differences(const RunComparison& comparison) {
  std::vector<std::string> names;
  for (const auto& one : comparison.numerics) names.push_back("numerics of " + one.name);
  for (const auto* list : {&comparison.code, &comparison.environment})
    for (const auto& one : *list) names.push_back(one.name == "dirty" ? "uncommitted changes" : one.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string line_of(const std::string& kind, const RunComparison& comparison) {
  const std::string name = fmt::format("{:<5} {}", kind, execute::short_id(comparison.case_a));
  const std::string known = known_differences(comparison);
  if (comparison.state_a != comparison.state_b)
    return fmt::format("{}  different: final state {} was bundled, {} came out; {}", name, comparison.state_a,
                       comparison.state_b.empty() ? "none" : comparison.state_b, present::verdict(comparison));
  if (!is_same(comparison)) return fmt::format("{}  different: {}", name, present::verdict(comparison));
  return fmt::format("{}  same: final state {}, to the last bit{}", name, comparison.state_a,
                     known.empty() ? "" : fmt::format("; {} differed and changed no bit", known));
}

/// Bundled runs beside repeated ones, the bed first; the exit code.
int judge(const store::Bundle& bundle, const FinishedRun& repeated, const fs::path& root) {
  std::vector<std::pair<std::string, RunComparison>> comparisons;
  if (bundle.bed)
    comparisons.emplace_back("bed",
                             present::compare({bundle.bed->folder, bundle.bed->manifest}, bed_of(repeated, root)));
  comparisons.emplace_back(repeated.manifest.header.kind,
                           present::compare({bundle.run.folder, bundle.run.manifest}, repeated));
  const auto different = [](const auto& one) { return !is_same(one.second); };
  for (const auto& [kind, comparison] : comparisons)
    if (!is_same(comparison))
      fmt::print("{}: A as bundled, B repeated\n{}\n", kind, present::comparison_text(comparison));
  for (const auto& [kind, comparison] : comparisons) fmt::print("{}\n", line_of(kind, comparison));
  std::fflush(stdout);
  const auto first = std::ranges::find_if(comparisons, different);
  if (first == comparisons.end()) return execute::kDone;
  const std::string known = known_differences(first->second);
  const bool on_other_bed = comparisons.size() > 1 && first == comparisons.begin();
  fmt::print(stderr, "FAILED  the repetition is not the bundled run{}; {}\n",
             on_other_bed ? ": the bed is the first to differ, and the drive was built on the repeated one" : "",
             known.empty() ? "nothing known differs of how both were made"
                           : "known to differ of how both were made: " + known);
  return execute::kCheckFailed;
}

/// Throws UsageError, also where what was bundled cannot be compared with itself, nor then with a repetition.
store::Bundle unpack(const std::string& file, const std::string& folder) {
  try {
    store::Bundle bundle = usage_checked([&] { return store::read_bundle(file, folder); });
    const auto read = [](const store::BundledRun& run) {
      return present::compare({run.folder, run.manifest}, {run.folder, run.manifest});
    };
    if (read(bundle.run).state_a.empty() || (bundle.bed && read(*bundle.bed).state_a.empty()))
      throw UsageError(file + ": it holds no final state to compare");
    return bundle;
  } catch (const store::StoreError& error) {
    throw UsageError(store::said_of_bundle(error.what(), file, folder));
  }
}

/// A store of its own has the grains too, so that its runs can be repeated and bundled again.
void keep_grains(const fs::path& from, const fs::path& to) {
  if (fs::is_regular_file(to)) return;
  store::make_folder(to.parent_path());
  store::write_text(to, store::read_text(from));
}

}  // namespace

int repeat(const std::string& bundle_file, const execute::CampaignOptions& options, bool dry_run) {
  const fs::path root = options.root;
  const Unpacked unpacked;
  const store::Bundle bundle = unpack(bundle_file, unpacked.folder());
  study::Study study =
      execute::repetition_of(bundle.run.manifest, bundle.grains ? bundle.grains->file : fs::path(), bundle_file);
  const fs::path grains = bundle.grains ? fs::absolute(root / store::grains_path(bundle.grains->content)) : fs::path();
  if (bundle.grains) study.cases.front().scene.bed.file = grains.string();

  execute::Campaign campaign(study, options);
  if (const auto objection = execute::objection(campaign.sharing()); !objection.empty()) throw UsageError(objection);
  require_repetition(campaign.plan(), bundle, root);
  for (const std::string& line : execute::describe(campaign.plan()))
    fmt::print(stderr, "{}\n", execute::tinted(line, stderr));
  if (dry_run) return execute::kDone;
  if (bundle.grains) keep_grains(bundle.grains->file, grains);

  const int code = campaign.carry_out();
  const fs::path folder = campaign.outcomes().front().run_folder;
  // A run that diverged is a result, and so it may be compared with what was bundled.
  if (folder.empty() || (code != execute::kDone && code != execute::kSomeCasesFailed)) return code;
  const FinishedRun repeated = run_in(folder);
  const auto made_otherwise = execute::differences(repeated.manifest.provenance, execute::provenance());
  if (!made_otherwise.empty() || repeated.manifest.seal == bundle.run.manifest.seal) {
    fmt::print(stderr,
               "FAILED  another program has meanwhile put its run in the repetition's place; name another store\n");
    return execute::kCheckFailed;
  }
  return judge(bundle, repeated, root);
}

}  // namespace seapile::commands
