// `runner compare` on real runs: what differs, by how much, and why.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// Two tips, each in two packings: four drives, run once for all tests.
struct Compare : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->run_study("small", small_study("small", R"("replicates": {"seeds": 2},)"));
    const json answer =
        json::parse(place->run({"query", "small", "--columns", "pile.tip,bed.seed", "--each", "--format", "json"}).out);
    for (const json& row : answer.at("rows"))
      (*ids)[row.at("pile.tip").get<std::string>() + std::to_string(row.at("bed.seed").get<int>())] = row.at("case");
  }
  static void TearDownTestSuite() { delete place; }

  static std::string id(const std::string& name) { return ids->at(name); }
  static std::vector<std::string> bed_ids() {
    const json all = json::parse(place->run({"query", "--format", "json"}).out);
    std::vector<std::string> beds;
    for (const json& row : all.at("rows"))
      if (row.at("kind") == "bed") beds.push_back(row.at("case"));
    return beds;
  }
  /// The rows of a section by their names.
  static std::map<std::string, json> rows(const std::string& a, const std::string& b, const std::string& section) {
    std::map<std::string, json> found;
    const json answer = json::parse(place->run({"compare", a, b, "--format", "json"}).out);
    for (const json& row : answer.at("rows"))
      if (row.at("section") == section) found[row.at("name")] = row;
    return found;
  }

  static Workplace* place;
  static inline std::map<std::string, std::string>* ids = new std::map<std::string, std::string>;
};
Workplace* Compare::place;

TEST_F(Compare, ARunIsIdenticalToItself) {
  const Finished same = place->run({"compare", id("flat1"), id("flat1"), "--expect-equal"});
  EXPECT_EQ(same.exit_code, 0) << same.error;
  EXPECT_THAT(same.out, HasSubstr("identical to the last bit"));
  EXPECT_TRUE(rows(id("flat1"), id("flat1"), "parameter").empty());
  for (const auto& [name, row] : rows(id("flat1"), id("flat1"), "metric")) EXPECT_EQ(row.at("difference"), 0) << name;
  EXPECT_EQ(rows(id("flat1"), id("flat1"), "curve").at("tip_resistance").at("difference"), 0);
}

TEST_F(Compare, AnotherParameterIsNamedWithBothValuesAndExplainsTheDifference) {
  const Finished other = place->run({"compare", id("flat1"), id("conical1")});
  EXPECT_EQ(other.exit_code, 0) << other.error;  // a comparison is no check
  const auto parameters = rows(id("flat1"), id("conical1"), "parameter");
  EXPECT_EQ(parameters.at("pile.tip").at("a"), "flat");
  EXPECT_EQ(parameters.at("pile.tip").at("b"), "conical");
  EXPECT_EQ(parameters.at("pile.tip.conical.apex_angle").at("unit"), "rad");
  EXPECT_FALSE(parameters.contains("bed.seed"));
  EXPECT_THAT(other.out, HasSubstr("they differ"));
  EXPECT_THAT(other.out, HasSubstr("other parameters (pile.tip"));
  EXPECT_THAT(other.out, Not(HasSubstr("nothing known")));
  EXPECT_THAT(other.out, Not(HasSubstr("packing")));
}

TEST_F(Compare, TwoPackingsAreSaidToCarryTheirScatter) {
  const Finished packings = place->run({"compare", id("flat1"), id("flat2")});
  EXPECT_EQ(packings.exit_code, 0);
  EXPECT_THAT(packings.out, HasSubstr("two packings of one scene"));
  EXPECT_THAT(packings.out, HasSubstr("scatter"));
  EXPECT_EQ(rows(id("flat1"), id("flat2"), "parameter").size(), 1u);
}

