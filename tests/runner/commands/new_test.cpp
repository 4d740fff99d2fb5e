// `runner new`: a study file to begin with, from one that ships or from nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

TEST(New, AStudyThatBeginsAsAnotherAsksTheSameUnderItsOwnName) {
  const Workplace place;
  const Finished made = place.run({"new", "my_tips", "--from", "tip_shape", "--question", "Which tip for our sand?"});
  EXPECT_EQ(made.exit_code, 0) << made.error;
  EXPECT_EQ(made.out, "my_tips.json\n");
  const json study = json::parse(content(place.folder() / "my_tips.json"));
  EXPECT_EQ(study.at("study"), "my_tips");
  EXPECT_EQ(study.at("question"), "Which tip for our sand?");
  const Finished plan = place.run({"plan", "my_tips.json", "--format", "csv"});
  EXPECT_EQ(plan.exit_code, 0) << plan.error;
  EXPECT_THAT(plan.out, HasSubstr("pile.tip=conical"));
  EXPECT_THAT(plan.out, HasSubstr("pile.tip=flat"));
}

TEST(New, OneThatBeginsFromNothingCanBePlanned) {
  const Workplace place;
  ASSERT_EQ(place.run({"new", "first"}).exit_code, 0);
  EXPECT_EQ(place.run({"plan", "first.json"}).exit_code, 0);
}

TEST(New, WhatShipsIsListedWithItsQuestion) {
  const Workplace place;
  const json rows = json::parse(place.run({"new", "--list", "--format", "json"}).out).at("rows");
  EXPECT_GT(rows.size(), 30U);
  for (const json& row : rows) {
    EXPECT_FALSE(row.at("question").get<std::string>().empty()) << row;
    EXPECT_GE(row.at("cases"), 1) << row;
  }
}

TEST(New, AFileIsNeverWrittenOver) {
  const Workplace place;
  place.write("mine.json", "precious");
  const Finished refused = place.run({"new", "mine"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.error, HasSubstr("mine.json is there already"));
  EXPECT_EQ(content(place.folder() / "mine.json"), "precious");
}

TEST(New, WrongWishesEndWithTwoAndLeaveNothing) {
  const Workplace place;
  const Finished unknown = place.run({"new", "mine", "--from", "tip_shap"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.error, HasSubstr("did you mean \"tip_shape\"?"));
  EXPECT_EQ(place.run({"new", "No Name"}).exit_code, 2);
  EXPECT_EQ(place.run({"new"}).exit_code, 2);
  EXPECT_EQ(place.run({"new", "mine", "-o", "nowhere/mine.json"}).exit_code, 2);
  for (const auto& entry : fs::directory_iterator(place.folder())) {
    EXPECT_NE(entry.path().extension(), ".json") << entry.path();
  }
}

}  // namespace
}  // namespace seapile::commands
