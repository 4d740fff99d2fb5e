// `runner check --junit`, read back by a parser of XML.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "runner/present/junit.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

using boost::property_tree::ptree;
using testing::HasSubstr;

/// Two tips in one packing, run once.
struct Junit : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->run_study("tips", small_study("tips"));
  }
  static void TearDownTestSuite() { delete ran; }

  /// Checks the study with these checks, writes checks.xml.
  Finished check(const std::string& checks, const std::string& more = "") const {
    place.write("tips.json", small_study("tips", more + R"("checks": [)" + checks + "],"));
    return place.run({"check", "tips.json", "--store", ran->results().string(), "--junit", "checks.xml"});
  }
  ptree read() const {
    ptree document;
    std::ifstream file(place.folder() / "checks.xml");
    boost::property_tree::read_xml(file, document);
    return document.get_child("testsuites.testsuite");
  }
  static std::vector<ptree> cases(const ptree& suite) {
    std::vector<ptree> all;
    for (const auto& [name, child] : suite)
      if (name == "testcase") all.push_back(child);
    return all;
  }
  static std::string check_of(const std::string& tip, const std::string& rest) {
    return R"({"metric": "tip_resistance_mean", "if": {"pile.tip": ")" + tip + R"("}, )" + rest + "}";
  }

  static Workplace* ran;
  const Workplace place;
};
Workplace* Junit::ran;

TEST_F(Junit, ACheckThatHoldsOneThatFailsAndAClaimAreThreeTestCases) {
  const Finished finished =
      check(check_of("flat", R"("at_least": "1 Pa")") + "," + check_of("conical", R"("at_most": "1 Pa")") +
            R"(,{"claim": "flat over conical", "metric": "tip_resistance_mean",
      "of": {"pile.tip": "flat"}, "over": {"pile.tip": "conical"}, "at_least": 1, "margin": 0.05,
      "expect": "confirmed"})");
  EXPECT_EQ(finished.exit_code, 3) << finished.error;  // as without --junit
  const ptree suite = read();
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.name"), "tips");
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 1);
  EXPECT_EQ(suite.get<int>("<xmlattr>.skipped"), 1 + 2);  // the claim of one packing, and two values not accepted yet
  const std::vector<ptree> all = cases(suite);
  EXPECT_EQ(suite.get<std::size_t>("<xmlattr>.tests"), all.size());
  ASSERT_EQ(all.size(), 5u);
  EXPECT_THAT(all[0].get<std::string>("<xmlattr>.name"), HasSubstr("pile.tip=flat"));
  EXPECT_EQ(all[0].count("failure") + all[0].count("skipped"), 0u);
  EXPECT_THAT(all[1].get<std::string>("<xmlattr>.name"), HasSubstr("pile.tip=conical"));
  EXPECT_EQ(all[1].get<std::string>("failure.<xmlattr>.message"), "FAILED");
  EXPECT_THAT(all[1].get<std::string>("failure"), HasSubstr("at most 1 Pa"));
  EXPECT_EQ(all[4].get<std::string>("<xmlattr>.classname"), "tips.claim");
  EXPECT_EQ(all[4].get<std::string>("skipped.<xmlattr>.message"), "underpowered, expected confirmed");
}

TEST_F(Junit, AnyNameIsWellFormedAndReadBackAsItWas) {
  const std::string name = R"(<&'\"> ]]> -- ü end)", read_back = "<&'\"> ]]> -- ü end";
  const Finished finished = check(R"({"claim": ")" + name + R"(", "metric": "tip_resistance_mean",
      "of": {"pile.tip": "flat"}, "at_least": "1 Pa", "margin": "1 Pa", "expect": "confirmed"})");
  EXPECT_EQ(finished.exit_code, 4) << finished.error;
  const std::vector<ptree> all = cases(read());
  ASSERT_EQ(all.size(), 1u);
  EXPECT_THAT(all[0].get<std::string>("<xmlattr>.name"), HasSubstr(read_back));
}

TEST(JunitText, ACharacterThatXmlCannotHoldIsReplaced) {
  present::Comparison comparison;
  comparison.metric = "metric\x01\x0b";
  comparison.source = "\x1b[31m";
  std::istringstream text(present::junit_text("study\x08", {comparison}, {}));
  ptree document;
  boost::property_tree::read_xml(text, document);
  const ptree suite = document.get_child("testsuites.testsuite");
  EXPECT_EQ(suite.get<std::string>("<xmlattr>.name"), "study\uFFFD");
  EXPECT_EQ(suite.get<std::string>("testcase.<xmlattr>.name"), "metric\uFFFD\uFFFD");
  EXPECT_EQ(document.get<std::string>("testsuites.testsuite.testcase.skipped").find('\x1b'), std::string::npos);
}

TEST_F(Junit, AMissingResultIsSkippedAndTheCodeSaysSo) {
  const Finished finished = check(check_of("flat", R"("at_least": "1 Pa")"), R"("replicates": {"seed": [7]},)");
  EXPECT_EQ(finished.exit_code, 4);
  const ptree suite = read();
  EXPECT_EQ(suite.get<int>("<xmlattr>.failures"), 0);
  EXPECT_EQ(cases(suite).at(0).get<std::string>("skipped.<xmlattr>.message"), "missing");
}

TEST_F(Junit, NothingHalfWrittenIsLeftAndAPlaceThatCannotBeWrittenIsSaid) {
  place.write("checks.xml", "an older report");
  EXPECT_EQ(check(check_of("flat", R"("at_least": "1 Pa")")).exit_code, 0);
  EXPECT_EQ(cases(read()).at(0).count("failure"), 0u);
  for (const auto& entry : std::filesystem::directory_iterator(place.folder()))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("checks.xml."))) << entry.path();
  const Finished nowhere =
      place.run({"check", "tips.json", "--store", ran->results().string(), "--junit", "no_such_folder/checks.xml"});
  EXPECT_EQ(nowhere.exit_code, 5);
  EXPECT_THAT(nowhere.error, HasSubstr("no_such_folder"));
}

}  // namespace
}  // namespace seapile::commands
