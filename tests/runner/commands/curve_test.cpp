// Curves of packings as pictures, without units, beside tests of the field, and as tables of penetration tests, through
// the real program. The tests of the field are synthetic: no ground was tested.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "runner/study/cpt.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

/// The rows of a CSV table without quotes: values by heading.
std::vector<Row> rows_of(const std::string& csv) {
  const std::vector<std::string> lines = split(csv, '\n'), heading = split(lines.at(0), ',');
  std::vector<Row> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::vector<std::string> values = split(lines[i], ',');
    values.resize(heading.size());
    for (std::size_t k = 0; k < heading.size(); ++k) rows.resize(i), rows.back()[heading[k]] = values[k];
  }
  return rows;
}

constexpr double kGravity = 9.81, kDensity = 2600, kWater = 1000, kWidth = 0.08;

const std::string kSite =
    "#GEFID= 1, 1, 0\n#FILEOWNER= synthetic, no ground was tested\n#FILEDATE= 2024, 1, 1\n#PROJECTID= synthetic\n"
    "#COLUMN= 2\n#COLUMNINFO= 1, m, length, 1\n#COLUMNINFO= 2, MPa, cone, 2\n#MEASUREMENTVAR= 1, 1000, mm2, cone\n"
    "#EOH=\n0.02 0.4\n0.05 0.7\n0.5 3\n";

/// Two packings, dry and saturated, run once for all tests.
struct Curve : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->run_study("wet", R"({"study": "wet", "question": "Does water help?",
      "record": {"travel": "1 mm", "frames": [0]},
      "base": {"bed": {"domain": {"width": "0.8 m", "height": "1 m"},
                       "grains": {"count": 250, "density": 2600, "radius": {"min": "0.012 m", "max": "0.02 m"}}},
               "pile": {"radius": "0.04 m", "tip": "flat", "driving": {"constant": {"speed": "0.4 m/s"}},
                        "depth": "0.2 m"}},
      "axes": {"fluid": [null, {"density": 1000}]},
      "when": [{"if": {"fluid": {}}, "set": {"fluid.depth": "0.8 m", "fluid.mesh.size": "0.1 m",
                "fluid.mesh.pile_size": "0.06 m", "fluid.mesh.motion": {"zones": {"reach": "0.2 m"}}}}],
      "replicates": {"seeds": 2}})");
    place->write("site.gef", kSite);
  }
  static void TearDownTestSuite() { delete place; }

  static Finished curve(std::vector<std::string> more) {
    more.insert(more.begin(), {"curve", "wet"});
    return place->run(more);
  }
  static const std::vector<std::string> dry, wet, overlay;

  static std::vector<std::string> with(std::vector<std::string> first, const std::vector<std::string>& second) {
    first.insert(first.end(), second.begin(), second.end());
    return first;
  }
  static void refused(const std::vector<std::string>& arguments, const std::string& why) {
    const Finished finished = curve(arguments);
    EXPECT_EQ(finished.exit_code, 2) << why;
    EXPECT_EQ(finished.out, "") << why;
    EXPECT_THAT(finished.error, HasSubstr(why));
  }
  static Workplace* place;
};
Workplace* Curve::place;
const std::vector<std::string> Curve::dry = {"--where", "fluid = null", "--where", "bed.seed = 1"};
const std::vector<std::string> Curve::wet = {"--where", "fluid != null", "--where", "bed.seed = 1"};
const std::vector<std::string> Curve::overlay = {"--overlay", "site.gef",           "--site-unit-weight",
                                                 "18 kN/m3",  "--site-water-depth", "0 m"};

