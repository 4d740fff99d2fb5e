// A disk that is really full: a small file system in memory, in a mount namespace of its own. Where that may not be
// made, a limit on the size of files stands in.
#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <functional>

#include "tests/fault/store_child.h"
#include "tests/fault/store_writer.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store::fault {
namespace {

using Path = std::filesystem::path;

Path home(const Path& root) { return case_folder(root, sample::drive_header().case_id); }

/// What went on in a child: 0 the worker got through, 1 it reported an error, 2 no file system could be made, 3 a
/// promise was broken.
enum Verdict { got_through, reported, not_possible, broken };

Verdict in_child(const std::function<Verdict()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      ::_exit(work());
    } catch (const std::exception& error) {
      std::fprintf(stderr, "%s\n", error.what());
    }
    ::_exit(broken);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? static_cast<Verdict>(WEXITSTATUS(status)) : broken;
}

/// Whatever calls itself complete is right; what was promised is there.
bool holds(const Path& root, const Ending& ending) {
  for (const std::string& run : complete_runs(home(root))) {
    const Path folder = home(root) / run;
    if (!verify(folder).empty()) return false;
    if (!sample::difference(read_series(folder), sample::records(0, kRecords)).empty()) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!sample::difference(read_frame(folder, k), frame(k)).empty()) return false;
    }
    return true;
  }
  if (ending.exit_code == 0) return false;
  std::size_t promised = 0;
  for (const std::string& promise : ending.promises) promised = std::stoul(promise.substr(promise.find(' ')));
  if (promised == 0) return true;
  const RunWriter again(home(root) / "0001", sample::drive_header());
  return again.resumable().records.size() >= promised && is_expected(again.resumable());
}

/// Runs the worker on a file system of so many kilobytes; then grows it and runs the worker again.
Verdict on_small_disk(const Path& place, int kilobytes) {
  return in_child([&] {
    const int flags = ::geteuid() == 0 ? CLONE_NEWNS : CLONE_NEWNS | CLONE_NEWUSER;
    if (::unshare(flags) != 0 || ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0) return not_possible;
    const std::string size = "size=" + std::to_string(kilobytes) + "k";
    if (::mount("none", place.c_str(), "tmpfs", 0, size.c_str()) != 0) return not_possible;
    const Path root = place / "root";
    std::filesystem::create_directory(root);
    const Path notes = place.string() + "_notes";  // What the worker says lies outside.
    const Ending ending = run_writer(root, {}, notes);
    if (::mount("none", place.c_str(), "tmpfs", MS_REMOUNT, "size=20m") != 0) return not_possible;
    const bool clean = ending.exit_code == 0 || (ending.exit_code >= kFirstError && ending.exit_code <= kLastError);
    if (!clean || !holds(root, ending)) return broken;
    const Ending after = run_writer(root, {}, notes);
    if (after.exit_code != 0 || !holds(root, after)) return broken;
    return ending.exit_code == 0 ? got_through : reported;
  });
}

/// Runs the worker with a limit on the size of each file, then without.
Verdict with_small_files(const Path& root, rlim_t bytes) {
  return in_child([&] {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    const rlim_t before = limit.rlim_cur;
    ::signal(SIGXFSZ, SIG_IGN);
    limit.rlim_cur = bytes;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const Ending ending = run_writer(root);
    limit.rlim_cur = before;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const bool clean = ending.exit_code == 0 || (ending.exit_code >= kFirstError && ending.exit_code <= kLastError);
    if (!clean || !holds(root, ending)) return broken;
    const Ending after = run_writer(root);
    if (after.exit_code != 0 || !holds(root, after)) return broken;
    return ending.exit_code == 0 ? got_through : reported;
  });
}

TEST(FullDisk, EndsInAClearErrorAndCostsNothingThatWasPromised) {
  const Scratch scratch;
  if (on_small_disk(scratch.fresh("try"), 20'000) == not_possible) GTEST_SKIP() << "no file system may be mounted";
  std::size_t errors = 0, successes = 0;
  for (int kilobytes = 4; kilobytes < 1500; kilobytes += kilobytes < 420 ? 11 : 400) {
    const Verdict verdict = on_small_disk(scratch.fresh("disk"), kilobytes);
    EXPECT_TRUE(verdict == got_through || verdict == reported) << kilobytes << " kB: " << verdict;
    ++(verdict == got_through ? successes : errors);
  }
  std::printf("full disk: %zu sizes ended in an error, %zu were enough\n", errors, successes);
  EXPECT_GT(errors, 10U);
  EXPECT_GT(successes, 2U);
}

TEST(SmallFiles, EndInAClearErrorAndCostNothingThatWasPromised) {
  const Scratch scratch;
  std::size_t errors = 0, successes = 0;
  for (rlim_t bytes = 500; bytes < 500'000; bytes += bytes / 4) {
    const Verdict verdict = with_small_files(scratch.fresh("root"), bytes);
    EXPECT_TRUE(verdict == got_through || verdict == reported) << bytes << " bytes: " << verdict;
    ++(verdict == got_through ? successes : errors);
  }
  EXPECT_GT(errors, 10U);
  EXPECT_GT(successes, 0U);
}

}  // namespace
}  // namespace seapile::store::fault
