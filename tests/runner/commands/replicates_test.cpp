// What a study with several packings says, through the real program: the intervals against ones that are computed here
// from the single runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// t_0.975(2), of a table: three packings.
constexpr double kStudent = 4.302653;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

/// The rows of a CSV table without quotes: values by heading.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv) {
  const std::vector<std::string> lines = split(csv, '\n');
  const std::vector<std::string> heading = split(lines.at(0), ',');
  std::vector<std::map<std::string, std::string>> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<std::string> values = split(lines[i], ',');
    values.resize(heading.size());
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < heading.size(); ++k) row[heading[k]] = values[k];
  }
  return rows;
}

/// Mean and half-width of the interval of three values, straight from the formula.
std::pair<double, double> mean_and_half(const std::vector<double>& v) {
  const double mean = (v.at(0) + v.at(1) + v.at(2)) / 3;
  double squares = 0;
  for (const double x : v) squares += (x - mean) * (x - mean);
  return {mean, kStudent * std::sqrt(squares / 2) / std::sqrt(3)};
}

/// Two densities and two speeds on three packings, run once for all tests.
struct Replicated : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->write("dense.json", R"({
      "study": "dense", "question": "How does density change the effect of speed?",
      "base": {"bed": {"domain": {"width": "0.8 m", "height": "1.5 m"},
                       "grains": {"count": 200, "radius": {"min": "0.02 m", "max": "0.03 m"}},
                       "preparation": {"tolerance": 0.01}},
               "pile": {"radius": "0.05 m", "depth": "0.3 m"}, "fluid": null},
      "axes": {"bed.preparation.solid_fraction": [0.77, 0.80], "pile.driving.constant.speed": ["0.2 m/s", "0.8 m/s"]},
      "replicates": {"seeds": 3}})");
    first = new Finished(place->run({"dense.json"}));
  }
  static void TearDownTestSuite() {
    delete first;
    delete place;
  }
  static std::vector<std::map<std::string, std::string>> csv(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--format", "csv"});
    return rows_of(place->run(arguments).out);
  }
  /// A metric of the runs of one case, by seed.
  static std::vector<double> values(const std::string& metric, const std::string& density, const std::string& speed) {
    std::vector<double> found;
    for (const auto& row : csv({"query", "dense", "--each", "--columns", metric})) {
      if (row.at("bed.preparation.solid_fraction") != density) continue;
      if (row.at("pile.driving.constant.speed") != speed) continue;
      for (const auto& [heading, value] : row) {
        if (heading.starts_with(metric + "[")) found.push_back(std::stod(value));
      }
    }
    return found;
  }
  static Workplace* place;
  static Finished* first;
};
Workplace* Replicated::place;
Finished* Replicated::first;

TEST_F(Replicated, TheClosingTableHasARowPerCaseWithItsInterval) {
  ASSERT_EQ(first->exit_code, 0) << first->error;
  const std::vector<std::string> lines = split(first->out, '\n');
  ASSERT_GE(lines.size(), 10u) << first->out;
  EXPECT_THAT(lines[0], HasSubstr("  n  "));
  EXPECT_THAT(lines[0], Not(HasSubstr("bed.seed")));
  for (std::size_t row = 3; row < 7; ++row) EXPECT_THAT(lines[row], HasSubstr("  3  ")) << first->out;
  const auto [mean, half] = mean_and_half(values("tip_resistance_mean", "0.77", "0.2 m/s"));
  std::ostringstream shown;
  shown.setf(std::ios::fixed);
  shown.precision(1);
  shown << mean / 1000 << " ± " << half / 1000;
  EXPECT_THAT(lines[3], HasSubstr(shown.str())) << first->out;
  EXPECT_THAT(first->out, HasSubstr("± is the 95 % interval"));
  EXPECT_THAT(first->out, Not(HasSubstr("one packing")));
}

