// Submitted studies from end to end: the real program and a real Slurm, which slurm_fixture.sh has started.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "runner/cluster/scheduler.h"
#include "runner/cluster/slurm.h"
#include "runner/cluster/submission.h"
#include "tests/runner/commands/program.h"

namespace seapile::cluster {
namespace {

namespace fs = std::filesystem;
using commands::content;
using commands::everything;
using commands::Finished;
using commands::small_study;
using commands::Workplace;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using namespace std::chrono_literals;

bool comes_true(const std::function<bool()>& condition, std::chrono::seconds patience = 60s) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(100ms);
  }
  return true;
}

/// What `runner jobs` tells, by case id.
std::map<std::string, json> jobs(const Workplace& place, const std::string& study) {
  const Finished finished = place.run({"jobs", study, "--format", "json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  std::map<std::string, json> rows;
  const json answer = json::parse(finished.out);
  for (const json& row : answer.at("rows")) rows[row.at("case")] = row;
  return rows;
}

Submission newest(const Workplace& place, const std::string& study) {
  return read_submissions(place.results(), study).at(0);
}

/// Whether Slurm has nothing left to do for the newest submission.
bool is_over(const Workplace& place, const std::string& study) {
  for (const std::string& job : newest(place, study).jobs()) {
    for (const SlurmTask& task : job_tasks(job)) {
      if (is_live(task)) return false;
    }
  }
  return true;
}

/// State hash by case id, of every sealed run's newest.
std::map<std::string, std::string> hashes(const Workplace& place) {
  std::map<std::string, std::string> found;
  for (const auto& entry : fs::directory_iterator(place.results() / "cases")) {
    for (const auto& run : fs::directory_iterator(entry.path())) {
      const fs::path manifest = run.path() / "manifest.json";
      if (fs::exists(manifest))
        found[entry.path().filename()] = json::parse(content(manifest)).at("result").at("state_hash");
    }
  }
  return found;
}

std::string states_text(const std::map<std::string, json>& rows) {
  std::string text;
  for (const auto& [id, row] : rows) text += row.dump() + "\n";
  return text;
}

/// Whether PATH leads to programs of a folder before all others; undone at the end.
class WithPath {
 public:
  explicit WithPath(const std::string& path) : before_(std::getenv("PATH")) { ::setenv("PATH", path.c_str(), 1); }
  ~WithPath() { ::setenv("PATH", before_.c_str(), 1); }
  WithPath(const WithPath&) = delete;
  WithPath& operator=(const WithPath&) = delete;
  const std::string& before() const { return before_; }

 private:
  std::string before_;
};

/// A process with both words in its command line; 0: none.
pid_t process_with(const std::string& one, const std::string& other) {
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    const std::string line = content(entry.path() / "cmdline");
    if (line.find(one) != std::string::npos && line.find(other) != std::string::npos) return std::stoi(name);
  }
  return 0;
}

/// The worker that computes a case.
pid_t worker_of(const std::string& case_id) { return process_with("exec", case_id); }

// Six beds, one array. Slurm notices a passed time limit within half a minute: the array is begun before the other
// tests, and looked at after them.
const std::string kEndings = R"({
  "study": "endings",
  "question": "How can a case end?",
  "base": {
    "bed": {"domain": {"width": "8 m", "height": "80 m"}, "grains": {"radius": {"min": "0.02 m", "max": "0.03 m"}}},
    "pile": null, "fluid": null
  },
  "zip": {
    "bed.grains.count":         [200, 201, 40000, 40001, 100000, 202],
    "bed.preparation.longest":  ["12 s", "0.02 s", "12 s", "12 s", "12 s", "12 s"]
  }
})";

struct Cluster : testing::Test {
  static void SetUpTestSuite() {
    endings = std::make_unique<Workplace>();
    endings->write("endings.json", kEndings);
    submitted = endings->run({"submit", "endings.json", "--memory", "75M", "--", "--begin=now+2seconds"});
    if (submitted.exit_code != 0) return;
    for (const SubmittedCase& one : newest(*endings, "endings").cases) {
      const auto request = json::parse(content(newest(*endings, "endings").folder / "requests" / (one.id + ".json")));
      id_by_count[request.at("scene").at("bed").at("grains").at("count")] = one.id;
    }
    // A file where the case's folder would be: an error of the world.
    fs::create_directories(endings->results() / "cases");
    endings->write("results/cases/" + id_by_count[202], "in the way");
    const bool begun = comes_true([] { return worker_of(id_by_count[40000]) && worker_of(id_by_count[40001]); });
    if (!begun) return;
    ::kill(worker_of(id_by_count[40000]), SIGKILL);
    for (const SubmittedCase& one : newest(*endings, "endings").cases) {
      if (one.id != id_by_count[40001]) continue;
      const std::string task = newest(*endings, "endings").arrays[one.array].job + "_" + std::to_string(one.task);
      ask_surely("scontrol", {"update", "JobId=" + task, "EndTime=now+1"});
    }
  }
  static void TearDownTestSuite() { endings.reset(); }

