#include "runner/store/catalogue.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "runner/store/durable.h"
#include "runner/store/sha256.h"
#include "tests/runner/store/dump.h"
#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using Path = std::filesystem::path;
using Texts = std::vector<std::string>;

/// A run of a case of its own: tip, speed, seed and the metric that came out.
RunHeader header_of(const std::string& tip, double speed, int seed) {
  RunHeader header = sample::drive_header();
  std::ostringstream scene;
  scene << R"({"bed":{"seed":)" << seed << R"(},"fluid":null,"pile":{"driving":{"constant":{"speed":)" << speed
        << R"(}},"radius":0.125,"tip":{")" << tip << R"(":{}}}})";
  header.scene_json = header.canonical = scene.str();
  header.case_id = sha256(header.canonical);
  return header;
}

Path write_run(const Path& root, const RunHeader& header, double tip_resistance, const std::string& run = "0001") {
  simulation::RunResult result = sample::drive_result();
  result.metrics[0].value = tip_resistance;
  const Path folder = case_folder(root, header.case_id) / run;
  RunWriter(folder, header).finish(result, sample::provenance(), nullptr);
  return folder;
}

std::string text(const Table& table) {
  std::ostringstream out;
  for (std::size_t i = 0; i < table.columns.size(); ++i) out << table.columns[i] << '[' << table.units[i] << "] ";
  for (const auto& row : table.rows) {
    out << '\n';
    for (const Cell& cell : row) {
      if (const auto* number = std::get_if<double>(&cell)) out << *number << ' ';
      if (const auto* word = std::get_if<std::string>(&cell)) out << *word << ' ';
      if (std::holds_alternative<std::monostate>(cell)) out << "- ";
    }
  }
  return out.str();
}

class FilledCatalogue : public testing::Test {
 protected:
  void SetUp() override {
    Catalogue catalogue = Catalogue::open(root_);
    StudyEntry study{"tips", "which tip?", std::string(64, '0'), {}};
    for (const char* tip : {"flat", "conical"}) {
      for (const double speed : {0.06, 0.2}) {
        const RunHeader header = header_of(tip, speed, 1);
        folders_.push_back(write_run(root_, header, 1000 * static_cast<double>(folders_.size() + 1)));
        catalogue.ingest(folders_.back());
        std::ostringstream label;
        label << speed << " m/s";
        study.cases.emplace_back(header.case_id,
                                 Labels{{"pile.tip", tip}, {"pile.driving.constant.speed", label.str()}});
      }
    }
    // A case that has not been run, and one of another study.
    study.cases.emplace_back(std::string(64, 'f'), Labels{{"pile.tip", "round"}});
    catalogue.put(study);
    catalogue.ingest(write_run(root_, header_of("flat", 0.4, 2), 9000));
  }

  std::size_t count(const std::string& study, const Texts& where) const {
    return Catalogue::open_read_only(root_).query(study, where, {"bed.seed"}).rows.size();
  }

  Scratch scratch_;
  Path root_ = scratch_.fresh("root");
  std::vector<Path> folders_;
};

TEST_F(FilledCatalogue, AnswersInTheOrderOfTheStudyWithLabelsAndUnits) {
  const Table table =
      Catalogue::open_read_only(root_).query("tips", {}, {"tip_resistance_mean", "pile.driving.constant.speed"});
  EXPECT_EQ(table.columns, (Texts{"case", "run", "kind", "outcome", "pile.tip", "pile.driving.constant.speed",
                                  "tip_resistance_mean", "pile.driving.constant.speed"}));
  EXPECT_EQ(table.units, (Texts{"", "", "", "", "", "", "Pa", "m/s"}));
  ASSERT_EQ(table.rows.size(), 4U);
  const std::string id = header_of("flat", 0.2, 1).case_id.substr(0, 10);
  EXPECT_EQ(table.rows[1], (std::vector<Cell>{id, "0001", "drive", "completed", "flat", "0.2 m/s", 2000.0, 0.2}));
}

TEST_F(FilledCatalogue, ShowsTheFirstMetricsWhenNoneAreAskedFor) {
  const Table table = Catalogue::open_read_only(root_).query("tips", {}, {});
  EXPECT_EQ(Texts(table.columns.begin() + 6, table.columns.end()),
            (Texts{"tip_resistance_mean", "tip_resistance_fluctuation", "overlap_max", "tip_resistance_bin_0.25"}));
  EXPECT_EQ(table.rows[0].back(), Cell{});  // A NaN is no number.
}

