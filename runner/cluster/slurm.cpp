#include "runner/cluster/slurm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <sstream>

#include "runner/cluster/scheduler.h"

namespace seapile::cluster {
namespace {

constexpr const char* kForgotten = "Invalid job id";  // what scontrol and scancel say of a job that is gone

long number(const std::string& text) {
  long value = -1;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

/// "Key=value Key=value ..." of one line. A value may hold blanks; what is read here comes before any that does.
std::map<std::string, std::string> members(const std::string& line) {
  std::map<std::string, std::string> found;
  std::istringstream words(line);
  for (std::string word; words >> word;) {
    const auto equals = word.find('=');
    if (equals != std::string::npos) found.try_emplace(word.substr(0, equals), word.substr(equals + 1));
  }
  return found;
}

}  // namespace

std::size_t most_array_tasks() {
  std::istringstream answer(ask_surely("scontrol", {"show", "config"}));
  for (std::string line; std::getline(answer, line);) {
    if (!line.starts_with("MaxArraySize")) continue;
    // The largest index is one less, and the first is 0.
    const long size = number(line.substr(line.find_first_of("0123456789")));
    if (size < 1) throw SchedulerError("Slurm takes no job arrays here: its MaxArraySize is 0");
    return static_cast<std::size_t>(size);
  }
  throw SchedulerError("scontrol show config does not tell MaxArraySize");
}

std::string submit_job(const std::vector<std::string>& sbatch_arguments) {
  const std::string answer = ask_surely("sbatch", sbatch_arguments);
  const std::string id = answer.substr(0, answer.find_first_of(";\n"));  // "id" or "id;cluster"
  if (id.empty() || id.find_first_not_of("0123456789") != std::string::npos)
    throw SchedulerError(fmt::format("sbatch answered \"{}\" instead of a job id", id));
  return id;
}

void release_jobs(const std::vector<std::string>& ids) {
  if (ids.empty()) return;
  std::vector<std::string> words = {"release"};
  words.insert(words.end(), ids.begin(), ids.end());
  ask_surely("scontrol", words);
}

void cancel_jobs(const std::vector<std::string>& ids) {
  if (ids.empty()) return;
  const Answer answer = ask("scancel", ids);
  const bool only_forgotten = answer.error.find(kForgotten) != std::string::npos;
  if (answer.exit_code != 0 && !only_forgotten) throw SchedulerError(complaint("scancel", answer));
}

bool is_live(const SlurmTask& task) {
  constexpr std::array kLive = {"PENDING",      "RUNNING",     "CONFIGURING", "COMPLETING", "SUSPENDED",
                                "REQUEUED",     "RESIZING",    "SIGNALING",   "STAGE_OUT",  "STOPPED",
                                "REQUEUE_HOLD", "REQUEUE_FED", "SPECIAL_EXIT"};
  return std::ranges::find(kLive, task.state) != kLive.end();
}

std::vector<SlurmTask> job_tasks(const std::string& id) {
  const Answer answer = ask("scontrol", {"show", "job", "--oneliner", id});
  if (answer.exit_code == 0) return parse_tasks(answer.out);
  if ((answer.out + answer.error).find(kForgotten) != std::string::npos) return {};
  throw SchedulerError(complaint("scontrol", answer));
}

std::vector<SlurmTask> parse_tasks(const std::string& text) {
  std::vector<SlurmTask> tasks;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    auto all = members(line);
    if (!all.contains("JobId") || !all.contains("JobState")) continue;
    SlurmTask one;
    one.job = all.contains("ArrayJobId") ? all["ArrayJobId"] : all["JobId"];
    one.state = all["JobState"];
    if (all["Reason"] != "None") one.reason = all["Reason"];
    const std::string& ending = all["ExitCode"];  // "exit code:signal"
    one.exit_code = static_cast<int>(std::max(0L, number(ending)));
    if (const auto colon = ending.find(':'); colon != std::string::npos)
      one.signal = static_cast<int>(std::max(0L, number(ending.substr(colon + 1))));
    one.restarts = static_cast<int>(std::max(0L, number(all["Restarts"])));
    if (!all.contains("ArrayTaskId")) {
      tasks.push_back(one);
      continue;
    }
    for (const long index : array_indices(all["ArrayTaskId"])) {
      one.task = index;
      tasks.push_back(one);
    }
  }
  return tasks;
}

std::vector<long> array_indices(const std::string& expression) {
  std::vector<long> indices;
  std::istringstream parts(expression.substr(0, expression.find('%')));
  for (std::string part; std::getline(parts, part, ',');) {
    const auto dash = part.find('-'), colon = part.find(':');
    const long first = number(part);
    const long last = dash == std::string::npos ? first : number(part.substr(dash + 1));
    const long step = colon == std::string::npos ? 1 : number(part.substr(colon + 1));
    if (first < 0 || step < 1) continue;
    for (long index = first; index <= last; index += step) indices.push_back(index);
  }
  return indices;
}

}  // namespace seapile::cluster
