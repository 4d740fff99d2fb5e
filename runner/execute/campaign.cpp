#include "runner/execute/campaign.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <set>

#include "runner/execute/exit_codes.h"
#include "runner/execute/history.h"
#include "runner/execute/notes.h"
#include "runner/execute/price.h"
#include "runner/execute/processes.h"
#include "runner/execute/progress.h"
#include "runner/execute/provenance.h"
#include "runner/store/catalogue.h"
#include "runner/store/run_folder.h"

namespace seapile::execute {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kShownLogLines = 5;
constexpr double kShareOfMemory = 0.9;  // of what is available, for all cases together

/// Peak memory [MB] of a case's newest run; 0 when that cannot be told.
double memory_of(const fs::path& root, const std::string& case_id) {
  try {
    return store::read_manifest(store::newest_run(root, case_id)).provenance.peak_memory_mb;
  } catch (const store::StoreError&) {
    return 0;
  }
}

}  // namespace

Sharing on_this_machine(Sharing sharing) {
  sharing.cores = usable_cores();
  if (!sharing.memory_mb) sharing.memory_mb = kShareOfMemory * available_memory_mb();
  return sharing;
}

store::StudyEntry entry_of(const study::Study& study) {
  store::StudyEntry entry{study.name, study.question, study.file_sha256, {}};
  for (const study::Case& c : study.cases) entry.cases.emplace_back(c.id, c.labels);
  return entry;
}

std::vector<simulation::NumericsVersion> todays_numerics(const scene::SceneSpec& scene) {
  return simulation::numerics_versions(scene);
}

Equivalences declared_equivalences(const fs::path& root) {
  static std::set<std::string> told;
  store::Equivalences found = store::read_equivalences(root);
  for (const std::string& sentence : found.left_out) {
    if (told.insert(sentence).second) fmt::print(stderr, "{}; it declares nothing\n", sentence);
  }
  return std::move(found.declared);
}

bool are_of_today(const std::vector<simulation::NumericsVersion>& versions, const scene::SceneSpec& scene) {
  return store::same_numerics(versions, todays_numerics(scene));
}

Campaign::Campaign(const study::Study& study, CampaignOptions options)
    : study_(study),
      options_(std::move(options)),
      numerics_(todays_numerics),
      equivalences_(declared_equivalences(options_.root)) {
  options_.sharing = on_this_machine(options_.sharing);
  const Disk disk = [this](const std::string& id) { return read_history(options_.root, id); };
  plan_ = make_plan(study_, numerics_, disk, equivalences_);
}

int Campaign::carry_out() {
  announce();
  Processes processes(kThisProgram, [this](const Task& task) { return request_of(study_, task, options_); });
  {
    Display display(plan_, stderr, ::isatty(STDERR_FILENO) == 1);
    Watch watch = display.watch();
    watch.changed = [this, show = watch.changed](std::size_t task, State state, const std::string& why) {
      if (state == State::completed || state == State::diverged) ingest(plan_.tasks[task].id);
      show(task, state, why);
      if (state == State::failed) note_failure(task, why);
      if (state == State::failed || state == State::diverged) show_log(plan_.tasks[task].id);
    };
    const StoreView store = {[this](const std::string& id) { return read_history(options_.root, id); },
                             [this](const std::string& id) { return is_claimed(options_.root, id); },
                             [this](const std::string& id) { return memory_of(options_.root, id); }, equivalences_};
    const Prices prices = prices_of(study_, plan_, options_.root);
    for (std::size_t i = 0; i < prices.size(); ++i) {
      if (prices[i]) plan_.tasks[i].memory_mb = prices[i]->memory_mb;
    }
    summary_ = execute::carry_out(plan_, study_, numerics_, options_.sharing, processes, store, watch);
  }
  const int code = exit_code(summary_);
  if (ingest_trouble_.empty()) return code;
  fmt::print(stderr, "{}\nThe results are safe in their folders; `runner reindex` lists them again.\n",
             ingest_trouble_);
  return code == kDone ? kStoreUnusable : code;
}

std::vector<CaseOutcome> Campaign::outcomes() const {
  const auto word = [](State state) {
    switch (state) {
      case State::fresh:
      case State::completed:
        return "completed";
      case State::diverged:
        return "diverged";
      case State::failed:
        return "failed";
      case State::blocked:
        return "not run";
      default:
        return "interrupted";
    }
  };
  std::map<std::string, State> states;
  for (std::size_t i = 0; i < plan_.tasks.size(); ++i) states[plan_.tasks[i].id] = summary_.states[i];
  std::vector<CaseOutcome> outcomes;
  for (const study::Case& c : study_.cases) {
    const State state = states.at(c.id);
    CaseOutcome outcome{c.id, c.labels, word(state), {}, {}};
    if (state == State::fresh || state == State::completed || state == State::diverged) {
      outcome.run_folder = store::newest_run(options_.root, c.id);
      if (!c.bed_id.empty()) outcome.bed_folder = store::newest_run(options_.root, c.bed_id);
    }
    outcomes.push_back(std::move(outcome));
  }
  return outcomes;
}

/// Tells the catalogue of the study, and of finished runs that it has missed.
void Campaign::announce() const {
  auto catalogue = store::Catalogue::open(options_.root);
  catalogue.put(entry_of(study_));
  for (const Task& task : plan_.tasks) {
    if (task.decision.action != Action::fresh) continue;
    const fs::path run = store::case_folder(options_.root, task.id) / task.decision.run;
    if (catalogue.find(task.id) != run) catalogue.ingest(run);
  }
}

/// So that `runner status` can tell it later, where the run got as far as a folder.
void Campaign::note_failure(std::size_t task, const std::string& why) const {
  const fs::path run = unfinished_run(options_.root, plan_.tasks[task].id);
  if (!run.empty()) write_failure(run, {"failed", why});
}

/// The last lines that the run itself wrote, below the line that says how it ended.
void Campaign::show_log(const std::string& case_id) const {
  fs::path run;
  try {
    run = unfinished_run(options_.root, case_id);
    if (run.empty()) run = store::newest_run(options_.root, case_id);
  } catch (const store::StoreError&) {  // The case's folder cannot be looked into: that it failed is said already.
  }
  if (run.empty()) return;
  for (const std::string& line : last_log_lines(run, kShownLogLines)) fmt::print(stderr, "           | {}\n", line);
}

void Campaign::ingest(const std::string& case_id) {
  try {
    store::Catalogue::open(options_.root).ingest(store::newest_run(options_.root, case_id));
  } catch (const store::StoreError& error) {
    if (ingest_trouble_.empty()) ingest_trouble_ = error.what();
  }
}

Request request_of(const study::Study& study, const Task& task, const CampaignOptions& options) {
  const study::Case& c = study.cases[task.study_case];
  Request request;
  request.root = fs::absolute(options.root).string();
  request.case_id = task.id;
  request.newest = task.newest;
  request.scene = c.scene;
  request.record = study.record;
  request.checkpoint_every = options.checkpoint_every;
  if (task.kind == Kind::bed) {
    request.kind = "bed";
    request.canonical = c.bed_canonical;
    request.scene = bed_alone(c.scene);
  } else if (task.kind == Kind::flow) {
    request.kind = "flow";
    request.canonical = c.canonical;
  } else {
    request.kind = "drive";
    request.canonical = c.canonical;
    request.bed_id = c.bed_id;
    request.bed_run = store::newest_run(options.root, c.bed_id).filename().string();
  }
  return request;
}

}  // namespace seapile::execute
