#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "runner/store/catalogue.h"
#include "runner/store/names.h"

namespace seapile::store {

inline constexpr std::size_t kShownDigits = 10;  ///< of a case id, for people

/// The newest run of a case, with what sets the case apart in its study.
struct ListedRun {
  std::int64_t run_id;
  std::string case_id;
  std::int64_t number;
  std::string kind, outcome, folder;
  std::string bed_id;  ///< "": the case is a bed
  Labels labels;
};

/// In the order of the study; of all studies: in the order of the case ids.
std::vector<ListedRun> list_runs(SQLite::Database& sqlite, const Names& names, const std::string& study,
                                 const Expression& where);

Table query_table(SQLite::Database& sqlite, const std::string& study, const Expression& where,
                  const std::vector<std::string>& extra);

}  // namespace seapile::store
