#include "runner/store/durable.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <set>

#include "runner/store/run_folder.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

std::size_t entries(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(Durable, ATextReadsBackAsWrittenAndLeavesNothingBeside) {
  const Scratch scratch;
  const std::string text = "first line\nsecond\0line\n";
  write_text(scratch.path() / "text", "before");
  write_text(scratch.path() / "text", text);
  EXPECT_EQ(read_text(scratch.path() / "text"), text);
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(Durable, ATextThatCannotBeWrittenLeavesTheOneBefore) {
  const Scratch scratch;
  std::filesystem::create_directory(scratch.path() / "text");  // A rename onto a folder fails.
  EXPECT_THROW(write_text(scratch.path() / "text", "text"), StoreError);
  EXPECT_TRUE(std::filesystem::is_directory(scratch.path() / "text"));
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(Durable, NeitherAPipeNorADeviceGivesWayToAFile) {
  const Scratch scratch;
  ASSERT_EQ(::mkfifo((scratch.path() / "text").c_str(), 0600), 0);
  EXPECT_THROW(write_text(scratch.path() / "text", "text"), StoreError);
  EXPECT_TRUE(std::filesystem::is_fifo(scratch.path() / "text"));
  EXPECT_EQ(entries(scratch.path()), 1U);
}

TEST(Durable, TemporaryNamesAreNeverTheSame) {
  std::set<std::filesystem::path> names;
  for (int i = 0; i < 1000; ++i) names.insert(temporary_name("/a/series.h5"));
  EXPECT_EQ(names.size(), 1000U);
  EXPECT_TRUE(is_temporary(*names.begin()));
  EXPECT_FALSE(is_temporary("/a/series.h5"));
  EXPECT_EQ(names.begin()->parent_path(), "/a");
}

TEST(Durable, FoldersAreMadeAllTheWay) {
  const Scratch scratch;
  make_folder(scratch.path() / "a" / "b" / "c");
  make_folder(scratch.path() / "a" / "b" / "c");
  EXPECT_TRUE(std::filesystem::is_directory(scratch.path() / "a" / "b" / "c"));
  write_text(scratch.path() / "file", "");
  EXPECT_THROW(make_folder(scratch.path() / "file"), StoreError);
}

TEST(Durable, AFolderOrAPipeIsNotReadAsAFile) {
  const Scratch scratch;
  EXPECT_THROW(read_text(scratch.path()), StoreError);
  ASSERT_EQ(::mkfifo((scratch.path() / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(read_text(scratch.path() / "pipe"), StoreError);
}

TEST(Lock, IsHeldByOneAndFreedByClosing) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path() / "lock";
  {
    const auto held = try_lock(file);
    ASSERT_TRUE(held.has_value());
    EXPECT_FALSE(try_lock(file).has_value());
  }
  EXPECT_TRUE(try_lock(file).has_value());
  EXPECT_TRUE(std::filesystem::exists(file));
}

TEST(Lock, DiesWithItsProcess) {
  const Scratch scratch;
  const std::filesystem::path file = scratch.path() / "lock";
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const auto held = try_lock(file);
    [[maybe_unused]] const auto told = ::write(ready[1], held ? "1" : "0", 1);
    ::pause();
    ::_exit(0);
  }
  char answer = '0';
  ASSERT_EQ(::read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, '1');
  EXPECT_FALSE(try_lock(file).has_value());
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  EXPECT_TRUE(try_lock(file).has_value());
  ::close(ready[0]);
  ::close(ready[1]);
}

TEST(Lock, IsNotTakenThroughASymbolicLink) {
  const Scratch scratch;
  std::filesystem::create_symlink("/etc/passwd", scratch.path() / "lock");
  EXPECT_THROW(try_lock(scratch.path() / "lock"), StoreError);
}

TEST(Lock, IsNotInheritedByAProgramThatIsStarted) {
  const Scratch scratch;
  const auto held = try_lock(scratch.path() / "lock");
  ASSERT_TRUE(held.has_value());
  EXPECT_NE(::fcntl(held->get(), F_GETFD) & FD_CLOEXEC, 0);
}

}  // namespace
}  // namespace seapile::store
