#include "runner/store/parameters.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/runner/store/sample_run.h"

namespace seapile::store {
namespace {

TEST(Parameters, AreTheScenesLeavesUnderDottedPaths) {
  const std::string scene = R"({"a":{"b":1.5,"c":"text","d":null,"e":true,"f":[1,2.5]},"g":3})";
  const std::vector<Parameter> expected = {{"a.b", 1.5, {}},    {"a.c", {}, "text"},    {"a.d", {}, {}},
                                           {"a.e", {}, "true"}, {"a.f", {}, "[1,2.5]"}, {"g", 3, {}}};
  EXPECT_EQ(parameters(scene, "drive"), expected);
}

TEST(Parameters, NameAChoiceUnderItsPath) {
  const std::vector<Parameter> expected = {
      {"tip", {}, "flat"}, {"driving", {}, "constant"}, {"driving.constant.speed", 0.06, {}}};
  EXPECT_EQ(parameters(R"({"tip":{"flat":{}},"driving":{"constant":{"speed":0.06}}})", "drive"), expected);
}

TEST(Parameters, OfABedAreOnlyTheBeds) {
  for (const Parameter& parameter : parameters(sample::drive_header().scene_json, "bed")) {
    EXPECT_TRUE(parameter.path.starts_with("bed.")) << parameter.path;
  }
  EXPECT_EQ(parameters(sample::drive_header().scene_json, "bed"), parameters(sample::bed_header().scene_json, "bed"));
}

TEST(Parameters, OfNoObjectAreRefused) {
  for (const char* text : {"", "null", "[1]", "{\"a\":"})
    EXPECT_THROW(parameters(text, "drive"), std::invalid_argument);
}

TEST(Parameters, HaveTheUnitsOfTheFieldLists) {
  const auto& units = parameter_units();
  EXPECT_EQ(units.at("pile.driving.constant.speed"), "m/s");
  EXPECT_EQ(units.at("pile.driving.vibratory.frequency"), "Hz");
  EXPECT_EQ(units.at("pile.tip.conical.apex_angle"), "rad");
  EXPECT_EQ(units.at("pile.depth"), "m");
  EXPECT_EQ(units.at("bed.preparation.contact.step"), "s");
  EXPECT_EQ(units.at("bed.seed"), "-");
  EXPECT_FALSE(units.contains("pile.tip"));
  // Every number of a scene has one.
  for (const Parameter& parameter : parameters(sample::drive_header().scene_json, "drive")) {
    EXPECT_TRUE(!parameter.number || units.contains(parameter.path)) << parameter.path;
  }
}

}  // namespace
}  // namespace seapile::store
