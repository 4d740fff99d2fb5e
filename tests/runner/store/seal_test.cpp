#include "runner/store/seal.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>
#include <stdexcept>

#include "runner/store/run_folder.h"
#include "runner/store/sha256.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

void write_number(hdf5::FileWriter& writer, double value) {
  writer.dataset("/value", {1, 0}, std::vector<double>{value});
}

double read_number(const std::filesystem::path& file) {
  hdf5::FileReader reader(file);
  const double value = reader.read<double>("/value").at(0);
  reader.close();
  return value;
}

std::vector<std::string> names(const std::filesystem::path& folder) {
  std::vector<std::string> list;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) list.push_back(entry.path().filename());
  return list;
}

/// Runs `work` in a process that may write files of at most so many bytes. 0: it went through; 1: StoreError.
int in_small_disk(rlim_t bytes, const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{bytes, bytes};
    ::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      work();
    } catch (const StoreError&) {
      ::_exit(1);
    } catch (...) {
      ::_exit(2);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

TEST(Seal, PublishesTheFileAndNothingElse) {
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  seal(file, hdf5::Storage::packed, [](auto& writer) { write_number(writer, 7); });
  EXPECT_EQ(read_number(file), 7);
  EXPECT_EQ(names(scratch.path()), std::vector<std::string>{"file.h5"});
}

TEST(Seal, PublishesNothingWhenTheWriterGivesUp) {
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  seal(file, hdf5::Storage::plain, [](auto& writer) { write_number(writer, 7); });
  EXPECT_THROW(seal(file, hdf5::Storage::plain,
                    [](auto& writer) {
                      write_number(writer, 8);
                      throw std::runtime_error("gives up");
                    }),
               std::runtime_error);
  EXPECT_EQ(read_number(file), 7);
  EXPECT_EQ(names(scratch.path()), std::vector<std::string>{"file.h5"});
}

TEST(Seal, NothingIsPublishedWhenTheDiskIsFull) {
  const Scratch scratch;
  const auto file = scratch.path() / "file.h5";
  const std::vector<double> values(100'000, 0.1);
  const auto write = [&] {
    seal(file, hdf5::Storage::plain, [&](auto& writer) { writer.dataset("/value", {values.size(), 0}, values); });
  };
  for (const rlim_t bytes : {0, 1, 512, 4096, 100'000, 799'999, 800'000}) {
    EXPECT_EQ(in_small_disk(bytes, write), 1) << bytes;
    EXPECT_EQ(names(scratch.path()), std::vector<std::string>{}) << bytes;
  }
  EXPECT_EQ(in_small_disk(1'000'000, write), 0);
  EXPECT_EQ(names(scratch.path()), std::vector<std::string>{"file.h5"});
}

TEST(Seal, OfTheSameContentGivesTheSameFile) {
  const Scratch scratch;
  for (const char* name : {"a.h5", "b.h5"}) {
    seal(scratch.path() / name, hdf5::Storage::packed, [](auto& writer) {
      writer.dataset("/group/values", {1000, 2}, std::vector<double>(2000, 0.25));
      writer.attribute("/group", "units", "m");
    });
  }
  EXPECT_EQ(sha256_of_file(scratch.path() / "a.h5"), sha256_of_file(scratch.path() / "b.h5"));
}

TEST(Seal, RefusesAFolderThatIsNotThere) {
  EXPECT_THROW(seal("/nowhere/file.h5", hdf5::Storage::plain, [](auto& writer) { write_number(writer, 7); }),
               StoreError);
}

}  // namespace
}  // namespace seapile::store
