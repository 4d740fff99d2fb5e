#include "runner/execute/notes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>

namespace seapile::execute {
namespace {

namespace fs = std::filesystem;

struct NotesTest : testing::Test {
  fs::path folder = fs::path(testing::TempDir()) / ("notes_" + std::to_string(::getpid()));
  NotesTest() { fs::create_directories(folder); }
  ~NotesTest() override { fs::remove_all(folder); }
};

TEST_F(NotesTest, AreReadAsTheyWereWrittenAndAreGoneOnceRemoved) {
  EXPECT_FALSE(read_progress(folder));
  write_progress(folder, {0.25, 0.1, 12.5, 2, ""});
  write_failure(folder, {"failed", "killed by \xff"});
  const auto progress = read_progress(folder);
  ASSERT_TRUE(progress);
  EXPECT_EQ(progress->fraction, 0.25);
  EXPECT_EQ(progress->start_fraction, 0.1);
  EXPECT_EQ(progress->elapsed, 12.5);
  EXPECT_EQ(progress->threads, 2);
  EXPECT_NE(progress->host, "");
  ASSERT_TRUE(read_failure(folder));
  remove_notes(folder);
  EXPECT_FALSE(read_progress(folder));
  EXPECT_FALSE(read_failure(folder));
}

TEST_F(NotesTest, HalfOfOneIsNone) {
  std::ofstream(folder / "progress.json") << R"({"fraction": 0.)";
  EXPECT_FALSE(read_progress(folder));
}

TEST_F(NotesTest, OneThatCannotBeWrittenDoesNoHarm) {
  write_progress(folder / "missing", {});
  EXPECT_FALSE(fs::exists(folder / "missing"));
}

TEST_F(NotesTest, TheLastLinesOfALogAreThoseAtItsEnd) {
  EXPECT_TRUE(last_log_lines(folder, 2).empty());
  std::ofstream(folder / "log.txt") << "one\ntwo\nthree\n";
  EXPECT_THAT(last_log_lines(folder, 2), testing::ElementsAre("two", "three"));
  EXPECT_EQ(last_log_lines(folder, 9).size(), 3U);
}

}  // namespace
}  // namespace seapile::execute
