// The catalogue through the program: expressions, SQL, what others have written, and other versions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sqlite3.h>

#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

struct Queries : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->run_study("small", small_study("small"));
  }
  static void TearDownTestSuite() { delete place; }
  static std::size_t rows(const std::vector<std::string>& words) {
    std::vector<std::string> command = {"query", "--format", "json"};
    command.insert(command.end(), words.begin(), words.end());
    const Finished answer = place->run(command);
    EXPECT_EQ(answer.exit_code, 0) << answer.error;
    return json::parse(answer.out).at("rows").size();
  }
  static Workplace* place;
};
Workplace* Queries::place;

/// Questions of every kind.
const std::vector<std::vector<std::string>> kQuestions = {
    {"query", "small"},
    {"query", "small", "tip = conical", "--format", "json"},
    {"query", "kind = bed or speed > 0.1 m/s", "--format", "csv"},
    {"query", "small", "--columns", "tip,bed:solid_fraction,bed:case", "--format", "ndjson"},
    {"query", "--sql", "SELECT study, ordinal, case_id, labels, number, kind, outcome, depth, folder FROM results",
     "--format", "csv"},
    {"query", "--sql", "SELECT case_id, path, num, txt FROM param ORDER BY 1, 2", "--format", "csv"},
    {"query", "--sql", "SELECT name, value FROM metric JOIN run USING (run_id) ORDER BY case_id, name", "--format",
     "csv"},
    {"curve", "small"},
    {"status", "--format", "csv"}};

std::vector<std::string> answers(const Workplace& place) {
  std::vector<std::string> all;
  for (const auto& question : kQuestions) {
    const Finished answer = place.run(question);
    EXPECT_EQ(answer.exit_code, 0) << answer.error;
    EXPECT_GT(answer.out.size(), 40U);
    all.push_back(answer.out);
  }
  return all;
}

TEST_F(Queries, ExpressionsTakeEndsOfPathsAndUnits) {
  EXPECT_EQ(rows({"tip = conical"}), 1U);
  EXPECT_EQ(rows({"small", "tip = conical or tip = flat"}), 2U);
  EXPECT_EQ(rows({"speed > 0.3 m/s and not tip = flat"}), 1U);
  EXPECT_EQ(rows({"kind = bed"}), 1U);
  EXPECT_EQ(place->run({"query", "speed > 40 cm/s"}).exit_code, 4) << "all are as fast as that";
  const Finished unknown = place->run({"query", "tp = flat"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_THAT(unknown.error, HasSubstr("the nearest is"));
  EXPECT_EQ(place->run({"query", "speed > 40 kPa"}).exit_code, 2);
  EXPECT_EQ(place->run({"query", "(tip = flat"}).exit_code, 2);
}

TEST_F(Queries, SqlReadsAndDoesNotWrite) {
  EXPECT_EQ(rows({"--sql", "SELECT * FROM run WHERE outcome = :how", "--bind", "how=completed"}), 3U);
  const auto before = content(place->results() / "catalogue.sqlite");
  for (const char* harm : {"DELETE FROM run", "ATTACH 'x' AS y", "PRAGMA user_version = 9", "SELECT 1; DELETE FROM run",
                           "SELECT load_extension('x')"}) {
    const Finished refused = place->run({"query", "--sql", harm});
    EXPECT_EQ(refused.exit_code, 2) << harm;
    EXPECT_EQ(std::ranges::count(refused.error, '\n'), 1) << refused.error;
  }
  const Finished endless = place->run(
      {"query", "--sql", "WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT max(i) FROM n",
       "--time-limit", "0.05"});
  EXPECT_EQ(endless.exit_code, 2);
  EXPECT_EQ(content(place->results() / "catalogue.sqlite"), before);
}

TEST_F(Queries, ACatalogueMadeAnewGivesTheSameAnswers) {
  const auto before = answers(*place);
  fs::remove(place->results() / "catalogue.sqlite");
  EXPECT_EQ(place->run({"query", "small"}).exit_code, 5);
  ASSERT_EQ(place->run({"reindex"}).exit_code, 0);
  EXPECT_EQ(answers(*place), before);
  fs::remove(place->results() / "catalogue.sqlite");
  ASSERT_EQ(place->run({"ingest"}).exit_code, 0);
  EXPECT_EQ(answers(*place), before);
  const Finished again = place->run({"ingest"});
  EXPECT_THAT(again.error, HasSubstr("0 runs added, 3 were listed already"));
  EXPECT_EQ(answers(*place), before);
  EXPECT_EQ(place->run({"ingest", "nowhere"}).exit_code, 2);
}

/// Gives the catalogue of a place another version.
void set_version(const Workplace& place, int version) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((place.results() / "catalogue.sqlite").c_str(), &database), SQLITE_OK);
  const std::string pragma = "PRAGMA user_version = " + std::to_string(version);
  EXPECT_EQ(sqlite3_exec(database, pragma.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

TEST(OtherCatalogues, AnOlderOneIsMigratedOnRequestAloneAndANewerOneIsRefused) {
  const Workplace place;
  fs::copy(SEAPILE_RESULTS_SCHEMA "/golden/v1", place.results(), fs::copy_options::recursive);
  const Finished older = place.run({"query"});
  EXPECT_EQ(older.exit_code, 5);
  EXPECT_THAT(older.error, HasSubstr("runner migrate"));
  const auto before = everything(place.results());
  EXPECT_THAT(place.run({"migrate", "--check"}).out, HasSubstr("would be brought to schema 3"));
  EXPECT_EQ(everything(place.results()), before);

  const Finished migrated = place.run({"migrate"});
  EXPECT_EQ(migrated.exit_code, 0) << migrated.error;
  const Finished answer = place.run({"query", "--format", "csv"});
  EXPECT_EQ(answer.exit_code, 0) << answer.error;
  ASSERT_EQ(place.run({"reindex"}).exit_code, 0);
  EXPECT_EQ(place.run({"query", "--format", "csv"}).out, answer.out);
  EXPECT_THAT(place.run({"migrate"}).out, HasSubstr("nothing to do"));

  set_version(place, 99);
  for (const char* command : {"query", "migrate", "status"}) {
    const Finished newer = place.run({command});
    EXPECT_EQ(newer.exit_code, 5) << command;
    EXPECT_THAT(newer.error, HasSubstr("newer version of Seapile"));
  }
}

}  // namespace
}  // namespace seapile::commands
