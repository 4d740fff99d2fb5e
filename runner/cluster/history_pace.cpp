#include "runner/cluster/history_pace.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <vector>

namespace seapile::cluster {
namespace {

std::optional<double> median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

std::vector<double> cpu_seconds(SQLite::Statement&& statement) {
  std::vector<double> values;
  while (statement.executeStep()) values.push_back(statement.getColumn(0).getDouble());
  return values;
}

}  // namespace

const char* kind_name(execute::Kind kind) {
  return kind == execute::Kind::bed ? "bed" : kind == execute::Kind::drive ? "drive" : "flow";
}

std::optional<double> median_cpu_seconds(const std::filesystem::path& root, const std::string& study,
                                         execute::Kind kind) {
  // A bed belongs to a study through the drives that are built on it.
  constexpr const char* kOfStudy =
      "SELECT run.cpu_seconds FROM run JOIN kase USING (case_id) WHERE kase.kind = ?1 AND run.outcome = 'completed' "
      "AND run.cpu_seconds IS NOT NULL AND run.case_id IN ("
      "SELECT study_case.case_id FROM study_case JOIN study USING (study_id) WHERE study.name = ?2 UNION "
      "SELECT built.bed_id FROM study_case JOIN study USING (study_id) JOIN kase AS built USING (case_id) "
      "WHERE study.name = ?2)";
  constexpr const char* kOfAll =
      "SELECT run.cpu_seconds FROM run JOIN kase USING (case_id) WHERE kase.kind = ?1 AND run.outcome = 'completed' "
      "AND run.cpu_seconds IS NOT NULL ORDER BY run.run_id DESC LIMIT 1000";
  try {
    SQLite::Database sqlite((root / "catalogue.sqlite").string(), SQLite::OPEN_READONLY, 5000);
    SQLite::Statement of_study(sqlite, kOfStudy);
    of_study.bind(1, kind_name(kind));
    of_study.bind(2, study);
    if (const auto own = median(cpu_seconds(std::move(of_study)))) return own;
    SQLite::Statement of_all(sqlite, kOfAll);
    of_all.bind(1, kind_name(kind));
    return median(cpu_seconds(std::move(of_all)));
  } catch (const SQLite::Exception&) {
    return std::nullopt;  // No catalogue, or one that is busy or of another version: then there is no history to use.
  }
}

}  // namespace seapile::cluster
