#include "runner/present/series_figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runner/present/thinning.h"
#include "tests/runner/store/sample_flow.h"
#include "tests/runner/store/scratch.h"

namespace seapile::present {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

/// A basin's run of five records.
struct SeriesFigureTest : testing::Test {
  SeriesFigureTest() {
    store::RunWriter writer(folder, store::sample::basin_header());
    for (std::size_t i = 0; i < 5; ++i) writer.add(store::sample::flow_record(i));
    writer.finish(store::sample::flow_result(), store::sample::provenance(), nullptr);
  }
  SeriesFigure figure(const std::vector<std::string>& columns) const {
    const std::string id = store::sample::basin_header().case_id;
    return series_figure("t$itle", {{id, "0001", {{"basin.depth", "1 m"}, {"bed.seed", "3"}}, folder}}, Series::water,
                         columns);
  }
  store::Scratch scratch;
  std::filesystem::path folder = store::case_folder(scratch.path(), store::sample::basin_header().case_id) / "0001";
};

TEST_F(SeriesFigureTest, HasTheFirstColumnBelowAllOthers) {
  const SeriesFigure found = figure({"rise", "wave", "volume"});
  EXPECT_EQ(found.abscissa.name, "rise");
  EXPECT_EQ(found.abscissa.unit, "m");
  ASSERT_EQ(found.panels.size(), 2u);
  EXPECT_EQ(found.panels[1].unit, "m2");
  EXPECT_EQ(found.panels[0].values.at(0).at(3), store::sample::flow_record(3).wave);
  EXPECT_THAT(found.runs, ElementsAre("depth 1 m"));
}

TEST_F(SeriesFigureTest, ALineIsBrokenWhereAValueIsMissing) {
  // The height in the middle is absent from the second record.
  const std::string script = gnuplot_script(figure({"time", "middle"}));
  const std::size_t from = script.find("$line_0_0 << END\n"), to = script.find("END\n", from + 20);
  const std::string block = script.substr(from, to - from);
  EXPECT_EQ(std::ranges::count(block, '\n'), 1 + 5);
  EXPECT_THAT(block, HasSubstr("\n\n0.1 "));
  EXPECT_THAT(block, Not(HasSubstr("nan")));
  EXPECT_THAT(script, Not(HasSubstr("t$itle"))) << "nothing in a title is a macro";
}

TEST(Thinned, KeepsEveryPointOfAShortLine) {
  EXPECT_THAT(thinned({3, 1, 2}), ElementsAre(0, 1, 2));
  EXPECT_TRUE(thinned({}).empty());
}

TEST(Thinned, KeepsThePeaksOfALongOne) {
  std::vector<double> values(1'000'000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::sin(1e-3 * static_cast<double>(i));
  values[123'456] = 7;
  values[654'321] = -7;
  const std::vector<std::size_t> kept = thinned(values);
  EXPECT_LE(kept.size(), kMostPoints + 2);
  EXPECT_TRUE(std::ranges::is_sorted(kept));
  for (const std::size_t peak : {123'456u, 654'321u}) EXPECT_TRUE(std::ranges::binary_search(kept, peak)) << peak;
}

}  // namespace
}  // namespace seapile::present
