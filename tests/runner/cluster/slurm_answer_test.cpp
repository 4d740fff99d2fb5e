// What Slurm says of jobs, read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runner/cluster/scheduler.h"
#include "runner/cluster/slurm.h"

namespace seapile::cluster {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(SlurmAnswer, ArrayExpressionsNameEachIndex) {
  EXPECT_THAT(array_indices("4"), ElementsAre(4));
  EXPECT_THAT(array_indices("0-3,7%2"), ElementsAre(0, 1, 2, 3, 7));
  EXPECT_THAT(array_indices("1-9:4"), ElementsAre(1, 5, 9));
  EXPECT_THAT(array_indices("2,5-6"), ElementsAre(2, 5, 6));
  EXPECT_THAT(array_indices(""), IsEmpty());
  EXPECT_THAT(array_indices("N/A"), IsEmpty());
}

TEST(SlurmAnswer, APendingRangeIsOneEntryPerTask) {
  const auto tasks = parse_tasks(
      "JobId=12 ArrayJobId=12 ArrayTaskId=2-3%1 JobName=a JobState=PENDING Reason=JobArrayTaskLimit Restarts=0 "
      "ExitCode=0:0\n"
      "JobId=13 ArrayJobId=12 ArrayTaskId=0 JobName=a JobState=FAILED Reason=NonZeroExitCode Restarts=2 ExitCode=7:0\n"
      "JobId=14 ArrayJobId=12 ArrayTaskId=1 JobName=a JobState=FAILED Reason=None Restarts=0 ExitCode=0:9\n"
      "JobId=20 JobName=ingest JobState=COMPLETED Reason=None Restarts=0 ExitCode=0:0\n"
      "a line that is none of a job\n");
  ASSERT_EQ(tasks.size(), 5U);
  EXPECT_EQ(tasks[0].task, 2);
  EXPECT_EQ(tasks[1].task, 3);
  EXPECT_EQ(tasks[1].reason, "JobArrayTaskLimit");
  EXPECT_EQ(tasks[2].job, "12");
  EXPECT_EQ(tasks[2].exit_code, 7);
  EXPECT_EQ(tasks[2].restarts, 2);
  EXPECT_EQ(tasks[3].signal, 9);
  EXPECT_EQ(tasks[3].reason, "");
  EXPECT_FALSE(tasks[4].task.has_value());
}

TEST(SlurmAnswer, OnlyWhatCanStillDoSomethingIsLive) {
  for (const char* state : {"PENDING", "RUNNING", "COMPLETING", "SUSPENDED", "REQUEUED"})
    EXPECT_TRUE(is_live({"1", 0, state, ""})) << state;
  for (const char* state : {"COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL", "OUT_OF_MEMORY", ""})
    EXPECT_FALSE(is_live({"1", 0, state, ""})) << state;
}

TEST(SlurmAnswer, AComplaintIsOneLineWithoutItsProgram) {
  EXPECT_EQ(complaint("sbatch", {1, "", "sbatch: error: Batch job submission failed: Invalid account\n"}),
            "sbatch: Batch job submission failed: Invalid account");
  EXPECT_EQ(complaint("sbatch", {1, "", "sbatch: error: one\nsbatch: two\n"}), "sbatch: one; two");
  EXPECT_EQ(complaint("sbatch", {7, "", ""}), "sbatch: ended with exit code 7");
}

TEST(SlurmAnswer, AProgramThatIsNotThereIsAnErrorOfTheScheduler) {
  EXPECT_THROW(ask("no_such_program_of_slurm", {}), SchedulerError);
}

}  // namespace
}  // namespace seapile::cluster
