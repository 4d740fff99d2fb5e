#include "runner/store/sha256.h"

#include <gtest/gtest.h>

#include "runner/store/run_folder.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

// FIPS 180-4's examples.
TEST(Sha256, IsThatOfTheStandard) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256(std::string(1'000'000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, OfAFileIsThatOfItsBytes) {
  const Scratch scratch;
  const std::string text(3'000'001, 'x');
  write_text(scratch.path() / "file", text);
  EXPECT_EQ(sha256_of_file(scratch.path() / "file"), sha256(text));
}

TEST(Sha256, OfAMissingFileIsAnErrorWithItsName) {
  try {
    sha256_of_file("/nowhere/at all");
    FAIL();
  } catch (const StoreError& error) {
    EXPECT_EQ(error.kind, StoreError::Kind::io);
    EXPECT_STREQ(error.what(), "cannot open /nowhere/at all: No such file or directory");
  }
}

}  // namespace
}  // namespace seapile::store
