// Every command from end to end, on studies that take about a second.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> result;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) result.push_back(line);
  return result;
}

/// One study that was run, shared by the tests that only look.
struct RunStudy : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->write("small.json", small_study("small"));
    first = new Finished(place->run({"small.json"}));
  }
  static void TearDownTestSuite() {
    delete first;
    delete place;
  }
  static nlohmann::json query(std::vector<std::string> more) {
    more.insert(more.begin(), {"query", "--format", "json"});
    return nlohmann::json::parse(place->run(more).out);
  }
  static std::string id_of(const std::string& tip) {
    return query({"small", "--where", "pile.tip = " + tip}).at("rows").at(0).at("case");
  }
  static Workplace* place;
  static Finished* first;
};
Workplace* RunStudy::place;
Finished* RunStudy::first;

TEST_F(RunStudy, EndsWithATableARemarkAndAPicture) {
  EXPECT_EQ(first->exit_code, 0) << first->error;
  const auto out = lines(first->out);
  ASSERT_GE(out.size(), 8u) << first->out;
  EXPECT_THAT(out[0], HasSubstr("mean q_c"));
  EXPECT_THAT(out[3], HasSubstr("conical"));
  EXPECT_THAT(out[3], HasSubstr("completed"));
  EXPECT_THAT(out[4], HasSubstr("flat"));
  EXPECT_THAT(first->out, HasSubstr("one packing: no interval"));
  EXPECT_EQ(out.back(), "results/figures/small.svg");
  EXPECT_THAT(content(place->results() / "figures" / "small.svg"), HasSubstr("Which tip meets more resistance?"));
}

TEST_F(RunStudy, SaysWhyEachCaseIsRunAndRunsTheBedOnce) {
  EXPECT_THAT(first->error, HasSubstr("never run"));
  EXPECT_EQ(std::ranges::count_if(lines(first->error),
                                  [](const std::string& line) { return line.starts_with("started    bed"); }),
            1);
  EXPECT_THAT(first->error, Not(HasSubstr("\x1b")));  // no terminal
}

TEST_F(RunStudy, ASecondCallRunsNothingSaysSoAndPrintsTheSame) {
  const Finished second = place->run({"run", "small.json"});
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_EQ(second.out, first->out);
  EXPECT_THAT(second.error, HasSubstr("nothing to run"));
  EXPECT_THAT(second.error, HasSubstr("completed with today's numerics"));
  EXPECT_THAT(second.error, Not(HasSubstr("started")));
}

TEST_F(RunStudy, ADryRunWritesNothing) {
  const auto before = everything(place->results());
  const Finished dry = place->run({"small.json", "--dry-run", "--set", "pile.depth=0.1"});
  EXPECT_EQ(dry.exit_code, 0);
  EXPECT_THAT(dry.error, HasSubstr("never run"));
  EXPECT_EQ(everything(place->results()), before);
}

TEST_F(RunStudy, AMissingFrameRunsTheDrivesAgainButNotTheBed) {
  const Finished dry = place->run({"small.json", "--dry-run", "--set", "record.frames=[0.05]"});
  EXPECT_EQ(dry.exit_code, 0) << dry.error;
  EXPECT_THAT(dry.error, HasSubstr("frame at 0.05 m not recorded"));
  EXPECT_THAT(dry.error, HasSubstr("fresh   bed"));
}

TEST_F(RunStudy, QueryAnswersInThreeFormats) {
  const Finished table = place->run({"query", "small"});
  EXPECT_EQ(table.exit_code, 0) << table.error;
  EXPECT_THAT(table.out, HasSubstr("conical"));
  const Finished csv = place->run({"query", "small", "--format", "csv"});
  EXPECT_EQ(lines(csv.out).size(), 3u);
  EXPECT_THAT(lines(csv.out)[0], HasSubstr("case,run,kind,outcome,pile.tip"));
  const auto json = query({"small"});
  EXPECT_EQ(json.at("schema"), "runner/table/1");
  EXPECT_EQ(json.at("rows").size(), 2u);
}

