#include "runner/execute/pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <deque>
#include <set>

#include "runner/execute/exit_codes.h"
#include "tests/runner/execute/fake_study.h"

namespace seapile::execute {
namespace {

using fake::FakeDisk;
using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// Workers that end when and how the test says. Endings are by case id, one per start; without one a worker completes
/// its case on the fake disk.
class FakeWorkers : public Workers {
 public:
  FakeWorkers(FakeDisk& disk, const Plan& plan) : disk_(disk), plan_(plan) {}

  struct Start {
    std::string id;
    int threads;
    friend bool operator==(const Start&, const Start&) = default;
  };
  std::map<std::string, std::deque<Ending>> endings;
  std::vector<Start> starts;
  std::map<int, int> signal_after;  ///< before the n-th wait (from 1), the runner receives this signal
  std::size_t most_at_once = 0;
  std::vector<std::size_t> running_at_start;  ///< with the one that starts
  int most_cores = 0;
  bool asked = false, killed = false;

  void start(std::size_t task, const Task& what, int threads) override {
    starts.push_back({what.id, threads});
    running_.push_back({task, what.id, threads});
    most_at_once = std::max(most_at_once, running_.size());
    running_at_start.push_back(running_.size());
    int cores = 0;
    for (const auto& worker : running_) cores += worker.threads;
    most_cores = std::max(most_cores, cores);
  }

  std::optional<Event> wait(std::chrono::milliseconds) override {
    if (++waits_ > 5000) throw std::logic_error("the pool never ends");
    if (const auto signal = signal_after.find(waits_); signal != signal_after.end()) return Signalled{signal->second};
    if (running_.empty()) return std::nullopt;
    const Running worker = running_.front();
    running_.pop_front();
    if (killed) return Ended{worker.task, {0, SIGKILL, ""}};
    if (asked) return Ended{worker.task, {kStoppedResumable, 0, ""}};
    auto& planned = endings[worker.id];
    if (!planned.empty()) {
      const Ending ending = planned.front();
      planned.pop_front();
      if (ending.exit_code != 0 || ending.signal != 0) return Ended{worker.task, ending};
    }
    if (plan_.tasks[worker.task].kind == Kind::bed) {
      disk_.complete_bed(worker.id);
    } else {
      disk_.complete_drive(worker.id);
    }
    return Ended{worker.task, {}};
  }

  void ask_to_stop() override { asked = true; }
  void kill() override { killed = true; }

 private:
  struct Running {
    std::size_t task;
    std::string id;
    int threads;
  };
  FakeDisk& disk_;
  const Plan& plan_;
  std::deque<Running> running_;
  int waits_ = 0;
};

struct PoolTest : testing::Test {
  FakeDisk disk;
  study::Study study = fake::make_study({{"flat", "bed"}, {"cone", "bed"}});
  Plan plan;
  Sharing sharing{2, {}, {}};
  std::set<std::string> claimed;
  double peak_mb = 0;  ///< of every case that has run
  std::vector<std::string> told;
  std::optional<FakeWorkers> workers;

