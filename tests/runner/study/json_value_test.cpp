#include "runner/study/json_value.h"

#include <gtest/gtest.h>

namespace seapile::study {
namespace {

Value good(std::string_view bytes) {
  base::Problems problems;
  Value value = read_json(bytes, "", problems);
  EXPECT_TRUE(problems.empty()) << problems[0].what;
  return value;
}

TEST(JsonValue, EveryValueKnowsItsPlace) {
  const Value value = good(R"({"a": [1, {"b/c": {"~": "x"}}], "": 2})");
  EXPECT_EQ(pointer(value.place), "");
  EXPECT_EQ(pointer(value.find("a")->items[0].place), "/a/0");
  EXPECT_EQ(pointer(value.find("a")->items[1].find("b/c")->find("~")->place), "/a/1/b~1c/~0");
  EXPECT_EQ(pointer(value.find("")->place), "/");
}

TEST(JsonValue, MembersKeepTheOrderTheyAreWrittenIn) {
  EXPECT_EQ(good(R"({"zeta": 1, "alpha": 2, "mid": 3})").keys, (std::vector<std::string>{"zeta", "alpha", "mid"}));
}

TEST(JsonValue, NumbersAreTheNearestDoubles) {
  EXPECT_EQ(good("0.1").number, 0.1);
  EXPECT_EQ(good("1e3").number, 1000);
  EXPECT_EQ(good("-0.0").number, 0);
  EXPECT_EQ(good("0e5").number, 0);
  EXPECT_EQ(good("0.000e-999").number, 0);
  EXPECT_EQ(good("2.2250738585072014e-308").number, 2.2250738585072014e-308);
  EXPECT_EQ(good("1.7976931348623157e308").number, 1.7976931348623157e308);
  EXPECT_EQ(good("9007199254740992").number, 9007199254740992.0);
  EXPECT_EQ(good("-9007199254740992").number, -9007199254740992.0);
}

TEST(JsonValue, EscapesAndOtherAlphabetsAreText) {
  EXPECT_EQ(good(R"("\u00e4 \"q\" \\ \/ 橋 \ud83d\ude00")").text, "ä \"q\" \\ / 橋 😀");
}

TEST(JsonValue, SeveralProblemsAreCollectedWhileTheTextCanBeTakenApart) {
  base::Problems problems;
  read_json(R"({"a": 1e-999, "b": 99999999999999999999, "a": 2, "c": "\u0007"})", "", problems);
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_EQ(problems[0].pointer, "/a");
  EXPECT_EQ(problems[1].pointer, "/b");
  EXPECT_EQ(problems[2].pointer, "/a");
  EXPECT_EQ(problems[3].pointer, "/c");
}

TEST(JsonValue, TheRootsNameStandsBeforeThePointer) {
  base::Problems problems;
  read_json(R"({"x": [1e999]})", "--set pile.tip", problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].pointer, "--set pile.tip/x/0");
}

TEST(JsonValue, ManyKeysOfOneObjectAreReadInLittleTime) {
  std::string bytes = "{\"k\":0";
  for (int i = 0; i < 190'000; ++i) bytes += ",\"k" + std::to_string(i) + "\":0";
  EXPECT_EQ(good(bytes + "}").items.size(), 190'001u);
}

}  // namespace
}  // namespace seapile::study