  inline static std::unique_ptr<Workplace> endings;
  inline static Finished submitted;
  inline static std::map<int, std::string> id_by_count;
};

TEST_F(Cluster, AStudyComesToWhatRunGives) {
  const Workplace there, here;
  const std::string text = small_study("small", R"("replicates": {"seeds": 4},)");
  there.write("small.json", text);
  here.write("small.json", text);
  const Finished dry = there.run({"submit", "small.json", "--dry-run"});
  EXPECT_EQ(dry.exit_code, 0) << dry.error;
  EXPECT_THAT(dry.out, HasSubstr("sbatch --parsable"));
  EXPECT_FALSE(fs::exists(there.results())) << "a dry run writes nothing";

  const Finished finished = there.run({"submit", "small.json", "--throttle", "3"});
  ASSERT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_THAT(finished.error, HasSubstr("no history of beds: one in a task"));
  const Submission submission = newest(there, "small");
  ASSERT_EQ(submission.arrays.size(), 3u) << "four beds, and eight drives in arrays of at most six";
  EXPECT_EQ(submission.arrays[1].tasks, 6u);
  EXPECT_EQ(submission.arrays[2].tasks, 2u);
  EXPECT_THAT(submission.arrays[1].command, testing::Contains("--array=0-5%3"));
  EXPECT_THAT(submission.arrays[2].command, testing::Contains("--dependency=afterany:" + submission.arrays[0].job));
  EXPECT_THAT(submission.ingest_command, testing::Contains(testing::EndsWith(",singleton")));

  // What is in the queue is not submitted again.
  const Finished again = there.run({"submit", "small.json"});
  EXPECT_EQ(again.exit_code, 0) << again.error;
  EXPECT_EQ(read_submissions(there.results(), "small").size(), 1u) << again.error;

  ASSERT_TRUE(comes_true([&] { return is_over(there, "small"); })) << states_text(jobs(there, "small"));
  const auto rows = jobs(there, "small");
  EXPECT_EQ(rows.size(), 12u);
  for (const auto& [id, row] : rows) EXPECT_EQ(row.at("state"), "done") << row;
  // The last job has listed the results, so that the study is answered without another command.
  EXPECT_EQ(there.run({"query", "small"}).exit_code, 0);
  EXPECT_THAT(there.run({"submit", "small.json"}).error, HasSubstr("every case is fresh"));

  ASSERT_EQ(here.run({"small.json"}).exit_code, 0);
  EXPECT_EQ(hashes(there), hashes(here));

  // With a history short cases share a task.
  const Finished batched = there.run({"submit", "small.json", "--seeds", "12", "--dry-run"});
  EXPECT_THAT(batched.error, HasSubstr("(median): "));
  EXPECT_THAT(batched.out, HasSubstr("--array=0-0 ")) << batched.error;
}