TEST_F(FilledCatalogue, FindsByParameterMetricAndOutcome) {
  EXPECT_EQ(count("tips", {}), 4U);
  EXPECT_EQ(count("", {}), 5U);
  EXPECT_EQ(count("tips", {"pile.tip = flat"}), 2U);
  EXPECT_EQ(count("tips", {"pile.tip != flat", "pile.driving.constant.speed<0.1"}), 1U);
  EXPECT_EQ(count("", {"pile.driving.constant.speed=0.06"}), 2U);
  EXPECT_EQ(count("", {"pile.driving.constant.speed >= 0.2"}), 3U);
  EXPECT_EQ(count("", {"pile.driving = constant"}), 5U);
  EXPECT_EQ(count("", {"bed.seed > 1"}), 1U);
  EXPECT_EQ(count("", {"tip_resistance_mean > 2500", "tip_resistance_mean <= 4000"}), 2U);
  EXPECT_EQ(count("", {"fluid = null"}), 5U);
  EXPECT_EQ(count("", {"pile.tip = null"}), 0U);
  EXPECT_EQ(count("", {"pile.tip != null"}), 5U);
  EXPECT_EQ(count("", {"pile = null"}), 0U) << "a part is there when it has members";
  EXPECT_EQ(count("", {"pile != null", "fluid = null"}), 5U);
  EXPECT_EQ(count("", {"fluid != null"}), 0U);
  EXPECT_EQ(count("", {"tip_resistance_bin_0.25 = null"}), 5U);
  EXPECT_EQ(count("", {"outcome = completed"}), 5U);
  EXPECT_EQ(count("", {"outcome != completed"}), 0U);
  EXPECT_EQ(count("", {"kind = bed"}), 0U);
}

TEST_F(FilledCatalogue, ADriveIsAskedForWhatItsBedIsKnownBy) {
  const sample::Written written = sample::write(root_);
  Catalogue catalogue = Catalogue::open(root_);
  catalogue.ingest(written.bed);
  catalogue.ingest(written.drive);
  // A later run of the same bed, on which the drive does not stand.
  simulation::RunResult again = sample::bed_result();
  again.metrics[0].value = 0.9;
  const Path later = written.bed.parent_path() / "0002";
  const simulation::Bed bed = sample::bed();
  RunWriter(later, sample::bed_header()).finish(again, sample::provenance(), &bed);
  catalogue.ingest(later);

  const Texts columns = {"bed:solid_fraction", "bed:surface", "bed:case"};
  const std::string id = sample::bed_header().case_id.substr(0, 10);
  const Table table = catalogue.query("", {"bed:solid_fraction > 0.8", "bed:surface != null"}, columns);
  ASSERT_EQ(table.rows.size(), 6U);  // All drives here stand on that bed; it is no drive.
  EXPECT_EQ(Texts(table.units.end() - 3, table.units.end()), (Texts{"-", "m", ""}));
  for (const auto& row : table.rows) {
    EXPECT_EQ(row[2], Cell{std::string("drive")});
    EXPECT_EQ(std::vector<Cell>(row.end() - 3, row.end()), (std::vector<Cell>{0.8112, 1.2071, id}));
  }
  EXPECT_EQ(catalogue.query("", {"bed:solid_fraction > 0.85"}, {}).rows.size(), 0U);
  EXPECT_EQ(catalogue.query("", {"bed:case = " + id}, {}).rows.size(), 6U);
  EXPECT_EQ(catalogue.query("", {"bed:solid_fraction = null"}, {}).rows.size(), 1U);  // A bed stands on none.
  EXPECT_EQ(catalogue.query("", {"kind = bed"}, columns).rows[0].back(), Cell{});
  EXPECT_THROW(catalogue.query("", {}, {"bed:tip_resistance_mean"}), std::invalid_argument);
}

TEST_F(FilledCatalogue, SaysWhatEachColumnTells) {
  const Table table = Catalogue::open_read_only(root_).query("tips", {}, {"tip_resistance_mean", "bed.seed", "kind"});
  using enum ColumnKind;
  EXPECT_EQ(table.kinds,
            (std::vector<ColumnKind>{identity, identity, identity, outcome, label, label, metric, parameter, fact}));
}