TEST_F(RunStudy, QueryFollowsConditionsAndColumns) {
  EXPECT_EQ(query({"small", "--where", "pile.tip = flat"}).at("rows").size(), 1u);
  EXPECT_EQ(query({"--where", "outcome = completed"}).at("rows").size(), 3u);  // the bed too
  EXPECT_EQ(query({"small", "--where", "pile.tip = flat", "--where", "tip_resistance_mean > 0"}).at("rows").size(), 1u);
  const auto row = query({"small", "--columns", "bed.seed,tip_resistance_mean"}).at("rows").at(0);
  EXPECT_EQ(row.at("bed.seed"), 1);
  EXPECT_TRUE(row.at("tip_resistance_mean").is_number());
}

TEST_F(RunStudy, QueryThatMatchesNothingEndsWithFour) {
  EXPECT_EQ(place->run({"query", "small", "--where", "bed.seed = 99"}).exit_code, 4);
  const Finished unknown = place->run({"query", "smal"});
  EXPECT_EQ(unknown.exit_code, 4);
  EXPECT_THAT(unknown.error, HasSubstr("small"));
}

TEST_F(RunStudy, QueryWithAnUnknownNameEndsWithTwoAndNamesTheNearest) {
  const Finished finished = place->run({"query", "small", "--where", "tip_resistance_meen > 0"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.error, HasSubstr("tip_resistance_mean"));
  EXPECT_EQ(place->run({"query", "small", "--format", "xml"}).exit_code, 2);
}

TEST_F(RunStudy, CurveIsTidyAndRepeatsTheParameters) {
  const Finished finished = place->run({"curve", "small.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const auto rows = lines(finished.out);
  EXPECT_THAT(rows[0], HasSubstr("case,run,pile.tip,time[s],span[s],depth[m]"));
  EXPECT_THAT(rows[0], HasSubstr("tip_resistance[Pa]"));
  EXPECT_GT(rows.size(), 2 * 0.3 / 5e-4);
  const auto commas = std::ranges::count(rows[0], ',');
  for (const std::string& row : rows) EXPECT_EQ(std::ranges::count(row, ','), commas);
  EXPECT_THAT(rows[1], HasSubstr(",0001,conical,"));
  EXPECT_THAT(rows.back(), HasSubstr(",0001,flat,"));

  EXPECT_EQ(place->run({"curve", "small", "--out", "curves.csv"}).exit_code, 0);
  EXPECT_EQ(content(place->folder() / "curves.csv"), finished.out);
  EXPECT_EQ(place->run({"curve", "small", "--out", "no/such/folder.csv"}).exit_code, 2);
  EXPECT_EQ(place->run({"curve", "small", "--where", "bed.seed = 99"}).exit_code, 4);
}

TEST_F(RunStudy, ShowTellsEverythingAboutOneRun) {
  const Finished finished = place->run({"show", id_of("flat")});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  for (const char* word : {"outcome     completed", "state hash", "fluid", "left out", "dry", "tip_resistance_mean",
                           "pile.radius", "series.h5", "CPU s", "numerics", "compiler", "again with  runner show"}) {
    EXPECT_THAT(finished.out, HasSubstr(word));
  }
  EXPECT_EQ(place->run({"show", "ffffffffff"}).exit_code, 4);
}

TEST_F(RunStudy, TheStudyThatShowPrintsIsTheSameCase) {
  const Workplace again;
  again.write("case.json", place->run({"show", id_of("flat"), "--study"}).out);
  const Finished finished = again.run({"case.json"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const std::string id = id_of("flat");
  const auto hash = [&](const Workplace& where) {
    const std::string text = where.run({"show", id}).out;
    return text.substr(text.find("state hash"), 28);
  };
  EXPECT_EQ(hash(again), hash(*place));
}

TEST_F(RunStudy, VerifyFindsAChangedByte) {
  const Workplace copy;
  fs::copy(place->results(), copy.results(), fs::copy_options::recursive);
  EXPECT_EQ(copy.run({"verify"}).exit_code, 0);
  const std::string id = id_of("flat");
  for (const auto& entry : fs::recursive_directory_iterator(copy.results() / "cases")) {
    const bool its_series =
        entry.path().filename() == "series.h5" && entry.path().string().find(id) != std::string::npos;
    if (!its_series) continue;
    std::string bytes = content(entry.path());
    bytes[bytes.size() / 2] ^= 1;
    std::ofstream(entry.path(), std::ios::binary) << bytes;
  }
  const Finished damaged = copy.run({"verify"});
  EXPECT_EQ(damaged.exit_code, 3);
  EXPECT_THAT(damaged.out, HasSubstr("series.h5"));
  EXPECT_THAT(damaged.error, HasSubstr("2 of 3 runs verified"));
  EXPECT_EQ(copy.run({"verify", id}).exit_code, 3);
  EXPECT_EQ(copy.run({"verify", id_of("conical")}).exit_code, 0);
  EXPECT_EQ(copy.run({"verify", "ffff"}).exit_code, 4);
}

TEST_F(RunStudy, ReindexGivesTheSameAnswersFromTheFoldersAlone) {
  const Workplace copy;
  fs::copy(place->results(), copy.results(), fs::copy_options::recursive);
  fs::remove(copy.results() / "catalogue.sqlite");
  const Finished reindexed = copy.run({"reindex"});
  EXPECT_EQ(reindexed.exit_code, 0) << reindexed.error;
  EXPECT_THAT(reindexed.error, HasSubstr("3 runs listed"));
  EXPECT_EQ(copy.run({"query", "--format", "csv"}).out, place->run({"query", "--format", "csv"}).out);
  EXPECT_EQ(copy.run({"reindex", "--store", "nowhere"}).exit_code, 4);
  EXPECT_FALSE(fs::exists(copy.folder() / "nowhere"));
}

TEST_F(RunStudy, ADamagedCatalogueIsRefusedAndReindexedFromTheFolders) {
  const Workplace copy;
  fs::copy(place->results(), copy.results(), fs::copy_options::recursive);
  std::ofstream(copy.results() / "catalogue.sqlite") << "this is no database";
  EXPECT_EQ(copy.run({"query"}).exit_code, 5);
  copy.write("small.json", small_study("small"));
  EXPECT_EQ(copy.run({"small.json"}).exit_code, 5);
  EXPECT_EQ(copy.run({"reindex"}).exit_code, 0);
  EXPECT_EQ(copy.run({"query", "small", "--format", "csv"}).out, place->run({"query", "small", "--format", "csv"}).out);
}

TEST_F(RunStudy, ReadingCommandsWriteNothing) {
  const auto before = everything(place->results());
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"query"},
        {"curve", "small"},
        {"figure", "bed", id_of("flat")},
        {"show", id_of("flat")},
        {"verify"}}) {
    EXPECT_EQ(place->run(command).exit_code, 0) << command[0];
  }
  EXPECT_EQ(everything(place->results()), before);
}

TEST(Run, ADamagedResultIsNoticedAndRunAgain) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  ASSERT_EQ(place.run({"small.json"}).exit_code, 0);
  for (const auto& entry : fs::recursive_directory_iterator(place.results() / "cases")) {
    if (entry.path().filename() == "series.h5") {
      fs::resize_file(entry.path(), 100);
      break;
    }
  }
  const Finished second = place.run({"small.json"});
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_THAT(second.error, HasSubstr("is damaged: series.h5 has 100 bytes"));
  EXPECT_THAT(place.run({"small.json"}).error, HasSubstr("nothing to run"));
}

TEST(Run, SetAndSeedsMakeOtherCases) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  const Finished finished =
      place.run({"small.json", "--set", "pile.depth=0.1 m", "--set", "pile.tip=flat", "--seeds", "2", "--jobs", "1"});
  EXPECT_EQ(finished.exit_code, 0) << finished.error;
  const auto rows =
      nlohmann::json::parse(
          place.run({"query", "small", "--columns", "bed.seed,pile.depth,pile.tip", "--each", "--format", "json"}).out)
          .at("rows");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.at(0).at("bed.seed"), 1);
  EXPECT_EQ(rows.at(1).at("bed.seed"), 2);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("pile.depth"), 0.1);
    EXPECT_EQ(row.at("pile.tip"), "flat");
  }
  EXPECT_THAT(finished.out, Not(HasSubstr("one packing: no interval")));
}

