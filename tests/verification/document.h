// docs/verification.md: a heading and prose by hand for every law, and a table between two markers that the program
// verification_table fills in.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/verification/law.h"

namespace seapile::verification {

struct SolverRow {
  std::string solver;
  Row row;
};

/// How a row begins in a table: with its quantity and its solver.
std::string row_head(const Row& row, const std::string& solver);

/// A law's Markdown table, ending with a line break.
std::string table(const std::vector<SolverRow>& rows);

using Tables = std::map<std::string, std::string>;  ///< by law

/// The document's tables, by law: what stands between "<!-- rows of LAW -->" and "<!-- end -->". Throws where a marker
/// lacks its end.
Tables tables_of(const std::string& text);

/// The names in the document's headings of third order, in its order.
std::vector<std::string> headings_of(const std::string& text);

/// Replaces those of the document's tables that are given. Throws std::runtime_error when the file cannot be read or
/// written, or lacks the place of a table.
void put_tables(const std::string& path, const Tables& tables);

/// The file's text; throws when it cannot be read.
std::string read_document(const std::string& path);

}  // namespace seapile::verification
