#include "runner/cluster/job_states.h"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runner/execute/history.h"
#include "runner/execute/message.h"
#include "runner/store/durable.h"
#include "runner/store/run_folder.h"

namespace seapile::cluster {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kVerdicts = "verdicts.json";

std::optional<json> read_json(const fs::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  json object = json::parse(in, nullptr, false);
  if (object.is_discarded()) return std::nullopt;
  return object;
}

std::optional<ScriptEnding> read_ending(const fs::path& file) {
  const auto object = read_json(file);
  if (!object) return std::nullopt;
  try {
    return ScriptEnding{object->at("exit_code"), object->at("signal"), object->at("asked_by"),
                        object->at("checkpoint")};
  } catch (const json::exception&) {
    return std::nullopt;
  }
}

/// What a worker has said so far.
struct Said {
  std::string trouble;
  std::optional<double> fraction;
};

Said read_messages(const fs::path& file) {
  Said said;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto message = execute::decode(line);
    if (!message) continue;
    if (const auto* trouble = std::get_if<execute::Trouble>(&*message)) said.trouble = trouble->sentence;
    if (const auto* advanced = std::get_if<execute::Advanced>(&*message)) said.fraction = advanced->fraction;
  }
  return said;
}

/// Without control groups Slurm reports a job over its memory as killed; only its log names the reason.
bool says_memory_exceeded(const fs::path& log) {
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);) {
    if (line.find("xceeded memory limit") != std::string::npos || line.find("oom-kill event") != std::string::npos ||
        line.find("oom_kill event") != std::string::npos)
      return true;
  }
  return false;
}

/// One submission with what Slurm knows of its arrays, each asked about once and only when it matters.
class Look {
 public:
  Look(fs::path root, const Submission& submission) : root_(std::move(root)), submission_(submission) {
    const auto object = read_json(submission.folder / kVerdicts);
    if (!object || !object->is_object()) return;
    for (const auto& [id, entry] : object->items()) {
      if (!entry.is_object()) continue;
      if (const auto state = job_word(entry.value("state", ""))) kept_[id] = {*state, entry.value("detail", "")};
    }
  }

  JobState state_of(const SubmittedCase& one) {
    const SubmittedArray& array = submission_.arrays[one.array];
    JobState state{submission_.study,
                   submission_.stamp,
                   one.id,
                   one.name,
                   one.kind,
                   fmt::format("{}_{}", array.job, one.task),
                   JobWord::queued,
                   "",
                   std::nullopt,
                   0};
    Evidence evidence = from_store(one);
    JobVerdict verdict;
    if (const auto kept = kept_.find(one.id); !evidence.sealed && kept != kept_.end()) {
      verdict = kept->second;
    } else {
      if (!evidence.sealed) {
        add_files(one, array, evidence);
        evidence.task = task_of(array.job, one.task);
        if (evidence.task) state.restarts = evidence.task->restarts;
      }
      verdict = judge(evidence);
      // Once the store holds the run, it tells the end itself.
      const bool live = evidence.task && is_live(*evidence.task);
      if (!evidence.sealed && !live && is_final(verdict.state)) {
        kept_[one.id] = verdict;
        learned_ = true;
      }
    }
    if (verdict.state == JobWord::running)
      state.fraction = read_messages(file_of("messages", one.id, "jsonl")).fraction;
    state.state = verdict.state;
    state.detail = verdict.detail;
    return state;
  }

  /// Keeps what was learned of ended cases.
  void keep() const {
    if (!learned_) return;
    json object = json::object();
    for (const auto& [id, verdict] : kept_) object[id] = {{"state", word(verdict.state)}, {"detail", verdict.detail}};
    store::write_text(submission_.folder / kVerdicts, object.dump(1) + "\n");
  }

 private:
  fs::path file_of(const char* kind, const std::string& id, const char* ending) const {
    return submission_.folder / kind / fmt::format("{}.{}", id, ending);
  }

  Evidence from_store(const SubmittedCase& one) const {
    Evidence evidence;
    const execute::History history = execute::read_history(root_, one.id);
    evidence.checkpoint = history.interrupted && history.interrupted->checkpoint;
    if (!history.past || history.past->run == one.newest || !history.past->damage.empty()) return evidence;
    evidence.sealed = true;
    if (history.past->outcome == simulation::Outcome::diverged) evidence.diverged = history.past->reason;
    return evidence;
  }

  void add_files(const SubmittedCase& one, const SubmittedArray& array, Evidence& evidence) const {
    evidence.started = fs::exists(file_of("messages", one.id, "jsonl"));
    evidence.ending = read_ending(file_of("endings", one.id, "json"));
    evidence.trouble = read_messages(file_of("messages", one.id, "jsonl")).trouble;
    evidence.memory_exceeded =
        says_memory_exceeded(submission_.folder / "logs" / fmt::format("{}_{}.txt", array.job, one.task));
  }

  std::optional<SlurmTask> task_of(const std::string& job, std::size_t index) {
    auto [known, is_new] = tasks_.try_emplace(job);
    if (is_new && !job.empty()) {
      for (SlurmTask& task : job_tasks(job)) {
        if (task.task) known->second[static_cast<std::size_t>(*task.task)] = std::move(task);
      }
    }
    const auto found = known->second.find(index);
    return found == known->second.end() ? std::nullopt : std::optional(found->second);
  }

  fs::path root_;
  const Submission& submission_;
  std::map<std::string, JobVerdict> kept_;
  std::map<std::string, std::map<std::size_t, SlurmTask>> tasks_;
  bool learned_ = false;
};

}  // namespace

std::vector<JobState> states_of(const fs::path& root, const Submission& submission) {
  std::vector<JobState> states;
  Look look(root, submission);
  for (const SubmittedCase& one : submission.cases) states.push_back(look.state_of(one));
  look.keep();
  return states;
}

std::vector<JobState> job_states(const fs::path& root, const std::string& study) {
  std::vector<JobState> states;
  std::set<std::string> seen;
  for (const Submission& submission : read_submissions(root, study)) {
    for (JobState& state : states_of(root, submission)) {
      if (seen.insert(state.case_id).second) states.push_back(std::move(state));
    }
  }
  return states;
}

}  // namespace seapile::cluster
