// Work in a child process: what crashes or hangs there ends there.
#include "solver/mesh/in_child.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/solver/mesh/children.h"

namespace seapile::mesh {
namespace {

using InChild = WithChildren;

TEST_F(InChild, AnAnswerOfAnyLengthComesWhole) {
  for (const std::size_t length : {0, 1, 65536, 3'000'001}) {
    const std::string text(length, 'x');
    const Ending ending = in_child([&] { return text; }, kForever);
    EXPECT_EQ(ending.trouble, "");
    EXPECT_TRUE(ending.answer == text) << length;
  }
}

TEST_F(InChild, WhatItDoesToMemoryIsLost) {
  int number = 0;
  EXPECT_EQ(in_child([&] { return std::to_string(++number); }, kForever).answer, "1");
  EXPECT_EQ(number, 0);
}

TEST_F(InChild, WhatIsThrownEndsTheChildAlone) {
  EXPECT_EQ(in_child([]() -> std::string { throw 1; }, kForever).trouble, "ended by signal " + std::to_string(SIGABRT));
  EXPECT_EQ(in_child([]() -> std::string { ::_exit(3); }, kForever).trouble, "ended with code 3");
}

TEST_F(InChild, WhatHangsIsKilledAfterItsTime) {
  const Ending ending = in_child(
      [] {
        hang();
        return std::string();
      },
      kShort);
  EXPECT_FALSE(ending.in_time);
  EXPECT_EQ(ending.trouble, "did not answer within 0.2 s");
}

TEST_F(InChild, TheParentsHandlersAreNotCalledAndRequestsToStopAreIgnored) {
  static volatile std::sig_atomic_t handled = 0;
  struct sigaction action = {}, before = {}, before_stop = {};
  action.sa_handler = [](int) { handled = 1; };
  ::sigaction(SIGUSR2, &action, &before);
  ::sigaction(SIGTERM, &action, &before_stop);
  const Ending stopped = in_child(
      [] {
        for (const int request : {SIGTERM, SIGINT, SIGHUP, SIGUSR1}) ::raise(request);
        return std::to_string(handled);
      },
      kForever);
  const Ending other = in_child([] { return std::to_string(::raise(SIGUSR2)); }, kForever);
  ::sigaction(SIGUSR2, &before, nullptr);
  ::sigaction(SIGTERM, &before_stop, nullptr);
  EXPECT_EQ(stopped.answer, "0");
  EXPECT_EQ(stopped.trouble, "");
  EXPECT_EQ(other.trouble, "ended by signal " + std::to_string(SIGUSR2));
}

TEST_F(InChild, AnInterruptedParentWaitsOn) {
  struct sigaction action = {}, before = {};
  action.sa_handler = [](int) {};
  ::sigaction(SIGUSR2, &action, &before);
  const pid_t parent = ::getpid();
  const Ending ending = in_child(
      [&] {
        for (int i = 0; i < 20; ++i) {
          ::kill(parent, SIGUSR2);
          ::usleep(1000);
        }
        return std::string("done");
      },
      kForever);
  ::sigaction(SIGUSR2, &before, nullptr);
  EXPECT_EQ(ending.answer, "done");
}

// A lock (flock) is held until the last copy of its descriptor is closed, and a pipe has no end before that.
TEST_F(InChild, NoDescriptorOfTheParentIsOpenInTheChild) {
  const int held = ::open(testing::TempDir().c_str(), O_RDONLY), high = ::dup2(held, 900);
  ASSERT_EQ(high, 900);
  const Ending ending = in_child(
      [] {
        int open = 0;
        for (int number = 0; number < 1024; ++number) open += ::fcntl(number, F_GETFD) >= 0 ? 1 : 0;
        return std::to_string(open);
      },
      kForever);
  EXPECT_EQ(ending.answer, "4") << "the three standard ones and the pipe";
  ::close(held);
  ::close(high);
}

// What the parent does at its end would be done twice, with the parent's files and its store.
TEST_F(InChild, ItDoesNothingOfWhatTheParentDoesAtItsEnd) {
  static std::atomic<int>* at_exit = nullptr;
  const Shared count;
  at_exit = &*count;
  std::atexit([] {
    if (at_exit) ++*at_exit;
  });
  in_child([] { return std::string(); }, kForever);
  EXPECT_EQ(*count, 0);
  at_exit = nullptr;
}

TEST_F(InChild, WhatItPrintsGoesNowhere) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  std::fputs("the parent's, not yet written out", stdout);
  in_child(
      [] {
        std::fputs("out", stdout);
        std::fputs("error", stderr);
        std::fflush(stdout);
        return std::string();
      },
      kForever);
  std::fflush(stdout);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "the parent's, not yet written out");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

// A hanging child would otherwise be there for ever. The one between is killed as a worker may be; its child becomes
// this process's (a subreaper).
TEST_F(InChild, AChildEndsWithItsParent) {
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  Shared hanging;
  const pid_t between = ::fork();
  ASSERT_GE(between, 0);
  if (between == 0) {
    in_child(
        [&] {
          *hanging = ::getpid();
          hang();
          return std::string();
        },
        kForever);
    ::_exit(0);
  }
  while (*hanging == 0) ::usleep(1000);
  ::kill(between, SIGKILL);
  EXPECT_EQ(::waitpid(between, nullptr, 0), between);
  int status = 0;
  pid_t ended = 0;
  for (int look = 0; look < 2000 && ended == 0; ++look) {
    ended = ::waitpid(*hanging, &status, WNOHANG);
    ::usleep(10'000);
  }
  EXPECT_EQ(ended, *hanging) << "it goes on without its parent";
  EXPECT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  if (ended == 0) {
    ::kill(*hanging, SIGKILL);
    ::waitpid(*hanging, nullptr, 0);
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

}  // namespace
}  // namespace seapile::mesh
