#include "runner/present/surface_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>

#include "runner/present/summary.h"
#include "runner/store/run_folder.h"
#include "tests/runner/store/sample_flow.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A jet that comes to 1 + swell.
SurfaceCurve jet(const std::string& label, double swell) {
  SurfaceCurve curve{label, {}, {}};
  for (int i = 0; i <= 40; ++i) {
    curve.x.push_back(0.5 * i);
    curve.height.push_back(1 + swell * (1 - std::exp(-0.5 * i)));
  }
  return curve;
}

/// The number behind a word of the script.
double number_behind(const std::string& script, const std::string& word) {
  return std::stod(script.substr(script.find(word) + word.size()));
}

struct SurfaceFigureTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("surface_figure_test_" + std::to_string(::getpid()));
  SurfaceFigureTest() { fs::create_directories(folder); }
  ~SurfaceFigureTest() override { fs::remove_all(folder); }
  static std::string content(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST_F(SurfaceFigureTest, IsACompletePictureWithItsTexts) {
  draw({"Does a jet swell?", {jet("reynolds 24", -0.05), jet("reynolds 36", -0.07)}}, folder / "a.svg");
  const std::string svg = content(folder / "a.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  for (const char* text : {"Does a jet swell?", "reynolds 24", "reynolds 36", "Distance from the lip",
                           "Height of the surface", "</svg>"}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST(SurfaceScript, HoldsEveryPointOfEveryCurve) {
  const std::string script = gnuplot_script(SurfaceFigure{"", {jet("a", -0.05), jet("b", 0.1)}});
  EXPECT_THAT(script, HasSubstr("$surface_0 << END\n0 1\n0.5 0.980327\n"));
  EXPECT_THAT(script, HasSubstr("\n20 1.1\nEND\n"));
  EXPECT_THAT(script, Not(HasSubstr("$surface_2")));
  EXPECT_EQ(std::ranges::count(script, '\n'), std::ranges::count(gnuplot_script(SurfaceFigure{}), '\n') + 2 * (41 + 3));
}

TEST(SurfaceScript, TheAxesHoldAllCurvesAndTheLip) {
  const std::string script = gnuplot_script(SurfaceFigure{"", {jet("a", 0.05), jet("b", 0.2)}});
  EXPECT_EQ(number_behind(script, "set xrange [0:"), 20);
  EXPECT_LT(number_behind(script, "set yrange ["), 1);
  const std::string above = script.substr(script.find("set yrange ["));
  EXPECT_GT(number_behind(above, ":"), 1.2);
}

TEST(SurfaceScript, NoTextIsRunAsACommand) {
  const std::string script = gnuplot_script(SurfaceFigure{"`touch harm`", {jet("\"; system(\"touch harm\")", 0.1)}});
  EXPECT_THAT(script, Not(HasSubstr("`touch")));
  EXPECT_THAT(script, Not(HasSubstr("system(\"")));
}

TEST_F(SurfaceFigureTest, OfARunIsTheSurfaceOfItsLastFrame) {
  const fs::path run = store::sample::write_flow(folder);
  const auto frame = store::sample::flow_frame(store::sample::kFlowFrames - 1);
  const auto curve = read_surface(run);
  ASSERT_TRUE(curve);
  EXPECT_EQ(curve->x, std::get<std::vector<double>>(frame.surface.at(1).values));
  EXPECT_EQ(curve->height, std::get<std::vector<double>>(frame.surface.at(2).values));

  CaseResult result{
      store::sample::flow_header().case_id, {{"jet.reynolds", "24"}}, "completed", run, {}, SceneKind::jet};
  const SurfaceFigure figure =
      surface_figure("title", {result, {std::string(64, 'a'), {}, "failed", {}, {}, SceneKind::jet}});
  ASSERT_EQ(figure.curves.size(), 1u);
  EXPECT_EQ(figure.curves[0].label, "reynolds 24");
  EXPECT_EQ(figure.curves[0].height, curve->height);
  EXPECT_THAT(resistance_figure("title", {result}).groups, IsEmpty()) << "a flow is no drive";
  result.kind = SceneKind::basin;
  EXPECT_THAT(surface_figure("title", {result}).curves, IsEmpty()) << "a basin has no die";
}

}  // namespace
}  // namespace seapile::present
