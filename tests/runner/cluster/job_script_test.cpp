// Time limits as Slurm takes them, and the job script as a shell takes it.
#include <gtest/gtest.h>

#include "runner/cluster/job_script.h"
#include "runner/cluster/scheduler.h"

namespace seapile::cluster {
namespace {

TEST(JobScript, EveryFormOfATimeLimitIsRead) {
  EXPECT_EQ(limit_seconds("90"), 90 * 60);
  EXPECT_EQ(limit_seconds("30:15"), 30 * 60 + 15);
  EXPECT_EQ(limit_seconds("02:00:00"), 7200);
  EXPECT_EQ(limit_seconds("1-12"), 36 * 3600);
  EXPECT_EQ(limit_seconds("1-12:30"), 36 * 3600 + 1800);
  EXPECT_EQ(limit_seconds("1-00:00:01"), 86401);
}

TEST(JobScript, WhatIsNoTimeLimitIsNone) {
  for (const char* text : {"", "soon", "1:2:3:4", "-5", "1-", "-", "1-2:3:4:5", "2 h", "::", "1e3", "0"})
    EXPECT_EQ(limit_seconds(text), 0) << '"' << text << '"';
}

TEST(JobScript, ThereIsTimeToSealACheckpointBeforeEveryLimit) {
  for (const long limit : {60L, 120L, 300L, 3600L, 86400L}) {
    EXPECT_GT(lead_seconds(limit), 0) << limit;
    EXPECT_LT(lead_seconds(limit), limit) << limit;
  }
  EXPECT_GE(lead_seconds(3600), 120);
}

TEST(JobScript, AShellReadsItWhateverTheSitePutsInFront) {
  Engine site;
  site.modules = {"hdf5/1.14", "a module; with 'odd' $names"};
  site.setup = {"export OMP_PROC_BIND=true", "ulimit -c 0"};
  for (const std::string& script : {job_script({}, site), ingest_script(site)}) {
    const Answer answer = ask("bash", {"-n", "-c", script});
    EXPECT_EQ(answer.exit_code, 0) << answer.error << script;
    EXPECT_EQ(answer.error, "");
  }
}

}  // namespace
}  // namespace seapile::cluster
