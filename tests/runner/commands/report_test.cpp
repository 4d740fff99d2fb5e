// A study's report through the real program; what it looks like is tested in a browser (docs/report.md).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kHostile = "</script><script>document.title = 'no'</script>";

/// Two tips on two packings, run once; a third packing is asked for and missing. The flat tip's question is hostile.
struct ReportCommand : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->write("tips.json", study(R"("replicates": {"seeds": 2},)"));
    ASSERT_EQ(ran->run({"tips.json"}).exit_code, 0);
    ran->write("tips.json", study(R"("replicates": {"seeds": 3},)"));
    std::ofstream(ran->results() / "figures" / "tips_longer.svg") << "<svg xmlns='http://www.w3.org/2000/svg'/>";
    made = new Finished(ran->run({"report", "tips.json", "-o", "r.html"}));
    html = content(ran->folder() / "r.html");
  }
  static void TearDownTestSuite() {
    delete made;
    delete ran;
  }
  static std::string study(const std::string& more) {
    std::string text = small_study("tips", more + R"("checks": [
      {"metric": "tip_resistance_bin_0.10", "value": "1 MPa", "tolerance": "1 kPa", "source": ")" +
                                               kHostile + R"(",
       "if": {"pile.tip": "flat"}},
      {"metric": "overlap_max", "at_most": 1},
      {"claim": ")" + kHostile + R"(", "metric": "tip_resistance_mean", "of": {"pile.tip": "flat"},
       "over": {"pile.tip": "conical"}, "at_least": 1, "margin": 0.05}],)");
    return text.replace(text.find("Which tip"), 0, kHostile + " ");
  }
  static json data() {
    const std::string open = R"(<script type="application/json" id="data">)";
    const auto first = html.find(open) + open.size();
    return json::parse(html.substr(first, html.find("</script>", first) - first));
  }
  static json section(const std::string& id) {
    const json all = data();
    for (const json& one : all.at("sections")) {
      if (one.at("id") == id) return one.at("blocks");
    }
    return json::array();
  }
  static json block(const std::string& id, const std::string& type, std::size_t place = 0) {
    const json all = section(id);
    for (const json& one : all) {
      if (one.at("type") == type && place-- == 0) return one;
    }
    return {};
  }
  static std::vector<std::string> counts() {
    std::vector<std::string> words;
    const json all = data();
    for (const json& one : all.at("counts")) words.push_back(one.at("words"));
    return words;
  }
  static Workplace* ran;
  static Finished* made;
  static std::string html;
};
Workplace* ReportCommand::ran;
Finished* ReportCommand::made;
std::string ReportCommand::html;

TEST_F(ReportCommand, EndsWithZeroAndNamesTheFile) {
  EXPECT_EQ(made->exit_code, 0) << made->error;
  EXPECT_EQ(made->out, "r.html\n");
}

TEST_F(ReportCommand, AsksForNothingFromAnywhere) {
  EXPECT_THAT(html, HasSubstr("default-src 'none'"));
  const std::string page = html.substr(0, html.find(R"(<script type="application/json")"));
  for (const char* word : {"<link", "<img", "<iframe", "<object", "@import", "url(", "http:", "https:"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
  EXPECT_FALSE(std::regex_search(html, std::regex(R"(<(script|img|link|source|iframe)[^>]*\s(src|href)\s*=)")));
  EXPECT_THAT(html, Not(HasSubstr("fetch(")));
  EXPECT_THAT(html, Not(HasSubstr("XMLHttpRequest")));
}

TEST_F(ReportCommand, HoldsHostileTextsAsData) {
  EXPECT_THAT(html, Not(HasSubstr(kHostile)));
  EXPECT_THAT(data().at("question").get<std::string>(), HasSubstr(kHostile));
  EXPECT_THAT(block("verdicts", "table").at("notes").dump(), HasSubstr("</script>"));
}

TEST_F(ReportCommand, CountsVerdictsAndCases) {
  EXPECT_THAT(counts(),
              testing::IsSupersetOf({"1 claim missing", "4 cases completed", "0 cases failed", "2 cases missing"}));
  const json rest = block("verdicts", "table", 3);
  EXPECT_EQ(rest.at("caption"), "Cases that are not completed");
  EXPECT_EQ(rest.at("rows"), 2);
}

TEST_F(ReportCommand, DrawsBandsRecordsAndReferencePointsWithDepthDownwards) {
  const json chart = block("results", "chart");
  EXPECT_EQ(chart.at("downwards"), true);
  EXPECT_EQ(chart.at("groups").size(), 2u);
  std::map<std::string, int> kinds;
  for (const json& line : chart.at("lines")) {
    ++kinds[line.at("kind")];
    EXPECT_LE(line.at("x").size(), 2000u);
    EXPECT_EQ(line.at("x").size(), line.at("y").size());
  }
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"band", 2}, {"mean", 2}, {"record", 4}, {"reference", 1}}));
  const json& point = chart.at("lines").back();
  EXPECT_EQ(point.at("y").at(0), 0.125);
  EXPECT_EQ(point.at("group"), 1);
}

