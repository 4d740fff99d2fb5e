// Declarations of equivalence as files of the store: sealed, never changed, and of no account when they are damaged.
#include "runner/store/equivalence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "runner/store/durable.h"
#include "runner/store/sealed_text.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using testing::HasSubstr;

Equivalence sample() {
  Equivalence one;
  one.kind = "drive";
  one.before = {{"grains", 2}, {"pile", 1}};
  one.now = {{"grains", 3}, {"pile", 1}, {"rest", 1}};
  one.case_id = std::string(60, '0') + "cafe";
  one.run = "0002";
  one.state_before = "0123456789abcdef";
  one.state_now = "fedcba9876543210";
  one.likeness = "tolerance";
  one.largest = 0.1 + 0.2;
  one.largest_of = "tip_resistance";
  one.tolerance = 0.5;
  one.date = "2026-01-02T03:04:05Z";
  one.version = "0.1.0";
  one.commit = "abc";
  one.dirty = true;
  return one;
}

struct Declarations : testing::Test {
  const Scratch scratch;
  const Path root = scratch.fresh("root");

  std::vector<Path> files() const { return entries(root / "equivalents"); }
  /// How many are read, and how many sentences there are about others.
  std::pair<std::size_t, std::size_t> counts() const {
    const Equivalences all = read_equivalences(root);
    return {all.declared.size(), all.left_out.size()};
  }
  using Counts = std::pair<std::size_t, std::size_t>;
};

TEST_F(Declarations, AreReadAsTheyWereWritten) {
  EXPECT_EQ(counts(), Counts(0, 0)) << "without a folder";
  EXPECT_TRUE(declare(root, sample()));
  const Equivalences all = read_equivalences(root);
  ASSERT_EQ(all.declared.size(), 1u);
  const Equivalence &read = all.declared[0], written = sample();
  EXPECT_EQ(read.kind, written.kind);
  EXPECT_TRUE(same_numerics(read.before, written.before));
  EXPECT_TRUE(same_numerics(read.now, written.now));
  EXPECT_EQ(read.case_id + read.run, written.case_id + written.run);
  EXPECT_EQ(read.state_before + read.state_now, written.state_before + written.state_now);
  EXPECT_EQ(read.likeness + read.largest_of, written.likeness + written.largest_of);
  EXPECT_EQ(read.largest, written.largest);
  EXPECT_EQ(read.tolerance, written.tolerance);
  EXPECT_EQ(read.date + read.version + read.commit, written.date + written.version + written.commit);
  EXPECT_TRUE(read.dirty);
  EXPECT_EQ(read.seal, seal_of(read_text(root / "equivalents" / read.file), read.file));
}

TEST_F(Declarations, TheFirstOfTwoThatSayTheSameStays) {
  EXPECT_TRUE(declare(root, sample()));
  const std::string before = read_text(files().at(0));
  Equivalence later = sample();
  later.date = "2027-01-02T03:04:05Z";
  std::swap(later.before[0], later.before[1]);
  EXPECT_FALSE(declare(root, later));
  ASSERT_EQ(files().size(), 1u);
  EXPECT_EQ(read_text(files()[0]), before);
  // A copy under another name declares nothing more.
  std::filesystem::copy_file(files()[0], root / "equivalents" / "copy.json");
  EXPECT_EQ(counts(), Counts(1, 0));
}

TEST_F(Declarations, OfAnotherKindOrOtherListsStandBesideEachOther) {
  EXPECT_TRUE(declare(root, sample()));
  Equivalence other = sample();
  other.kind = "bed";
  EXPECT_TRUE(declare(root, other));
  other.before[1].version = 7;
  EXPECT_TRUE(declare(root, other));
  EXPECT_EQ(files().size(), 3u);
  EXPECT_EQ(counts(), Counts(3, 0));
}

TEST_F(Declarations, ThatAreDamagedCountForNothingAndAreNamed) {
  declare(root, sample());
  const Path file = files().at(0);
  const std::string whole = read_text(file);
  const auto left_out_with = [&](const std::string& text) {
    std::ofstream(file) << text;
    const Equivalences all = read_equivalences(root);
    EXPECT_TRUE(all.declared.empty()) << text;
    return all.left_out.size() == 1 ? all.left_out[0] : "";
  };
  const auto changed = [&](const std::string& what, const std::string& by) {
    std::string text = whole;
    return text.replace(text.find(what), what.size(), by);
  };
  const auto resealed = [&](const std::string& what, const std::string& by) {
    std::string text = changed(what, by);
    text = text.substr(0, text.rfind(",\n  \"seal\"")) + "\n}";
    return with_seal(text);
  };
  EXPECT_THAT(left_out_with(""), HasSubstr(file.string()));
  EXPECT_THAT(left_out_with(whole.substr(0, whole.size() / 2)), HasSubstr("seal"));
  EXPECT_THAT(left_out_with(changed("\"tolerance\": 0.5", "\"tolerance\": 0.6")), HasSubstr("seal"));
  // Sealed, but no declaration that a probe makes.
  EXPECT_THAT(left_out_with(with_seal("{\n  \"a\": 1\n}")), HasSubstr("schema"));
  EXPECT_THAT(left_out_with(resealed("equivalence/1", "equivalence/2")), HasSubstr("equivalence/2"));
  EXPECT_THAT(left_out_with(resealed("\"drive\"", "\"pile\"")), HasSubstr("kind"));
  EXPECT_THAT(left_out_with(resealed("\"tolerance\": 0.5", "\"tolerance\": 0.1")), HasSubstr("tolerance"));
  EXPECT_THAT(left_out_with(resealed("\"tolerance\": 0.5", "\"tolerance\": null")), HasSubstr("type"));
  // A new declaration takes the place of one that is damaged.
  left_out_with("");
  EXPECT_TRUE(declare(root, sample()));
  EXPECT_EQ(counts(), Counts(1, 0));
}

TEST_F(Declarations, AFolderOfThatNameOrALockedOneIsNoCrash) {
  std::filesystem::create_directories(root / "equivalents" / "folder.json");
  EXPECT_EQ(counts(), Counts(0, 1));
  std::filesystem::remove_all(root / "equivalents");
  std::ofstream(root / "equivalents") << "a file";
  EXPECT_LE(read_equivalences(root).left_out.size(), 1u);
}

TEST(Equivalent, WordsNameWhatMovedTheCaseAndTheDistance) {
  EXPECT_EQ(in_words(sample()), "grains 2 -> 3, rest none -> 1, probe of case 0000000000 within 0.3 (tolerance 0.5)");
  Equivalence same = sample();
  same.likeness = "identical";
  EXPECT_THAT(in_words(same), HasSubstr("identical to the last bit"));
}

}  // namespace
}  // namespace seapile::store