TEST(Run, ABadStudyIsRefusedWithEveryProblemAndLeavesNoFolder) {
  const Workplace place;
  std::string study = small_study("bad", R"("colour": "red",)");
  study.replace(study.find("\"count\": 200"), 12, "\"count\": -1");
  place.write("bad.json", study);
  const Finished finished = place.run({"bad.json"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_EQ(finished.out, "");
  const auto problems = lines(finished.error);
  EXPECT_EQ(problems.size(), 2u) << finished.error;
  for (const std::string& problem : problems) EXPECT_THAT(problem, HasSubstr("bad.json: /"));
  EXPECT_THAT(finished.error, HasSubstr("/base/bed/grains/count"));
  EXPECT_FALSE(fs::exists(place.results()));
  EXPECT_EQ(place.run({"missing.json"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(place.results()));
}

TEST(Run, ABadSetOrMoreThreadsThanCoresIsRefusedAndLeavesNoFolder) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--set", "pile.raduis=1"},
                                                {"--set", "pile.radius"},
                                                {"--jobs", "0"},
                                                {"--jobs", "-1"},
                                                {"--jobs", "two"},
                                                {"--threads", "100000"},
                                                {"--seeds", "0"},
                                                {"--checkpoint", "-1"},
                                                {"--unknown"}}) {
    std::vector<std::string> arguments = {"small.json"};
    arguments.insert(arguments.end(), wrong.begin(), wrong.end());
    const Finished finished = place.run(arguments);
    EXPECT_EQ(finished.exit_code, 2) << wrong[0] << ": " << finished.error;
    EXPECT_NE(finished.error, "") << wrong[0];
  }
  EXPECT_FALSE(fs::exists(place.results()));
}

TEST(Run, ADivergedCaseEndsWithOneAndTheOthersAreDone) {
  // A settling time that is too short: the bed of one seed is refused by the physics, not by the grammar.
  const Workplace place;
  place.write("small.json", small_study("small", R"("zip": {"bed.preparation.longest": ["0.02 s", "12 s"]},)"));
  const Finished finished = place.run({"small.json"});
  EXPECT_EQ(finished.exit_code, 1) << finished.error;
  EXPECT_THAT(finished.error, HasSubstr("FAILED"));
  EXPECT_THAT(finished.error, HasSubstr("NOT RUN"));
  EXPECT_THAT(finished.out, HasSubstr("completed"));
  EXPECT_THAT(finished.out, HasSubstr("not run"));
  const Finished again = place.run({"small.json"});
  EXPECT_EQ(again.exit_code, 1);
  EXPECT_THAT(again.error, HasSubstr("last run diverged"));
}

TEST(Run, AStoreThatCannotBeWrittenEndsWithFive) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  place.write("results", "a file in the way");
  const Finished finished = place.run({"small.json"});
  EXPECT_EQ(finished.exit_code, 5) << finished.error;
  EXPECT_THAT(finished.error, HasSubstr("results"));
}