TEST_F(Cluster, ACaseStoppedBeforeTheTimeLimitContinuesToTheSameHash) {
  const std::vector<std::string> slow = {
      "small.json", "--set", "pile.tip=flat", "--set", "pile.driving.constant.speed=0.03 m/s", "--checkpoint", "0"};
  const auto words = [&](std::vector<std::string> first, const std::vector<std::string>& last) {
    first.insert(first.end(), slow.begin(), slow.end());
    first.insert(first.end(), last.begin(), last.end());
    return first;
  };
  const Workplace there, here;
  for (const Workplace* place : {&there, &here}) place->write("small.json", small_study("small"));
  ASSERT_EQ(there.run(words({"submit"}, {"--restarts", "1"})).exit_code, 0);
  const Submission first = newest(there, "small");
  const SubmittedCase drive = first.cases.back();
  ASSERT_EQ(drive.kind, "drive");
  const std::string task = first.arrays.back().job + "_0";
  const auto state = [&] { return jobs(there, "small").at(drive.id.substr(0, 10)).at("state"); };
  const auto sealed_checkpoints = [&] {
    const fs::path folder = there.results() / "cases" / drive.id / "0001" / "checkpoint";
    return fs::exists(folder / "a.h5") || fs::exists(folder / "b.h5");
  };
  // The signal that Slurm sends --signal's seconds before the limit.
  const auto warn = [&] { ask_surely("scancel", {"--signal=USR1", "--batch", task}); };

  ASSERT_TRUE(comes_true([&] { return worker_of(drive.id) != 0 && sealed_checkpoints(); }));
  EXPECT_EQ(state(), "running");
  warn();
  ASSERT_TRUE(comes_true([&] { return state() == "requeued"; })) << state();
  // Slurm holds what was put back for two minutes; this is not waited for.
  ASSERT_TRUE(comes_true([&] { return job_tasks(first.arrays.back().job).at(0).state == "PENDING"; }));
  // Within the second in which it was stopped, slurmd would not start it: "Job credential revoked".
  ask_surely("scontrol", {"update", "JobId=" + task, "StartTime=now+2"});
  ASSERT_TRUE(comes_true([&] { return worker_of(drive.id) != 0; }));
  std::this_thread::sleep_for(500ms);
  warn();  // for the last time: one restart was allowed
  ASSERT_TRUE(comes_true([&] { return is_over(there, "small"); }));
  const json row = jobs(there, "small").at(drive.id.substr(0, 10));
  EXPECT_EQ(row.at("state"), "timed out") << row;
  EXPECT_EQ(row.at("detail"), "a checkpoint is kept");

  const Finished second = there.run(words({"submit"}, {}));
  ASSERT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.error, HasSubstr("was interrupted after a checkpoint"));
  EXPECT_EQ(newest(there, "small").cases.size(), 1u);
  ASSERT_TRUE(comes_true([&] { return is_over(there, "small"); }));
  EXPECT_EQ(state(), "done");
  ASSERT_EQ(here.run(words({"run"}, {})).exit_code, 0);
  EXPECT_EQ(hashes(there), hashes(here));
  const json manifest = json::parse(content(there.results() / "cases" / drive.id / "0001" / "manifest.json"));
  EXPECT_EQ(manifest.at("provenance").at("attempts"), 3);
}

TEST_F(Cluster, ADriveWhoseBedFailedIsNotRunAndDoesNotWait) {
  const Workplace place;
  place.write("small.json", small_study("small", R"("zip": {"bed.preparation.longest": ["0.02 s", "12 s"]},)"));
  ASSERT_EQ(place.run({"submit", "small.json"}).exit_code, 0);
  ASSERT_TRUE(comes_true([&] { return is_over(place, "small"); }));
  std::map<std::string, int> count;
  for (const auto& [id, row] : jobs(place, "small")) {
    ++count[row.at("kind").get<std::string>() + " " + row.at("state").get<std::string>()];
    if (row.at("state") != "not run") continue;
    EXPECT_THAT(row.at("detail"), HasSubstr("last run diverged")) << row;
  }
  EXPECT_EQ(count, (std::map<std::string, int>{
                       {"bed diverged", 1}, {"bed done", 1}, {"drive done", 2}, {"drive not run", 2}}));
}

TEST_F(Cluster, WhatSlurmRefusesEndsWithSixAndItsSentenceAndLeavesNothing) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const Finished refused = place.run({"submit", "small.json", "--", "--partition=nowhere"});
  EXPECT_EQ(refused.exit_code, 6);
  EXPECT_THAT(refused.error, HasSubstr("sbatch: invalid partition specified: nowhere"));
  EXPECT_TRUE(read_submissions(place.results(), "").empty());
  const Finished large = place.run({"submit", "small.json", "--memory", "900G"});
  EXPECT_EQ(large.exit_code, 6);
  EXPECT_THAT(large.error, HasSubstr("Requested node configuration is not available"));
  EXPECT_FALSE(fs::exists(place.results() / "jobs" / "small") && !fs::is_empty(place.results() / "jobs" / "small"));
}

TEST_F(Cluster, WhatWasAcceptedIsCancelledWhenALaterPartIsRefused) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  fs::create_directories(place.folder() / "bin");
  const WithPath path(place.folder().string() + "/bin:" + std::getenv("PATH"));
  const fs::path shim = place.write("bin/sbatch", R"(#!/bin/bash
case "$*" in
  *seapile-ingest*) echo "sbatch: error: Batch job submission failed: Job violates accounting policy" >&2; exit 1;;
