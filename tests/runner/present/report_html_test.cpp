// The file of a report whose texts were written by somebody who means harm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "runner/present/report.h"

namespace seapile::present {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kHostile =
    R"(</script><script>alert("x")</script><img src="https://example.org/a.png"> & 'q' {{script}})";

Report report_of(const std::string& text) {
  Report report{text, text, text, {{text, Tone::bad}}, {}};
  ReportSection section{"all", text, {}};
  section.blocks.emplace_back(ReportText{{text}});
  section.blocks.emplace_back(
      ReportTable{text, {{text, "verdict"}, {"", ""}, {{text, "ok"}}}, {}, "verdict", {Tone::good}, {text}});
  ReportChart chart{text, text, {text, "Pa"}, {"d", "m"}, true};
  chart.groups = {text};
  chart.lines.push_back({LineKind::mean, 0, text, {1, std::numeric_limits<double>::quiet_NaN()}, {2, 3}});
  section.blocks.emplace_back(std::move(chart));
  section.blocks.emplace_back(ReportBars{text, {text, "s"}, {text}, {1}});
  section.blocks.emplace_back(ReportPicture{text, text});
  section.blocks.emplace_back(ReportLog{text, text, text, text, text});
  report.sections.push_back(std::move(section));
  return report;
}

std::string island_of(const std::string& html) {
  const std::string open = R"(<script type="application/json" id="data">)";
  const auto first = html.find(open) + open.size();
  return html.substr(first, html.find("</script>", first) - first);
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

TEST(ReportHtml, HoldsTheTextsAsDataAndNeverAsMarkup) {
  const std::string html = report_html(report_of(kHostile));
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("<img")));
  EXPECT_EQ(count(html, "</script>"), count(report_html(report_of("plain")), "</script>"));
  const auto data = nlohmann::json::parse(island_of(html));
  EXPECT_EQ(data.at("schema"), "seapile/report/1");
  EXPECT_EQ(data.at("study"), kHostile);
  const auto& blocks = data.at("sections").at(0).at("blocks");
  ASSERT_EQ(blocks.size(), 6u);
  EXPECT_EQ(blocks[1].at("columns").at(1).at("cells").at(0), kHostile);
  EXPECT_EQ(blocks[5].at("log"), kHostile);
}

TEST(ReportHtml, SurvivesBytesThatAreNoText) {
  const auto data = nlohmann::json::parse(island_of(report_html(report_of("log \xff\xfe end"))));
  EXPECT_THAT(data.at("study").get<std::string>(), HasSubstr("end"));
}

TEST(ReportHtml, WritesAGapAsNull) {
  const auto data = nlohmann::json::parse(island_of(report_html(report_of("a"))));
  const auto& line = data.at("sections").at(0).at("blocks").at(2).at("lines").at(0);
  EXPECT_EQ(line.at("x"), nlohmann::json::parse("[1.0, null]"));
}

TEST(ReportHtml, PutsTheVerdictFirstWithItsToneAndLeavesOutWhatIsEmpty) {
  Report report{"a", "b", "", {}, {{"s", "S", {}}}};
  report.sections[0].blocks.emplace_back(
      ReportTable{"t",
                  {{"metric", "case", "verdict"}, {"", "", ""}, {{"q", {}, "FAILED"}, {"r", {}, "ok"}}},
                  {},
                  "verdict",
                  {Tone::bad, Tone::good}});
  const auto data = nlohmann::json::parse(island_of(report_html(report)));
  const auto& table = data.at("sections").at(0).at("blocks").at(0);
  ASSERT_EQ(table.at("columns").size(), 2u);
  EXPECT_EQ(table.at("columns").at(0).at("cells"), nlohmann::json::parse(R"(["FAILED", "ok"])"));
  EXPECT_EQ(table.at("tones"), nlohmann::json::parse(R"(["bad", "good"])"));
  EXPECT_EQ(table.at("csv"), "metric,case,verdict\nq,,FAILED\nr,,ok\n");
}

TEST(ReportHtml, HoldsChartJsWithItsLicence) {
  const std::string html = report_html(report_of("a"));
  EXPECT_THAT(html, HasSubstr("Chart.js v"));
  EXPECT_THAT(html, HasSubstr("Released under the MIT License"));
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
}

}  // namespace
}  // namespace seapile::present