TEST_F(FilledCatalogue, NamesTheNearestOfAnUnknownName) {
  const Catalogue catalogue = Catalogue::open_read_only(root_);
  const auto complaint = [&](const std::string& study, const Texts& where, const Texts& extra) -> std::string {
    try {
      catalogue.query(study, where, extra);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(complaint("", {"pile.tipp = flat"}, {}),
            "there is no parameter or metric \"pile.tipp\"; the nearest is \"pile.tip\"");
  EXPECT_EQ(complaint("", {}, {"tip_resistance_meen"}),
            "there is no parameter or metric \"tip_resistance_meen\"; the nearest is \"tip_resistance_mean\"");
  EXPECT_EQ(complaint("tip", {}, {}), "there is no study \"tip\"; the nearest is \"tips\"");
  EXPECT_EQ(complaint("", {"bed.seed = one"}, {}), "bed.seed is a number, in SI units; \"one\" is none");
  EXPECT_EQ(complaint("", {"outcome = 3"}, {}), "outcome is a text");
}

TEST_F(FilledCatalogue, TakesNoSqlFromItsUser) {
  for (const char* attack : {"'; DROP TABLE run; --", "x' OR '1'='1", "\"; DELETE FROM run; --",
                             "1); DROP TABLE run; --", "pile.tip' UNION SELECT * FROM run --"}) {
    const Catalogue catalogue = Catalogue::open_read_only(root_);
    EXPECT_THROW(catalogue.query(attack, {}, {}), std::invalid_argument);
    EXPECT_THROW(catalogue.query("", {}, {attack}), std::invalid_argument);
    EXPECT_THROW(catalogue.query("", {std::string(attack) + " = 1"}, {}), std::invalid_argument);
    EXPECT_EQ(catalogue.query("", {"pile.tip != null"}, {}).rows.size(), 5U);
    EXPECT_EQ(catalogue.find(attack), Path());
  }
  EXPECT_EQ(count("", {"pile.tip = \"x' OR '1'='1\""}), 0U);
}

TEST_F(FilledCatalogue, ListsFoldersAndFindsThemByPrefix) {
  const Catalogue catalogue = Catalogue::open_read_only(root_);
  const auto runs = catalogue.runs("tips", {"pile.tip = conical"});
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].first, folders_[2]);
  EXPECT_EQ(runs[0].second[0], (std::pair<std::string, std::string>{"pile.tip", "conical"}));
  const std::string id = folders_[0].parent_path().filename();
  EXPECT_EQ(catalogue.find(id), folders_[0]);
  EXPECT_EQ(catalogue.find(id.substr(0, 12)), folders_[0]);
  EXPECT_EQ(catalogue.find("0123456789"), Path());
  EXPECT_THROW(catalogue.find(""), std::invalid_argument);
  EXPECT_EQ(catalogue.studies(), Texts{"tips"});
}

TEST_F(FilledCatalogue, ShowsTheNewestRunOfACase) {
  const RunHeader header = header_of("flat", 0.06, 1);
  Catalogue::open(root_).ingest(write_run(root_, header, 1234, "0002"));
  const Catalogue catalogue = Catalogue::open_read_only(root_);
  EXPECT_EQ(catalogue.query("tips", {}, {}).rows.size(), 4U);
  EXPECT_EQ(catalogue.query("tips", {}, {"tip_resistance_mean"}).rows[0].back(), Cell{1234.0});
  EXPECT_EQ(catalogue.find(header.case_id).filename(), "0002");
}

TEST_F(FilledCatalogue, TakesTheParametersFromTheNewestRunInWhateverOrder) {
  // Two runs of one case may differ in what is no part of its identity, such as where a file lay.
  RunHeader header = header_of("flat", 0.7, 9);
  const std::string scene = header.scene_json;
  std::vector<Path> runs;
  for (const char* run : {"0001", "0002"}) {
    header.scene_json = scene;
    header.scene_json.replace(header.scene_json.find("0.125"), 5, run == std::string("0001") ? "0.111" : "0.222");
    runs.push_back(write_run(root_, header, 1, run));
  }
  for (const auto& order : {std::vector<Path>{runs[0], runs[1]}, std::vector<Path>{runs[1], runs[0]}}) {
    std::filesystem::remove(root_ / "catalogue.sqlite");
    Catalogue catalogue = Catalogue::open(root_);
    for (const Path& run : order) catalogue.ingest(run);
    EXPECT_EQ(catalogue.query("", {"bed.seed = 9"}, {"pile.radius"}).rows[0].back(), Cell{0.222});
  }
}