esac
PATH=)" + path.before() + R"( exec sbatch "$@"
)");
  fs::permissions(shim, fs::perms::owner_all);
  const Finished refused = place.run({"submit", "small.json"});
  EXPECT_EQ(refused.exit_code, 6);
  EXPECT_THAT(refused.error, HasSubstr("Job violates accounting policy; cancelled what was accepted before: "));
  const std::string ids = refused.error.substr(refused.error.rfind(": ") + 2);
  for (std::size_t begin = 0; begin < ids.size();) {
    const auto end = ids.find_first_of(",\n", begin);
    for (const SlurmTask& task : job_tasks(ids.substr(begin, end - begin))) EXPECT_EQ(task.state, "CANCELLED");
    begin = ids.find_first_of("0123456789", end);
  }
  EXPECT_TRUE(read_submissions(place.results(), "").empty());
  EXPECT_FALSE(fs::exists(place.results() / "cases")) << "on hold until all is accepted: none has begun";
}

TEST_F(Cluster, CancelTakesOutExactlyTheStudysJobs) {
  const Workplace place;
  place.write("one.json", small_study("one"));
  place.write("two.json", small_study("two"));
  ASSERT_EQ(place.run({"submit", "one.json", "--", "--begin=now+1hour"}).exit_code, 0);
  const Finished two = place.run({"submit", "two.json", "--set", "bed.seed=7", "--", "--begin=now+1hour"});
  ASSERT_EQ(two.exit_code, 0) << two.error;
  const Finished cancelled = place.run({"cancel", "one"});
  EXPECT_EQ(cancelled.exit_code, 0) << cancelled.error;
  EXPECT_THAT(cancelled.error, HasSubstr("cancelled 3 tasks of one"));
  EXPECT_TRUE(is_over(place, "one"));
  EXPECT_FALSE(is_over(place, "two"));
  for (const auto& [id, row] : jobs(place, "one")) EXPECT_EQ(row.at("state"), "cancelled") << row;
  const Finished again = place.run({"cancel", "one"});
  EXPECT_EQ(again.exit_code, 4) << again.error;
  EXPECT_EQ(place.run({"cancel", "two.json"}).exit_code, 0);
}

TEST_F(Cluster, WithoutAReachableSlurmEndsWithSix) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  {
    const WithPath path(place.folder().string());
    const Finished absent = place.run({"submit", "small.json"});
    EXPECT_EQ(absent.exit_code, 6);
    EXPECT_THAT(absent.error, HasSubstr("is not in PATH"));
    EXPECT_FALSE(fs::exists(place.results()));
  }
  ASSERT_EQ(place.run({"submit", "small.json", "--", "--begin=now+1hour"}).exit_code, 0);
  {
    const WithPath path(place.folder().string());
    EXPECT_EQ(place.run({"cancel", "small"}).exit_code, 6);
    EXPECT_EQ(place.run({"jobs", "small"}).exit_code, 6) << "not knowing is not having lost";
  }
  EXPECT_EQ(place.run({"cancel", "small"}).exit_code, 0);
}

TEST_F(Cluster, EveryWayToEndHasItsWord) {
  ASSERT_EQ(submitted.exit_code, 0) << submitted.error;
  ASSERT_EQ(newest(*endings, "endings").arrays.size(), 1u);
  ASSERT_TRUE(comes_true([] { return is_over(*endings, "endings"); })) << states_text(jobs(*endings, "endings"));
  const auto rows = jobs(*endings, "endings");
  const auto row = [&](int count) { return rows.at(id_by_count.at(count).substr(0, 10)); };
  EXPECT_EQ(row(200).at("state"), "done") << row(200);
  EXPECT_EQ(row(201).at("state"), "diverged") << row(201);
  EXPECT_EQ(row(202).at("state"), "failed") << row(202);
  EXPECT_THAT(row(202).at("detail"), HasSubstr("reading or writing failed"));
  EXPECT_EQ(row(40000).at("state"), "killed") << row(40000);
  EXPECT_THAT(row(40000).at("detail"), HasSubstr("SIGKILL"));
  EXPECT_EQ(row(40001).at("state"), "timed out") << row(40001);
  EXPECT_EQ(row(40001).at("detail"), "without a checkpoint");
  EXPECT_EQ(row(100000).at("state"), "over memory") << row(100000);

  // What Slurm knew was kept by the last job: the same is told when Slurm is gone.
  const WithPath path(endings->folder().string());
  EXPECT_EQ(jobs(*endings, "endings"), rows);
}

}  // namespace
}  // namespace seapile::cluster