TEST(Program, HelpVersionAndUsage) {
  const Workplace place;
  const Finished help = place.run({"--help"});
  EXPECT_EQ(help.exit_code, 0);
  for (const char* word : {"run", "query", "curve", "figure", "trend", "check", "show", "verify", "reindex", "Examples"}) {
    EXPECT_THAT(help.out, HasSubstr(word));
  }
  EXPECT_THAT(help.out, Not(HasSubstr("exec")));
  for (const char* command : {"run", "query", "curve", "figure", "trend", "check", "show", "verify", "reindex"}) {
    const Finished finished = place.run({command, "--help"});
    EXPECT_EQ(finished.exit_code, 0);
    EXPECT_THAT(finished.out, HasSubstr("Example")) << command;
  }
  const Finished version = place.run({"--version"});
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_THAT(version.out, HasSubstr("seapile "));
  EXPECT_EQ(place.run({}).exit_code, 2);
  EXPECT_EQ(place.run({"fly"}).exit_code, 2);
  EXPECT_EQ(place.run({"query", "--fly"}).exit_code, 2);
  EXPECT_EQ(place.run({"exec", "missing.json"}).exit_code, 40);
  EXPECT_EQ(place.run({"exec", "-"}, "{}").exit_code, 40);
  EXPECT_FALSE(fs::exists(place.results()));
}

}  // namespace
}  // namespace seapile::commands
