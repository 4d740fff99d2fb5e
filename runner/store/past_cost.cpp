#include "runner/store/past_cost.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <optional>

namespace seapile::store {
namespace {

std::vector<Parameter> parameters_of(SQLite::Statement& rows, const std::string& case_id) {
  rows.reset();
  rows.bind(1, case_id);
  std::vector<Parameter> parameters;
  while (rows.executeStep()) {
    const SQLite::Column number = rows.getColumn(1), text = rows.getColumn(2);
    parameters.push_back({rows.getColumn(0).getString(),
                          number.isNull() ? std::nullopt : std::optional(number.getDouble()),
                          text.isNull() ? std::nullopt : std::optional(text.getString())});
  }
  return parameters;
}

}  // namespace

std::vector<PastCost> past_costs(SQLite::Database& sqlite) {
  SQLite::Statement runs(
      sqlite,
      "SELECT r.case_id, r.cpu_seconds, r.peak_memory_mb, r.bytes FROM run r JOIN kase k ON k.case_id = r.case_id "
      "WHERE k.kind = ?1 AND r.outcome = 'completed' AND r.cpu_seconds IS NOT NULL "
      "ORDER BY r.run_id DESC LIMIT ?2");
  SQLite::Statement parameters(sqlite, "SELECT path, num, txt FROM param WHERE case_id = ?1 ORDER BY path");
  std::vector<PastCost> costs;
  for (const char* kind : {"bed", "drive", "flow"}) {
    runs.reset();
    runs.bind(1, kind);
    runs.bind(2, kMostPastCosts);
    while (runs.executeStep()) {
      const std::string case_id = runs.getColumn(0).getString();
      costs.push_back({case_id, kind, runs.getColumn(1).getDouble(), runs.getColumn(2).getDouble(),
                       runs.getColumn(3).getDouble(), parameters_of(parameters, case_id)});
    }
  }
  return costs;
}

}  // namespace seapile::store
