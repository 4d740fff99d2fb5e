#include "runner/commands/case_states.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "runner/execute/campaign.h"
#include "runner/execute/history.h"
#include "runner/store/durable.h"
#include "runner/store/run_folder.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLogLines = 15;

/// What the history alone tells; whether a completed run is up to date is the plan's to say.
CaseState state_of(const std::string& id, const present::Labels& labels, const fs::path& root) {
  const execute::History history = execute::read_history(root, id);
  const fs::path folder = store::case_folder(root, id);
  CaseState one{id, labels, State::missing, "never run", false, {}, {}, {}};
  if (history.past) {
    const fs::path run = folder / history.past->run;
    const bool damaged = !history.past->damage.empty();
    one.completed = !damaged && history.past->outcome == simulation::Outcome::completed;
    one.state = one.completed ? State::done : State::failed;
    one.why = damaged ? history.past->damage : fmt::format("diverged: {}", history.past->reason);
    if (!damaged) one.run_folder = run;
    if (!one.completed) one.log_folder = run;
  } else if (history.interrupted) {
    one.state = State::unfinished;
    one.why = "begun and not sealed";
    one.log_folder = folder / history.interrupted->run;
  }
  return one;
}

/// A completed run that is not fresh, and why.
void judge(CaseState& one, const execute::Decision& decision) {
  if (one.completed && decision.action != execute::Action::fresh) one.state = State::stale;
  const bool told = one.state == State::stale || one.state == State::unfinished;
  if (told || one.state == State::done) one.why = decision.reason;
}

/// The end of a log; what cannot be read is said in its place.
std::string last_lines(const fs::path& log) {
  std::string text;
  try {
    text = store::read_text(log);
  } catch (const store::StoreError& error) {
    return error.what();
  }
  while (text.ends_with('\n')) text.pop_back();
  std::size_t at = text.size();
  for (std::size_t lines = 0; lines < kLogLines && at != std::string::npos; ++lines)
    at = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return at == std::string::npos ? text : text.substr(at + 1);
}

execute::Plan plan_of(const study::Study& study, const fs::path& root) {
  return execute::make_plan(study, execute::todays_numerics,
                            [&](const std::string& id) { return execute::read_history(root, id); });
}

}  // namespace

std::string words(State state) {
  switch (state) {
    case State::done:
      return "done";
    case State::failed:
      return "failed";
    case State::missing:
      return "missing";
    case State::unfinished:
      return "unfinished";
    case State::stale:
      break;
  }
  return "stale";
}

present::Tone tone(State state) {
  return state == State::done ? present::Tone::good : state == State::failed ? present::Tone::bad : present::Tone::open;
}

std::vector<CaseState> case_states(const study::Study& study, const fs::path& root) {
  const execute::Plan plan = plan_of(study, root);
  std::map<std::string, const execute::Decision*> decisions;
  for (const execute::Task& task : plan.tasks) decisions[task.id] = &task.decision;
  std::vector<CaseState> states;
  for (const study::Case& one : study.cases) {
    CaseState& state = states.emplace_back(state_of(one.id, one.labels, root));
    if (const auto found = decisions.find(one.id); found != decisions.end()) judge(state, *found->second);
    if (!one.bed_id.empty()) state.bed_folder = store::newest_run(root, one.bed_id);
  }
  return states;
}

std::vector<CaseState> bed_states(const study::Study& study, const fs::path& root) {
  std::set<std::string> seen;
  for (const study::Case& one : study.cases) seen.insert(one.id);
  std::vector<CaseState> states;
  for (const study::Case& one : study.cases) {
    if (one.bed_id.empty() || !seen.insert(one.bed_id).second) continue;
    states.push_back(state_of(one.bed_id, {}, root));
  }
  return states;
}

std::vector<present::ReportBlock> failure_logs(const std::vector<CaseState>& states) {
  std::vector<present::ReportBlock> blocks;
  for (const CaseState& one : states) {
    if (one.log_folder.empty()) continue;
    const std::string labels = execute::label_line(one.labels), id = execute::short_id(one.case_id);
    const fs::path log = one.log_folder / "log.txt";
    blocks.emplace_back(present::ReportLog{labels.empty() ? "case " + id : fmt::format("{} (case {})", labels, id),
                                           words(one.state), one.why, log.string(), last_lines(log)});
  }
  return blocks;
}

}  // namespace seapile::commands
