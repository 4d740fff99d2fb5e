#include "runner/store/run_folder.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

const std::string kId(64, 'a');

TEST(Claim, IsHeldByOne) {
  const Scratch scratch;
  const Path folder = case_folder(scratch.path(), kId);
  {
    const auto claim = Claim::take(folder);
    ASSERT_TRUE(claim.has_value());
    EXPECT_FALSE(Claim::take(folder).has_value());
  }
  EXPECT_TRUE(Claim::take(folder).has_value());
}

TEST(RunFolder, LiesBelowItsCase) {
  EXPECT_EQ(case_folder("/store", kId), Path("/store/cases") / kId);
  for (const char* id : {"", "..", "abc", "../../etc/passwd"}) {
    EXPECT_THROW(case_folder("/store", id), std::invalid_argument) << id;
  }
}

TEST(NextRun, GoesOnWithTheNewestFolderOnlyWhenItHasNoManifest) {
  const Scratch scratch;
  const Path folder = scratch.path() / "case";
  EXPECT_EQ(next_run(folder, true), "0001");
  std::filesystem::create_directories(folder / "0001");
  EXPECT_EQ(next_run(folder, true), "0001");
  EXPECT_EQ(next_run(folder, false), "0002");
  std::filesystem::create_directories(folder / "0002");
  write_text(folder / "0002" / "manifest.json", "{}");
  // 0001 was given up when 0002 was begun.
  EXPECT_EQ(next_run(folder, true), "0003");
  std::filesystem::create_directories(folder / "10000");
  EXPECT_EQ(next_run(folder, true), "10000");
  EXPECT_EQ(next_run(folder, false), "10001");
}

TEST(NextRun, TakesOnlyFoldersWithANumberForRuns) {
  const Scratch scratch;
  for (const char* name : {"1", "abcd", "0000", "12345678901", "segment"}) {
    std::filesystem::create_directories(scratch.path() / name);
  }
  write_text(scratch.path() / "0007", "");
  std::filesystem::create_directory_symlink("/tmp", scratch.path() / "0008");
  EXPECT_EQ(next_run(scratch.path(), true), "0001");
  EXPECT_TRUE(complete_runs(scratch.path()).empty());
}

class CompleteRun : public testing::Test {
 protected:
  Scratch scratch_;
  sample::Written run_ = sample::write(scratch_.path());
};

TEST_F(CompleteRun, IsListedAndVerifies) {
  EXPECT_EQ(complete_runs(run_.drive.parent_path()), std::vector<std::string>{"0001"});
  EXPECT_EQ(verify(run_.drive), std::vector<std::string>{});
  EXPECT_EQ(verify(run_.bed), std::vector<std::string>{});
}

TEST_F(CompleteRun, ReadsBackBitForBit) {
  EXPECT_EQ(sample::difference(read_series(run_.drive), sample::records(0, 20)), "");
  ASSERT_EQ(frame_count(run_.drive), 2U);
  for (const std::size_t k : {0, 1}) EXPECT_EQ(sample::difference(read_frame(run_.drive, k), sample::frame(k)), "");
  EXPECT_THROW(read_frame(run_.drive, 2), std::out_of_range);
  EXPECT_EQ(sample::difference(read_bed(run_.bed), sample::bed()), "");
  EXPECT_EQ(sample::difference(read_series(run_.bed), sample::bed().records), "");
  EXPECT_EQ(frame_count(run_.bed), 0U);
}

TEST_F(CompleteRun, IsReadThroughAPathThatEndsInASlash) {
  EXPECT_EQ(read_manifest(run_.drive / "").run, "0001");
  EXPECT_EQ(read_series(run_.drive / "").size(), 20U);
}

TEST_F(CompleteRun, IsRefusedInThePlaceOfAnother) {
  const Path other = case_folder(scratch_.path(), kId) / "0001";
  std::filesystem::create_directories(other.parent_path());
  std::filesystem::copy(run_.drive, other);
  EXPECT_THROW(read_manifest(other), StoreError);
  const Path next = run_.drive.parent_path() / "0002";
  std::filesystem::copy(run_.drive, next);
  EXPECT_THROW(read_manifest(next), StoreError);
  std::filesystem::copy(run_.drive, scratch_.path() / "copy");
  EXPECT_EQ(verify(scratch_.path() / "copy"), std::vector<std::string>{});
}

TEST_F(CompleteRun, WithTheFileOfAnotherRunIsNotRead) {
  std::filesystem::copy_file(run_.bed / "bed.h5", run_.drive / "series.h5",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_THROW(read_series(run_.drive), StoreError);
  EXPECT_EQ(verify(run_.drive).size(), 1U);
}

TEST_F(CompleteRun, SaysWhichFileIsMissingShortOrChanged) {
  std::filesystem::remove(run_.drive / "grains.xdmf");
  std::filesystem::resize_file(run_.drive / "series.h5", 1000);
  {
    std::fstream file(run_.drive / "fields.vtkhdf", std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(5000);
    file.put('x').put('y');
  }
  const std::vector<std::string> found = verify(run_.drive);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_NE(found[0].find("fields.vtkhdf has another SHA-256"), std::string::npos);
  EXPECT_NE(found[1].find("grains.xdmf: No such file"), std::string::npos);
  EXPECT_NE(found[2].find("series.h5 has 1000 bytes instead of"), std::string::npos);
}

TEST_F(CompleteRun, HasNoManifestWithoutItsSeal) {
  const std::string text = [&] {
    std::ifstream in(run_.drive / "manifest.json");
    return std::string(std::istreambuf_iterator<char>(in), {});
  }();
  std::string other = text;
  other.replace(other.find("81234.5"), 7, "91234.5");
  for (const std::string& damaged : {other, text.substr(0, text.size() / 2), std::string(), std::string("{}"),
                                     text + " ", std::string(200'000, '[')}) {
    write_text(run_.drive / "manifest.json", damaged);
    EXPECT_THROW(read_manifest(run_.drive), StoreError);
  }
  write_text(run_.drive / "manifest.json", text);
  EXPECT_EQ(read_manifest(run_.drive).records, 20U);
}

}  // namespace
}  // namespace seapile::store