TEST_F(Replicated, QueryGivesTheIntervalOfTheSingleRuns) {
  const auto rows = csv({"query", "dense"});
  ASSERT_EQ(rows.size(), 4u);
  const struct {
    const char *density, *speed;
  } cases[] = {{"0.77", "0.2 m/s"}, {"0.77", "0.8 m/s"}, {"0.8", "0.2 m/s"}, {"0.8", "0.8 m/s"}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].at("n"), "3");
    for (const std::string metric : {"tip_resistance_mean", "tip_resistance_fluctuation"}) {
      const auto [mean, half] = mean_and_half(values(metric, cases[i].density, cases[i].speed));
      EXPECT_NEAR(std::stod(rows[i].at(metric + ".mean[Pa]")), mean, 1e-9 * mean);
      EXPECT_NEAR(std::stod(rows[i].at(metric + ".low[Pa]")), mean - half, 1e-6 * mean);
      EXPECT_NEAR(std::stod(rows[i].at(metric + ".high[Pa]")), mean + half, 1e-6 * mean);
    }
  }
}

TEST_F(Replicated, EachListsTheRunsAsBefore) {
  const auto rows = csv({"query", "dense", "--each"});
  ASSERT_EQ(rows.size(), 12u);
  for (const char* column : {"case", "run", "kind", "outcome", "bed.seed", "tip_resistance_mean[Pa]"}) {
    EXPECT_EQ(rows[0].count(column), 1u) << column;
  }
  EXPECT_EQ(csv({"query"}).size(), 18u);  // of no study: every run, six beds among them
}

TEST_F(Replicated, OnePackingHasAValueAndTheTableSaysSo) {
  const Finished table = place->run({"query", "dense", "--where", "bed.seed = 1"});
  EXPECT_THAT(table.out, HasSubstr("one packing: no interval"));
  EXPECT_THAT(table.out, Not(HasSubstr("±")));
  const auto rows = csv({"query", "dense", "--where", "bed.seed = 1"});
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].at("n"), "1");
  EXPECT_NE(rows[0].at("tip_resistance_mean.mean[Pa]"), "");
  EXPECT_EQ(rows[0].at("tip_resistance_mean.low[Pa]"), "");
}

TEST_F(Replicated, CurveBandsAreTheIntervalOverTheBins) {
  const Finished finished = place->run({"curve", "dense", "--bands"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const auto bands = rows_of(finished.out);
  EXPECT_THAT(split(finished.out, '\n')[0],
              "bed.preparation.solid_fraction,pile.driving.constant.speed[m/s],depth[m],n,mean[Pa],low[Pa],high[Pa]");
  // Six bins of 0.05 m to 0.3 m; a run may stop a hair above the end of the last.
  EXPECT_GE(bands.size(), 4 * 5u);
  // The solver's own means over bins weigh records by their travel, which at constant speed is the same.
  const auto [mean, half] = mean_and_half(values("tip_resistance_bin_0.10", "0.77", "0.2 m/s"));
  const auto bin = std::ranges::find_if(bands, [](const auto& row) { return row.at("depth[m]") == "0.125"; });
  ASSERT_NE(bin, bands.end());
  EXPECT_EQ(bin->at("n"), "3");
  EXPECT_NEAR(std::stod(bin->at("mean[Pa]")), mean, 0.02 * mean);
  EXPECT_NEAR(std::stod(bin->at("high[Pa]")) - std::stod(bin->at("low[Pa]")), 2 * half, 0.1 * half);
  EXPECT_EQ(place->run({"curve", "--bands"}).exit_code, 2);
  EXPECT_EQ(place->run({"curve", "dense", "--bands", "--out", "bands.csv"}).exit_code, 0);
  EXPECT_EQ(content(place->folder() / "bands.csv"), finished.out);
}

TEST_F(Replicated, ThePictureHasBands) {
  const std::string svg = content(place->results() / "figures" / "dense.svg");
  EXPECT_THAT(svg, HasSubstr("mean of 3 packings, 95 % band"));
}

TEST_F(Replicated, TrendPairsTheEffectOnTheSameBed) {
  const auto rows = csv({"trend", "dense", "--of", "tip_resistance_mean", "--against", "bed:solid_fraction", "--effect",
                         "pile.driving.constant.speed", "-o", "trend.svg"});
  ASSERT_EQ(rows.size(), 4u);
  for (const auto& [row, density] : {std::pair(0, "0.77"), std::pair(2, "0.8")}) {
    const auto& slow = rows.at(static_cast<std::size_t>(row));
    const auto& fast = rows.at(static_cast<std::size_t>(row) + 1);
    EXPECT_EQ(slow.at("pairs"), "");
    EXPECT_EQ(fast.at("pairs"), "3");
    const auto below = values("tip_resistance_mean", density, "0.2 m/s");
    const auto above = values("tip_resistance_mean", density, "0.8 m/s");
    std::vector<double> logarithms;
    for (std::size_t i = 0; i < 3; ++i) logarithms.push_back(std::log(above[i] / below[i]));
    const auto [mean, half] = mean_and_half(logarithms);
    EXPECT_NEAR(std::stod(fast.at("ratio.mean")), std::exp(mean), 1e-9);
    EXPECT_NEAR(std::stod(fast.at("ratio.low")), std::exp(mean - half), 1e-6);
    EXPECT_NEAR(std::stod(fast.at("ratio.high")), std::exp(mean + half), 1e-5);
    const auto [x, x_half] = mean_and_half(values("bed:solid_fraction", density, "0.2 m/s"));
    EXPECT_NEAR(std::stod(slow.at("bed:solid_fraction.mean[-]")), x, 1e-9);
    EXPECT_NEAR(std::stod(slow.at("bed:solid_fraction.high[-]")), x + x_half, 1e-6);
  }
  EXPECT_THAT(content(place->folder() / "trend.svg"), HasSubstr("ratio to speed 0.2 m/s, on the same bed"));
}

TEST_F(Replicated, TrendWidensWithItsLevelAndAnswersInThreeFormats) {
  const std::vector<std::string> plain = {
      "trend", "dense", "--of", "tip_resistance_mean", "--against", "bed:solid_fraction"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), plain.begin(), plain.end());
    return place->run(more);
  };
  const auto width = [](const std::string& text) {
    const auto row = nlohmann::json::parse(text).at("rows").at(0);
    return row.at("tip_resistance_mean.high").get<double>() - row.at("tip_resistance_mean.low").get<double>();
  };
  const std::string at_95 = with({"--format", "json"}).out;
  // t_0.995(2) over t_0.975(2), of tables.
  EXPECT_NEAR(width(with({"--format", "json", "--level", "0.99"}).out) / width(at_95), 9.925 / 4.303, 1e-3);
  EXPECT_THAT(with({"--level", "0.99"}).out, HasSubstr("± is the 99 % interval"));
}

