// The command "figure" from end to end, and the laws that hold between a real frame and what is drawn of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runner/present/frame_figure.h"
#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"
#include "tests/support/picture.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// One study of two tips that was run, shared by all tests.
struct FigureCommand : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->write("small.json", small_study("small"));
    ASSERT_EQ(place->run({"small.json"}).exit_code, 0);
    const auto rows = nlohmann::json::parse(place->run({"query", "--format", "json"}).out).at("rows");
    for (const auto& row : rows) {
      ids[row.at("kind") == "bed" ? "bed" : row.at("pile.tip").get<std::string>()] = row.at("case");
    }
  }
  static void TearDownTestSuite() { delete place; }

  /// What lies in the folder beside the results.
  static std::set<std::string> pictures() {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(place->folder())) names.insert(entry.path().filename());
    return names;
  }

  static present::FrameOfRun frame_of(const std::string& tip) {
    for (const auto& entry : fs::directory_iterator(place->results() / "cases")) {
      if (!entry.path().filename().string().starts_with(ids.at(tip))) continue;
      const fs::path folder = entry.path() / "0001";
      const auto manifest = store::read_manifest(folder);
      const auto bed =
          store::read_manifest(store::case_folder(place->results(), manifest.header.bed_id) / manifest.header.bed_run);
      double surface = std::nan("");
      for (const auto& metric : bed.result.metrics) surface = metric.name == "surface" ? metric.value : surface;
      return {tip, study::scene_from_json(manifest.header.scene_json), surface, store::read_frame(folder, 1)};
    }
    throw std::runtime_error("no run of that tip");
  }

  static Workplace* place;
  static std::map<std::string, std::string> ids;
};
Workplace* FigureCommand::place;
std::map<std::string, std::string> FigureCommand::ids;

template <class T>
const std::vector<T>& values(const std::vector<simulation::Array>& arrays, const std::string& name) {
  for (const auto& array : arrays) {
    if (array.info.name == name) return std::get<std::vector<T>>(array.values);
  }
  throw std::runtime_error("no array " + name);
}

TEST_F(FigureCommand, EveryKindIsAWholePictureInEitherFormat) {
  for (const char* kind : {"bed", "forces", "stress", "velocity", "zone"}) {
    const Finished svg = place->run({"figure", kind, ids["flat"], "--depth", "0.1", "-o", "a.svg"});
    EXPECT_EQ(svg.exit_code, 0) << svg.error;
    EXPECT_EQ(svg.out, "a.svg\n");
    const std::string text = content(place->folder() / "a.svg");
    EXPECT_TRUE(text.ends_with("</svg>\n"));
    EXPECT_THAT(text, HasSubstr("pile.tip=flat, d = 0.100 m"));
    EXPECT_THAT(text, Not(HasSubstr("conical")));

    const Finished png = place->run({"figure", kind, ids["flat"], ids["conical"], "--depth", "0.1", "--out", "a.png"});
    EXPECT_EQ(png.exit_code, 0) << png.error;
    const Picture picture = picture_from_png(content(place->folder() / "a.png"));
    if (kind != std::string("zone")) {
      EXPECT_GT(picture.width, picture.height) << "side by side";
    }
    EXPECT_GT(std::set(picture.pixels.begin(), picture.pixels.end()).size(), 50u);
    EXPECT_EQ(picture.at(0, 0), 0xFFFFFFu);
  }
}

TEST_F(FigureCommand, TheInitialConfigurationIsTheFrameAtDepthZeroWithItsSizes) {
  EXPECT_EQ(place->run({"figure", "initial", ids["flat"], "-o", "initial.svg"}).exit_code, 0);
  const std::string text = content(place->folder() / "initial.svg");
  for (const char* word : {"Initial configuration", "200 grains of radii", "m wide"})
    EXPECT_THAT(text, HasSubstr(word));
  EXPECT_THAT(text, Not(HasSubstr("fluid")));
}

