#include "runner/execute/standing.h"

#include <algorithm>

#include "runner/execute/history.h"
#include "runner/execute/progress.h"
#include "runner/store/store_error.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;

/// What is to be seen of a case that was begun and has not come to an end; false when there is no such run.
bool look_at_unfinished(const fs::path& root, CaseStanding& about) {
  const fs::path run = unfinished_run(root, about.case_id);
  if (run.empty()) return false;
  about.run_folder = run;
  about.progress = read_progress(run);
  if (is_seen_claimed(root, about.case_id)) {
    about.standing = Standing::running;
  } else if (const auto failure = read_failure(run)) {
    about.standing = Standing::failed;
    about.reason = failure->sentence;
  } else {
    about.standing = Standing::interrupted;
  }
  return true;
}

}  // namespace

const char* name(Standing standing) {
  static constexpr const char* kNames[] = {"completed", "running", "interrupted", "failed",
                                           "diverged",  "stale",   "missing"};
  return kNames[static_cast<int>(standing)];
}

std::vector<CaseStanding> standings(const Plan& plan, const fs::path& root) {
  std::vector<CaseStanding> all;
  for (const Task& task : plan.tasks) {
    CaseStanding about{task.id, task.name, Standing::missing, "", {}, {}};
    if (task.decision.action == Action::fresh) {
      about.standing = Standing::completed;
      about.run_folder = store::case_folder(root, task.id) / task.decision.run;
    } else if (!look_at_unfinished(root, about)) {
      about.run_folder = store::newest_run(root, task.id);
      if (!about.run_folder.empty()) {
        about.reason = task.decision.reason;
        about.standing = about.reason.starts_with("last run diverged") ? Standing::diverged : Standing::stale;
      }
    }
    all.push_back(std::move(about));
  }
  return all;
}

std::vector<CaseStanding> standings(const store::StudyEntry& study, const fs::path& root) {
  std::vector<CaseStanding> all;
  for (const auto& [case_id, labels] : study.cases) {
    const std::string words = label_line(labels);
    CaseStanding about{case_id, words.empty() ? "case " + short_id(case_id) : words, Standing::missing, "", {}, {}};
    if (!look_at_unfinished(root, about)) {
      about.run_folder = store::newest_run(root, case_id);
      try {
        if (!about.run_folder.empty()) {
          const store::Manifest manifest = store::read_manifest(about.run_folder);
          const bool completed = manifest.result.outcome == simulation::Outcome::completed;
          about.standing = completed ? Standing::completed : Standing::diverged;
          about.reason = manifest.result.reason;
        }
      } catch (const store::StoreError& error) {
        about.standing = Standing::stale;
        about.reason = error.what();
      }
    }
    all.push_back(std::move(about));
  }
  return all;
}

std::optional<double> seconds_left(const RunProgress& progress) {
  Outlook outlook;
  outlook.going = {{Kind::drive, progress.start_fraction, progress.fraction, progress.elapsed}};
  return seconds_left(outlook);
}

}  // namespace seapile::execute
