// What a query can name: parameters, metrics, and what every run has.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <set>
#include <string>
#include <vector>

namespace seapile::store {

enum class Subject { outcome, kind, study, bed_case, parameter, metric, bed_metric };

/// A name with what it stands for.
struct Name {
  Subject subject;
  std::string text;  ///< in full: "pile.tip", "tip_resistance_mean", "bed:solid_fraction"

  bool is_metric() const { return subject == Subject::metric || subject == Subject::bed_metric; }
  /// The metric's own name: "solid_fraction" of "bed:solid_fraction".
  std::string metric() const;
};

/// The metrics of beds, for a drive's run d of a case with bed_id: of the very run that it was built on.
inline constexpr const char* kMetricsOfBed =
    "FROM metric m JOIN run b ON b.run_id = m.run_id JOIN kase c ON c.bed_id = b.case_id "
    "JOIN run d ON d.case_id = c.case_id AND CAST(d.bed_run AS INTEGER) = b.number ";

/// The names that a catalogue knows, read at once: it takes as many look-ups as there are names, however many runs.
class Names {
 public:
  explicit Names(SQLite::Database& sqlite);

  /// The name as it is written, else the only parameter whose path ends in it ("speed" for
  /// "pile.driving.constant.speed"); where several do, the only one that the study's cases have. Throws
  /// std::invalid_argument naming the nearest known one, or those between which it cannot tell.
  Name find(const std::string& text, const std::string& study) const;

  /// The unit; "" for texts.
  std::string unit(const Name& name) const;

 private:
  bool is_of_beds(const std::string& metric) const;

  SQLite::Database& sqlite_;
  std::set<std::string> places_;  ///< paths of parameters and of the parts that hold them
  std::set<std::string> metrics_;
};

/// Throws std::invalid_argument: "there is no `what` "`name`"; the nearest is ...".
[[noreturn]] void refuse_unknown(const std::string& what, const std::string& name,
                                 const std::vector<std::string>& known);

/// The names of all studies.
std::vector<std::string> study_names(SQLite::Database& sqlite);

}  // namespace seapile::store
