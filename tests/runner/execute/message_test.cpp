#include "runner/execute/message.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seapile::execute {
namespace {

TEST(Message, ComesBackAsItWasSent) {
  const auto started = decode(encode(Started{"0007", true}));
  ASSERT_TRUE(started);
  EXPECT_EQ(std::get<Started>(*started).run, "0007");
  EXPECT_TRUE(std::get<Started>(*started).resumed);
  const auto advanced = decode(encode(Advanced{0.375}));
  ASSERT_TRUE(advanced);
  EXPECT_EQ(std::get<Advanced>(*advanced).fraction, 0.375);
  const auto trouble = decode(encode(Trouble{"line one\nline \"two\""}));
  ASSERT_TRUE(trouble);
  EXPECT_EQ(std::get<Trouble>(*trouble).sentence, "line one\nline \"two\"");
}

TEST(Message, IsOneLineWhateverItHolds) {
  EXPECT_EQ(encode(Trouble{"a\nb"}).find('\n'), std::string::npos);
  EXPECT_NO_THROW(encode(Trouble{"a path with \xff\xfe in it"}));
}

TEST(Message, WhatIsNoneIsIgnored) {
  for (const char* line : {"", "hello", "{", "[]", "3", "{\"run\": 3}", "{\"fraction\": null}", "{\"other\": 1}"}) {
    EXPECT_FALSE(decode(line)) << line;
  }
  EXPECT_FALSE(decode(encode(Advanced{std::nan("")})));
}

}  // namespace
}  // namespace seapile::execute