TEST_F(FilledCatalogue, IsUnchangedByIngestingAgain) {
  const auto dump = [&] { return sample::rows_of_all_tables(root_ / "catalogue.sqlite"); };
  const auto before = dump();
  for (const Path& folder : folders_) Catalogue::open(root_).ingest(folder);
  EXPECT_EQ(dump(), before);
  Catalogue catalogue = Catalogue::open(root_);
  for (const Ingested& again : {catalogue.ingest_all({root_}), catalogue.ingest_missing()}) {
    EXPECT_EQ(again.added, 0U);
    EXPECT_EQ(again.known, 5U);
    EXPECT_EQ(again.studies, 0U);
  }
  EXPECT_EQ(dump(), before);
  EXPECT_GT(before.at("metric").size(), 1000U);
}

TEST_F(FilledCatalogue, IngestedFromItsFoldersIsTheSameWhateverHoldsThem) {
  const auto before = text(Catalogue::open_read_only(root_).query("", {}, {"bed.seed"}));
  const Path cases = root_ / "cases";
  std::vector<Path> each = entries(cases);
  for (const std::vector<Path>& folders :
       {std::vector<Path>{root_}, {cases}, {cases / ""}, each, {each[0] / "0001", each[1], cases}}) {
    std::filesystem::remove(root_ / "catalogue.sqlite");
    Catalogue catalogue = Catalogue::open(root_);
    EXPECT_EQ(catalogue.ingest_all(folders).added, 5U);
    EXPECT_EQ(catalogue.ingest_missing().studies, 1U);
    EXPECT_EQ(text(catalogue.query("", {}, {"bed.seed"})), before);
  }
  std::filesystem::remove(root_ / "catalogue.sqlite");
  Catalogue catalogue = Catalogue::open(root_);
  catalogue.ingest(folders_[3]);
  const Ingested missing = catalogue.ingest_missing();
  EXPECT_EQ(missing.added, 4U);
  EXPECT_EQ(missing.known, 1U);
  EXPECT_EQ(text(catalogue.query("", {}, {"bed.seed"})), before);
  for (const Path& elsewhere : {scratch_.path(), root_ / "studies", root_ / ".." / "root2", cases / "a" / "b" / "c"}) {
    EXPECT_THROW(catalogue.ingest_all({elsewhere}), std::invalid_argument) << elsewhere;
  }
}

TEST_F(FilledCatalogue, KeepsOneNewestRunOfEachCaseWhoeverRemovesRuns) {
  const RunHeader header = header_of("flat", 0.06, 1);
  Catalogue::open(root_).ingest_all({write_run(root_, header, 3, "0003"), write_run(root_, header, 2, "0002")});
  const auto newest = [&] {
    const Table table = Catalogue::open_read_only(root_).query("tips", {}, {"tip_resistance_mean"});
    EXPECT_EQ(table.rows.size(), 4U);
    return table.rows[0].back();
  };
  EXPECT_EQ(newest(), Cell{3.0});
  const auto remove = [&](int number) {
    SQLite::Database sqlite((root_ / "catalogue.sqlite").string(), SQLite::OPEN_READWRITE);
    sqlite.exec("PRAGMA foreign_keys=ON");
    SQLite::Statement gone(sqlite, "DELETE FROM run WHERE case_id = ? AND number = ?");
    gone.bind(1, header.case_id);
    gone.bind(2, number);
    EXPECT_EQ(gone.exec(), 1);
  };
  remove(3);
  EXPECT_EQ(newest(), Cell{2.0});
  remove(1);
  EXPECT_EQ(newest(), Cell{2.0});
}

TEST_F(FilledCatalogue, FindsByExpressions) {
  const Catalogue catalogue = Catalogue::open_read_only(root_);
  const auto found = [&](const std::string& study, const char* expression) {
    return catalogue.query_matching(study, parse_expression(expression), {"bed.seed"}).rows.size();
  };
  EXPECT_EQ(found("", "pile.tip = flat and pile.driving.constant.speed > 0.1"), 2U);
  EXPECT_EQ(found("", "pile.tip = conical or bed.seed = 2"), 3U);
  EXPECT_EQ(found("", "not pile.tip = conical"), 3U);
  EXPECT_EQ(found("", "not (pile.tip = conical or bed.seed = 2)"), 2U);
  EXPECT_EQ(found("", "pile.tip = conical and tip_resistance_mean > 3500 or bed.seed = 2"), 2U);
  EXPECT_EQ(found("", "pile.tip = conical and (tip_resistance_mean > 3500 or bed.seed = 2)"), 1U);
  EXPECT_EQ(found("", "study = tips"), 4U);
  EXPECT_EQ(found("", "study != tips"), 1U);
  EXPECT_EQ(found("tips", "not study = tips"), 0U);
  // "not" turns round whether a run meets what is asked, also where it lacks it.
  EXPECT_EQ(found("", "tip_resistance_bin_0.25 > 0"), 0U);
  EXPECT_EQ(found("", "not tip_resistance_bin_0.25 > 0"), 5U);
  EXPECT_EQ(found("", "not bed:case = 0123456789"), 5U);
  EXPECT_THROW(found("", "study = tip"), std::invalid_argument);
  EXPECT_THROW(found("", "pile.tip > 3 m"), std::invalid_argument);
}

