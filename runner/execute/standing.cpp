#include "runner/execute/standing.h"

#include "runner/execute/history.h"
#include "runner/execute/progress.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;

/// What the case's folder tells; whether a completed run is up to date is the plan's to say.
CaseStanding look_at(const fs::path& root, const std::string& case_id, const std::string& name) {
  CaseStanding about;
  about.case_id = case_id;
  about.name = name;
  const History history = read_history(root, case_id);
  if (history.past) {
    const fs::path run = store::case_folder(root, case_id) / history.past->run;
    const bool damaged = !history.past->damage.empty();
    about.completed = !damaged && history.past->outcome == simulation::Outcome::completed;
    about.standing = about.completed ? Standing::completed : damaged ? Standing::stale : Standing::diverged;
    about.reason = damaged ? history.past->damage : history.past->reason;
    about.run_folder = run;
    if (!damaged) about.sealed_folder = run;
  }
  if (!history.interrupted) return about;
  about.run_folder = store::case_folder(root, case_id) / history.interrupted->run;
  about.progress = read_progress(about.run_folder);
  about.reason.clear();
  if (is_seen_claimed(root, case_id)) {
    about.standing = Standing::running;
  } else if (const auto failure = read_failure(about.run_folder)) {
    about.standing = Standing::failed;
    about.reason = failure->sentence;
  } else {
    about.standing = Standing::interrupted;
  }
  return about;
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
    CaseStanding about = look_at(root, task.id, task.name);
    if (about.standing == Standing::completed && task.decision.action != Action::fresh)
      about.standing = Standing::stale;
    if (about.standing != Standing::failed && about.standing != Standing::diverged) about.reason = task.decision.reason;
    all.push_back(std::move(about));
  }
  return all;
}

std::vector<CaseStanding> standings(const store::StudyEntry& study, const fs::path& root) {
  std::vector<CaseStanding> all;
  for (const auto& [case_id, labels] : study.cases) {
    const std::string words = label_line(labels);
    all.push_back(look_at(root, case_id, words.empty() ? "case " + short_id(case_id) : words));
  }
  return all;
}

std::optional<double> seconds_left(const RunProgress& progress) {
  Outlook outlook;
  outlook.going = {{Kind::drive, progress.start_fraction, progress.fraction, progress.elapsed}};
  return seconds_left(outlook);
}

}  // namespace seapile::execute
