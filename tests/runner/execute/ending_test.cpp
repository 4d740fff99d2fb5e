#include "runner/execute/ending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "runner/execute/exit_codes.h"

namespace seapile::execute {
namespace {

using testing::HasSubstr;

TEST(Ending, EveryCodeHasItsClass) {
  EXPECT_EQ(classify({kDone, 0, ""}), Verdict::completed);
  EXPECT_EQ(classify({kStoppedResumable, 0, ""}), Verdict::stopped);
  EXPECT_EQ(classify({kDiverged, 0, ""}), Verdict::diverged);
  EXPECT_EQ(classify({kClaimHeld, 0, ""}), Verdict::claimed);
  EXPECT_EQ(classify({kIoFailed, 0, ""}), Verdict::io);
  EXPECT_EQ(classify({kSyncFailed, 0, ""}), Verdict::io);
  for (const int code : {kBadRequest, kVerifyFailed, kInternalError, 1, 2, 47, 127, 255}) {
    EXPECT_EQ(classify({code, 0, ""}), Verdict::failed) << code;
  }
}

TEST(Ending, ASignalIsNoExitCode) {
  EXPECT_EQ(classify({0, SIGKILL, ""}), Verdict::killed);
  EXPECT_THAT(in_words({0, SIGSEGV, ""}), HasSubstr("SIGSEGV"));
  EXPECT_THAT(in_words({0, SIGKILL, ""}), HasSubstr("SIGKILL"));
}

TEST(Ending, OnlyWhatMayPassIsTriedAgain) {
  EXPECT_TRUE(worth_a_retry(Verdict::killed));
  EXPECT_TRUE(worth_a_retry(Verdict::io));
  for (const Verdict verdict :
       {Verdict::completed, Verdict::diverged, Verdict::stopped, Verdict::claimed, Verdict::failed}) {
    EXPECT_FALSE(worth_a_retry(verdict));
  }
}

TEST(Ending, TheWorkersSentenceIsPassedOn) {
  EXPECT_EQ(in_words({kIoFailed, 0, "cannot write x: No space left on device"}),
            "reading or writing failed (exit code 41): cannot write x: No space left on device");
  EXPECT_EQ(in_words({kDiverged, 0, "a grain left the box"}), "diverged: a grain left the box");
}

}  // namespace
}  // namespace seapile::execute