TEST_F(ReportCommand, TellsCostParametersAndProvenance) {
  EXPECT_THAT(block("cost", "table").at("csv").get<std::string>(),
              HasSubstr("CPU[s],wall[s],memory[MB],steps,steps_rejected"));
  EXPECT_EQ(block("cost", "table").at("rows"), 4);
  EXPECT_THAT(block("parameters", "table").at("csv").get<std::string>(), HasSubstr("bed.seed,pile.tip"));
  EXPECT_THAT(block("parameters", "table", 1).at("csv").get<std::string>(), HasSubstr("bed.grains.count,200,,all"));
  const std::string by = block("provenance", "table").dump();
  EXPECT_THAT(by, HasSubstr("runner report tips.json -o r.html"));
  EXPECT_THAT(block("provenance", "table", 1).dump(), HasSubstr("compiler"));
  EXPECT_EQ(block("provenance", "table", 2).at("rows"), 6);  // four drives, two beds
}

TEST_F(ReportCommand, HoldsThePicturesThatAreNamedAfterTheStudy) {
  ASSERT_EQ(section("figures").size(), 2u);
  EXPECT_EQ(section("figures").at(0).at("name"), "tips.svg");
  ran->write("longer.json", small_study("tips_longer"));
  const fs::path entry = ran->results() / "studies" / "tips_longer-0123.json";
  std::ofstream(entry) << "{}";
  ASSERT_EQ(ran->run({"report", "tips.json", "-o", "again.html"}).exit_code, 0);
  EXPECT_THAT(content(ran->folder() / "again.html"), Not(HasSubstr("tips_longer.svg")));
  fs::remove(entry);
}

TEST_F(ReportCommand, ShowsWhatIsStaleAndHowARunEnded) {
  const Workplace place;
  fs::copy(ran->results(), place.results(), fs::copy_options::recursive);
  place.write("tips.json", study(R"("replicates": {"seeds": 3},)"));
  const auto query = json::parse(place.run({"query", "tips", "--each", "--format", "json"}).out);
  const std::string id = query.at("rows").at(0).at("case");
  for (const auto& folder : fs::directory_iterator(place.results() / "cases")) {
    if (!folder.path().filename().string().starts_with(id)) continue;
    fs::remove(folder.path() / "0001" / "manifest.json");
    std::ofstream(folder.path() / "0001" / "log.txt") << "first line\n" << kHostile << " \xff\n";
  }
  ASSERT_EQ(place.run({"report", "tips.json", "-o", "r.html", "--set", "record.frames=[0.05]"}).exit_code, 0);
  const std::string text = content(place.folder() / "r.html");
  EXPECT_THAT(text, HasSubstr("3 cases stale"));
  EXPECT_THAT(text, HasSubstr("frame at 0.05 m not recorded"));
  EXPECT_THAT(text, HasSubstr("1 case interrupted"));
  EXPECT_THAT(text, HasSubstr("first line\\n\\u003c/script"));
  EXPECT_THAT(text, Not(HasSubstr(kHostile)));
}

TEST_F(ReportCommand, ThatFindsNoRunEndsWithFourAndWritesNothing) {
  const Workplace place;
  place.write("tips.json", small_study("tips"));
  const Finished none = place.run({"report", "tips.json"});
  EXPECT_EQ(none.exit_code, 4);
  EXPECT_THAT(none.error, HasSubstr("no case of tips.json was ever run in results"));
  EXPECT_FALSE(fs::exists(place.folder() / "tips.html"));
}

TEST_F(ReportCommand, ThatCannotBeWrittenOrIsAskedWronglyEndsWithTwo) {
  const Finished nowhere = ran->run({"report", "tips.json", "-o", "nowhere/r.html"});
  EXPECT_EQ(nowhere.exit_code, 2);
  EXPECT_THAT(nowhere.error, HasSubstr("nowhere/"));
  EXPECT_EQ(ran->run({"report", "tips.json", "-o", "r.pdf"}).exit_code, 2);
  EXPECT_EQ(ran->run({"report", "absent.json"}).exit_code, 2);
  EXPECT_EQ(ran->run({"report"}).exit_code, 2);
  EXPECT_THAT(ran->run({"report", "--help"}).out, HasSubstr("Examples:"));
}

}  // namespace
}  // namespace seapile::commands
