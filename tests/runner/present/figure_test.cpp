#include "runner/present/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <set>

#include "runner/store/run_folder.h"

namespace seapile::present {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

/// q_c = 1000 Pa times the depth in bins, one record per half millimetre.
ResistanceCurve ramp(double deepest) {
  ResistanceCurve curve;
  for (int i = -200; i * 5e-4 <= deepest + 1e-9; ++i) {
    curve.depth.push_back(i * 5e-4);
    curve.resistance.push_back(1000 * i * 5e-4 / kBinWidth);
  }
  return curve;
}

struct FigureTest : testing::Test {
  fs::path folder = fs::temp_directory_path() / ("figure_test_" + std::to_string(::getpid()));
  FigureTest() { fs::create_directories(folder); }
  ~FigureTest() override { fs::remove_all(folder); }
  static std::string content(const fs::path& file) {
    std::ifstream in(file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
};

TEST(BinMeans, AreMeansOverFiveCentimetresBelowTheSurface) {
  const auto means = bin_means(ramp(0.2));
  ASSERT_EQ(means.size(), 4u);
  for (std::size_t bin = 0; bin < 4; ++bin) {
    EXPECT_NEAR(means[bin].first, (static_cast<double>(bin) + 0.5) * 0.05, 1e-12);
    // The records end at 0.5, 1, ..., 50 mm of the bin, so their mean lies a quarter millimetre below its middle.
    EXPECT_NEAR(means[bin].second, 1000 * (static_cast<double>(bin) + 0.505), 1e-6);
  }
}

TEST(BinMeans, ABinThatIsNotFullIsLeftOut) { EXPECT_EQ(bin_means(ramp(0.18)).size(), 3u); }

TEST(BinMeans, APileThatMovesUpAndDownCountsWhereItReachesNewDepth) {
  ResistanceCurve steady = ramp(0.1), bouncing;
  for (std::size_t i = 0; i < steady.depth.size(); ++i) {
    bouncing.depth.push_back(steady.depth[i]);
    bouncing.resistance.push_back(steady.resistance[i]);
    for (const double back : {0.002, 0.001}) {
      bouncing.depth.push_back(steady.depth[i] - back);
      bouncing.resistance.push_back(-1e6);
    }
  }
  EXPECT_EQ(bin_means(bouncing), bin_means(steady));
}

TEST(BandOfPackings, IsTheIntervalOfTheMeanOverTheBinsThatAllHave) {
  CurveGroup group{"", {ramp(0.2), ramp(0.1), ramp(0.2)}};
  for (double& value : group.packings[1].resistance) value *= 3;
  for (double& value : group.packings[2].resistance) value *= 2;
  const auto band = band_of_packings(group);
  ASSERT_EQ(band.size(), 2u);
  EXPECT_NEAR(band[0].depth, 0.025, 1e-12);
  EXPECT_EQ(band[0].mean.n, 3u);
  EXPECT_NEAR(band[0].mean.mean, 2 * 505, 1e-6);
  // 505, 1515, 1010: standard deviation 505, t_0.975(2) = 4.302653.
  EXPECT_NEAR(band[0].mean.high - band[0].mean.mean, 4.302653 * 505 / std::sqrt(3), 1e-3);
  EXPECT_NEAR(band[0].mean.mean - band[0].mean.low, 4.302653 * 505 / std::sqrt(3), 1e-3);
}

TEST(BandOfPackings, NarrowsWithTheNumberOfPackings) {
  CurveGroup group;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 8; ++i) {
    group.packings.push_back(ramp(0.2));
    for (double& value : group.packings.back().resistance) value *= i % 2 == 0 ? 1 : 1.2;
    if (i % 2 == 0) continue;
    const auto mean = band_of_packings(group)[2].mean;
    EXPECT_LT(mean.high - mean.low, before);
    before = mean.high - mean.low;
  }
}

TEST_F(FigureTest, DrivesThatAreTooShortForALineAreToldInASentence) {
  const std::vector<CurveGroup> many(kMostFaint + 1, CurveGroup{"", {ramp(0.04)}});
  for (const auto& groups : {std::vector<CurveGroup>{{"", {ramp(0.04), ramp(0.03)}}}, many}) {
    try {
      draw({"", groups}, folder / "a.svg");
      ADD_FAILURE() << "something was drawn";
    } catch (const store::StoreError& error) {
      EXPECT_THAT(error.what(), HasSubstr("a.svg is not drawn: no drive goes through a full 0.05 m of depth"));
    }
  }
  EXPECT_FALSE(fs::exists(folder / "a.svg"));
  draw({"", {{"", {ramp(0.04)}}}}, folder / "a.svg");  // a run by itself is drawn record by record
  EXPECT_TRUE(fs::exists(folder / "a.svg"));
}

TEST_F(FigureTest, SeveralPackingsHaveABandAndALegendThatSaysSo) {
  ResistanceCurve higher = ramp(1.2);
  for (double& value : higher.resistance) value += 2000;
  draw({"", {{"tip flat", {ramp(1.2), higher}}, {"tip conical", {ramp(1.2), ramp(1.2), higher}}}}, folder / "a.svg");
  const std::string svg = content(folder / "a.svg");
  EXPECT_THAT(svg, HasSubstr("mean of 2 to 3 packings, 95 % band"));
  EXPECT_THAT(svg, HasSubstr("fill-opacity"));
  EXPECT_THAT(gnuplot_script({"", {{"a", {ramp(0.2), ramp(0.2)}}}}), HasSubstr("$band_0 "));
}

TEST_F(FigureTest, OnePackingHasNoBand) {
  const std::string script = gnuplot_script({"", {{"tip flat", {ramp(1.2)}}}});
  EXPECT_THAT(script, Not(HasSubstr("band")));
  EXPECT_THAT(script, HasSubstr("One packing"));
}

TEST_F(FigureTest, IsACompletePictureWithItsTexts) {
  draw({"How does q_c change?", {{"tip flat", {ramp(1.2)}}, {"tip conical", {ramp(1.2)}}}}, folder / "a.svg");
  const std::string svg = content(folder / "a.svg");
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_THAT(svg, HasSubstr("How does q_c change?"));
  EXPECT_THAT(svg, HasSubstr("tip conical"));
  EXPECT_THAT(svg, HasSubstr("(kPa)"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1) << "something was left beside the picture";
}

TEST_F(FigureTest, ADeathWhileDrawingLeavesNothing) {
  // A gnuplot that kills whoever started it, once the picture is drawn.
  const fs::path fake = folder / "bin" / "gnuplot", pictures = folder / "pictures";
  fs::create_directories(fake.parent_path());
  const std::string path = std::getenv("PATH");
  std::ofstream(fake) << "#!/bin/sh\nPATH='" << path << "' gnuplot \"$@\"\nkill -9 $PPID\n";
  fs::permissions(fake, fs::perms::owner_all);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
    draw({"", {{"", {ramp(0.2)}}}}, pictures / "a.svg");
    ::_exit(0);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status)) << status;
  EXPECT_TRUE(fs::is_empty(pictures));
}

TEST_F(FigureTest, AGnuplotThatDiesTakesNobodyAlong) {
  const fs::path fake = folder / "bin" / "gnuplot";
  fs::create_directories(fake.parent_path());
  std::ofstream(fake) << "#!/bin/sh\nkill -9 $$\n";
  fs::permissions(fake, fs::perms::owner_all);
  // More of a script than a pipe holds.
  Figure figure;
  for (int i = 0; i < 400; ++i) figure.groups.push_back({"pile " + std::to_string(i), {ramp(1.2)}});
  ASSERT_GT(gnuplot_script(figure).size(), 1U << 17);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", (fake.parent_path().string() + ":" + path).c_str(), 1);
  EXPECT_THROW(draw(figure, folder / "a.svg"), store::StoreError);
  ::setenv("PATH", path.c_str(), 1);
  EXPECT_FALSE(fs::exists(folder / "a.svg"));
}

TEST_F(FigureTest, NoTextIsRunAsACommandOrBreaksThePicture) {
  const std::string file = (folder / "harm").string();
  const std::string harm =
      "'; system(\"touch " + file + "\"); `touch " + file + "` $x @y {/Bold b} <b> & \\ \"\nset output";
  draw({harm, {{harm, {ramp(0.2)}}, {"b", {ramp(0.2)}}}}, folder / "a'b.svg");
  EXPECT_FALSE(fs::exists(file));
  const std::string svg = content(folder / "a'b.svg");
  EXPECT_THAT(svg, HasSubstr("&lt;b> &amp;"));
  EXPECT_THAT(svg, Not(HasSubstr("<b>")));
}

TEST_F(FigureTest, ALongTitleIsBrokenAndCut) {
  std::string title;
  for (int i = 0; i < 200; ++i) title += "word ";
  const std::string script = gnuplot_script({title, {{"", {ramp(0.2)}}}});
  EXPECT_THAT(script, HasSubstr("set label 3 "));
  EXPECT_THAT(script, HasSubstr("…"));
  EXPECT_THAT(script, Not(HasSubstr("set label 5 ")));
}

TEST_F(FigureTest, ManyRecordsAreThinnedButThePeaksStay) {
  ResistanceCurve curve;
  for (int i = 1; i <= 100000; ++i) {
    curve.depth.push_back(i * 1e-5);
    curve.resistance.push_back(i == 77777 ? 5e6 : 1000);
  }
  const std::string script = gnuplot_script({"", {{"", {curve}}}});
  EXPECT_LT(script.size(), 100'000u);
  EXPECT_THAT(script, HasSubstr("\n5000 0.77777\n"));
}

TEST_F(FigureTest, TwelveCasesHaveTwelveLooks) {
  Figure figure;
  for (int i = 0; i < 12; ++i) figure.groups.push_back({"case " + std::to_string(i), {ramp(0.2)}});
  const std::string script = gnuplot_script(figure);
  std::set<std::string> looks;
  for (std::size_t at = 0; (at = script.find(" dt ", at)) != std::string::npos; ++at) {
    looks.insert(script.substr(at, script.find(" title", at) - at));
  }
  EXPECT_EQ(looks.size(), 12u);
}

TEST_F(FigureTest, AFolderThatCannotBeWrittenIsAnErrorInWords) {
  std::ofstream(folder / "file") << "in the way";
  const fs::path before = fs::current_path(), apart = folder / "apart";
  fs::create_directories(apart);
  fs::current_path(apart);
  EXPECT_THROW(draw({"", {{"", {ramp(0.2)}}}}, folder / "file" / "a.svg"), store::StoreError);
  fs::current_path(before);
  EXPECT_TRUE(fs::is_empty(apart)) << "something was written where the program was started";
}

}  // namespace
}  // namespace seapile::present
