#include "runner/store/ingest.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>

#include "runner/store/durable.h"
#include "runner/store/layout.h"
#include "runner/store/manifest.h"
#include "runner/store/parameters.h"
#include "runner/store/sha256.h"
#include "runner/store/stamp.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;
using Path = std::filesystem::path;

// How each kind of C++ value becomes a column's value.
void put_value(SQLite::Statement& statement, int index, const std::string& text) { statement.bind(index, text); }
void put_value(SQLite::Statement& statement, int index, std::int64_t number) { statement.bind(index, number); }
void put_value(SQLite::Statement& statement, int index, double number) {
  if (std::isnan(number)) {
    statement.bind(index);
  } else {
    statement.bind(index, number);
  }
}
template <class T>
void put_value(SQLite::Statement& statement, int index, const std::optional<T>& value) {
  if (value) {
    put_value(statement, index, *value);
  } else {
    statement.bind(index);
  }
}

/// Inserts one row; the number of values is that of the table's columns.
class Insertion {
 public:
  Insertion(SQLite::Database& sqlite, const std::string& table, int columns)
      : statement_(sqlite, "INSERT INTO " + table + " VALUES (?" + repeated(", ?", columns - 1) + ")") {}

  template <class... Values>
  void operator()(const Values&... values) {
    int index = 0;
    (put_value(statement_, ++index, values), ...);
    statement_.exec();
    statement_.reset();
  }

 private:
  static std::string repeated(const std::string& text, int times) {
    std::string all;
    for (int i = 0; i < times; ++i) all += text;
    return all;
  }

  SQLite::Statement statement_;
};

std::optional<std::string> unless_empty(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

std::int64_t whole(auto number) { return static_cast<std::int64_t>(number); }

/// The case's row and parameters. Where runs of a case differ in what is no part of its identity (the path of a grain
/// file), the newest run's scene counts, in whatever order they are ingested.
void put_case(SQLite::Database& sqlite, const RunHeader& header, std::int64_t number) {
  SQLite::Statement newer(sqlite, "SELECT count(*) FROM run WHERE case_id = ? AND number > ?");
  newer.bind(1, header.case_id);
  newer.bind(2, number);
  newer.executeStep();
  if (newer.getColumn(0).getInt() > 0) return;

  SQLite::Statement put(
      sqlite,
      "INSERT INTO kase VALUES (?, ?, ?, ?) ON CONFLICT (case_id) DO UPDATE SET kind = excluded.kind, "
      "canonical = excluded.canonical, bed_id = excluded.bed_id");
  put_value(put, 1, header.case_id);
  put_value(put, 2, header.kind);
  put_value(put, 3, header.canonical);
  put_value(put, 4, unless_empty(header.bed_id));
  put.exec();

  SQLite::Statement forget(sqlite, "DELETE FROM param WHERE case_id = ?");
  forget.bind(1, header.case_id);
  forget.exec();
  Insertion param(sqlite, "param", 4);
  for (const Parameter& parameter : parameters(header.scene_json, header.kind)) {
    param(header.case_id, parameter.path, parameter.number, parameter.text);
  }
}

void put_details(SQLite::Database& sqlite, std::int64_t run_id, const Manifest& manifest) {
  std::int64_t ordinal = 0;
  Insertion metric(sqlite, "metric", 6);
  for (const simulation::Metric& m : manifest.result.metrics) {
    metric(run_id, m.name, ordinal++, m.value, m.unit, m.meaning);
  }
  Insertion artifact(sqlite, "artifact", 4);
  for (const FileEntry& file : manifest.files) artifact(run_id, file.path, whole(file.bytes), file.sha256);
  put_parts(sqlite, run_id, manifest.header.parts);
  Insertion numerics(sqlite, "numerics", 3);
  for (const simulation::NumericsVersion& n : manifest.header.numerics) numerics(run_id, n.module, whole(n.version));
  ordinal = 0;
  Insertion cost(sqlite, "cost", 5);
  for (const simulation::ProfileEntry& entry : manifest.result.profile) {
    cost(run_id, entry.part, ordinal++, entry.seconds, entry.calls);
  }
}

/// Readable, and different for different names whatever characters they have.
Path study_file(const Path& root, const std::string& study) {
  std::string readable = study.substr(0, 60);
  const auto is_plain = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-'; };
  std::ranges::replace_if(readable, std::not_fn(is_plain), '_');
  return root / "studies" / (readable + "-" + sha256(study).substr(0, 8) + ".json");
}

}  // namespace

