// What a run has to meet, as SQL over the tables of the catalogue.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

#include "runner/store/catalogue.h"
#include "runner/store/expression.h"
#include "runner/store/names.h"

namespace seapile::store {

/// A piece of a WHERE clause over run r and its kase k. Names and values are bound; the text holds none of either.
struct Clause {
  std::string text;  ///< by an index: how the runs are found
  std::string test;  ///< the same asked of one run after the other, with the same values in their order
  std::vector<Cell> values;
  bool is_narrow = false;  ///< few runs are expected to meet it: it finds them, and what stands beside it tests them
};

/// True or false for every run, never NULL, so that "not" turns it round. Throws std::invalid_argument for a name that
/// is not known and for a value that does not fit its name.
Clause clause_of(SQLite::Database& sqlite, const Names& names, const std::string& study, const Expression& expression);

}  // namespace seapile::store
