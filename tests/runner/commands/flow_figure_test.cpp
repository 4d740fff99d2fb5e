// What a study of jets ends with, and the command "figure" on its runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "tests/runner/commands/program.h"
#include "tests/support/picture.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// A study of two coarse jets and one of two piles that were run, shared by all tests.
struct FlowFigureCommand : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    ids = place->run_study("jet", R"({
      "study": "jet", "question": "Does a jet shrink?", "fidelity": "standard",
      "base": { "jet": { "geometry": "axisymmetric", "upstream": 1, "downstream": 5, "lip_size": 0.1, "growth": 0.4,
                         "largest_size": 0.4 } },
      "axes": { "jet.reynolds": [24, 36] } })");
    ASSERT_EQ(ids.size(), 2u);
    drive = place->run_study("small", small_study("small")).at(0);
  }
  static void TearDownTestSuite() { delete place; }
  static Workplace* place;
  static std::vector<std::string> ids;
  static std::string drive;
};
Workplace* FlowFigureCommand::place;
std::vector<std::string> FlowFigureCommand::ids;
std::string FlowFigureCommand::drive;

TEST_F(FlowFigureCommand, AStudyOfJetsEndsWithItsSurfacesAndOneOfDrivesDoesNot) {
  EXPECT_THAT(place->run({"jet.json"}).out, EndsWith("\nresults/figures/jet_surface.svg\n"));
  const std::string svg = content(place->results() / "figures" / "jet_surface.svg");
  for (const char* text : {"Does a jet shrink?", "reynolds 24", "reynolds 36"}) EXPECT_THAT(svg, HasSubstr(text));
  EXPECT_FALSE(fs::exists(place->results() / "figures" / "jet.svg"));
  EXPECT_TRUE(fs::exists(place->results() / "figures" / "small.svg"));
  EXPECT_FALSE(fs::exists(place->results() / "figures" / "small_surface.svg"));
}

TEST_F(FlowFigureCommand, EveryKindIsAWholePictureInEitherFormat) {
  for (const char* kind : {"mesh", "velocity"}) {
    const Finished svg = place->run({"figure", kind, ids[0]});
    EXPECT_EQ(svg.exit_code, 0) << svg.error;
    EXPECT_EQ(svg.out, std::string(kind) + ".svg\n");
    const std::string text = content(place->folder() / (std::string(kind) + ".svg"));
    EXPECT_TRUE(text.ends_with("</svg>\n"));
    EXPECT_THAT(text, HasSubstr("jet.reynolds=24"));
    EXPECT_THAT(text, Not(HasSubstr("jet.reynolds=36")));

    const Finished png = place->run({"figure", kind, ids[0], ids[1], "--window", "-1,2,0,1.1", "-o", "a.png"});
    EXPECT_EQ(png.exit_code, 0) << png.error;
    const Picture picture = picture_from_png(content(place->folder() / "a.png"));
    EXPECT_GT(std::set(picture.pixels.begin(), picture.pixels.end()).size(), 50u);
  }
}

TEST_F(FlowFigureCommand, AJetsMeshHasAQualityToo) {
  EXPECT_EQ(place->run({"figure", "quality", ids[0], ids[1]}).out, "quality.svg\n");
  EXPECT_THAT(content(place->folder() / "quality.svg"), HasSubstr("q &lt; 0.5"));
}

TEST_F(FlowFigureCommand, AWholeJetIsNotTooLongForAWindow) {
  EXPECT_EQ(place->run({"figure", "mesh", ids[0], "--window", "-3.5,20,-0.1,1.1", "-o", "long.svg"}).exit_code, 0);
}

TEST_F(FlowFigureCommand, WhatDoesNotFitTheRunEndsWithTwoAndOneLineAndWritesNothing) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"figure", "forces", ids[0], "-o", "c.svg"},
       "is a flow: its figures are mesh, velocity, pressure, porosity and quality"},
      {{"figure", "bed", ids[0], "-o", "c.svg"},
       "is a flow: its figures are mesh, velocity, pressure, porosity and quality"},
      {{"figure", "mesh", drive, "-o", "c.svg"},
       "is a dry drive: its figures are initial, bed, forces, stress, velocity and zone"},
      {{"figure", "velocity", ids[0], drive, "-o", "c.svg"}, "a drive and a flow"},
      {{"figure", "velocity", drive, ids[0], "-o", "c.svg"}, "a drive and a flow"},
      {{"figure", "velocity", ids[0], "--depth", "0.1", "-o", "c.svg"}, "is a flow; its last frame is drawn"},
      {{"figure", "mesh", ids[0], "--window", "7,8,0,1", "-o", "c.svg"}, "nothing of the fluid"},
      {{"figure", "mesh", ids[0], "--time", "0.1", "-o", "c.svg"}, "is a jet; its last frame is drawn"},
      {{"figure", "velocity", drive, "--time", "0.1", "-o", "c.svg"}, "is a drive; its frames are chosen by --depth"},
      {{"figure", "quality", drive, "-o", "c.svg"}, "is a dry drive: its figures are initial,"},
      {{"figure", "quality", ids[0], "--window", "7,8,0,1", "-o", "c.svg"}, "nothing of the fluid"},
  };
  for (const auto& [arguments, word] : wrong) {
    const Finished finished = place->run(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += " " + argument;
    EXPECT_EQ(finished.exit_code, 2) << line << ": " << finished.error;
    EXPECT_THAT(finished.error, HasSubstr(word)) << line;
    EXPECT_EQ(std::ranges::count(finished.error, '\n'), 1) << line << ": " << finished.error;
    EXPECT_EQ(finished.out, "") << line;
  }
  EXPECT_FALSE(fs::exists(place->folder() / "c.svg"));
}

}  // namespace
}  // namespace seapile::commands