std::string labels_text(const std::vector<std::pair<std::string, std::string>>& labels) {
  Json list = Json::array();
  for (const auto& [path, value] : labels) list.push_back(Json::array({path, value}));
  return list.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<std::pair<std::string, std::string>> labels_from(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> labels;
  for (const Json& pair : Json::parse(text)) labels.emplace_back(pair.at(0), pair.at(1));
  return labels;
}

void put_parts(SQLite::Database& sqlite, std::int64_t run_id, const std::vector<simulation::Part>& parts) {
  SQLite::Statement forget(sqlite, "DELETE FROM part WHERE run_id = ?");
  forget.bind(1, run_id);
  forget.exec();
  Insertion part(sqlite, "part", 11);
  std::int64_t ordinal = 0;
  for (const simulation::Part& p : parts) {
    const char* decided = p.by == scene::By::asked ? "asked" : "scene";
    const auto asked = [&](auto member) { return p.criterion ? std::optional((*p.criterion).*member) : std::nullopt; };
    part(run_id, p.name, ordinal++, whole(p.built), p.reason, std::string(decided), asked(&scene::Criterion::quantity),
         asked(&scene::Criterion::number), asked(&scene::Criterion::threshold), asked(&scene::Criterion::bound),
         asked(&scene::Criterion::answer));
  }
}

bool ingest_run(SQLite::Database& sqlite, const std::string& folder, const Manifest& manifest) {
  const RunHeader& header = manifest.header;
  const std::int64_t number = whole(run_number(manifest.run));
  SQLite::Statement known(sqlite, "SELECT run_id, seal FROM run WHERE case_id = ? AND number = ?");
  known.bind(1, header.case_id);
  known.bind(2, number);
  if (known.executeStep()) {
    if (known.getColumn(1).getString() == manifest.seal) return false;
    SQLite::Statement forget(sqlite, "DELETE FROM run WHERE run_id = ?");
    forget.bind(1, known.getColumn(0).getInt64());
    known.reset();
    forget.exec();
  }
  put_case(sqlite, header, number);
  const simulation::RunResult& result = manifest.result;
  const Provenance& made = manifest.provenance;
  std::uint64_t bytes = 0;
  for (const FileEntry& file : manifest.files) bytes += file.bytes;
  Insertion run(sqlite, "run", 25);
  run(std::optional<std::int64_t>(), header.case_id, number, folder, manifest.seal, unless_empty(header.bed_run),
      std::string(name(result.outcome)), result.reason, result.time, result.depth, hex(result.state_hash),
      whole(manifest.records + manifest.flow_records), whole(manifest.frames), made.version, made.commit,
      whole(made.dirty), made.host_cpu, whole(made.threads), made.simd, made.cpu_seconds, made.wall_seconds,
      made.peak_memory_mb, whole(made.attempts), whole(bytes), whole(0));
  put_details(sqlite, sqlite.getLastInsertRowid(), manifest);
  return true;
}

void ingest_equivalences(SQLite::Database& sqlite, const std::vector<Equivalence>& declared) {
  sqlite.exec("DELETE FROM equivalence");
  Insertion equivalence(sqlite, "equivalence", 17);
  for (const Equivalence& one : declared) {
    equivalence(one.kind, numerics_json(one.before), numerics_json(one.now), one.case_id, whole(run_number(one.run)),
                one.state_before, one.state_now, one.likeness, one.largest, one.largest_of, one.tolerance, one.date,
                one.version, one.commit, whole(one.dirty), one.file, one.seal);
  }
}

void ingest_study(SQLite::Database& sqlite, const StudyEntry& study) {
  SQLite::Statement forget(sqlite, "DELETE FROM study WHERE name = ?");
  forget.bind(1, study.name);
  forget.exec();
  Insertion(sqlite, "study", 4)(std::optional<std::int64_t>(), study.name, study.question, study.file_sha256);
  const std::int64_t id = sqlite.getLastInsertRowid();
  Insertion study_case(sqlite, "study_case", 4);
  std::int64_t ordinal = 0;
  for (const auto& [case_id, labels] : study.cases) study_case(id, ordinal++, case_id, labels_text(labels));
}

void write_study(const Path& root, const StudyEntry& study) {
  Json cases = Json::array();
  for (const auto& [case_id, labels] : study.cases) {
    cases.push_back(Json{{"case", case_id}, {"labels", Json::parse(labels_text(labels))}});
  }
  const Json json = {{"schema", kSchema},
                     {"study", study.name},
                     {"question", study.question},
                     {"file_sha256", study.file_sha256},
                     {"cases", cases}};
  make_folder(root / "studies");
  write_text(study_file(root, study.name), json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::vector<StudyEntry> read_studies(const Path& root) {
  std::vector<StudyEntry> studies;
  for (const Path& file : entries(root / "studies")) {
    if (file.extension() != ".json") continue;
    try {
      const Json json = Json::parse(read_text(file));
      StudyEntry study{json.at("study"), json.at("question"), json.at("file_sha256"), {}};
      for (const Json& item : json.at("cases")) {
        study.cases.emplace_back(item.at("case"), labels_from(item.at("labels").dump()));
      }
      studies.push_back(std::move(study));
    } catch (const Json::exception& error) {
      throw StoreError(StoreError::Kind::damaged, file.string() + " is damaged: " + error.what());
    }
  }
  return studies;
}

}  // namespace seapile::store