TEST_F(FigureCommand, AZoneIsAlsoRowsOfNumbers) {
  const Finished finished = place->run({"figure", "zone", ids["flat"], ids["conical"], "-o", "zone.csv"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const std::string text = content(place->folder() / "zone.csv");
  EXPECT_TRUE(text.starts_with("run,depth[m],distance[m],porosity_before"));
  for (const char* word : {"pile.tip=flat,0.1", "pile.tip=conical,0.1"}) EXPECT_THAT(text, HasSubstr(word));
}

TEST_F(FigureCommand, ASecondTimeIsTheSamePicture) {
  EXPECT_EQ(place->run({"figure", "forces", ids["flat"], "-o", "b.svg"}).exit_code, 0);
  const std::string first = content(place->folder() / "b.svg");
  EXPECT_EQ(place->run({"figure", "forces", ids["flat"], "-o", "b.svg"}).exit_code, 0);
  EXPECT_TRUE(content(place->folder() / "b.svg") == first);
}

TEST_F(FigureCommand, WithoutADepthTheLastFrameIsDrawnIntoAFileOfItsKind) {
  const Finished finished = place->run({"figure", "stress", ids["conical"]});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  EXPECT_EQ(finished.out, "stress.svg\n");
  EXPECT_THAT(content(place->folder() / "stress.svg"), HasSubstr("pile.tip=conical, d = 0.100 m"));
}

TEST_F(FigureCommand, AWindowIsWhatIsSeen) {
  const Finished finished =
      place->run({"figure", "--window", "-0.2,0.2,0.1,0.3", "bed", ids["flat"], "-o", "window.png"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const Picture picture = picture_from_png(content(place->folder() / "window.png"));
  EXPECT_EQ(place->run({"figure", "bed", ids["flat"], "--window=-0.2,0.2,0,0.6", "-o", "window.png"}).exit_code, 0);
  const Picture tall = picture_from_png(content(place->folder() / "window.png"));
  EXPECT_LT(static_cast<double>(picture.height) / picture.width, static_cast<double>(tall.height) / tall.width);
}

TEST_F(FigureCommand, WhatCannotBeDrawnEndsWithTwoAndOneLineAndWritesNothing) {
  const auto before = pictures();
  const std::string flat = ids["flat"];
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"figure", "colours", flat},
       "initial, bed, forces, stress, velocity, zone, mesh, flow, pressure, porosity and quality"},
      {{"figure", flat, "bed"}, "there is no figure"},
      {{"figure", "bed", flat, "-o", "c.pdf"}, ".svg or .png"},
      {{"figure", "bed", flat, "-o", "c"}, ".svg or .png"},
      {{"figure", "bed", flat, "--depth", "0.0511", "-o", "c.svg"}, "frames are at 0, 0.1 m"},
      {{"figure", "bed", flat, "--depth", "0.102", "-o", "c.svg"}, "frames are at 0, 0.1 m"},
      {{"figure", "bed", flat, "--depth", "deep", "-o", "c.svg"}, "deep"},
      {{"figure", "bed", flat, "--depth", "nan", "-o", "c.svg"}, "frames are at 0, 0.1 m"},
      {{"figure", "bed", flat, "--window", "0,1,2", "-o", "c.svg"}, "--window"},
      {{"figure", "bed", flat, "--window", "1,0,0,1", "-o", "c.svg"}, "x0 < x1"},
      {{"figure", "bed", flat, "--window", "0,nan,0,1", "-o", "c.svg"}, "x0 < x1"},
      {{"figure", "bed", flat, "--window", "0,1m,0,1", "-o", "c.svg"}, "x0 < x1"},
      {{"figure", "bed", flat, "--window", "0,1,0,0.01", "-o", "c.svg"}, "30 times"},
      {{"figure", "bed", flat, "--window", "7,8,0,1", "-o", "c.svg"}, "nothing of the box"},
      {{"figure", "bed", ids["bed"], "-o", "c.svg"}, "is a bed"},
      {{"figure", "bed", flat, ids["bed"], "-o", "c.svg"}, "is a bed"},
      {{"figure", "bed", flat, "-o", "no/such/c.svg"}, "no/such"},
      {{"figure", "bed", "", "-o", "c.svg"}, "several"},
      {{"figure", "bed", flat, flat, flat, flat, "-o", "c.svg"}, "4 drives; at most 3"},
      {{"figure", "initial", flat, "--depth", "0.1", "-o", "c.svg"}, "initial is at d = 0"},
      {{"figure", "zone", flat, "--depth", "0", "-o", "c.svg"}, "zone compares a depth with d = 0; the frames of"},
      {{"figure", "zone", flat, "--depth", "0.05", "-o", "c.svg"}, "frames are at 0, 0.1 m"},
      {{"figure", "zone", flat, "--time", "1", "-o", "c.svg"}, "chosen by --depth"},
      {{"figure", "zone", flat, "-o", "c.txt"}, "that of its numbers in .csv"},
      {{"figure", "bed", flat, "-o", "c.csv"}, ".svg or .png"},
      {{"figure", "zone", flat, "--window", "0,1,7,8", "-o", "c.svg"}, "no cell of"},
      {{"figure", "bed", "-o", "c.svg"}, "RUN"},
      {{"figure"}, "KIND"},
  };
  for (const auto& [arguments, word] : wrong) {
    const Finished finished = place->run(arguments);
    std::string line;
    for (const std::string& argument : arguments) line += " " + argument;
    EXPECT_EQ(finished.exit_code, 2) << line << ": " << finished.error;
    EXPECT_THAT(finished.error, HasSubstr(word)) << line;
    EXPECT_EQ(finished.out, "") << line;
  }
  EXPECT_EQ(place->run({"figure", "bed", "ffffffffff", "-o", "c.svg"}).exit_code, 4);
  EXPECT_EQ(pictures(), before);
}

TEST_F(FigureCommand, ADepthWithinAMillimetreWillDo) {
  EXPECT_EQ(place->run({"figure", "bed", ids["flat"], "--depth", "0.1009", "-o", "near.svg"}).exit_code, 0);
}

TEST_F(FigureCommand, ADamagedFrameIsNotDrawn) {
  const Workplace copy;
  fs::copy(place->results(), copy.results(), fs::copy_options::recursive);
  for (const auto& entry : fs::recursive_directory_iterator(copy.results() / "cases")) {
    if (entry.path().filename() == "contacts.vtkhdf") fs::resize_file(entry.path(), 1000);
  }
  const Finished finished = copy.run({"figure", "bed", ids["flat"], "-o", "c.svg"});
  EXPECT_EQ(finished.exit_code, 5);
  EXPECT_THAT(finished.error, HasSubstr("contacts.vtkhdf"));
  EXPECT_FALSE(fs::exists(copy.folder() / "c.svg"));
}

TEST_F(FigureCommand, TheTipsContactsLieOnThePileThatIsDrawn) {
  for (const char* tip : {"flat", "conical"}) {
    const present::FrameOfRun run = frame_of(tip);
    const auto outline = present::frame_figure(present::FigureKind::forces, {run}, {}).panels.at(0).pile;
    const auto& pair = values<std::int64_t>(run.frame.contacts, "contacts/grain");
    const auto& point = values<double>(run.frame.contacts, "contacts/position");
    const auto& radius = values<double>(run.frame.grains, "grains/radius");
    // A contact stands where it last was in the window of 0.01 s, in which the pile moves at 0.4 m/s; and overlaps.
    const double hair = 0.01 * 0.4 + 0.02 * *std::ranges::max_element(radius);
    int touching = 0;
    for (std::size_t k = 0; 2 * k < pair.size(); ++k) {
      if (pair[2 * k + 1] != -4) continue;
      ++touching;
      const base::Vec2 p{point[2 * k], point[2 * k + 1]};
      double nearest = 1;
      for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
        const base::Vec2 along = outline[i + 1] - outline[i];
        const double part = std::clamp(dot(p - outline[i], along) / dot(along, along), 0.0, 1.0);
        nearest = std::min(nearest, norm(p - outline[i] - part * along));
      }
      EXPECT_LT(nearest, hair) << tip;
    }
    EXPECT_GT(touching, 0) << tip;
  }
}

