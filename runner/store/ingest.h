#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/catalogue.h"
#include "runner/store/equivalence.h"
#include "runner/store/run_folder.h"

namespace seapile::store {

/// Puts a complete run's rows in the place of those that the run had, within the caller's transaction. Nothing changes
/// when they are from the same manifest: false.
bool ingest_run(SQLite::Database& sqlite, const std::string& folder, const Manifest& manifest);

/// Puts what a run's manifest says of the parts in the place of the rows that the run had.
void put_parts(SQLite::Database& sqlite, std::int64_t run_id, const std::vector<simulation::Part>& parts);

/// Puts the declarations of a store in the place of all that were listed, within the caller's transaction.
void ingest_equivalences(SQLite::Database& sqlite, const std::vector<Equivalence>& declared);

/// Puts a study's rows in the place of those that it had, within the caller's transaction.
void ingest_study(SQLite::Database& sqlite, const StudyEntry& study);

/// A study as a file of its own below <root>/studies, so that the catalogue can be made again.
void write_study(const std::filesystem::path& root, const StudyEntry& study);
std::vector<StudyEntry> read_studies(const std::filesystem::path& root);

/// JSON of a case's labels: [[path, value], ...].
std::string labels_text(const std::vector<std::pair<std::string, std::string>>& labels);
std::vector<std::pair<std::string, std::string>> labels_from(const std::string& text);

}  // namespace seapile::store
