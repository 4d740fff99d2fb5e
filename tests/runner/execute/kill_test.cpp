// What is left when processes are killed: kill -9 of workers and of the runner at random moments, stops, two runners.
//
// SEAPILE_KILLS sets how many workers and how many runners are killed (default 10), SEAPILE_SEED when. Only deaths
// count that came before the process had ended by itself.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "tests/runner/commands/program.h"

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;
using commands::content;
using commands::Finished;
using commands::small_study;
using commands::wait_for;
using commands::Workplace;
using testing::AnyOf;
using testing::Contains;
using testing::HasSubstr;
using namespace std::chrono_literals;

// A checkpoint at every record, and few enough of them.
const std::vector<std::string> kCommand = {"small.json", "--checkpoint", "0", "--set", "record.travel=0.002"};

int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : otherwise;
}

/// Processes that work in a place: the runner and its workers, whoever their parent is now.
std::vector<pid_t> processes_in(const Workplace& place) {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::error_code gone;
    if (fs::read_symlink(entry.path() / "cwd", gone) == place.folder()) found.push_back(std::stoi(name));
  }
  return found;
}

std::vector<pid_t> workers_of(const Workplace& place, pid_t runner) {
  std::vector<pid_t> workers = processes_in(place);
  std::erase(workers, runner);
  return workers;
}