TEST_F(FigureCommand, EllipsesAreTheEigenvectorsAndEigenvaluesOfTheStress) {
  const present::FrameOfRun run = frame_of("flat");
  const present::FrameFigure figure = present::frame_figure(present::FigureKind::stress, {run}, {});
  const auto& tensor = values<double>(run.frame.cells, "cells/stress");
  const simulation::Frame::Grid& grid = run.frame.grid;
  std::size_t skewed = 0;
  ASSERT_GT(figure.panels.at(0).stresses.size(), 20u);
  for (const present::DrawnStress& drawn : figure.panels.at(0).stresses) {
    const auto column = static_cast<std::size_t>((drawn.centre.x - grid.x0) / grid.spacing);
    const auto row = static_cast<std::size_t>((drawn.centre.y - grid.y0) / grid.spacing);
    const std::size_t k = row * static_cast<std::size_t>(grid.nx) + column;
    // One Jacobi rotation makes a symmetric 2 x 2 matrix diagonal; the larger value belongs to the major axis.
    const double xx = tensor.at(3 * k), yy = tensor.at(3 * k + 1), xy = tensor.at(3 * k + 2);
    double t = 0;
    if (xy != 0) {
      const double theta = (yy - xx) / (2 * xy);
      t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1));
    }
    const double c = 1 / std::sqrt(1 + t * t), s = t * c;
    const bool first = xx - t * xy >= yy + t * xy;
    const double major = first ? xx - t * xy : yy + t * xy, minor = first ? yy + t * xy : xx - t * xy;
    const base::Vec2 axis = first ? base::Vec2{c, -s} : base::Vec2{s, c};
    const double hair = 1e-9 * std::max(std::abs(major), std::abs(minor));
    EXPECT_NEAR(drawn.major, major, hair);
    EXPECT_NEAR(drawn.minor, minor, hair);
    EXPECT_NEAR(drawn.semi_major / figure.scale.length, std::abs(major) / figure.scale.full, 1e-9);
    EXPECT_NEAR(drawn.semi_minor / figure.scale.length, std::abs(minor) / figure.scale.full, 1e-9);
    if (major - minor < 1e-6 * major) continue;
    const double across = axis.x * std::sin(drawn.direction) - axis.y * std::cos(drawn.direction);
    EXPECT_NEAR(across, 0, 1e-6);
    skewed += std::abs(axis.x * axis.y) > 0.2 ? 1 : 0;
  }
  EXPECT_GT(skewed, 5u) << "a wrong sign of the angle would not be seen";
}

