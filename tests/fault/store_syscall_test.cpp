// A fault at every system call with which the store changes a file, one at a time, until the worker gets through.
//
// What is promised: a worker that ends with 0 has left the right result; a checkpoint that was announced is there; a
// run that has a manifest is whole; and the same command, given again, ends with the result of an undisturbed run.
//
// The kernel of a process that dies keeps what was written and renamed; only a machine that dies loses what was not
// synced. The modes "power" and "eio" lose it.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "runner/store/manifest.h"
#include "tests/fault/store_child.h"
#include "tests/fault/store_writer.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store::fault {
namespace {

/// What an undisturbed worker leaves: the files' hashes, and what the catalogue answers.
struct Outcome {
  std::vector<FileEntry> files;
  Table table;
};

std::filesystem::path home(const std::filesystem::path& root) {
  return case_folder(root, sample::drive_header().case_id);
}

Outcome outcome_of(const std::filesystem::path& root) {
  return {read_manifest(home(root) / "0001").files,
          Catalogue::open_read_only(root).query("faults", {"pile.tip = flat"}, {})};
}

bool operator==(const FileEntry& a, const FileEntry& b) {
  return a.path == b.path && a.bytes == b.bytes && a.sha256 == b.sha256;
}

/// Zeros in bytes of an HDF5 file that nobody reads (what it notes of its own free space) are not seen when it is read
/// back, and do no harm: its checksum is another one, its content the same.
void expect_same(const Outcome& found, const Outcome& undisturbed, const std::string& mode) {
  EXPECT_TRUE(mode == "silent" ||
              std::ranges::equal(found.files, undisturbed.files, [](const auto& a, const auto& b) { return a == b; }));
  EXPECT_EQ(found.table.columns, undisturbed.table.columns);
  EXPECT_EQ(found.table.rows, undisturbed.table.rows);
}

/// Everything that a reader takes for a result must be whole and right.
void expect_complete_runs_to_be_right(const std::filesystem::path& root) {
  for (const std::string& run : complete_runs(home(root))) {
    const std::filesystem::path folder = home(root) / run;
    EXPECT_EQ(verify(folder), std::vector<std::string>{});
    EXPECT_EQ(sample::difference(read_series(folder), sample::records(0, kRecords)), "");
    ASSERT_EQ(frame_count(folder), 3U);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(sample::difference(read_frame(folder, k), frame(k)), "");
  }
}

/// What was announced must be there.
void expect_promises_to_hold(const std::filesystem::path& root, const Ending& ending) {
  std::size_t checkpoint = 0;
  for (const std::string& promise : ending.promises) {
    if (promise.starts_with("checkpoint ")) checkpoint = std::stoul(promise.substr(11));
    if (promise == "finished") {
      EXPECT_EQ(complete_runs(home(root)).size(), 1U);
    }
    if (promise == "ingested") {
      EXPECT_EQ(Catalogue::open_read_only(root).runs("", {}).size(), 1U);
    }
  }
  if (!complete_runs(home(root)).empty() || checkpoint == 0) return;
  const RunWriter again(home(root) / next_run(home(root), true), sample::drive_header());
  EXPECT_GE(again.resumable().records.size(), checkpoint);
  EXPECT_TRUE(is_expected(again.resumable()));
}

bool is_clean(const Ending& ending, const std::string& mode) {
  if (mode == "kill" || mode == "torn" || mode == "power") return ending.signal == SIGKILL || ending.exit_code == 0;
  if (mode == "short") return ending.exit_code == 0;
  return ending.exit_code == 0 || (ending.exit_code >= kFirstError && ending.exit_code <= kLastError);
}

std::size_t number_from(const char* variable, std::size_t otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtoul(text, nullptr, 10);
}

/// Every n-th call only, so that the test takes a minute; SEAPILE_FAULT_EVERY=1 is the full loop. It can be shared out:
/// every second call from the first, and every second from the second (SEAPILE_FAULT_FIRST).
std::size_t stride() { return number_from("SEAPILE_FAULT_EVERY", 11); }

class SystemCall : public testing::TestWithParam<const char*> {};

TEST_P(SystemCall, ThatFailsCostsNothingThatWasPromised) {
  const std::string mode = GetParam();
  const Scratch scratch;
  const std::filesystem::path reference = scratch.fresh("reference");
  ASSERT_EQ(run_writer(reference).exit_code, 0);
  const Outcome undisturbed = outcome_of(reference);

  std::size_t at = number_from("SEAPILE_FAULT_FIRST", 1), faults = 0, got_through = 0;
  for (;; at += stride(), ++faults) {
    const std::filesystem::path root = scratch.fresh("root"), mark = scratch.path() / "mark";
    std::filesystem::remove(mark);
    const Ending ending = run_writer(root, with_fault(mode, at, root, mark));
    SCOPED_TRACE(mode + " at call " + std::to_string(at) + ", exit code " + std::to_string(ending.exit_code) +
                 ", signal " + std::to_string(ending.signal) + ": " + ending.complaint);
    if (!std::filesystem::exists(mark)) {
      EXPECT_EQ(ending.exit_code, 0);
      break;
    }
    EXPECT_TRUE(is_clean(ending, mode));
    expect_complete_runs_to_be_right(root);
    expect_promises_to_hold(root, ending);
    if (ending.exit_code == 0) {
      ++got_through;
      expect_same(outcome_of(root), undisturbed, mode);
    }
    EXPECT_EQ(run_writer(root).exit_code, 0);
    expect_complete_runs_to_be_right(root);
    expect_same(outcome_of(root), undisturbed, mode);
    if (HasFailure()) break;
  }
  std::printf("%s: %zu faults, %zu of them survived without an error, the rest reported; none lost or wrong\n",
              mode.c_str(), faults, got_through);
  EXPECT_GT(at, 600U) << "the shim does not see the worker's calls";
}

INSTANTIATE_TEST_SUITE_P(Store, SystemCall,
                         testing::Values("kill", "torn", "enospc", "full", "eio", "short", "silent", "power"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace
}  // namespace seapile::store::fault
