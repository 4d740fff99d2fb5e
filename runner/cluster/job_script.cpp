#include "runner/cluster/job_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "runner/cluster/shell.h"

namespace seapile::cluster {
namespace {

/// The lines of a site.
std::string site_lines(const Engine& engine) {
  std::string lines;
  for (const std::string& module : engine.modules) lines += "module load " + shell_word(module) + "\n";
  for (const std::string& line : engine.setup) lines += line + "\n";
  return lines;
}

constexpr const char* kJob = R"job(
# One task of a job array: the cases of one line of cases.txt, one after another. The task leaves files alone: sealed
# runs in the store, and here what the workers said and how they ended.
folder=$1      # of the submission
first=$2       # line of this array's task 0, from 0
runner=$3
task=${SLURM_ARRAY_JOB_ID}_${SLURM_ARRAY_TASK_ID}
attempt=${SLURM_RESTART_COUNT:-0}
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1}

# USR1 comes some time before the time limit: the case seals a checkpoint, and the task goes back into the queue. TERM
# comes from the limit itself, from scancel and from preemption: a checkpoint too, but Slurm decides what becomes of the
# task.
asked_by=
again=
worker=
ask_to_stop() {
  asked_by=${asked_by:-$1}
  again=yes
  if [ -n "$worker" ]; then kill -TERM "$worker" 2>/dev/null; fi
}
trap 'ask_to_stop USR1' USR1
trap 'ask_to_stop TERM' TERM

has_checkpoint() {
  local file
  for file in "$folder/../../../cases/$1"/*/checkpoint/?.h5; do
    [ -e "$file" ] && return 0
  done
  return 1
}

# How a case ended, under its final name only when it is whole.
note_ending() {
  local signal=0 exit_code=$2 checkpoint=false
  if [ "$exit_code" -gt 128 ]; then signal=$((exit_code - 128)) exit_code=0; fi
  has_checkpoint "$1" && checkpoint=true
  printf '{"task": "%s", "attempt": %d, "exit_code": %d, "signal": %d, "asked_by": "%s", "checkpoint": %s}\n' \
    "$task" "$attempt" "$exit_code" "$signal" "$asked_by" "$checkpoint" > "$folder/endings/$1.part"
  mv "$folder/endings/$1.part" "$folder/endings/$1.json"
}

read -r -a cases <<< "$(sed -n "$((first + SLURM_ARRAY_TASK_ID + 1))p" "$folder/cases.txt")"
for id in "${cases[@]}"; do rm -f "$folder/endings/$id.json" "$folder/messages/$id.jsonl"; done

worst=0
progress=
for id in "${cases[@]}"; do
  if [ -n "$asked_by" ]; then worst=75; break; fi
  "$runner" exec "$folder/requests/$id.json" > "$folder/messages/$id.jsonl" &
  worker=$!
  # A trap ends the wait, not the worker.
  while again=; wait "$worker"; code=$?; [ -n "$again" ]; do :; done
  worker=
  note_ending "$id" "$code"
  if [ "$code" = 0 ]; then progress=yes; continue; fi
  worst=$code
  if [ "$code" = 75 ]; then has_checkpoint "$id" && progress=yes; break; fi
done

# A task that came no further than before would come no further again.
if [ "$worst" = 75 ] && [ "$asked_by" = USR1 ]; then
  if [ -z "$progress" ]; then
    echo "stopped before the time limit without a checkpoint: not tried again" >&2
  elif [ "$attempt" -ge "$most_restarts" ]; then
    echo "stopped before the time limit for the last time: $attempt restarts were allowed" >&2
  else
    scontrol requeue "$task"
  fi
fi
exit "$worst"
)job";

constexpr const char* kIngest = R"job(
# Lists in the catalogue what the arrays have left in the store: the one job that writes it. Then notes how the cases
# ended, while Slurm still knows.
store=$1
runner=$2
study=$3
"$runner" ingest --store "$store"
code=$?
"$runner" jobs "$study" --store "$store"
exit "$code"
)job";

}  // namespace

long limit_seconds(const std::string& time) {
  static const std::regex kLimit(R"((?:(\d{1,4})-)?(\d{1,6})(?::(\d{1,2}))?(?::(\d{1,2}))?)");
  std::smatch match;
  if (!std::regex_match(time, match, kLimit)) return 0;
  const auto part = [&](std::size_t i) { return match[i].matched ? std::stol(match[i]) : 0L; };
  const bool days = match[1].matched, three = match[4].matched;
  if (days || three) return ((part(1) * 24 + part(2)) * 60 + part(3)) * 60 + part(4);
  return part(2) * 60 + part(3);
}

long lead_seconds(long limit) {
  constexpr long kLeast = 120, kMost = 600;
  return std::min(std::clamp(limit / 12, kLeast, kMost), limit / 2);
}

std::string job_script(const Resources& resources, const Engine& engine) {
  return fmt::format(
             "#!/bin/bash\n"
             "#SBATCH --requeue\n"
             "#SBATCH --open-mode=append\n"
             "#SBATCH --signal=B:USR1@{}\n"
             "#SBATCH --time={}\n"
             "#SBATCH --mem={}\n"
             "#SBATCH --cpus-per-task={}\n"
             "set -u\n"
             "most_restarts={}\n",
             lead_seconds(limit_seconds(resources.time)), resources.time, resources.memory, resources.threads,
             resources.most_restarts) +
         site_lines(engine) + kJob;
}

std::string ingest_script(const Engine& engine) {
  return "#!/bin/bash\n"
         "#SBATCH --time=01:00:00\n"
         "#SBATCH --mem=1G\n"
         "set -u\n" +
         site_lines(engine) + kIngest;
}

}  // namespace seapile::cluster