  void prepare() {
    plan = make_plan(study, fake::numerics, disk.look(), {});
    workers.emplace(disk, plan);
  }
  Summary go() {
    if (!workers) prepare();
    Watch watch;
    watch.started = [](std::size_t, int) {};
    watch.advanced = [](std::size_t, double) {};
    watch.changed = [this](std::size_t task, State state, const std::string& why) {
      if (state != State::ready) told.push_back(plan.tasks[task].id + ": " + why);
    };
    watch.retried = [this](std::size_t task, const std::string&) { told.push_back(plan.tasks[task].id + " again"); };
    watch.signalled = [](int) {};
    watch.tick = [] {};
    const StoreView store = {disk.look(), [this](const std::string& id) { return claimed.contains(id); },
                             [this](const std::string&) { return peak_mb; }};
    return carry_out(plan, study, fake::numerics, sharing, *workers, store, watch);
  }
  State state(const Summary& summary, const std::string& id) const {
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
      if (plan.tasks[i].id == id) return summary.states[i];
    }
    throw std::out_of_range(id);
  }
  std::vector<std::string> started() const {
    std::vector<std::string> ids;
    for (const auto& start : workers->starts) ids.push_back(start.id);
    return ids;
  }
};

TEST_F(PoolTest, ADriveStartsAfterItsBedAndTheCoresAreShared) {
  const Summary summary = go();
  EXPECT_THAT(workers->starts,
              ElementsAre(FakeWorkers::Start{"bed", 2}, FakeWorkers::Start{"flat", 1}, FakeWorkers::Start{"cone", 1}));
  EXPECT_THAT(summary.states, Each(State::completed));
  EXPECT_EQ(exit_code(summary), kDone);
}

TEST_F(PoolTest, WhatIsFreshIsNotStarted) {
  disk.complete_bed("bed");
  disk.complete_drive("flat");
  go();
  EXPECT_THAT(started(), ElementsAre("cone"));
}

TEST_F(PoolTest, NeverMoreThreadsThanCores) {
  study = fake::make_study({{"a", "x"}, {"b", "x"}, {"c", "y"}, {"d", "z"}, {"e", "z"}});
  for (const int cores : {1, 2, 3, 4, 7, 64}) {
    disk.histories.clear();
    workers.reset();
    sharing = {cores, {}, {}};
    const Summary summary = go();
    EXPECT_THAT(summary.states, Each(State::completed));
    EXPECT_LE(workers->most_cores, cores);
  }
}

TEST_F(PoolTest, JobsAndThreadsOfTheUserAreKept) {
  study = fake::make_study({{"a", "x"}, {"b", "x"}, {"c", "x"}, {"d", "x"}});
  sharing = {8, 2, 3};
  go();
  EXPECT_LE(workers->most_at_once, 2u);
  for (const auto& start : workers->starts) EXPECT_EQ(start.threads, 3);
}

TEST(Sharing, LeftoverCoresBecomeThreads) {
  EXPECT_EQ(threads_for_next({2, {}, {}}, 0, 0, 1, 64), 2);  // a bed alone
  EXPECT_EQ(threads_for_next({2, {}, {}}, 0, 0, 2, 64), 1);  // two drives
  EXPECT_EQ(threads_for_next({8, {}, {}}, 0, 0, 3, 64), 2);  // 2 + 3 + 3
  EXPECT_EQ(threads_for_next({8, {}, {}}, 1, 2, 2, 64), 3);
  EXPECT_EQ(threads_for_next({8, {}, {}}, 2, 5, 1, 64), 3);
  EXPECT_EQ(threads_for_next({2, {}, {}}, 0, 0, 100, 64), 1);
  EXPECT_EQ(threads_for_next({2, {}, {}}, 2, 2, 100, 64), 0);
  EXPECT_EQ(threads_for_next({8, 2, {}}, 0, 0, 100, 64), 4);  // two jobs share eight cores
  EXPECT_EQ(threads_for_next({8, 2, {}}, 2, 8, 100, 64), 0);
  EXPECT_EQ(threads_for_next({8, {}, 3}, 2, 6, 5, 64), 0);  // two cores are left, three are asked for
  EXPECT_EQ(threads_for_next({8, {}, {}}, 0, 0, 0, 64), 0);
}

TEST(Sharing, ASmallCaseGetsNoThreadsThatWouldOnlyWait) {
  EXPECT_EQ(threads_for_next({8, {}, {}}, 0, 0, 1, 1), 1);
  EXPECT_EQ(threads_for_next({8, {}, {}}, 0, 0, 1, 3), 3);
  EXPECT_EQ(threads_for_next({8, {}, 4}, 0, 0, 1, 1), 4);  // unless the user says so
}

TEST(Sharing, MoreThreadsThanCoresAreRefused) {
  EXPECT_EQ(objection({4, 2, 2}), "");
  EXPECT_EQ(objection({4, {}, 4}), "");
  EXPECT_THAT(objection({4, 2, 3}), HasSubstr("need 6 cores, there are 4"));
  EXPECT_NE(objection({4, {}, 5}), "");
  EXPECT_NE(objection({4, 5, {}}), "");
}

TEST(Sharing, MoreThreadsThanCoresAreHadWhereTheyAreWanted) {
  const Sharing sharing{.cores = 2, .jobs = 8, .oversubscribe = true};
  EXPECT_EQ(objection(sharing), "");
  EXPECT_EQ(threads_for_next(sharing, 7, 7, 100, 1), 1);
  EXPECT_EQ(threads_for_next(sharing, 8, 8, 100, 1), 0);
}

TEST(Sharing, MemoryIsNeverPromisedTwice) {
  const Sharing sharing{.cores = 8, .memory_mb = 1000};
  EXPECT_TRUE(memory_suffices(sharing, 600, 400));
  EXPECT_FALSE(memory_suffices(sharing, 600, 401));
  EXPECT_TRUE(memory_suffices(sharing, 0, 5000)) << "what needs more than there is runs by itself";
  EXPECT_TRUE(memory_suffices({.cores = 8}, 600, 1e9));
}

/// Fifty beds and two drives on each.
study::Study wide_study() {
  std::vector<std::pair<std::string, std::string>> cases;
  for (int bed = 0; bed < 50; ++bed) {
    const std::string name = "bed" + std::to_string(bed);
    for (const char* tip : {"flat", "cone"}) cases.emplace_back(tip + std::to_string(bed), name);
  }
  return fake::make_study(cases);
}

TEST_F(PoolTest, CasesThatDoNotFitIntoMemoryTogetherRunOneAfterAnother) {
  study = wide_study();
  sharing = {.cores = 8, .memory_mb = 1000};
  prepare();
  for (Task& task : plan.tasks) task.memory_mb = 400;
  go();
  EXPECT_EQ(workers->most_at_once, 2U);
  EXPECT_EQ(workers->starts.size(), 150U);
}

TEST_F(PoolTest, WhatEndedTellsWhatItsKindNeeds) {
  study = wide_study();
  sharing = {.cores = 4, .memory_mb = 1000};
  peak_mb = 600;
  go();
  EXPECT_EQ(workers->starts.size(), 150U);
  // The first four begin before anything is known of beds, and so do the first drives.
  std::vector<std::size_t> later(workers->running_at_start.end() - 40, workers->running_at_start.end());
  EXPECT_THAT(later, Each(1U));
}

TEST_F(PoolTest, EveryCaseOfManyIsDoneExactlyOnce) {
  study = wide_study();
  sharing = {.cores = 2, .jobs = 8, .oversubscribe = true};
  go();
  EXPECT_EQ(workers->most_at_once, 8U);
  std::vector<std::string> ids = started();
  EXPECT_EQ(ids.size(), 150U);
  std::ranges::sort(ids);
  EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

TEST_F(PoolTest, AFailedCaseDoesNotStopTheStudy) {
  prepare();
  workers->endings["flat"] = {{kInternalError, 0, "out of luck"}};
  const Summary summary = go();
  EXPECT_EQ(state(summary, "flat"), State::failed);
  EXPECT_EQ(state(summary, "cone"), State::completed);
  EXPECT_THAT(told, Contains(HasSubstr("out of luck")));
  EXPECT_EQ(exit_code(summary), kSomeCasesFailed);
}

TEST_F(PoolTest, AKilledWorkerIsStartedOnceMore) {
  prepare();
  workers->endings["flat"] = {{0, SIGSEGV, ""}};
  const Summary summary = go();
  EXPECT_EQ(state(summary, "flat"), State::completed);
  EXPECT_THAT(started(), ElementsAre("bed", "flat", "cone", "flat"));
  EXPECT_THAT(told, Contains("flat again"));
  EXPECT_EQ(exit_code(summary), kDone);
}

TEST_F(PoolTest, AWorkerKilledTwiceHasFailedAndTheSignalIsNamed) {
  prepare();
  workers->endings["flat"] = {{0, SIGSEGV, ""}, {0, SIGKILL, ""}};
  const Summary summary = go();
  EXPECT_EQ(state(summary, "flat"), State::failed);
  EXPECT_THAT(told, Contains(HasSubstr("killed by SIGKILL")));
  EXPECT_EQ(exit_code(summary), kSomeCasesFailed);
}

TEST_F(PoolTest, AFailedDiskIsTriedOnceMore) {
  prepare();
  workers->endings["flat"] = {{kIoFailed, 0, "disk full"}};
  EXPECT_EQ(state(go(), "flat"), State::completed);
}

TEST_F(PoolTest, ADivergedCaseIsNotTriedAgain) {
  prepare();
  workers->endings["flat"] = {{kDiverged, 0, "a grain left the box"}};
  const Summary summary = go();
  EXPECT_EQ(state(summary, "flat"), State::diverged);
  EXPECT_EQ(std::ranges::count(started(), "flat"), 1);
  EXPECT_EQ(exit_code(summary), kSomeCasesFailed);
}

TEST_F(PoolTest, DrivesOfABedThatFailedAreNotStarted) {
  prepare();
  workers->endings["bed"] = {{kDiverged, 0, "not settled"}};
  const Summary summary = go();
  EXPECT_THAT(started(), ElementsAre("bed"));
  EXPECT_EQ(state(summary, "flat"), State::blocked);
  EXPECT_EQ(state(summary, "cone"), State::blocked);
  EXPECT_EQ(exit_code(summary), kSomeCasesFailed);
}

TEST_F(PoolTest, DrivesOfABedThatWasStoppedAreLeftForTheNextTime) {
  prepare();
  workers->endings["bed"] = {{kStoppedResumable, 0, ""}};
  const Summary summary = go();
  EXPECT_THAT(summary.states, Each(State::stopped));
  EXPECT_EQ(exit_code(summary), kStoppedResumable);
}

TEST_F(PoolTest, ACaseThatAnotherRunnerFinishesIsNotDoneTwice) {
  prepare();
  disk.complete_bed("bed");
  workers->endings["flat"] = {{kClaimHeld, 0, ""}};
  claimed.insert("flat");
  // The other runner finishes it and lets go while this one waits.
  int looks = 0;
  const auto look = disk.look();
  Watch watch{[](auto...) {}, [](auto...) {}, [](auto...) {}, [](auto...) {}, [](auto...) {}, [] {}};
  const StoreView store = {look, [&](const std::string& id) {
                             if (++looks == 3) {
                               disk.complete_drive("flat");
                               claimed.clear();
                             }
                             return claimed.contains(id);
                           }};
  const Summary summary = carry_out(plan, study, fake::numerics, sharing, *workers, store, watch);
  EXPECT_EQ(looks, 3);
  EXPECT_EQ(state(summary, "flat"), State::completed);
  EXPECT_EQ(std::ranges::count(started(), "flat"), 1);
  EXPECT_EQ(exit_code(summary), kDone);
}

TEST_F(PoolTest, ACaseThatAnotherRunnerSawDivergeIsNotTriedAgain) {
  prepare();
  disk.complete_bed("bed");
  workers->endings["flat"] = {{kClaimHeld, 0, ""}};
  disk.complete_drive("flat");  // as the other runner leaves it, before this one looks again
  disk.histories["flat"].past->outcome = simulation::Outcome::diverged;
  disk.histories["flat"].past->reason = "overlap";
  const Summary summary = go();
  EXPECT_EQ(state(summary, "flat"), State::diverged);
  EXPECT_EQ(std::ranges::count(started(), "flat"), 1);
  EXPECT_EQ(exit_code(summary), kSomeCasesFailed);
  // What had diverged before it was planned is tried once more.
  workers.reset();
  EXPECT_EQ(state(go(), "flat"), State::completed);
}

TEST_F(PoolTest, ACaseThatAnotherRunnerGaveUpIsTakenOver) {
  prepare();
  workers->endings["flat"] = {{kClaimHeld, 0, ""}};
  const Summary summary = go();  // nobody holds the claim any more, and nothing was completed
  EXPECT_EQ(state(summary, "flat"), State::completed);
  EXPECT_EQ(std::ranges::count(started(), "flat"), 2);
}

TEST_F(PoolTest, ASignalStopsTheWorkersAndStartsNoOthers) {
  for (const int signal : {SIGINT, SIGTERM}) {
    disk.histories.clear();
    prepare();
    workers->signal_after = {{1, signal}};
    const Summary summary = go();
    EXPECT_TRUE(workers->asked);
    EXPECT_FALSE(workers->killed);
    EXPECT_THAT(started(), ElementsAre("bed"));
    EXPECT_THAT(summary.states, Each(State::stopped));
    EXPECT_EQ(exit_code(summary), kStoppedResumable);
  }
}

TEST_F(PoolTest, ASecondSignalKillsTheWorkersWithoutCallingThemFailed) {
  prepare();
  workers->signal_after = {{1, SIGINT}, {2, SIGINT}};
  const Summary summary = go();
  EXPECT_TRUE(workers->killed);
  EXPECT_THAT(summary.states, Each(State::stopped));
  EXPECT_EQ(exit_code(summary), kInterrupted);
}

TEST_F(PoolTest, AProcessThatCannotBeStartedIsAFailedCase) {
  struct NoProcesses : FakeWorkers {
    using FakeWorkers::FakeWorkers;
    void start(std::size_t, const Task&, int) override {
      throw std::system_error(EAGAIN, std::generic_category(), "fork");
    }
  };
  plan = make_plan(study, fake::numerics, disk.look(), {});
  NoProcesses none(disk, plan);
  Watch watch{[](auto...) {}, [](auto...) {}, [](auto...) {}, [](auto...) {}, [](auto...) {}, [] {}};
  const Summary summary =
      carry_out(plan, study, fake::numerics, sharing, none, {disk.look(), [](const auto&) { return false; }}, watch);
  EXPECT_EQ(state(summary, "bed"), State::failed);
  EXPECT_EQ(state(summary, "flat"), State::blocked);
}

TEST(ExitCode, AnyFailureOutweighsAStop) {
  EXPECT_EQ(exit_code({{State::fresh, State::completed}, {}, 0}), kDone);
  EXPECT_EQ(exit_code({{State::completed, State::stopped}, {}, 0}), kStoppedResumable);
  EXPECT_EQ(exit_code({{State::stopped, State::failed}, {}, 0}), kSomeCasesFailed);
}

}  // namespace
}  // namespace seapile::execute
