// The commands on a drive in a saturated bed: two series and two kinds of frames in one run. The run is made up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "runner/store/catalogue.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"
#include "tests/runner/store/sample_flow.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
namespace sample = store::sample;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::size_t lines_of(const std::string& text) { return static_cast<std::size_t>(std::ranges::count(text, '\n')); }

/// A dry and a saturated drive that differ in nothing else, of five records and two frames, 0.1 m and 0.2 m deep.
struct SaturatedCommand : testing::Test {
  static constexpr std::size_t kRecords = 5;

  static void SetUpTestSuite() {
    place = new Workplace;
    const sample::Written written = sample::write(place->results());
    store::Catalogue catalogue = store::Catalogue::open(place->results());
    catalogue.ingest(written.bed);
    store::StudyEntry entry{"water", "Does water help?", "", {}};
    for (const bool wet : {false, true}) {
      store::RunHeader header = sample::drive_header();
      scene::SceneSpec scene;
      scene.pile.emplace();
      if (wet) scene.fluid.emplace();
      header.scene_json = study::to_json(scene);
      header.canonical = study::canonical_text(scene, header.bed_id);
      header.case_id = study::case_id(header.canonical);
      const fs::path folder = store::case_folder(place->results(), header.case_id) / "0001";
      store::RunWriter writer(folder, header);
      for (std::size_t i = 0; i < kRecords; ++i) {
        writer.add(sample::record(i));
        if (wet) writer.add(sample::saturated_record(i));
        if (i % 3 != 0) continue;
        simulation::Frame frame = sample::frame(i / 3);
        frame.depth = frame.asked = i == 0 ? 0.1 : 0.2;
        writer.add(frame);
        if (wet) writer.add(sample::flow_frame(i / 3));
      }
      writer.finish(sample::drive_result(), sample::provenance(), nullptr);
      catalogue.ingest(folder);
      (wet ? saturated : dry) = header.case_id.substr(0, 10);
      entry.cases.push_back({header.case_id, {{"fluid", wet ? "density=1000 kg/m3" : "null"}}});
    }
    catalogue.put(entry);
  }
  static void TearDownTestSuite() { delete place; }

  /// The columns of a line of CSV.
  static std::vector<std::string> cells(const std::string& line) {
    std::vector<std::string> list;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');) list.push_back(cell);
    return list;
  }

  static Workplace* place;
  static std::string dry, saturated;
};
Workplace* SaturatedCommand::place;
std::string SaturatedCommand::dry, SaturatedCommand::saturated;

TEST_F(SaturatedCommand, ACurveTakesColumnsOfBothSeriesRowByRow) {
  const Finished curve = place->run({"curve", "water", "--where", "fluid != null", "--of",
                                     "tip_resistance,shoulder_pressure,fluid:tip_force_y", "--against", "depth"});
  ASSERT_EQ(curve.exit_code, 0) << curve.error;
  std::istringstream lines(curve.out);
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "case,run,fluid,depth[m],tip_resistance[Pa],shoulder_pressure[Pa],fluid:tip_force_y[N/m]");
  for (std::size_t i = 0; i < kRecords; ++i) {
    ASSERT_TRUE(std::getline(lines, line));
    const std::vector<std::string> row = cells(line);
    ASSERT_EQ(row.size(), 7U) << line;
    EXPECT_EQ(row[0], saturated);
    EXPECT_EQ(std::stod(row[3]), sample::record(i).depth);
    EXPECT_EQ(std::stod(row[4]), sample::record(i).tip_resistance);
    EXPECT_EQ(std::stod(row[5]), sample::saturated_record(i).shoulder_pressure);
    EXPECT_EQ(std::stod(row[6]), sample::saturated_record(i).tip_force_y);
  }
  EXPECT_FALSE(std::getline(lines, line));
}

TEST_F(SaturatedCommand, TheFluidsColumnsAreNoNumbersInADryRunBesideIt) {
  const Finished curve = place->run({"curve", "water", "--of", "tip_resistance,shoulder_pressure"});
  ASSERT_EQ(curve.exit_code, 0) << curve.error;
  EXPECT_EQ(lines_of(curve.out), 1 + 2 * kRecords);
  std::istringstream lines(curve.out);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("case")) continue;
    EXPECT_EQ(cells(line).at(5) == "nan", line.starts_with(dry)) << line;
  }
  EXPECT_EQ(place->run({"curve", "water", "--of", "shoulder_pressure,tip_resistance", "--out", "c.svg"}).exit_code, 0);
  EXPECT_THAT(content(place->folder() / "c.svg"), HasSubstr("shoulder_pressure"));
}

TEST_F(SaturatedCommand, WithoutAWordACurveIsOfAllColumnsThatARunHas) {
  const std::string all = place->run({"curve", "water"}).out, heading = all.substr(0, all.find('\n'));
  for (const char* word : {"depth[m]", ",tip_force_y[N/m]", ",fluid:tip_force_y[N/m]", ",immersed[-]"})
    EXPECT_THAT(heading, HasSubstr(word));
  EXPECT_THAT(place->run({"curve", "water", "--where", "fluid = null"}).out, Not(HasSubstr("immersed")));
}

