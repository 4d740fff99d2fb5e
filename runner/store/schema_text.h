// The descriptions of what is on disk, below results_schema, as they were when the program was built.
#pragma once

#include <string>

namespace seapile::store {

/// The text of results_schema/result_file.md: every path in every file of a run.
std::string result_file_text();

/// The text of results_schema/catalogue.sql: the catalogue's tables.
std::string catalogue_text();

}  // namespace seapile::store
