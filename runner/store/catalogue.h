// The SQLite catalogue: an index of the sealed run folders, with one writer, rebuilt from them at any time.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "runner/store/expression.h"
#include "runner/store/past_cost.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

/// Before the name of what a drive's bed is known by: "bed:solid_fraction". No path of a parameter has a colon.
inline constexpr std::string_view kOfBed = "bed:";

/// One cell of a query's answer: absent, number, or text.
using Cell = std::variant<std::monostate, double, std::string>;

/// What a column of a query's answer tells of a run.
enum class ColumnKind {
  identity,   ///< which run it is: case, number, kind
  outcome,    ///< how it ended
  label,      ///< what sets its case apart
  fact,       ///< what else is known of it, where a query asked: the case of its bed, its kind
  parameter,  ///< what was asked for
  metric,     ///< what came out
};

struct Table {
  std::vector<std::string> columns;
  std::vector<std::string> units;  ///< one per column, "" where there is none
  std::vector<std::vector<Cell>> rows;
  std::vector<ColumnKind> kinds = {};  ///< one per column of a query's answer; other tables have none
};

/// What sets a case apart in its study: (dotted path, value as text with its unit).
using Labels = std::vector<std::pair<std::string, std::string>>;

/// A study's cases as they were planned: (case id, labels), so that a query can be limited to a study.
struct StudyEntry {
  std::string name, question, file_sha256;
  std::vector<std::pair<std::string, Labels>> cases;
};

/// What ingest() did with run folders.
struct Ingested {
  std::size_t added = 0;              ///< runs that were not listed, or otherwise
  std::size_t known = 0;              ///< runs that were listed as they are
  std::size_t studies = 0;            ///< studies likewise added
  std::vector<std::string> left_out;  ///< a sentence for each folder or declaration that does not hold
};

/// What a name of a query stands for.
struct Meaning {
  std::string name;  ///< in full
  std::string unit;  ///< "-" for numbers without, "" for texts
};

class Catalogue {
 public:
  /// Opens or creates <root>/catalogue.sqlite for writing. Waits up to 20 s for another writer.
  /// Throws StoreError::locked, ::damaged (also when it is newer than this program, or older and to be migrated) or
  /// ::io.
  static Catalogue open(const std::filesystem::path& root);
  /// Opens for reading only; writes nothing, creates nothing.
  static Catalogue open_read_only(const std::filesystem::path& root);
  /// For a catalogue that open() finds damaged: keeps the file under another name and opens an empty one, to be
  /// rebuilt.
  static Catalogue open_anew(const std::filesystem::path& root);

  /// Reads all of the file; throws StoreError::damaged.
  void check();

  /// Inserts or replaces a study and the order of its cases, also as a file below <root>/studies, from which rebuild()
  /// makes it again.
  void put(const StudyEntry& study);

  /// Ingests a complete run in one transaction; ingesting it again changes nothing. Throws StoreError.
  void ingest(const std::filesystem::path& run_folder);

  /// Takes a run as its folder says it is now: forgotten when it is gone, else its rows anew. Throws StoreError.
  void refresh(const std::filesystem::path& run_folder);
  /// Ingests every complete run in a folder below the root (a run's, a case's, or one that holds several) in one
  /// transaction. Throws std::invalid_argument when a folder lies elsewhere.
  Ingested ingest_all(const std::vector<std::filesystem::path>& folders);
  /// The same of every run and study below the root that is not listed; what is listed is not read again. The
  /// declarations are those of the store now.
  Ingested ingest_missing();
  /// The complete run folders below the root that are not listed.
  std::vector<std::filesystem::path> missing() const;

  /// Takes the declarations of equivalence as they are in the store now (equivalence.h). A sentence for each that does
  /// not hold.
  std::vector<std::string> refresh_equivalences();

  /// Forgets everything and ingests every study, every declaration and every complete run folder below the root, in one
  /// transaction. Returns how many runs; `left_out` receives a sentence for each folder or declaration that does not
  /// hold.
  std::size_t rebuild(std::vector<std::string>* left_out = nullptr);

  /// The runs of a study (all when ""), newest run of each case, one row each. Columns: "case" (10 hex digits), "run",
  /// "kind", "outcome", then the distinguishing labels, then `extra` (dotted parameter paths or metric names), or by
  /// default the first six metrics in the runs' own order. `where`: conditions "path op value" with op one of = != < <=
  /// > >= over parameters ("pile.driving.constant.speed", "bed.seed", "pile.tip"; also by the end of the path where no
  /// other has it), metrics, "outcome", "kind" or "study"; values are bound, never pasted. What a drive's bed is known
  /// by has "bed:" before its name ("bed:solid_fraction"), which no path has; "bed:case" is the bed's case. Throws
  /// std::invalid_argument naming the nearest known name for an unknown one.
  Table query_matching(const std::string& study, const Expression& where, const std::vector<std::string>& extra) const;
  /// All of `where`, each parsed.
  Table query(const std::string& study, const std::vector<std::string>& where,
              const std::vector<std::string>& extra) const;

  /// What a name in a query of that study stands for. Throws as query() does.
  Meaning meaning(const std::string& name, const std::string& study) const;

  /// The newest complete run folder of each case that query() would list, in its order, with its labels.
  std::vector<std::pair<std::filesystem::path, Labels>> runs(const std::string& study,
                                                             const std::vector<std::string>& where) const;

  /// The run folder of the case whose id starts with `prefix`; empty path when none, throws std::invalid_argument when
  /// several.
  std::filesystem::path find(const std::string& prefix) const;

  /// What the latest completed runs of each kind have cost, the latest first.
  std::vector<PastCost> costs() const;

  /// A study's cases as they were last planned; absent when it is not known.
  std::optional<StudyEntry> entry(const std::string& study) const;

  /// Names of the studies known.
  std::vector<std::string> studies() const;

 private:
  Catalogue() = default;

  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace seapile::store