TEST_F(Compare, TheDistanceOfTheCurvesIsThatOfTheRecords) {
  // The same norm from the records as `runner curve` writes them: both runs record at the same depths.
  const auto curve = [&](const std::string& tip) {
    std::vector<std::pair<double, double>> points;
    const Finished csv = place->run({"curve", "small", "--of", "tip_resistance", "--against", "depth", "--where",
                                     "pile.tip = " + tip, "--where", "bed.seed = 1"});
    std::istringstream in(csv.out);
    std::string line;
    for (std::getline(in, line); std::getline(in, line);) {
      const auto last = line.rfind(','), before = line.rfind(',', last - 1);
      points.emplace_back(std::stod(line.substr(before + 1)), std::stod(line.substr(last + 1)));
    }
    return points;
  };
  auto a = curve("flat"), b = curve("conical");
  ASSERT_GT(a.size(), 10u);
  if (a[0].first > 1) {  // the columns stand the other way round
    for (auto* points : {&a, &b})
      for (auto& [x, y] : *points) std::swap(x, y);
  }
  ASSERT_EQ(a.size(), b.size());
  const auto squares = [&](auto value) {
    double sum = 0;
    for (std::size_t i = 1; i < a.size(); ++i) {
      const double u = value(i - 1), v = value(i);
      sum += (a[i].first - a[i - 1].first) * (u * u + u * v + v * v) / 3;
    }
    return std::sqrt(sum);
  };
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i].first, b[i].first, 1e-9);
    largest = std::max(largest, std::abs(a[i].second - b[i].second));
  }
  const double expected = squares([&](std::size_t i) { return a[i].second - b[i].second; }) /
                          std::max(squares([&](std::size_t i) { return a[i].second; }),
                                   squares([&](std::size_t i) { return b[i].second; }));
  const json row = rows(id("flat1"), id("conical1"), "curve").at("tip_resistance");
  EXPECT_GT(expected, 1e-3);
  EXPECT_NEAR(row.at("difference").get<double>(), expected, 1e-6 * expected);
  EXPECT_NEAR(row.at("largest").get<double>(), largest, 1e-6 * largest);
  EXPECT_EQ(row.at("over"), "depth");
}

TEST_F(Compare, OnlyWhatWasExpectedToBeEqualFails) {
  const std::string a = id("flat1"), b = id("flat2");
  const Finished bits = place->run({"compare", a, b, "--expect-equal"});
  EXPECT_EQ(bits.exit_code, 3);
  EXPECT_THAT(bits.error, HasSubstr("FAILED"));
  EXPECT_EQ(place->run({"compare", a, b, "--expect-equal", "1e-6"}).exit_code, 3);
  EXPECT_EQ(place->run({"compare", a, b, "--expect-equal", "some"}).exit_code, 2);
  EXPECT_EQ(place->run({"compare", a, b, "--expect-equal", "-1"}).exit_code, 2);
}

TEST_F(Compare, TheToleranceIsThatOfTheLargestDifference) {
  const auto beds = bed_ids();
  ASSERT_EQ(beds.size(), 2u);
  const double largest = rows(beds[0], beds[1], "verdict").at("different").at("difference");
  ASSERT_GT(largest, 0);
  const auto code = [&](double tolerance) {
    return place->run({"compare", beds[0], beds[1], "--expect-equal", std::to_string(tolerance)}).exit_code;
  };
  EXPECT_EQ(code(1.01 * largest), 0);
  EXPECT_EQ(code(0.99 * largest), 3);
}

TEST_F(Compare, ABedIsComparedByItsGrains) {
  const auto found = bed_ids();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_THAT(place->run({"compare", found[0], found[0]}).out, HasSubstr("identical to the last bit"));
  const Finished two = place->run({"compare", found[0], found[1], "--expect-equal"});
  EXPECT_EQ(two.exit_code, 3);
  EXPECT_THAT(two.out, HasSubstr("two packings"));
}

TEST_F(Compare, TheSameCaseOfAnotherStoreIsIdentical) {
  const Workplace other;
  other.write("case.json", place->run({"show", id("flat1"), "--study"}).out);
  ASSERT_EQ(other.run({"case.json"}).exit_code, 0);
  const Finished finished =
      place->run({"compare", id("flat1"), id("flat1"), "--with-store", other.results().string(), "--expect-equal"});
  EXPECT_EQ(finished.exit_code, 0) << finished.out;
}

TEST_F(Compare, WhatIsNotThereIsSaid) {
  EXPECT_EQ(place->run({"compare", "ffffffffff", id("flat1")}).exit_code, 4);
  const Finished run = place->run({"compare", id("flat1") + "/7", id("flat1")});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_THAT(run.error, HasSubstr("no complete run 0007; it has 0001"));
  EXPECT_EQ(place->run({"compare", id("flat1") + "/1", id("flat1")}).exit_code, 0);
  EXPECT_EQ(place->run({"compare", "", id("flat1")}).exit_code, 2);  // begins several
  EXPECT_EQ(place->run({"compare", id("flat1")}).exit_code, 2);
  const Finished help = place->run({"compare", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("Example"));
}

TEST_F(Compare, ComparingWritesNothing) {
  const auto before = everything(place->results());
  for (const char* format : {"table", "csv", "json"})
    EXPECT_EQ(place->run({"compare", id("flat1"), id("conical2"), "--format", format}).exit_code, 0);
  EXPECT_EQ(everything(place->results()), before);
}

}  // namespace
}  // namespace seapile::commands
