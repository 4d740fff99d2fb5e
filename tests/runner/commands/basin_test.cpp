// What the commands make of a study of basins, with and without a pile.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Standing waves at two viscosities, and a drive in a bed, run once and shared by all tests.
struct BasinCommands : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    ids = place->run_study("wave", wave("1e-10"));
    ASSERT_EQ(ids.size(), 2u);
    place->run_study("small", small_study("small"));
  }
  static void TearDownTestSuite() { delete place; }
  static std::string wave(const std::string& most) {
    return R"({"study": "wave", "question": "Does a wave keep its volume?",
      "base": {"basin": {"surface": {"initial": {"cosine": {}}},
        "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"step": 0.01, "duration": 0.2}}},
      "axes": {"basin.viscosity": [0.001, 0.1]}, "record": {"interval": 0.05, "times": [0.1]},
      "checks": [{"metric": "volume_drift", "at_most": )" +
           most + "}]}";
  }
  static Workplace* place;
  static std::vector<std::string> ids;
};
Workplace* BasinCommands::place;
std::vector<std::string> BasinCommands::ids;

TEST_F(BasinCommands, AStudyEndsWithItsNumbersAndSaysNothingOfPackings) {
  const std::string out = place->run({"wave.json"}).out;
  for (const char* word : {"reached", "volume drift", "lowest q", "meshes", "completed"}) EXPECT_THAT(out, HasSubstr(word));
  EXPECT_THAT(out, Not(HasSubstr("packing")));
  EXPECT_THAT(out, Not(HasSubstr("swell")));
  EXPECT_FALSE(fs::exists(place->results() / "figures" / "wave_surface.svg")) << "a picture of jets";
}

TEST_F(BasinCommands, ARunIsShownWithItsRecordAndCanBeRunAgainFromItsStudy) {
  const Finished shown = place->run({"show", ids[0]});
  ASSERT_EQ(shown.exit_code, 0) << shown.error;
  for (const char* word : {"volume_drift", "record.interval", "basin.viscosity", "free_surface", "basin          1"})
    EXPECT_THAT(shown.out, HasSubstr(word));
  place->write("again.json", place->run({"show", ids[0], "--study"}).out);
  EXPECT_THAT(place->run({"again.json"}).error, HasSubstr("nothing to run"));
}

TEST_F(BasinCommands, AreFoundByParameterAndMetric) {
  EXPECT_THAT(place->run({"query", "wave", "--where", "basin.viscosity > 0.01", "--columns", "meshes"}).out,
              HasSubstr(ids[1]));
  const Finished trend = place->run({"trend", "wave", "--of", "highest", "--against", "basin.viscosity"});
  EXPECT_EQ(trend.exit_code, 0) << trend.error;
  EXPECT_THAT(trend.out, HasSubstr("0.1"));
}

TEST_F(BasinCommands, ABoundIsCheckedAndItsViolationSaid) {
  const Finished good = place->run({"check", "wave.json"});
  EXPECT_EQ(good.exit_code, 0) << good.out << good.error;
  EXPECT_THAT(good.out, StartsWith("bounds\n"));
  EXPECT_THAT(good.out, Not(HasSubstr("packing")));
  place->write("wave.json", wave("-1"));
  const Finished bad = place->run({"check", "wave.json"});
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.out, HasSubstr("FAILED  volume_drift, basin.viscosity=0.001 Pa s: "));
  EXPECT_THAT(bad.out, HasSubstr(", at most -1\n"));
  place->write("wave.json", wave(R"("1 m")"));
  const Finished unit = place->run({"check", "wave.json"});
  EXPECT_EQ(unit.exit_code, 2);
  EXPECT_THAT(unit.error, HasSubstr("/checks/0/at_most"));
  place->write("wave.json", wave("1e-10"));
}

TEST_F(BasinCommands, ACurveIsAnyColumnOverAnyColumn) {
  const Finished plain = place->run({"curve", "wave"});
  ASSERT_EQ(plain.exit_code, 0) << plain.error;
  EXPECT_THAT(plain.out, StartsWith("case,run,basin.viscosity[Pa s],time[s],volume_error[-],wave[m]\n"));
  EXPECT_EQ(std::ranges::count(plain.out, '\n'), 1 + 2 * 5);
  EXPECT_THAT(place->run({"curve", "wave", "--of", "kinetic_energy,wave", "--against", "left"}).out,
              HasSubstr(",left[m],kinetic_energy[J/m],wave[m]\n"));
  EXPECT_THAT(place->run({"curve", "wave", "--of", "all"}).out,
              HasSubstr(",small_angles[-],vertices[-],meshes[-],iterations[-],cfl[-]\n"));
  EXPECT_THAT(place->run({"curve", "small", "--of", "tip_resistance"}).out,
              HasSubstr(",depth[m],tip_resistance[Pa]\n"));
  EXPECT_THAT(place->run({"curve", "--where", "kind = flow"}).out, HasSubstr("volume_error"));
}

TEST_F(BasinCommands, ACurveIsAPictureToo) {
  EXPECT_EQ(place->run({"curve", "wave", "--out", "wave.svg"}).out, "wave.svg\n");
  const std::string svg = content(place->folder() / "wave.svg");
  EXPECT_TRUE(svg.find("</svg>") != std::string::npos);
  for (const char* text : {"volume_error", "wave (m)", "time (s)", "viscosity 0.001 Pa s", "viscosity 0.1 Pa s"})
    EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_EQ(place->run({"curve", "small", "--of", "tip_resistance", "--out", "small.svg"}).exit_code, 0);
}

TEST_F(BasinCommands, EveryFigureIsAWholePicture) {
  for (const char* kind : {"mesh", "velocity", "quality"}) {
    const Finished drawn = place->run({"figure", kind, ids[0], ids[1], "--time", "0,0.1"});
    ASSERT_EQ(drawn.exit_code, 0) << drawn.error;
    EXPECT_EQ(drawn.out, std::string(kind) + ".svg\n");
    const std::string svg = content(place->folder() / (std::string(kind) + ".svg"));
    EXPECT_TRUE(svg.ends_with("</svg>\n"));
    for (const char* title : {"basin.viscosity=0.001 Pa s, t = 0 s", "basin.viscosity=0.001 Pa s, t = 0.1 s",
                              "basin.viscosity=0.1 Pa s, t = 0.1 s"})
      EXPECT_THAT(svg, HasSubstr(title));
  }
}

TEST_F(BasinCommands, TheNearestFrameIsDrawnAndWithoutATimeTheLast) {
  ASSERT_EQ(place->run({"figure", "mesh", ids[0], "--time", "0.13", "-o", "near.svg"}).exit_code, 0);
  EXPECT_THAT(content(place->folder() / "near.svg"), HasSubstr("t = 0.1 s"));
  ASSERT_EQ(place->run({"figure", "mesh", ids[0], "--window", "-0.2,0.2,0.1,0.3", "-o", "last.png"}).exit_code, 0);
  ASSERT_EQ(place->run({"figure", "mesh", ids[0], "-o", "last.svg"}).exit_code, 0);
  EXPECT_THAT(content(place->folder() / "last.svg"), HasSubstr("t = 0.2 s"));
}

TEST_F(BasinCommands, WhatDoesNotFitEndsWithTwoAndOneLineAndWritesNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"figure", "mesh", ids[0], "--time", "0.09,0.11", "-o", "c.svg"},
       "is the nearest one twice; its frames are at 0, 0.1, 0.2 s"},
      {{"figure", "mesh", ids[0], "--depth", "0.1", "-o", "c.svg"}, "its frames are chosen by --time"},
      {{"figure", "forces", ids[0], "-o", "c.svg"},
       "is a flow: its figures are mesh, velocity, pressure, porosity and quality"},
      {{"figure", "mesh", ids[0], ids[1], ids[0], ids[1], "--time", "0,0.1", "-o", "c.svg"}, "8 panels; at most 6"},
      {{"curve", "wave", "--of", "wavy", "--out", "c.svg"}, "there is no column \"wavy\"; there are time, volume,"},
      {{"curve", "--out", "c.svg"}, "drives and basins have no columns in common"},
      {{"curve", "wave", "--bands", "--out", "c.svg"}, "basins have no packings"},
      {{"curve", "wave", "--of", "all", "--out", "c.svg"}, "a picture has at most 4 columns"},
      {{"curve", "wave", "--of", "time", "--out", "c.svg"}, "a picture needs a column over another one"},
      {{"curve", "wave", "--normalised", "--out", "c.svg"}, "--normalised: basins have no ground"},
      {{"curve", "wave", "--cpt", "--out", "c.csv"}, "--cpt: basins have no ground"},
  };
  for (const auto& [arguments, word] : wrong) {
    const Finished finished = place->run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << word << ": " << finished.error;
    EXPECT_THAT(finished.error, HasSubstr(word));
    EXPECT_EQ(std::ranges::count(finished.error, '\n'), 1) << finished.error;
    EXPECT_EQ(finished.out, "");
  }
  EXPECT_FALSE(fs::exists(place->folder() / "c.svg"));
}

}  // namespace
}  // namespace seapile::commands
