#include "runner/present/bytes.h"

#include <gtest/gtest.h>

namespace seapile::present {
namespace {

TEST(Bytes, AreWrittenWithThreeDigitsAndTheLargestPrefix) {
  EXPECT_EQ(bytes_text(0), "0 B");
  EXPECT_EQ(bytes_text(1023), "1023 B");
  EXPECT_EQ(bytes_text(1024), "1 KiB");
  EXPECT_EQ(bytes_text(1536), "1.5 KiB");
  EXPECT_EQ(bytes_text(std::uint64_t{5} << 40), "5 TiB");
}

TEST(Bytes, AreReadWithAndWithoutAPrefix) {
  EXPECT_EQ(bytes_from("0"), 0U);
  EXPECT_EQ(bytes_from("123"), 123U);
  EXPECT_EQ(bytes_from("1.5K"), 1536U);
  EXPECT_EQ(bytes_from("500M"), std::uint64_t{500} << 20);
  EXPECT_EQ(bytes_from("50GB"), std::uint64_t{50} << 30);
  EXPECT_EQ(bytes_from("12B"), 12U);
}

TEST(Bytes, WhatIsNoSizeIsNotRead) {
  for (const char* text : {"", "G", "-1", "50X", "5 G", "nan", "inf", "1e30", "5GG", "five"})
    EXPECT_FALSE(bytes_from(text).has_value()) << text;
}

}  // namespace
}  // namespace seapile::present