TEST_F(SaturatedCommand, DryDrivesAloneHaveNoColumnsOfTheFluid) {
  const Finished curve = place->run({"curve", "water", "--where", "fluid = null", "--of", "shoulder_pressure"});
  EXPECT_EQ(curve.exit_code, 2);
  EXPECT_THAT(curve.error, HasSubstr("there is no column \"shoulder_pressure\""));
}

TEST_F(SaturatedCommand, AFigureOfTheFluidIsChosenByDepthOrByTime) {
  for (const char* kind : {"mesh", "flow", "pressure", "porosity", "quality"}) {
    const Finished by_depth = place->run({"figure", kind, saturated, "--depth", "0.2", "-o", "depth.svg"});
    ASSERT_EQ(by_depth.exit_code, 0) << kind << by_depth.error;
    const Finished by_time = place->run({"figure", kind, saturated, "--time", "0.45", "-o", "time.svg"});
    ASSERT_EQ(by_time.exit_code, 0) << kind << by_time.error;
    const std::string drawn = content(place->folder() / "depth.svg");
    EXPECT_EQ(drawn, content(place->folder() / "time.svg")) << "the second frame of both";
    EXPECT_THAT(drawn, HasSubstr("d = 0.200 m"));
    EXPECT_EQ(place->run({"figure", kind, saturated, "-o", "last.svg"}).exit_code, 0);
    EXPECT_EQ(drawn, content(place->folder() / "last.svg"));
    EXPECT_EQ(place->run({"figure", kind, saturated, "--depth", "0.1", "-o", "first.svg"}).exit_code, 0);
    EXPECT_NE(drawn, content(place->folder() / "first.svg"));
  }
  EXPECT_EQ(place->run({"figure", "flow", saturated, "--time", "0,0.5", "-o", "two.svg"}).exit_code, 0);
  EXPECT_THAT(content(place->folder() / "two.svg"), testing::AllOf(HasSubstr("d = 0.100 m"), HasSubstr("d = 0.200 m")));
}

TEST_F(SaturatedCommand, ItsGrainsAreDrawnAsThoseOfADryDriveAndBesideThem) {
  for (const char* kind : {"bed", "forces", "velocity"}) {
    const Finished both = place->run({"figure", kind, dry, saturated, "--depth", "0.2", "-o", "both.svg"});
    EXPECT_EQ(both.exit_code, 0) << kind << both.error;
    EXPECT_THAT(content(place->folder() / "both.svg"),
                testing::AllOf(HasSubstr("no fluid, d = 0.200 m"), HasSubstr("fluid.density=1000 kg/m3, d = 0.200 m")));
  }
}

TEST_F(SaturatedCommand, WhatDoesNotFitTheRunIsSaid) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"figure", "mesh", dry}, "is a dry drive: its figures are initial, bed, forces, stress, velocity and zone"},
      {{"figure", "pressure", saturated, dry}, "is a dry drive"},
      {{"figure", "mesh", saturated, "--depth", "0.15"}, "has no frame within 1 mm of 0.15 m"},
      {{"figure", "mesh", saturated, "--depth", "0.1", "--time", "0"}, "one of them chooses frames"},
      {{"figure", "initial", saturated}, "has no frame within 1 mm of 0 m; its frames are at 0.1, 0.2 m"},
      {{"figure", "zone", saturated}, "has no frame within 1 mm of 0 m; its frames are at 0.1, 0.2 m"},
      {{"figure", "velocity", saturated, "--time", "0"}, "its frames are chosen by --depth"}};
  for (const auto& [arguments, word] : wrong) {
    const Finished finished = place->run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << arguments[1];
    EXPECT_THAT(finished.error, HasSubstr(word));
  }
}

TEST_F(SaturatedCommand, ShowQueryVerifyAndReindexKnowBoth) {
  const Finished show = place->run({"show", saturated});
  EXPECT_EQ(show.exit_code, 0) << show.error;
  for (const char* word : {"flow.vtkhdf", "surface.h5", "series.h5", "grains.vtkhdf", "fluid.density", "drive"})
    EXPECT_THAT(show.out, HasSubstr(word));
  EXPECT_THAT(place->run({"show", dry}).out, Not(HasSubstr("flow.vtkhdf")));
  EXPECT_EQ(place->run({"verify", saturated}).exit_code, 0);
  for (int pass = 0; pass < 2; ++pass) {
    const std::string wet = place->run({"query", "water", "--where", "fluid.density = 1000", "--format", "csv"}).out;
    EXPECT_EQ(lines_of(wet), 2U) << wet;
    EXPECT_THAT(wet, HasSubstr(saturated));
    EXPECT_THAT(wet, HasSubstr("density=1000 kg/m3"));
    const std::string without = place->run({"query", "water", "--where", "fluid = null", "--format", "csv"}).out;
    EXPECT_EQ(lines_of(without), 2U) << without;
    EXPECT_THAT(without, HasSubstr(dry));
    if (pass == 0) {
      EXPECT_EQ(place->run({"reindex"}).exit_code, 0);
    }
  }
}

}  // namespace
}  // namespace seapile::commands
