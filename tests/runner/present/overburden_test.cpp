#include "runner/present/overburden.h"

#include <gmock/gmock.h>

#include "runner/present/figure.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::present {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(EffectiveStress, IsTheWeightAboveLessThePressureOfStillWater) {
  const Overburden dry{20e3, 0, 0, 0.1}, under_water{20e3, 10e3, 0, 0.1}, table{20e3, 10e3, 2, 0.1};
  EXPECT_DOUBLE_EQ(effective_stress(dry, 3), 60e3);
  EXPECT_DOUBLE_EQ(effective_stress(under_water, 3), 30e3);
  EXPECT_DOUBLE_EQ(effective_stress(table, 2), 40e3);
  EXPECT_DOUBLE_EQ(effective_stress(table, 3), 50e3);
}

TEST(Shown, NormalisedIsTheStressAcrossAndTheWidthDown) {
  const ResistanceCurve curve{{}, {}, Overburden{20e3, 10e3, 0, 0.25}};
  const auto point = shown(curve, 0.5, 40e3);
  ASSERT_TRUE(point);
  EXPECT_DOUBLE_EQ(point->depth, 2);
  EXPECT_DOUBLE_EQ(point->resistance, 8);
  EXPECT_FALSE(shown(curve, 0, 1));
  EXPECT_FALSE(shown(curve, -0.1, 1));
  EXPECT_DOUBLE_EQ(shown({}, 0.5, 40e3)->resistance, 40e3);
}

/// q_c proportional to depth: N sigma'_v0.
ResistanceCurve proportional(double factor, const Overburden& ground) {
  ResistanceCurve curve{{}, {}, ground};
  for (int i = 1; i <= 400; ++i) {
    curve.depth.push_back(i * 5e-4);
    curve.resistance.push_back(factor * effective_stress(ground, i * 5e-4));
  }
  return curve;
}

TEST(BinMeans, OfANormalisedCurveAreTheMeanOverTheStressInTheMiddle) {
  const auto means = bin_means(proportional(7, {20e3, 10e3, 0, 0.1}));
  ASSERT_EQ(means.size(), 4u);
  for (std::size_t bin = 0; bin < 4; ++bin) {
    const double middle = (static_cast<double>(bin) + 0.5) * kBinWidth;
    EXPECT_DOUBLE_EQ(means[bin].first, middle / 0.1);
    // The records lie a quarter millimetre below the middle of their bin.
    EXPECT_NEAR(means[bin].second, 7 * (middle + 2.5e-4) / middle, 1e-9);
  }
}

TEST(NormalisedFigure, HasAxesWithoutUnitsAndALogarithmWhereTheFieldLiesOverIt) {
  const Overburden ground{20e3, 0, 0, 0.1};
  const std::vector<CurveGroup> groups = {{"a", {proportional(7, ground), proportional(8, ground)}}};
  const std::string alone = gnuplot_script({"", groups}),
                    over = gnuplot_script(
                        {"", groups, {{"site.gef", {{0.02, 0.5}, {1e6, 5e6}, Overburden{18e3, 10e3, 0, 0.0357}}}}});
  EXPECT_THAT(alone, HasSubstr("set x2label \"Tip resistance over vertical effective stress"));
  EXPECT_THAT(alone, HasSubstr("set ylabel \"Depth of the tip over width of the pile"));
  EXPECT_THAT(alone, HasSubstr("set yrange [2:0]"));
  EXPECT_THAT(alone, Not(HasSubstr("kPa")));
  EXPECT_THAT(alone, Not(HasSubstr("logscale")));
  EXPECT_THAT(over, HasSubstr("set logscale x2"));
  EXPECT_THAT(over, HasSubstr("title \"site.gef\""));
  // Across q_c/sigma'_v0 = 1e6/(0.02 (18e3 - 10e3)), down d/B = 0.02/0.0357.
  EXPECT_THAT(over, HasSubstr("$site_0 << END\n6250 0.560224\n"));
  EXPECT_THAT(over, HasSubstr("set yrange [2:0]")) << "the field goes deeper than the piles";
}

TEST(MedianDiameter, HasHalfOfTheMassBelowIt) {
  const store::Scratch scratch;
  const auto written = store::sample::write(scratch.path());
  const double d50 = median_diameter(written.bed);
  double below = 0, all = 0;
  const simulation::Bed bed = store::sample::bed();
  for (const simulation::Array& array : bed.grains) {
    if (array.info.name != "grains/radius") continue;
    for (const double r : std::get<std::vector<double>>(array.values)) {
      all += r * r;
      if (2 * r < d50) below += r * r;
      if (2 * r == d50) below += r * r / 2;
    }
  }
  EXPECT_NEAR(below / all, 0.5, 0.03) << "one grain of 50 is 2 %";
}

}  // namespace
}  // namespace seapile::present