TEST_F(FigureCommand, TheWholeBedHasEveryGrainInItsInitialLayer) {
  const present::FrameFigure figure = present::frame_figure(present::FigureKind::bed, {frame_of("flat")}, {});
  EXPECT_EQ(figure.panels.at(0).grains.size(), 200u);
  // The two drives start from one bed: layer by layer as many grains.
  std::map<long, int> flat, conical;
  for (const auto& grain : figure.panels[0].grains) ++flat[grain.layer];
  const auto other = present::frame_figure(present::FigureKind::bed, {frame_of("conical")}, {});
  for (const auto& grain : other.panels.at(0).grains) ++conical[grain.layer];
  EXPECT_EQ(flat, conical);
  EXPECT_GT(flat.size(), 4u);
}

TEST_F(FigureCommand, TwoPanelsShareTheScaleOfTheLargerForce) {
  const auto flat = frame_of("flat"), conical = frame_of("conical");
  const auto full = [](const std::vector<present::FrameOfRun>& runs) {
    return present::frame_figure(present::FigureKind::forces, runs, {}).scale.full;
  };
  EXPECT_NE(full({flat}), full({conical}));
  EXPECT_EQ(full({flat, conical}), std::max(full({flat}), full({conical})));
}

}  // namespace
}  // namespace seapile::commands
