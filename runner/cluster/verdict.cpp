#include "runner/cluster/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "runner/execute/ending.h"
#include "runner/execute/exit_codes.h"

namespace seapile::cluster {
namespace {

constexpr std::array<std::pair<JobWord, const char*>, 13> kWords = {{{JobWord::queued, "queued"},
                                                                     {JobWord::running, "running"},
                                                                     {JobWord::requeued, "requeued"},
                                                                     {JobWord::done, "done"},
                                                                     {JobWord::diverged, "diverged"},
                                                                     {JobWord::failed, "failed"},
                                                                     {JobWord::not_run, "not run"},
                                                                     {JobWord::timed_out, "timed out"},
                                                                     {JobWord::over_memory, "over memory"},
                                                                     {JobWord::killed, "killed"},
                                                                     {JobWord::stopped, "stopped"},
                                                                     {JobWord::cancelled, "cancelled"},
                                                                     {JobWord::lost, "lost"}}};

std::string kept(bool checkpoint) { return checkpoint ? "a checkpoint is kept" : "without a checkpoint"; }

bool is_any(const std::string& state, std::initializer_list<const char*> states) {
  return std::ranges::find(states, state) != states.end();
}

/// What Slurm did to a task of which a case did not come to its own end; absent when it did nothing.
std::optional<JobVerdict> by_slurm(const Evidence& evidence) {
  const std::string state = evidence.task ? evidence.task->state : "";
  if (evidence.memory_exceeded || state == "OUT_OF_MEMORY")
    return JobVerdict{JobWord::over_memory, "more memory than --memory gives"};
  if (is_any(state, {"TIMEOUT", "DEADLINE"})) return JobVerdict{JobWord::timed_out, kept(evidence.checkpoint)};
  if (state == "CANCELLED") return JobVerdict{JobWord::cancelled, kept(evidence.checkpoint)};
  if (is_any(state, {"NODE_FAIL", "BOOT_FAIL", "PREEMPTED", "REVOKED"}))
    return JobVerdict{JobWord::killed, fmt::format("Slurm: {}, {}", state, kept(evidence.checkpoint))};
  return std::nullopt;
}

JobVerdict from_ending(const ScriptEnding& ending, const Evidence& evidence) {
  const execute::Ending worker{ending.exit_code, ending.signal, evidence.trouble};
  switch (execute::classify(worker)) {
    case execute::Verdict::completed:
      return {JobWord::done, "was fresh when its turn came"};
    case execute::Verdict::diverged:
      return {JobWord::diverged, evidence.trouble};
    case execute::Verdict::stopped: {
      if (const auto verdict = by_slurm(evidence)) return *verdict;
      const bool limit = ending.asked_by == "USR1";
      return {limit ? JobWord::timed_out : JobWord::stopped, kept(ending.checkpoint)};
    }
    case execute::Verdict::killed:
      if (const auto verdict = by_slurm(evidence)) return *verdict;
      return {JobWord::killed, fmt::format("{}, {}", execute::in_words(worker), kept(evidence.checkpoint))};
    default:
      if (ending.exit_code == execute::kBedMissing) return {JobWord::not_run, evidence.trouble};
      return {JobWord::failed, execute::in_words(worker)};
  }
}

JobVerdict of_live_task(const Evidence& evidence) {
  const SlurmTask& task = *evidence.task;
  if (task.state == "PENDING" || task.state.starts_with("REQUEUE")) {
    if (task.restarts > 0) return {JobWord::requeued, kept(evidence.checkpoint)};
    return {JobWord::queued, task.reason};
  }
  if (!evidence.started) return {JobWord::queued, "waits for its turn in a task that runs"};
  const bool going = !evidence.ending || evidence.ending->exit_code == execute::kStoppedResumable;
  return going ? JobVerdict{JobWord::running, ""} : from_ending(*evidence.ending, evidence);
}

}  // namespace

const char* word(JobWord state) {
  return std::ranges::find(kWords, state, &decltype(kWords)::value_type::first)->second;
}

std::optional<JobWord> job_word(const std::string& text) {
  for (const auto& [state, name] : kWords) {
    if (text == name) return state;
  }
  return std::nullopt;
}

bool is_final(JobWord state) {
  return state != JobWord::queued && state != JobWord::running && state != JobWord::requeued;
}

JobVerdict judge(const Evidence& evidence) {
  if (evidence.sealed) {
    if (!evidence.diverged.empty()) return {JobWord::diverged, evidence.diverged};
    return {JobWord::done, ""};
  }
  if (evidence.task && is_live(*evidence.task)) return of_live_task(evidence);
  if (evidence.ending) return from_ending(*evidence.ending, evidence);
  if (!evidence.task) return {JobWord::lost, "Slurm has forgotten its job, and no run was sealed"};
  const auto verdict = by_slurm(evidence);
  if (!evidence.started && evidence.task->state != "CANCELLED")
    return {JobWord::not_run, verdict ? fmt::format("its task ended before its turn: {}", word(verdict->state))
                                      : "its task ended before its turn"};
  if (verdict) return *verdict;
  if (evidence.task->signal != 0)
    return {JobWord::killed, fmt::format("with its task: {}, {}", execute::in_words({0, evidence.task->signal, ""}),
                                         kept(evidence.checkpoint))};
  return {JobWord::lost, fmt::format("Slurm: {}, and no run was sealed", evidence.task->state)};
}

}  // namespace seapile::cluster
