// A question in SQL by whoever knows the tables (results_schema/catalogue.sql): it can read, and do nothing else.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/catalogue.h"

namespace seapile::store {

struct SqlQuestion {
  std::string text;  ///< one SELECT
  std::vector<std::string>
      bind;                ///< its parameters: "NAME=VALUE", or the values of those without a name in their order
  double time_limit = 10;  ///< [s]
  std::size_t limit = 1'000'000;  ///< rows
};

struct SqlAnswer {
  Table table;        ///< without units
  bool more = false;  ///< the limit left rows out
};

/// Opens the catalogue for this question alone. Throws std::invalid_argument with one sentence when it is no single
/// SELECT, has a mistake, or is not answered within the time limit, and StoreError.
SqlAnswer ask(const std::filesystem::path& root, const SqlQuestion& question);

}  // namespace seapile::store