TEST_F(FilledCatalogue, TakesTheEndOfAPathWhereItIsNoOthers) {
  EXPECT_EQ(count("", {"tip = flat", "speed > 0.1"}), 2U);
  EXPECT_EQ(count("", {"constant.speed = 0.06"}), 2U);
  const Catalogue catalogue = Catalogue::open_read_only(root_);
  EXPECT_EQ(catalogue.meaning("speed", "").name, "pile.driving.constant.speed");
  EXPECT_EQ(catalogue.meaning("speed", "").unit, "m/s");
  EXPECT_EQ(catalogue.meaning("tip", "").unit, "");
  EXPECT_EQ(catalogue.meaning("tip_resistance_mean", "").unit, "Pa");
  EXPECT_THROW(catalogue.meaning("peed", ""), std::invalid_argument);
}

TEST_F(FilledCatalogue, NamesThoseBetweenWhichItCannotTellUnlessTheStudyCan) {
  RunHeader header = header_of("flat", 0.3, 1);
  header.scene_json.replace(header.scene_json.find("constant"), 8, "vibratory");
  header.canonical = header.scene_json;
  header.case_id = sha256(header.canonical);
  Catalogue catalogue = Catalogue::open(root_);
  catalogue.ingest(write_run(root_, header, 1));
  EXPECT_EQ(catalogue.query("tips", {"speed = 0.06"}, {}).rows.size(), 2U);
  try {
    catalogue.query("", {"speed = 0.06"}, {});
    ADD_FAILURE();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "\"speed\" may be any of pile.driving.constant.speed, pile.driving.vibratory.speed: write more of the path");
  }
}

TEST_F(FilledCatalogue, RebuiltFromTheFoldersAnswersTheSame) {
  const auto answers = [&] {
    const Catalogue catalogue = Catalogue::open_read_only(root_);
    return text(catalogue.query("tips", {}, {})) + text(catalogue.query("", {"bed.seed > 0"}, {"pile.radius"}));
  };
  const std::string before = answers();
  EXPECT_EQ(Catalogue::open(root_).rebuild(), 5U);
  EXPECT_EQ(answers(), before);
  std::filesystem::remove(root_ / "catalogue.sqlite");
  EXPECT_EQ(Catalogue::open(root_).rebuild(), 5U);
  EXPECT_EQ(answers(), before);
}

TEST_F(FilledCatalogue, SaysWhatItLeavesOutOfARebuild) {
  std::filesystem::resize_file(folders_[0] / "series.h5", 10);
  write_text(folders_[1] / "manifest.json", "{}");
  Texts left_out;
  Catalogue catalogue = Catalogue::open(root_);
  EXPECT_EQ(catalogue.rebuild(&left_out), 3U);
  EXPECT_EQ(left_out.size(), 2U);
  EXPECT_THROW(catalogue.ingest(folders_[0]), StoreError);
}

TEST_F(FilledCatalogue, IsOneFileAtRestWhichReadersLeaveAlone) {
  const auto look = [&] {
    std::vector<std::pair<std::string, std::string>> files;
    for (const auto& entry : std::filesystem::directory_iterator(root_)) {
      if (entry.is_regular_file()) files.emplace_back(entry.path().filename(), sha256_of_file(entry.path()));
    }
    std::ranges::sort(files);
    return files;
  };
  const auto before = look();
  EXPECT_EQ(before.size(), 2U);  // The catalogue and its lock.
  {
    const Catalogue catalogue = Catalogue::open_read_only(root_);
    catalogue.query("tips", {}, {});
    EXPECT_EQ(look(), before);
  }
  EXPECT_EQ(look(), before);
}

