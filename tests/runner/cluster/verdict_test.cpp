// What became of a submitted case, from every kind of evidence.
#include <gtest/gtest.h>

#include "runner/cluster/verdict.h"
#include "runner/execute/exit_codes.h"

namespace seapile::cluster {
namespace {

SlurmTask task(const std::string& state, int signal = 0, int restarts = 0) {
  return {"12", 0, state, "Resources", 0, signal, restarts};
}

Evidence of(const std::string& state, bool started = true) {
  Evidence evidence;
  evidence.started = started;
  evidence.task = task(state);
  return evidence;
}

JobWord state(const Evidence& evidence) { return judge(evidence).state; }

TEST(JobVerdicts, ASealedRunOutweighsWhateverSlurmSays) {
  for (const char* said : {"FAILED", "TIMEOUT", "CANCELLED", "RUNNING", "PENDING"}) {
    Evidence evidence = of(said);
    evidence.sealed = true;
    evidence.ending = ScriptEnding{1, 0, "", false};
    EXPECT_EQ(state(evidence), JobWord::done) << said;
    evidence.diverged = "energy grew";
    EXPECT_EQ(judge(evidence), (JobVerdict{JobWord::diverged, "energy grew"})) << said;
  }
}

TEST(JobVerdicts, ALiveTaskIsQueuedRunningOrRequeued) {
  EXPECT_EQ(judge(of("PENDING", false)), (JobVerdict{JobWord::queued, "Resources"}));
  Evidence again = of("PENDING");
  again.task->restarts = 1;
  EXPECT_EQ(state(again), JobWord::requeued);
  EXPECT_EQ(state(of("RUNNING")), JobWord::running);
  EXPECT_EQ(state(of("RUNNING", false)), JobWord::queued);  // another case of its task has its turn
  Evidence ended = of("RUNNING");
  ended.ending = ScriptEnding{execute::kIoFailed, 0, "", false};
  EXPECT_EQ(state(ended), JobWord::failed);
  ended.ending = ScriptEnding{execute::kStoppedResumable, 0, "USR1", true};
  EXPECT_EQ(state(ended), JobWord::running);  // about to be put back
}

TEST(JobVerdicts, WhatSlurmEndedIsNamedByItsCause) {
  EXPECT_EQ(state(of("TIMEOUT")), JobWord::timed_out);
  EXPECT_EQ(state(of("DEADLINE")), JobWord::timed_out);
  EXPECT_EQ(state(of("OUT_OF_MEMORY")), JobWord::over_memory);
  EXPECT_EQ(state(of("CANCELLED")), JobWord::cancelled);
  EXPECT_EQ(state(of("CANCELLED", false)), JobWord::cancelled);
  EXPECT_EQ(state(of("NODE_FAIL")), JobWord::killed);
  Evidence memory = of("FAILED");
  memory.memory_exceeded = true;
  memory.ending = ScriptEnding{0, 9, "", false};
  EXPECT_EQ(state(memory), JobWord::over_memory);
  Evidence killed = of("FAILED");
  killed.task->signal = 9;
  EXPECT_EQ(state(killed), JobWord::killed);
}

TEST(JobVerdicts, TheScriptsWordCountsWhereSlurmDidNothing) {
  Evidence evidence = of("COMPLETED");
  evidence.ending = ScriptEnding{0, 9, "", false};
  EXPECT_EQ(state(evidence), JobWord::killed);
  evidence.ending = ScriptEnding{execute::kStoppedResumable, 0, "USR1", true};
  EXPECT_EQ(judge(evidence), (JobVerdict{JobWord::timed_out, "a checkpoint is kept"}));
  evidence.ending = ScriptEnding{execute::kStoppedResumable, 0, "TERM", false};
  EXPECT_EQ(judge(evidence), (JobVerdict{JobWord::stopped, "without a checkpoint"}));
  evidence.ending = ScriptEnding{execute::kBedMissing, 0, "", false};
  EXPECT_EQ(state(evidence), JobWord::not_run);
  evidence.ending = ScriptEnding{execute::kDiverged, 0, "", false};
  EXPECT_EQ(state(evidence), JobWord::diverged);
  evidence.ending = ScriptEnding{};
  EXPECT_EQ(state(evidence), JobWord::done);
}

TEST(JobVerdicts, WhatNobodyKnowsOfIsLostAndNeverDone) {
  EXPECT_EQ(state({}), JobWord::lost);
  EXPECT_EQ(state(of("COMPLETED")), JobWord::lost);
  EXPECT_EQ(state(of("FAILED", false)), JobWord::not_run);
}

TEST(JobVerdicts, EveryStateHasAWordThatIsReadBack) {
  for (int i = 0; i <= static_cast<int>(JobWord::lost); ++i) {
    const auto job = static_cast<JobWord>(i);
    EXPECT_EQ(job_word(word(job)), job);
    EXPECT_EQ(is_final(job), i > static_cast<int>(JobWord::requeued));
  }
  EXPECT_FALSE(job_word("nonsense").has_value());
}

}  // namespace
}  // namespace seapile::cluster