TEST_F(Curve, BandsAreDrawnAsTheStudysClosingPicture) {
  const Finished drawn = curve({"--bands", "--out", "bands.svg"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.error;
  EXPECT_EQ(drawn.out, "bands.svg\n");
  const std::string svg = content(place->folder() / "bands.svg");
  for (const char* word : {"mean of 2 packings, 95 % band", "no fluid", "(kPa)", "fill-opacity", "wet"})
    EXPECT_THAT(svg, HasSubstr(word));
}

// The closed form from numbers that are independent of the curve: the bed's metric from the catalogue, and the scene.
TEST_F(Curve, NormalisedIsTheResistanceOverTheWeightAboveLessItsUplift) {
  for (const bool saturated : {false, true}) {
    const auto& which = saturated ? wet : dry;
    std::vector<std::string> query = with({"query", "wet", "--each", "--columns", "bed:solid_fraction"}, which);
    const Row run = rows_of(place->run(with(query, {"--format", "csv"})).out).at(0);
    const double weight = std::stod(run.at("bed:solid_fraction[-]")) * (kDensity - (saturated ? kWater : 0)) * kGravity;
    const auto raw = rows_of(curve(with({"--of", "tip_resistance"}, which)).out);
    const auto rows = rows_of(curve(with({"--normalised"}, which)).out);
    ASSERT_GT(rows.size(), 150u);
    std::size_t next = 0;
    for (const Row& row : rows) {
      while (raw.at(next).at("depth[m]") != row.at("depth[m]")) ++next;
      const double depth = std::stod(row.at("depth[m]")), resistance = std::stod(raw[next].at("tip_resistance[Pa]"));
      EXPECT_GT(depth, 0);
      EXPECT_NEAR(std::stod(row.at("effective_stress[Pa]")), weight * depth, 1e-9 * weight);
      EXPECT_NEAR(std::stod(row.at("depth_over_width[-]")), depth / kWidth, 1e-12);
      EXPECT_NEAR(std::stod(row.at("resistance_over_stress[-]")), resistance / (weight * depth), 1e-9 * resistance);
      EXPECT_EQ(row.at("model"), "plane strain discs");
      EXPECT_EQ(row.at("source"), "simulated");
      // Radii of 12 to 20 mm: the median by mass lies in the upper half of the diameters.
      EXPECT_GT(std::stod(row.at("width_over_d50[-]")), kWidth / 0.040);
      EXPECT_LT(std::stod(row.at("width_over_d50[-]")), kWidth / 0.032);
    }
    EXPECT_TRUE(raw.at(next + 1 < raw.size() ? next + 1 : next) == raw.back()) << "every record below the surface";
  }
}

TEST_F(Curve, NormalisedBandsAreThoseOfTheStressOverThatInTheMiddleOfABin) {
  const auto raw = rows_of(curve({"--bands"}).out), rows = rows_of(curve({"--normalised", "--bands"}).out);
  ASSERT_EQ(raw.size(), rows.size());
  ASSERT_GE(rows.size(), 6u);
  const auto stress = rows_of(curve(with({"--normalised"}, dry)).out).back();
  const double weight = std::stod(stress.at("effective_stress[Pa]")) / std::stod(stress.at("depth[m]"));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double depth = std::stod(raw[i].at("depth[m]"));
    EXPECT_NEAR(std::stod(rows[i].at("depth_over_width[-]")), depth / kWidth, 1e-4);
    EXPECT_EQ(rows[i].at("n"), "2");
    EXPECT_LE(std::stod(rows[i].at("low[-]")), std::stod(rows[i].at("mean[-]")));
    if (raw[i].at("fluid") != "null") continue;
    // The beds of two packings differ in their solid fraction by a few per cent.
    EXPECT_NEAR(std::stod(rows[i].at("mean[-]")) * weight * depth / std::stod(raw[i].at("mean[Pa]")), 1, 0.05);
  }
}

TEST_F(Curve, TheNormalisedPictureSaysPlaneStrainGrainsAndPackings) {
  const Finished drawn = curve({"--normalised", "--bands", "--out", "n.svg"});
  EXPECT_EQ(drawn.exit_code, 0) << drawn.error;
  const std::string svg = content(place->folder() / "n.svg");
  for (const char* word : {"discs in plane strain", "B/d50 = ", "2 packings", "over vertical effective stress"})
    EXPECT_THAT(svg, HasSubstr(word));
  EXPECT_THAT(svg, Not(HasSubstr("kPa")));
  EXPECT_EQ(curve({"--normalised", "--out", "each.svg"}).exit_code, 0);
  EXPECT_THAT(content(place->folder() / "each.svg"), HasSubstr("no fluid, seed 2"));
}

TEST_F(Curve, ATestOfTheFieldLiesOverNormalisedCurvesOnly) {
  const std::string why = "--overlay needs --normalised";
  refused(overlay, why);
  refused(with(overlay, {"--out", "raw.svg"}), why);
  refused(with(overlay, {"--bands", "--out", "raw.csv"}), why);
  for (const char* file : {"raw.svg", "raw.csv"}) EXPECT_FALSE(fs::exists(place->folder() / file));
}

TEST_F(Curve, ATestOfTheFieldIsDrawnAndHasItsRows) {
  const Finished drawn = curve(with({"--normalised", "--bands", "--out", "o.svg"}, overlay));
  EXPECT_EQ(drawn.exit_code, 0) << drawn.error;
  const std::string svg = content(place->folder() / "o.svg");
  for (const char* word : {"site.gef", "Grey: measured in the field.", "rgb(119, 119, 119)"})
    EXPECT_THAT(svg, HasSubstr(word));
  const double diameter = std::sqrt(4 * 1000e-6 / std::acos(-1.0));
  for (const bool bands : {false, true}) {
    std::vector<Row> rows;
    for (const Row& row : rows_of(curve(with(bands ? std::vector<std::string>{"--normalised", "--bands"}
                                                   : std::vector<std::string>{"--normalised"},
                                             overlay))
                                      .out)) {
      if (row.at("source") == "site.gef") rows.push_back(row);
    }
    ASSERT_EQ(rows.size(), 3u);
    const double depth[] = {0.02, 0.05, 0.5}, resistance[] = {0.4e6, 0.7e6, 3e6};
    for (std::size_t i = 0; i < 3; ++i) {
      const double expected = resistance[i] / ((18e3 - 9.81e3) * depth[i]);
      EXPECT_NEAR(std::stod(rows[i].at(bands ? "mean[-]" : "resistance_over_stress[-]")), expected, 1e-9 * expected);
      EXPECT_NEAR(std::stod(rows[i].at("depth_over_width[-]")), depth[i] / diameter, 1e-4);
      EXPECT_EQ(rows[i].at("model"), "");
    }
  }
}

TEST_F(Curve, WhatAFileOfTheFieldDoesNotSayIsAskedForByName) {
  const Finished finished = curve({"--normalised", "--overlay", "site.gef"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(std::ranges::count(finished.error, '\n'), 2) << finished.error;
  EXPECT_THAT(finished.error,
              HasSubstr("site.gef: does not say the unit weight of the ground; allowed: --site-unit-w"));
  EXPECT_THAT(finished.error, HasSubstr("--site-water-depth"));
  place->write("site.csv", "depth[m],qc[MPa],remark\n0.02,0.4,synthetic\n");
  const std::vector<std::string> csv = {"--normalised", "--overlay",          "site.csv", "--site-unit-weight",
                                        "18 kN/m3",     "--site-water-depth", "0 m"};
  refused(csv, "site.csv: does not say the cone's area or diameter; allowed: --site-cone-diameter");
  EXPECT_EQ(curve(with(csv, {"--site-cone-diameter", "35.7 mm"})).exit_code, 0);
  refused(with(csv, {"--site-cone-diameter", "35.7"}), "--site-cone-diameter: \"35.7\" has no unit");
  refused(with(csv, {"--site-cone-diameter", "35.7 m"}), "is out of range; allowed: 1 to 1000 mm");
  refused({"--normalised", "--overlay", "site.gef", "--site-unit-weight", "18 kPa", "--site-water-depth", "0 m"},
          "--site-unit-weight: \"18 kPa\" is in kPa");
  refused({"--normalised", "--site-unit-weight", "18 kN/m3"}, "--overlay");
}

TEST_F(Curve, AWrongFileOfTheFieldIsToldWithItsLine) {
  place->write("wrong.gef", kSite + "0.6 three\n0.7\n");
  const std::vector<std::string> rest(overlay.begin() + 2, overlay.end());
  const Finished finished = curve(with({"--normalised", "--overlay", "wrong.gef"}, rest));
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.error, HasSubstr("wrong.gef: line 13: column 2 \"three\" is no finite number"));
  EXPECT_THAT(finished.error, HasSubstr("wrong.gef: line 14: has 1 numbers"));
  refused(with({"--normalised", "--overlay", "none.gef"}, rest), "none.gef: cannot be read");
}

TEST_F(Curve, ATableOfAPenetrationTestIsTheMeanOverTwoCentimetres) {
  const auto rows = rows_of(curve(with({"--cpt"}, dry)).out);
  ASSERT_GE(rows.size(), 9u);
  std::map<long, std::pair<double, int>> sums, frictions;
  for (const Row& record : rows_of(curve(with({"--of", "tip_resistance,sleeve_force_y"}, dry)).out)) {
    const double depth = std::stod(record.at("depth[m]"));
    if (depth <= 0) continue;
    const long bin = std::lround(std::ceil(depth / 0.02 - 1e-6)) - 1;
    sums[bin].first += std::stod(record.at("tip_resistance[Pa]"));
    ++sums[bin].second;
    frictions[bin].first += std::stod(record.at("sleeve_force_y[N/m]")) / (2 * depth);  // a flat tip has no height
    ++frictions[bin].second;
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto bin = static_cast<long>(i);
    EXPECT_NEAR(std::stod(rows[i].at("depth[m]")), 0.01 + 0.02 * static_cast<double>(i), 1e-9);
    EXPECT_NEAR(std::stod(rows[i].at("qc[MPa]")) * 1e6, sums[bin].first / sums[bin].second, 0.51);
    EXPECT_EQ(rows[i].at("fs[kPa]").empty(), i < 4) << "less of the sleeve than the pile's width is in the ground";
    if (i < 4) continue;
    EXPECT_NEAR(std::stod(rows[i].at("fs[kPa]")) * 1e3, frictions[bin].first / frictions[bin].second, 0.51);
  }
  EXPECT_EQ(rows[0].count("u2[kPa]"), 0u) << "a dry bed has no pore pressure";
}

TEST_F(Curve, PorePressuresAreThoseOfStillWaterAndTheExcess) {
  const auto rows = rows_of(curve(with({"--cpt"}, wet)).out);
  std::map<long, std::pair<double, int>> sums;
  for (const Row& record : rows_of(curve(with({"--of", "shoulder_pressure"}, wet)).out)) {
    const double depth = std::stod(record.at("depth[m]"));
    if (depth <= 0) continue;
    auto& [sum, count] = sums[std::lround(std::ceil(depth / 0.02 - 1e-6)) - 1];
    sum += std::stod(record.at("shoulder_pressure[Pa]")) + kWater * kGravity * depth;  // the shoulder of a flat tip
    ++count;
  }
  ASSERT_GE(rows.size(), 9u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& [sum, count] = sums[static_cast<long>(i)];
    EXPECT_NEAR(std::stod(rows[i].at("u2[kPa]")) * 1e3, sum / count, 0.51);
  }
  EXPECT_EQ(rows[0].at("u3[kPa]"), "") << "a pile's width above the shoulder is above the ground";
}

TEST_F(Curve, SeveralRunsGetAFileEach) {
  refused({"--cpt"}, "4 runs match");
  const Finished finished = curve({"--cpt", "--out", "table.csv"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const auto files = split(finished.out, '\n');
  ASSERT_EQ(files.size(), 4u);
  for (const std::string& file : files) {
    EXPECT_THAT(file, testing::MatchesRegex("table-[0-9a-f]{10}\\.csv"));
    EXPECT_THAT(content(place->folder() / file), testing::StartsWith("depth[m],qc[MPa],fs[kPa],Rf[%]"));
  }
  EXPECT_EQ(curve(with({"--cpt", "--out", "one.csv"}, dry)).out, "one.csv\n");
}

TEST_F(Curve, GefIsReadBackToThePrintedDigits) {
  for (const auto& which : {dry, wet}) {
    ASSERT_EQ(curve(with({"--cpt", "--out", "simulated.gef"}, which)).exit_code, 0);
    ASSERT_EQ(curve(with({"--cpt", "--out", "simulated.csv"}, which)).exit_code, 0);
    const study::Cpt gef = study::read_cpt(place->folder() / "simulated.gef");
    const study::Cpt csv = study::read_cpt(place->folder() / "simulated.csv");
    EXPECT_TRUE(gef.is_simulated);
    EXPECT_TRUE(csv.is_simulated);
    EXPECT_NEAR(gef.cone_area.value(), kWidth, 1e-12) << "per metre of depth";
    const auto rows = rows_of(content(place->folder() / "simulated.csv"));
    const auto expect = [&](const std::string& column, double unit, const std::vector<double>& a,
                            const std::vector<double>& b) {
      ASSERT_EQ(a.size(), rows.size()) << column;
      ASSERT_EQ(b.size(), rows.size()) << column;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::string& cell = rows[i].at(column);
        EXPECT_EQ(std::isnan(a[i]), cell.empty()) << column;
        EXPECT_EQ(std::isnan(b[i]), cell.empty()) << column;
        if (cell.empty()) continue;
        EXPECT_NEAR(a[i], std::stod(cell) * unit, 1e-6) << column;
        EXPECT_NEAR(b[i], std::stod(cell) * unit, 1e-6) << column;
      }
    };
    expect("depth[m]", 1, gef.depth, csv.depth);
    expect("qc[MPa]", 1e6, gef.cone_resistance, csv.cone_resistance);
    expect("fs[kPa]", 1e3, gef.sleeve_friction, csv.sleeve_friction);
    expect("Rf[%]", 0.01, gef.friction_ratio, csv.friction_ratio);
    if (which == wet) expect("u2[kPa]", 1e3, gef.pore_pressure[1], csv.pore_pressure[1]);
    refused(with({"--normalised", "--overlay", "simulated.gef"}, {overlay.begin() + 2, overlay.end()}),
            "is a simulated test, and --overlay is for measured ones");
  }
}

TEST_F(Curve, WhatDoesNotFitTogetherEndsWithTwoAndWhatIsNotThereWithFour) {
  refused(with({"--cpt", "--out", "table.gef"}, dry), "has to contain \"simulated\"");
  refused(with({"--cpt", "--out", "table.svg"}, dry), "allowed: FILE.csv, FILE.gef");
  refused({"--bands", "--out", "simulated.gef"}, "ask for it with --cpt");
  refused({"--cpt", "--bands"}, "excludes");
  refused({"--normalised", "--of", "depth"}, "excludes");
  EXPECT_EQ(curve({"--cpt", "--where", "bed.seed = 9"}).exit_code, 4);
  EXPECT_EQ(curve({"--normalised", "--where", "bed.seed = 9"}).exit_code, 4);
  EXPECT_EQ(place->run({"curve", "wett", "--normalised"}).exit_code, 4);
  EXPECT_EQ(curve(with({"--cpt", "--out", "no/such/folder.csv"}, dry)).exit_code, 2);
}

TEST_F(Curve, ReadingWritesNothingIntoTheStore) {
  const auto before = everything(place->results());
  curve({"--normalised", "--bands"});
  curve(with({"--cpt"}, wet));
  EXPECT_EQ(everything(place->results()), before);
}

}  // namespace
}  // namespace seapile::commands