/// True once no process works there any more.
bool deserted(const Workplace& place) {
  for (int i = 0; i < 500; ++i) {
    if (processes_in(place).empty()) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

std::vector<fs::path> manifests(const Workplace& place) {
  std::vector<fs::path> found;
  if (!fs::exists(place.results())) return found;
  for (const auto& entry : fs::recursive_directory_iterator(place.results())) {
    if (entry.path().filename() == "manifest.json") found.push_back(entry.path());
  }
  return found;
}

/// Size and time of every file below the results.
auto files(const Workplace& place) {
  std::map<fs::path, std::pair<std::uintmax_t, fs::file_time_type>> found;
  std::error_code changing;
  for (fs::recursive_directory_iterator entry(place.results(), changing), end; entry != end && !changing;
       entry.increment(changing)) {
    std::error_code gone;
    if (entry->is_regular_file(gone)) found[entry->path()] = {entry->file_size(gone), entry->last_write_time(gone)};
  }
  return found;
}

/// Waits until so many files of that name are somewhere below the results.
bool appears(const Workplace& place, const std::string& name, int count = 1) {
  for (int i = 0; i < 60'000; ++i) {
    int found = 0;
    std::error_code changing;
    for (fs::recursive_directory_iterator entry(place.results(), changing), end; entry != end && !changing;
         entry.increment(changing)) {
      if (entry->path().filename() == name && ++found == count) return true;
    }
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// Waits until the program has written a word to standard error.
bool says(const Workplace& place, const std::string& word) {
  for (int i = 0; i < 60'000; ++i) {
    if (content(place.folder() / "error").find(word) != std::string::npos) return true;
    std::this_thread::sleep_for(1ms);
  }
  return false;
}

/// State hash by case id, and of drives the checksums of all records and frames. A bed's file holds what it cost.
std::map<std::string, std::string> hashes(const Workplace& place) {
  std::map<std::string, std::string> result;
  for (const fs::path& file : manifests(place)) {
    const auto manifest = nlohmann::json::parse(content(file));
    std::string& text = result[file.parent_path().parent_path().filename().string()];
    text = manifest.at("result").at("state_hash").dump();
    if (manifest.at("kind") == "drive") text += manifest.at("files").dump();
  }
  return result;
}

int attempts(const Workplace& place) {
  int most = 0;
  for (const fs::path& file : manifests(place)) {
    most = std::max(most, nlohmann::json::parse(content(file)).at("provenance").at("attempts").get<int>());
  }
  return most;
}

/// The manifests of complete runs, by their place.
std::map<fs::path, std::string> sealed_runs(const Workplace& place) {
  std::map<fs::path, std::string> texts;
  for (const fs::path& file : manifests(place)) texts[file] = content(file);
  return texts;
}

/// Whatever happened: what is listed is whole.
void expect_only_whole_runs(const Workplace& place) {
  const Finished verified = place.run({"verify"});
  EXPECT_THAT(verified.exit_code, AnyOf(0, 4)) << verified.out << verified.error;
  const Finished listed = place.run({"query", "--format", "json"});
  if (listed.exit_code != 0) return;  // killed before the first case was listed
  for (const auto& row : nlohmann::json::parse(listed.out).at("rows")) {
    EXPECT_EQ(row.at("outcome"), "completed");
    EXPECT_EQ(place.run({"show", row.at("case")}).exit_code, 0);
  }
}

struct KillTest : testing::Test {
  static void SetUpTestSuite() {
    undisturbed = new Workplace;
    undisturbed->write("small.json", small_study("small"));
    const auto start = std::chrono::steady_clock::now();
    const Finished finished = undisturbed->run(kCommand);
    duration = std::chrono::steady_clock::now() - start;
    ASSERT_EQ(finished.exit_code, 0) << finished.error;
    expected = hashes(*undisturbed);
    ASSERT_EQ(expected.size(), 3u);
  }
  static void TearDownTestSuite() { delete undisturbed; }

  /// A moment of the study, as a random part of what it takes undisturbed.
  std::chrono::duration<double> random_moment() {
    return duration * std::uniform_real_distribution<double>(0, 1.1)(random);
  }

  /// The machine has become faster than it was: moments come earlier from now on.
  static void missed() { duration *= 0.9; }

  void expect_finished_like_undisturbed(const Workplace& place) {
    EXPECT_EQ(hashes(place), expected);
    EXPECT_EQ(manifests(place).size(), expected.size()) << "a case was done twice";
    expect_only_whole_runs(place);
    const Finished again = place.run(kCommand);
    EXPECT_EQ(again.exit_code, 0);
    EXPECT_THAT(again.error, HasSubstr("nothing to run"));
  }

  const int kills = number_from("SEAPILE_KILLS", 10);
  std::mt19937 random{static_cast<unsigned>(number_from("SEAPILE_SEED", 1))};
  static Workplace* undisturbed;
  static std::chrono::duration<double> duration;
  static std::map<std::string, std::string> expected;
};
Workplace* KillTest::undisturbed;
std::chrono::duration<double> KillTest::duration;
std::map<std::string, std::string> KillTest::expected;

TEST_F(KillTest, AKilledWorkerIsContinuedToTheSameBits) {
  int tried = 0, killed = 0, continued = 0;
  for (; killed < kills && tried < 3 * kills; ++tried) {
    const Workplace place;
    place.write("small.json", small_study("small"));
    const pid_t runner = place.start(kCommand);
    std::this_thread::sleep_for(random_moment());
    const auto workers = workers_of(place, runner);
    if (!workers.empty()) ::kill(workers[random() % workers.size()], SIGKILL);
    EXPECT_EQ(wait_for(runner), 0) << content(place.folder() / "error");
    EXPECT_TRUE(deserted(place));
    // A worker that had ended already is not killed any more: the runner says how it ended.
    if (content(place.folder() / "error").find("killed by SIGKILL") != std::string::npos) {
      ++killed;
      continued += attempts(place) > 1 ? 1 : 0;
    } else {
      missed();
    }
    expect_finished_like_undisturbed(place);
  }
  std::printf(
      "worker: %d killed in %d studies, the others had none at work or one that ended first; "
      "%d of the killed were gone on with as a second attempt\n",
      killed, tried, continued);
  EXPECT_EQ(killed, kills) << "too few workers were met";
}

TEST_F(KillTest, AKilledRunnerLeavesNoWorkerAndTheSameCommandFinishes) {
  int tried = 0, killed = 0;
  while (killed < kills && tried < 3 * kills) {
    const Workplace place;
    place.write("small.json", small_study("small"));
    std::map<fs::path, std::string> sealed;
    for (int death = 0; death < 3; ++death, ++tried) {
      const pid_t runner = place.start(kCommand);
      std::this_thread::sleep_for(random_moment() / 2);
      ::kill(runner, SIGKILL);
      if (wait_for(runner) == -SIGKILL)
        ++killed;
      else
        missed();
      EXPECT_TRUE(deserted(place)) << "a worker outlived its runner";
      expect_only_whole_runs(place);
      sealed.merge(sealed_runs(place));
    }
    const Finished finished = place.run(kCommand);
    EXPECT_EQ(finished.exit_code, 0) << finished.error;
    expect_finished_like_undisturbed(place);
    const auto found = sealed_runs(place);
    for (const auto& run : sealed) EXPECT_THAT(found, Contains(run)) << "a sealed run was lost";
  }
  std::printf("runner: %d killed in %d starts, the others had ended first\n", killed, tried);
  EXPECT_GE(killed, kills) << "too few runners were met";
}

// A worker that goes on ends soon, at the first message that nobody reads: only what it writes until then tells.
TEST_F(KillTest, AWorkerWritesNothingOnceItsRunnerIsDead) {
  for (int i = 0; i < 5; ++i) {
    const Workplace place;
    place.write("small.json", small_study("small"));
    const pid_t runner = place.start(kCommand);
    ASSERT_TRUE(appears(place, "a.h5"));
    ::kill(runner, SIGKILL);
    ASSERT_EQ(wait_for(runner), -SIGKILL);
    const auto at_death = files(place);
    EXPECT_TRUE(deserted(place));
    std::vector<std::pair<fs::path, std::pair<std::uintmax_t, fs::file_time_type>>> changed;
    std::ranges::set_symmetric_difference(at_death, files(place), std::back_inserter(changed));
    // The system call that the worker was in may end: a rename takes a name from one file and gives it to another.
    EXPECT_LE(changed.size(), 3U) << "a worker went on without its runner";
  }
}

TEST_F(KillTest, AStoppedStudyIsContinuedFromItsCheckpoints) {
  for (const auto& [signal, code] : {std::pair(SIGINT, 75), std::pair(SIGTERM, 75)}) {
    const Workplace place;
    place.write("small.json", small_study("small"));
    for (int stop = 0; stop < 3; ++stop) {
      const pid_t runner = place.start(kCommand);
      ASSERT_TRUE(appears(place, "b.h5"));
      ASSERT_TRUE(says(place, "started"));
      ::kill(runner, signal);
      EXPECT_EQ(wait_for(runner), code) << content(place.folder() / "error");
      EXPECT_THAT(content(place.folder() / "error"), HasSubstr("the same command continues"));
      EXPECT_TRUE(deserted(place));
      expect_only_whole_runs(place);
    }
    const Finished finished = place.run(kCommand);
    EXPECT_EQ(finished.exit_code, 0) << finished.error;
    EXPECT_THAT(finished.error, HasSubstr("was interrupted after a checkpoint"));
    expect_finished_like_undisturbed(place);
    EXPECT_GT(attempts(place), 1);
  }
}

TEST_F(KillTest, AStopSealsACheckpointWhereNoneWasDue) {
  std::vector<std::string> command = kCommand;
  command[2] = "3600";
  const Workplace place;
  place.write("small.json", small_study("small"));
  const pid_t runner = place.start(command);
  ASSERT_TRUE(appears(place, "log.txt", 2));  // The bed, which has no checkpoint, is done; a drive is at work.
  ::kill(runner, SIGTERM);
  EXPECT_EQ(wait_for(runner), 75) << content(place.folder() / "error");
  EXPECT_TRUE(appears(place, "a.h5"));
  EXPECT_EQ(place.run(kCommand).exit_code, 0);
  expect_finished_like_undisturbed(place);
}

TEST_F(KillTest, ASecondInterruptDoesNotWait) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const pid_t runner = place.start(kCommand);
  ASSERT_TRUE(appears(place, "a.h5"));
  // Workers that never come to their next checkpoint.
  for (const pid_t worker : workers_of(place, runner)) ::kill(worker, SIGSTOP);
  ::kill(runner, SIGINT);
  ASSERT_TRUE(says(place, "seal a checkpoint"));
  ::kill(runner, SIGINT);
  bool alone = false;
  for (int i = 0; i < 1000 && !alone; ++i) {
    std::this_thread::sleep_for(10ms);
    alone = workers_of(place, runner).empty();
  }
  EXPECT_TRUE(alone) << "the second interrupt killed no worker";
  for (const pid_t worker : workers_of(place, runner)) ::kill(worker, SIGCONT);
  EXPECT_EQ(wait_for(runner), 130);
  EXPECT_TRUE(deserted(place));
  expect_only_whole_runs(place);
  EXPECT_EQ(place.run(kCommand).exit_code, 0);
  expect_finished_like_undisturbed(place);
}

TEST_F(KillTest, AWorkerThatIsAskedToStopSealsACheckpointAndTheRunnerSaysSo) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const pid_t runner = place.start(kCommand);
  ASSERT_TRUE(appears(place, "a.h5"));
  for (const pid_t worker : workers_of(place, runner)) ::kill(worker, SIGUSR1);
  EXPECT_EQ(wait_for(runner), 75) << content(place.folder() / "error");
  EXPECT_THAT(content(place.folder() / "error"), HasSubstr("stopped at a checkpoint"));
  EXPECT_EQ(place.run(kCommand).exit_code, 0);
  expect_finished_like_undisturbed(place);
}

TEST_F(KillTest, TwoRunnersDoEveryCaseOnce) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const pid_t first = place.start(kCommand), second = place.start(kCommand);
  EXPECT_EQ(wait_for(first), 0);
  EXPECT_EQ(wait_for(second), 0);
  expect_finished_like_undisturbed(place);
}

}  // namespace
}  // namespace seapile::execute
