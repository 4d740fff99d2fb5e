#include "runner/present/edge.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "runner/present/edge_figure.h"

namespace seapile::present {
namespace {

/// Tries what the search asks for until it ends; `holds`: what the truth is.
EdgeSearch searched(EdgeSearch search, const std::function<bool(double)>& holds) {
  for (EdgeState state = judge(search); !state.next.empty(); state = judge(search))
    for (const double value : state.next) search.probes.push_back({value, true, holds(value) ? "" : "it broke"});
  return search;
}

EdgeSearch between(double good, double bad) {
  EdgeSearch search;
  search.path = "contact.step";
  search.good = good;
  search.bad = bad;
  search.within = 0.1;
  return search;
}

TEST(Edge, IsFoundWithinTheRatioAskedForOnEitherSide) {
  for (const auto& [good, bad] : {std::pair{1e-4, 1.0}, std::pair{1.0, 1e-4}}) {
    const bool rises = bad > good;
    const auto search = searched(between(good, bad), [&](double x) { return rises ? x < 0.0123 : x > 0.0123; });
    const EdgeState state = judge(search);
    EXPECT_EQ(state.end, EdgeEnd::found);
    EXPECT_LE(std::max(state.first_bad / state.last_good, state.last_good / state.first_bad), 1.1);
    EXPECT_TRUE(rises ? state.last_good < 0.0123 && state.first_bad >= 0.0123
                      : state.last_good > 0.0123 && state.first_bad <= 0.0123);
    EXPECT_EQ(state.tripped, "it broke");
    // log2(ln 1e4 / ln 1.1) halvings.
    EXPECT_EQ(search.probes.size(), 2 + 7);
  }
}

TEST(Edge, OfWholeNumbersIsBetweenNeighbours) {
  EdgeSearch search = between(1000, 1);
  search.whole = true;
  const EdgeState state = judge(searched(search, [](double x) { return x >= 37; }));
  EXPECT_EQ(state.last_good, 37);
  EXPECT_EQ(state.first_bad, 36);
}

TEST(Edge, SaysWhenThereIsNone) {
  const auto never = searched(between(1, 2), [](double) { return false; });
  EXPECT_EQ(judge(never).end, EdgeEnd::never_holds);
  const auto always = searched(between(1, 2), [](double) { return true; });
  EXPECT_EQ(judge(always).end, EdgeEnd::always_holds);
  EXPECT_EQ(never.probes.size() + always.probes.size(), 4u);
}

// What is known does not depend on the order in which it was found.
TEST(Edge, IsAFunctionOfTheProbesAlone) {
  EdgeSearch search = searched(between(1e-4, 1), [](double x) { return x < 0.3; });
  const EdgeState one = judge(search);
  std::ranges::reverse(search.probes);
  search.probes.push_back({17, true, "beyond both ends"});
  const EdgeState other = judge(search);
  EXPECT_EQ(one.last_good, other.last_good);
  EXPECT_EQ(one.first_bad, other.first_bad);
}

TEST(Edge, AProbeWithoutAResultIsTriedAgain) {
  EdgeSearch search = between(1, 4);
  search.probes = {{1, true, ""}, {4, true, "it broke"}, {2, false, ""}};
  EXPECT_THAT(judge(search).next, testing::ElementsAre(2));
  EXPECT_EQ(judge(search).end, EdgeEnd::searching);
}

TEST(Edge, AMapShowsWhatWasFoundAndWhatHoldsOrFailsThroughout) {
  EdgeSearch found = searched(between(1e-4, 1), [](double x) { return x < 0.3; }), always = between(1, 2),
             never = between(1, 2);
  found.labels = {{"scheme", "implicit"}, {"speed", "0.2 m/s"}};
  always.labels = {{"scheme", "implicit"}, {"speed", "0.4 m/s"}};
  never.labels = {{"scheme", "explicit"}, {"speed", "0.2 m/s"}};
  const std::string script = gnuplot_script(
      "t", {found, searched(always, [](double) { return true; }), searched(never, [](double) { return false; })});
  using testing::HasSubstr;
  for (const char* part : {"$found_0", "$holds_0", "$fails_1", "\"speed (m/s)\"", "scheme explicit"})
    EXPECT_THAT(script, HasSubstr(part));
  found.labels.pop_back();
  EXPECT_EQ(gnuplot_script("t", {found}), "") << "no axis is a number";
}

}  // namespace
}  // namespace seapile::present
