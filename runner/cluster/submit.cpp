#include "runner/cluster/submit.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "runner/cluster/job_states.h"
#include "runner/cluster/scheduler.h"
#include "runner/cluster/shell.h"
#include "runner/cluster/slurm.h"
#include "runner/execute/campaign.h"
#include "runner/execute/price.h"
#include "runner/execute/processes.h"
#include "runner/execute/request.h"
#include "runner/store/durable.h"
#include "runner/store/run_folder.h"
#include "runner/study/sha256.h"

namespace seapile::cluster {
namespace {

namespace fs = std::filesystem;

/// A path as sbatch's --output takes it: its percent signs stand for nothing.
std::string literal(const fs::path& path) {
  std::string text;
  for (const char c : path.string()) text += c == '%' ? std::string("%%") : std::string(1, c);
  return text;
}

/// The program under its own name: the link in /proc means another program on another machine.
fs::path this_program() { return fs::read_symlink(execute::kThisProgram); }

fs::path absolute_root(const SubmitOptions& options) { return fs::weakly_canonical(fs::absolute(options.root)); }

/// One catalogue, one writer: the jobs that ingest into a store share a name, and Slurm runs one of a name at a time.
std::string ingest_name(const fs::path& root) { return "seapile-ingest-" + study::sha256(root.string()).substr(0, 8); }

std::vector<std::string> with_site(std::vector<std::string> words, const SubmitOptions& options) {
  for (const auto& more : {sbatch_words(options.engine), options.sbatch}) {
    words.insert(words.end(), more.begin(), more.end());
  }
  return words;
}

/// What sbatch is told for an array; `job_of`: the id of each array before it.
std::vector<std::string> array_words(const study::Study& study, const Layout& layout, std::size_t number,
                                     const std::vector<std::string>& job_of, const fs::path& folder,
                                     const SubmitOptions& options) {
  const Array& array = layout.arrays[number];
  std::set<std::string> after;
  for (const std::size_t before : array.after) after.insert(job_of[before]);
  if (const auto jobs = layout.after_jobs.find(number); jobs != layout.after_jobs.end())
    after.insert(jobs->second.begin(), jobs->second.end());
  std::vector<std::string> words = {"--parsable", fmt::format("--job-name={}-{}", study.name, name(array.kind)),
                                    fmt::format("--array=0-{}{}", array.tasks.size() - 1,
                                                options.throttle > 0 ? fmt::format("%{}", options.throttle) : ""),
                                    fmt::format("--output={}/logs/%A_%a.txt", literal(folder)), "--hold"};
  if (!after.empty()) {
    words.push_back(fmt::format("--dependency=afterany:{}", fmt::join(after, ":")));
    words.push_back("--kill-on-invalid-dep=yes");
  }
  words = with_site(std::move(words), options);
  words.insert(words.end(),
               {(folder / "job.sh").string(), folder.string(), std::to_string(array.first), this_program().string()});
  return words;
}

std::vector<std::string> ingest_words(const study::Study& study, const std::vector<std::string>& jobs,
                                      const fs::path& folder, const SubmitOptions& options) {
  const fs::path root = absolute_root(options);
  std::vector<std::string> words = {
      "--parsable", "--job-name=" + ingest_name(root), fmt::format("--output={}/logs/ingest_%j.txt", literal(folder)),
      fmt::format("--dependency=afterany:{},singleton", fmt::join(jobs, ":")), "--kill-on-invalid-dep=yes"};
  words = with_site(std::move(words), options);
  words.insert(words.end(), {(folder / "ingest.sh").string(), root.string(), this_program().string(), study.name});
  return words;
}

/// A folder of this submission's own; two in one second get different names.
fs::path new_folder(const fs::path& root, const std::string& study) {
  const auto now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  const fs::path of_study = jobs_folder(root, study);
  store::make_folder(of_study);
  const std::string stamp = fmt::format("{:%Y%m%dT%H%M%SZ}", fmt::gmtime(now));
  for (int more = 1;; ++more) {
    const fs::path folder = of_study / (more == 1 ? stamp : fmt::format("{}-{}", stamp, more));
    std::error_code error;
    if (fs::create_directory(folder, error)) return folder;
    if (error)
      throw store::StoreError(store::StoreError::Kind::io, fmt::format("{}: {}", folder.string(), error.message()));
  }
}

execute::Request request_of(const study::Study& study, const execute::Task& task, const fs::path& root,
                            const SubmitOptions& options) {
  execute::CampaignOptions campaign;
  campaign.root = root.string();
  campaign.checkpoint_every = options.checkpoint_every;
  execute::Request request = execute::request_of(study, task, campaign);
  request.bed_run = "";  // known once the bed is there: the worker takes the newest then
  request.threads = options.resources.threads;
  return request;
}

void write_files(const study::Study& study, const execute::Plan& plan, const Layout& layout, const fs::path& root,
                 Submission& submission, const SubmitOptions& options) {
  for (const char* name : {"requests", "messages", "endings", "logs"}) store::make_folder(submission.folder / name);
  std::string lines;
  for (std::size_t number = 0; number < layout.arrays.size(); ++number) {
    const Array& array = layout.arrays[number];
    submission.arrays.push_back({"", name(array.kind), array.first, array.tasks.size(), {}});
    for (std::size_t index = 0; index < array.tasks.size(); ++index) {
      std::vector<std::string> ids;
      for (const std::size_t i : array.tasks[index]) {
        const execute::Task& task = plan.tasks[i];
        const execute::Request request = request_of(study, task, root, options);
        store::write_text(submission.folder / "requests" / (task.id + ".json"), execute::to_json(request) + "\n");
        submission.cases.push_back(
            {task.id, task.name, name(task.kind), number, index, task.newest});
        ids.push_back(task.id);
      }
      lines += fmt::format("{}\n", fmt::join(ids, " "));
    }
  }
  store::write_text(submission.folder / "cases.txt", lines);
  store::write_text(submission.folder / "job.sh", job_script(options.resources, options.engine));
  store::write_text(submission.folder / "ingest.sh", ingest_script(options.engine));
}

/// Lets Slurm say whether it would take such a job at all: of what is submitted on hold it does not look at memory or
/// processors, and would keep for ever what no node can run. All arrays ask for the same.
void try_out(const study::Study& study, const Layout& layout, const fs::path& folder, const SubmitOptions& options) {
  std::vector<std::string> words = array_words(study, layout, 0, {}, folder, options);
  std::erase(words, "--hold");
  words.insert(words.begin(), "--test-only");
  ask_surely("sbatch", words);
}

/// Submits array by array on hold, then the ingest, and lets go. submit.json tells of every job from the moment that
/// Slurm has accepted it, so that `cancel` finds it whatever happens to this process.
void hand_over(const study::Study& study, const Layout& layout, Submission& submission, const SubmitOptions& options) {
  try_out(study, layout, submission.folder, options);
  std::vector<std::string> jobs;
  for (std::size_t number = 0; number < layout.arrays.size(); ++number) {
    SubmittedArray& array = submission.arrays[number];
    array.command = array_words(study, layout, number, jobs, submission.folder, options);
    array.job = submit_job(array.command);
    array.command.insert(array.command.begin(), "sbatch");
    jobs.push_back(array.job);
    write_submission(submission);
  }
  submission.ingest_command = ingest_words(study, jobs, submission.folder, options);
  submission.ingest = submit_job(submission.ingest_command);
  submission.ingest_command.insert(submission.ingest_command.begin(), "sbatch");
  write_submission(submission);
  release_jobs(jobs);
}

}  // namespace

std::map<std::string, std::string> cases_in_queue(const fs::path& root) {
  std::map<std::string, std::string> queued;
  for (const JobState& state : job_states(root, "")) {
    if (!is_final(state.state)) queued[state.case_id] = state.job.substr(0, state.job.find('_'));
  }
  return queued;
}

Layout lay_out(const study::Study& study, const execute::Plan& plan, const std::map<std::string, std::string>& in_queue,
               const SubmitOptions& options) {
  std::vector<bool> wanted;
  for (const execute::Task& task : plan.tasks)
    wanted.push_back(task.decision.action != execute::Action::fresh && !in_queue.contains(task.id));
  Layout layout;
  const auto limit = static_cast<double>(limit_seconds(options.resources.time));
  const execute::Prices prices = execute::prices_of(study, plan, options.root);
  const auto per_task = [&](execute::Kind kind) {
    const auto pace = execute::typical_cpu_seconds(plan, prices, kind);
    const std::size_t count = cases_per_task(pace.value_or(0), options.batch_seconds, limit);
    layout.remarks.push_back(pace ? fmt::format("{}s take {:.3g} s (median): {} in a task", name(kind), *pace, count)
                                  : fmt::format("no history of {}s: one in a task", name(kind)));
    return count;
  };
  layout.arrays = make_arrays(plan, wanted, most_array_tasks(), per_task);
  std::ranges::sort(layout.remarks);
  layout.remarks.erase(std::ranges::unique(layout.remarks).begin(), layout.remarks.end());
  for (std::size_t number = 0; number < layout.arrays.size(); ++number) {
    for (const auto& tasks : layout.arrays[number].tasks) {
      for (const std::size_t i : tasks) {
        if (!plan.tasks[i].bed) continue;
        const auto bed = in_queue.find(plan.tasks[*plan.tasks[i].bed].id);
        if (bed != in_queue.end()) layout.after_jobs[number].insert(bed->second);
      }
    }
  }
  return layout;
}

std::vector<std::string> command_lines(const study::Study& study, const Layout& layout, const SubmitOptions& options) {
  const fs::path folder = jobs_folder(absolute_root(options), study.name) / "STAMP";
  std::vector<std::string> lines, jobs;
  for (std::size_t number = 0; number < layout.arrays.size(); ++number) {
    std::vector<std::string> words = array_words(study, layout, number, jobs, folder, options);
    words.insert(words.begin(), "sbatch");
    lines.push_back(shell_line(words));
    jobs.push_back(fmt::format("JOB{}", number + 1));
  }
  std::vector<std::string> words = ingest_words(study, jobs, folder, options);
  words.insert(words.begin(), "sbatch");
  lines.push_back(shell_line(words));
  return lines;
}

Submission submit(const study::Study& study, const execute::Plan& plan, const Layout& layout,
                  const SubmitOptions& options) {
  const fs::path root = absolute_root(options);
  Submission submission;
  submission.study = study.name;
  submission.folder = new_folder(root, study.name);
  submission.stamp = submission.folder.filename().string();
  try {
    store::Catalogue::open(root).put(execute::entry_of(study));
    write_files(study, plan, layout, root, submission, options);
    hand_over(study, layout, submission, options);
  } catch (const std::exception& error) {
    const std::vector<std::string> accepted = submission.jobs();
    std::string taken_back;
    if (!accepted.empty()) {
      cancel_jobs(accepted);  // They were on hold: none has begun.
      taken_back = fmt::format("; cancelled what was accepted before: {}", fmt::join(accepted, ", "));
    }
    std::error_code ignored;
    fs::remove_all(submission.folder, ignored);
    if (dynamic_cast<const SchedulerError*>(&error) == nullptr) throw;
    throw SchedulerError(error.what() + taken_back);
  }
  return submission;
}

}  // namespace seapile::cluster
