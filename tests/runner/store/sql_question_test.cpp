// A question in SQL reads, and does nothing else.
#include "runner/store/sql_question.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "runner/store/durable.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;

class SqlQuestions : public testing::Test {
 protected:
  void SetUp() override {
    const sample::Written written = sample::write(root_);
    Catalogue catalogue = Catalogue::open(root_);
    catalogue.ingest(written.bed);
    catalogue.ingest(written.drive);
    const std::string id = written.drive.parent_path().filename();
    catalogue.put({"tips", "?", "", {{id, {{"pile.tip", "flat"}}}, {std::string(64, 'f'), {}}}});
  }

  std::vector<std::vector<Cell>> rows(const std::string& text, const std::vector<std::string>& bind = {}) const {
    return ask(root_, {text, bind}).table.rows;
  }

  std::string complaint(const SqlQuestion& question) const {
    try {
      ask(root_, question);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  }

  Scratch scratch_;
  Path root_ = scratch_.fresh("root");
};

TEST_F(SqlQuestions, AreAnswered) {
  const SqlAnswer answer = ask(root_, {"SELECT kind, number, depth FROM newest ORDER BY kind", {}});
  EXPECT_EQ(answer.table.columns, (std::vector<std::string>{"kind", "number", "depth"}));
  EXPECT_EQ(answer.table.rows, (std::vector<std::vector<Cell>>{{"bed", 1.0, Cell{}}, {"drive", 1.0, 1.2}}));
  EXPECT_FALSE(answer.more);
  EXPECT_EQ(rows("SELECT study, outcome FROM results ORDER BY ordinal"),
            (std::vector<std::vector<Cell>>{{"tips", "completed"}, {"tips", Cell{}}}));
  EXPECT_EQ(rows("WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c WHERE n < 5) SELECT sum(n) FROM c"),
            (std::vector<std::vector<Cell>>{{15.0}}));
  EXPECT_EQ(rows("SELECT 1; -- and no more\n /* at all */ ;").size(), 1U);
  EXPECT_EQ(rows("SELECT 9007199254740993, x'00ff'"),
            (std::vector<std::vector<Cell>>{{std::string("9007199254740993"), std::string("00ff")}}));
  EXPECT_EQ(ask(root_, {"SELECT 1 AS a, 2 AS a", {}}).table.columns, (std::vector<std::string>{"a", "a_2"}));
  EXPECT_GT(rows("EXPLAIN QUERY PLAN SELECT * FROM run").size(), 0U);
}

TEST_F(SqlQuestions, ThatWouldWriteAreRefused) {
  const std::string before = read_text(root_ / "catalogue.sqlite");
  const std::string aside = (scratch_.path() / "aside.sqlite").string();
  for (const std::string& text : {std::string("DELETE FROM run"),
                                  std::string("UPDATE run SET outcome = 'x'"),
                                  std::string("INSERT INTO study VALUES (9, 'x', '', '')"),
                                  std::string("REPLACE INTO study VALUES (9, 'x', '', '')"),
                                  std::string("DELETE FROM run RETURNING run_id"),
                                  std::string("DROP TABLE run"),
                                  std::string("DROP INDEX param_by_num"),
                                  std::string("ALTER TABLE run RENAME TO x"),
                                  std::string("ALTER TABLE run ADD COLUMN x"),
                                  std::string("CREATE TABLE x (y)"),
                                  std::string("CREATE TEMP TABLE x (y)"),
                                  std::string("CREATE TABLE x AS SELECT * FROM run"),
                                  std::string("CREATE VIEW x AS SELECT 1"),
                                  std::string("CREATE INDEX x ON run (time)"),
                                  std::string("CREATE TRIGGER x AFTER DELETE ON run BEGIN SELECT 1; END"),
                                  std::string("CREATE VIRTUAL TABLE x USING fts5(y)"),
                                  std::string("WITH a AS (SELECT 1) DELETE FROM run"),
                                  "ATTACH '" + aside + "' AS aside",
                                  std::string("DETACH main"),
                                  "VACUUM INTO '" + aside + "'",
                                  std::string("VACUUM"),
                                  std::string("REINDEX"),
                                  std::string("ANALYZE"),
                                  std::string("BEGIN"),
                                  std::string("COMMIT"),
                                  std::string("SAVEPOINT x"),
                                  std::string("PRAGMA user_version = 7"),
                                  std::string("PRAGMA journal_mode = WAL"),
                                  std::string("PRAGMA query_only = OFF"),
                                  std::string("PRAGMA writable_schema = ON"),
                                  std::string("PRAGMA wal_checkpoint"),
                                  std::string("PRAGMA optimize"),
                                  std::string("PRAGMA table_info(run)"),
                                  std::string("SELECT load_extension('x')"),
                                  std::string("SELECT load_extension('x', 'y')"),
                                  std::string("EXPLAIN DELETE FROM run")}) {
    EXPECT_NE(complaint({text, {}}), "") << text;
    EXPECT_TRUE(read_text(root_ / "catalogue.sqlite") == before) << text;
  }
  EXPECT_FALSE(std::filesystem::exists(aside));
  EXPECT_NE(complaint({"DELETE FROM run", {}}).find("only reads"), std::string::npos);
  EXPECT_NE(complaint({"PRAGMA optimize", {}}).find("PRAGMA optimize is refused"), std::string::npos);
  EXPECT_NE(complaint({"SELECT load_extension('x')", {}}).find("load_extension is refused"), std::string::npos);
}

TEST_F(SqlQuestions, AreOneStatement) {
  for (const char* text :
       {"SELECT 1; SELECT 2", "SELECT 1; DELETE FROM run", "SELECT 1; nonsense", "SELECT 1;; SELECT 2"}) {
    EXPECT_NE(complaint({text, {}}).find("one statement"), std::string::npos) << text;
  }
  for (const char* text : {"", " ", ";", "-- nothing", "selec", "SELECT", "SELECT nothing FROM nowhere"}) {
    EXPECT_NE(complaint({text, {}}), "") << text;
  }
}

TEST_F(SqlQuestions, ThatNeverEndAreEndedByTheTimeLimit) {
  for (const char* text :
       {"WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) SELECT count(*) FROM c",
        "WITH RECURSIVE c(n) AS (SELECT 1 UNION ALL SELECT n + 1 FROM c) SELECT n FROM c WHERE n < 0",
        "SELECT count(*) FROM param a, param b, param c, param d, param e, param f, param g, param h"}) {
    const std::string why = complaint({.text = text, .bind = {}, .time_limit = 0.05});
    EXPECT_NE(why.find("within 0.05 s"), std::string::npos) << text << ": " << why;
  }
}

TEST_F(SqlQuestions, HaveALimitOfRows) {
  const SqlAnswer some = ask(root_, {.text = "SELECT path FROM param", .bind = {}, .limit = 3});
  EXPECT_EQ(some.table.rows.size(), 3U);
  EXPECT_TRUE(some.more);
  EXPECT_FALSE(ask(root_, {.text = "SELECT kind FROM kase", .bind = {}, .limit = 2}).more);
  EXPECT_NE(complaint({"SELECT zeroblob(20000000)", {}}), "");
}

TEST_F(SqlQuestions, TakeValuesThatAreBound) {
  EXPECT_EQ(rows("SELECT :a, ?, @b, $c", {"b=2.5", "flat", "a=it's", "c=3"}),
            (std::vector<std::vector<Cell>>{{std::string("it's"), std::string("flat"), 2.5, 3.0}}));
  EXPECT_EQ(rows("SELECT ?, ?", {"a=b", "1"}), (std::vector<std::vector<Cell>>{{std::string("a=b"), 1.0}}));
  EXPECT_EQ(rows("SELECT typeof(?), typeof(?), typeof(?)", {"3", "3.0", "3 m"}),
            (std::vector<std::vector<Cell>>{{std::string("integer"), std::string("real"), std::string("text")}}));
  EXPECT_EQ(rows("SELECT count(*) FROM run WHERE outcome = ?", {"x' OR '1'='1"}),
            (std::vector<std::vector<Cell>>{{0.0}}));
  EXPECT_NE(complaint({"SELECT ?", {}}).find("?1"), std::string::npos);
  EXPECT_NE(complaint({"SELECT :a", {"b=1"}}).find("b=1"), std::string::npos);
  EXPECT_NE(complaint({"SELECT :a, :b", {"a=1"}}).find(":b"), std::string::npos);
  EXPECT_NE(complaint({"SELECT ?", {"1", "2"}}).find("\"2\""), std::string::npos);
}

}  // namespace
}  // namespace seapile::store