TEST_F(FilledCatalogue, IsReadWhileItIsWritten) {
  const Catalogue reader = Catalogue::open_read_only(root_);
  Catalogue writer = Catalogue::open(root_);
  EXPECT_EQ(reader.query("", {}, {"bed.seed"}).rows.size(), 5U);
  writer.ingest(write_run(root_, header_of("flat", 0.5, 3), 1));
  EXPECT_EQ(reader.query("", {}, {"bed.seed"}).rows.size(), 6U);
}

TEST_F(FilledCatalogue, OfANewerProgramIsRefused) {
  SQLite::Database((root_ / "catalogue.sqlite").string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 4");
  for (const auto open : {&Catalogue::open, &Catalogue::open_read_only}) {
    try {
      open(root_);
      ADD_FAILURE();
    } catch (const StoreError& error) {
      EXPECT_EQ(error.kind, StoreError::Kind::damaged);
      EXPECT_NE(std::string(error.what()).find("newer version"), std::string::npos);
    }
  }
}

TEST_F(FilledCatalogue, ThatIsDamagedIsRefusedKeptAndMadeAnew) {
  const std::string before = text(Catalogue::open_read_only(root_).query("tips", {}, {}));
  std::string bytes = read_text(root_ / "catalogue.sqlite");
  std::fill(bytes.begin() + 4096, bytes.begin() + 12288, '\x5a');
  std::ofstream(root_ / "catalogue.sqlite", std::ios::binary) << bytes;
  try {
    Catalogue::open(root_);
    ADD_FAILURE();
  } catch (const StoreError& error) {
    EXPECT_EQ(error.kind, StoreError::Kind::damaged);
  }
  EXPECT_EQ(Catalogue::open_anew(root_).rebuild(), 5U);
  EXPECT_EQ(text(Catalogue::open_read_only(root_).query("tips", {}, {})), before);
  EXPECT_TRUE(read_text(root_ / "catalogue.sqlite.aside") == bytes);
}

TEST_F(FilledCatalogue, WithAnyBitChangedIsRefusedOrRebuiltToTheSame) {
  const std::string before = text(Catalogue::open_read_only(root_).query("tips", {}, {}));
  const std::string whole = read_text(root_ / "catalogue.sqlite");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < 60; ++i) {
    std::string bytes = whole;
    const auto at = static_cast<std::size_t>(sample::uniform(77, i) * static_cast<double>(bytes.size()));
    bytes[at] = static_cast<char>(bytes[at] ^ (1 << (i % 8)));
    std::ofstream(root_ / "catalogue.sqlite", std::ios::binary) << bytes;
    try {
      Catalogue::open(root_).rebuild();
    } catch (const StoreError&) {
      ++refused;
      Catalogue::open_anew(root_).rebuild();
    }
    EXPECT_EQ(text(Catalogue::open_read_only(root_).query("tips", {}, {})), before) << "bit " << i % 8 << " of " << at;
  }
  EXPECT_GT(refused, 0U);
}

TEST(Catalogue, IsNotCreatedByReading) {
  const Scratch scratch;
  EXPECT_THROW(Catalogue::open_read_only(scratch.path()), StoreError);
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(Catalogue, RefusesADatabaseOfAnotherProgram) {
  const Scratch scratch;
  SQLite::Database((scratch.path() / "catalogue.sqlite").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE other (x)");
  EXPECT_THROW(Catalogue::open(scratch.path()), StoreError);
}

TEST(Catalogue, RefusesARunThatLiesElsewhere) {
  const Scratch scratch;
  const sample::Written written = sample::write(scratch.fresh("other"));
  Catalogue catalogue = Catalogue::open(scratch.fresh("root"));
  EXPECT_THROW(catalogue.ingest(written.drive), std::invalid_argument);
  EXPECT_THROW(catalogue.ingest(scratch.path() / "nowhere"), StoreError);
}

TEST(Catalogue, KeepsStudiesOfAnyName) {
  const Scratch scratch;
  const Texts names = {"../../etc/passwd", "a b", "a_b", "\xc3\xa9tude", std::string(300, 'x')};
  {
    Catalogue catalogue = Catalogue::open(scratch.path());
    for (const std::string& name : names) catalogue.put({name, "?", "", {{std::string(64, 'a'), {{"x", "'1'"}}}}});
  }
  std::filesystem::remove(scratch.path() / "catalogue.sqlite");
  Catalogue catalogue = Catalogue::open(scratch.path());
  catalogue.rebuild();
  EXPECT_EQ(catalogue.studies().size(), names.size());
}

}  // namespace
}  // namespace seapile::store