TEST_F(Replicated, TrendRefusesInOneLineWhatItCannotAnswer) {
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    std::vector<std::string> words = {"trend", "dense"};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Finished finished = place->run(words);
    EXPECT_EQ(finished.exit_code, 2) << finished.out;
    EXPECT_EQ(finished.out, "");
    EXPECT_THAT(finished.error, HasSubstr(why));
  };
  const std::string of = "--of", q = "tip_resistance_mean", against = "--against", x = "bed:solid_fraction";
  refused({of, "tip_resistance_meen", against, x}, "the nearest is \"tip_resistance_mean\"");
  refused({of, q, against, "bed:solid_fractio"}, "the nearest is \"bed:solid_fraction\"");
  refused({of, q, against, "pile.tip"}, "pile.tip is no number");
  refused({of, "pile.depth", against, x}, "pile.depth is no metric");
  refused({of, q, against, x, "--effect", "pile.depth"}, "is no axis of the study");
  refused({of, q, against, x, "--effect", "bed.preparation.solid_fraction"}, "same bed");
  refused({of, q, against, x, "--level", "2"}, "--level");
  refused({of, q}, "--against");
  place->write("in_the_way", "a file");
  refused({of, q, against, x, "-o", "in_the_way/a.svg"}, "was not drawn");
  EXPECT_EQ(place->run({"trend", "dens", of, q, against, x}).exit_code, 4);
  EXPECT_EQ(place->run({"trend", "dense", of, q, against, x, "--where", "bed.seed = 9"}).exit_code, 4);
}

TEST_F(Replicated, ReadingWritesNothingIntoTheStore) {
  const auto before = everything(place->results());
  place->run({"query", "dense"});
  place->run({"curve", "dense", "--bands"});
  place->run({"trend", "dense", "--of", "tip_resistance_mean", "--against", "bed:solid_fraction"});
  EXPECT_EQ(everything(place->results()), before);
}

}  // namespace
}  // namespace seapile::commands
