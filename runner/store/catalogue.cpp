#include "runner/store/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "runner/store/database.h"
#include "runner/store/equivalence.h"
#include "runner/store/ingest.h"
#include "runner/store/layout.h"
#include "runner/store/query.h"

namespace seapile::store {

namespace {

using Path = std::filesystem::path;

/// A manifest, and the promise that the files it lists are there in their sizes.
Manifest read_complete(const Path& run_folder) {
  Manifest manifest = read_manifest(run_folder);
  for (const FileEntry& file : manifest.files) {
    std::error_code error;
    if (std::filesystem::file_size(run_folder / file.path, error) != file.bytes || error) {
      throw StoreError(StoreError::Kind::damaged, (run_folder / file.path).string() + " is not as its manifest says");
    }
  }
  return manifest;
}

bool is_case_folder(const Path& folder) {
  return is_case_id(folder.filename().string()) && !std::filesystem::is_symlink(folder);
}

/// The run folders of a case that have a manifest.
void add_runs(const Path& case_folder, std::vector<Path>& into) {
  for (const std::string& run : complete_runs(case_folder)) into.push_back(case_folder / run);
}

/// Every run folder below the root that has a manifest, in a fixed order.
std::vector<Path> run_folders(const Path& root) {
  std::vector<Path> folders;
  for (const Path& folder : entries(root / "cases")) {
    if (is_case_folder(folder)) add_runs(folder, folders);
  }
  return folders;
}

/// Those of which the catalogue has no row.
std::vector<Path> not_listed(SQLite::Database& sqlite, std::vector<Path> run_folders) {
  SQLite::Statement listed(sqlite, "SELECT 1 FROM run WHERE case_id = ? AND number = ?");
  std::erase_if(run_folders, [&](const Path& folder) {
    listed.reset();
    listed.bind(1, folder.parent_path().filename().string());
    listed.bind(2, static_cast<std::int64_t>(run_number(run_name(folder))));
    return listed.executeStep();
  });
  return run_folders;
}

Path normal(const Path& path) {
  Path whole = std::filesystem::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

/// Those of a run's folder, a case's, that of all cases, or the root.
std::vector<Path> run_folders(const Path& root, const Path& folder) {
  const Path relative = normal(folder).lexically_relative(normal(root));
  const auto depth = relative == "." ? 0 : std::distance(relative.begin(), relative.end());
  const bool below = depth == 0 || (*relative.begin() == "cases" && depth <= 3);
  if (!below) {
    throw std::invalid_argument(folder.string() + " does not lie in " + (root / "cases").string() +
                                "/<case id>/<number>, where the catalogue looks for runs");
  }
  const Path whole = root / relative;
  std::vector<Path> folders;
  if (depth < 2) return run_folders(root);
  if (depth == 2) {
    if (is_case_folder(whole)) add_runs(whole, folders);
  } else if (is_case_folder(whole.parent_path()) && run_number(run_name(whole)) > 0 &&
             is_there(whole / kManifestFile)) {
    folders.push_back(whole);
  }
  return folders;
}

}  // namespace

struct Catalogue::Impl {
  Path root;
  Database database;

  template <class Work>
  void transact(Work&& work) {
    try {
      guarded(database.file(), [&] {
        SQLite::Transaction transaction(database.sqlite(), SQLite::TransactionBehavior::IMMEDIATE);
        work(database.sqlite());
        transaction.commit();
      });
    } catch (const StoreError&) {
      database.distrust();
      throw;
    }
  }

  /// One run after the other; those that do not hold are left out.
  void ingest(SQLite::Database& sqlite, const std::vector<Path>& run_folders, Ingested& ingested) const {
    for (const Path& folder : run_folders) {
      try {
        ++(ingest(sqlite, folder, read_complete(folder)) ? ingested.added : ingested.known);
      } catch (const StoreError& error) {
        ingested.left_out.push_back(error.what());
      }
    }
  }

  bool ingest(SQLite::Database& sqlite, const Path& run_folder, const Manifest& manifest) const {
    const Path relative = std::filesystem::absolute(run_folder)
                              .lexically_normal()
                              .lexically_relative(std::filesystem::absolute(root).lexically_normal());
    if (relative.empty() || *relative.begin() == "..") {
      throw std::invalid_argument(run_folder.string() + " is not below " + root.string());
    }
    return ingest_run(sqlite, relative.generic_string(), manifest);
  }
};

Catalogue Catalogue::open(const Path& root) {
  Catalogue catalogue;
  catalogue.impl_ = std::make_shared<Impl>(Impl{root, Database::open_for_writing(root)});
  return catalogue;
}

Catalogue Catalogue::open_read_only(const Path& root) {
  Catalogue catalogue;
  catalogue.impl_ = std::make_shared<Impl>(Impl{root, Database::open_for_reading(root)});
  return catalogue;
}

Catalogue Catalogue::open_anew(const Path& root) {
  set_catalogue_aside(root);
  return open(root);
}

void Catalogue::put(const StudyEntry& study) {
  write_study(impl_->root, study);
  impl_->transact([&](SQLite::Database& sqlite) { ingest_study(sqlite, study); });
}

void Catalogue::ingest(const Path& run_folder) {
  const Manifest manifest = read_complete(run_folder);
  impl_->transact([&](SQLite::Database& sqlite) { impl_->ingest(sqlite, run_folder, manifest); });
}

void Catalogue::refresh(const Path& run_folder) {
  impl_->transact([&](SQLite::Database& sqlite) {
    SQLite::Statement forget(sqlite, "DELETE FROM run WHERE case_id = ? AND number = ?");
    forget.bind(1, run_folder.parent_path().filename().string());
    forget.bind(2, static_cast<std::int64_t>(run_number(run_name(run_folder))));
    forget.exec();
    if (is_there(run_folder / kManifestFile)) impl_->ingest(sqlite, run_folder, read_complete(run_folder));
  });
}

void Catalogue::check() { impl_->database.check(); }

Ingested Catalogue::ingest_all(const std::vector<Path>& folders) {
  std::vector<Path> all;
  for (const Path& folder : folders) {
    const std::vector<Path> runs = run_folders(impl_->root, folder);
    all.insert(all.end(), runs.begin(), runs.end());
  }
  Ingested ingested;
  impl_->transact([&](SQLite::Database& sqlite) { impl_->ingest(sqlite, all, ingested); });
  return ingested;
}

std::vector<std::string> Catalogue::refresh_equivalences() {
  Equivalences equivalences = read_equivalences(impl_->root);
  impl_->transact([&](SQLite::Database& sqlite) { ingest_equivalences(sqlite, equivalences.declared); });
  return std::move(equivalences.left_out);
}

Ingested Catalogue::ingest_missing() {
  Ingested ingested;
  Equivalences equivalences = read_equivalences(impl_->root);
  ingested.left_out = std::move(equivalences.left_out);
  const std::vector<StudyEntry> studies = read_studies(impl_->root);
  impl_->transact([&](SQLite::Database& sqlite) {
    ingest_equivalences(sqlite, equivalences.declared);
    SQLite::Statement same_study(sqlite, "SELECT 1 FROM study WHERE name = ? AND file_sha256 = ?");
    for (const StudyEntry& study : studies) {
      same_study.reset();
      same_study.bind(1, study.name);
      same_study.bind(2, study.file_sha256);
      if (same_study.executeStep()) continue;
      ingest_study(sqlite, study);
      ++ingested.studies;
    }
    std::vector<Path> folders = run_folders(impl_->root);
    ingested.known = folders.size();
    folders = not_listed(sqlite, std::move(folders));
    ingested.known -= folders.size();
    impl_->ingest(sqlite, folders, ingested);
  });
  return ingested;
}

std::vector<Path> Catalogue::missing() const {
  return guarded(impl_->database.file(),
                 [&] { return not_listed(impl_->database.sqlite(), run_folders(impl_->root)); });
}

std::size_t Catalogue::rebuild(std::vector<std::string>* left_out) {
  Ingested ingested;
  const std::vector<StudyEntry> studies = read_studies(impl_->root);
  Equivalences equivalences = read_equivalences(impl_->root);
  ingested.left_out = std::move(equivalences.left_out);
  impl_->transact([&](SQLite::Database& sqlite) {
    sqlite.exec("DELETE FROM run; DELETE FROM kase; DELETE FROM study;");
    ingest_equivalences(sqlite, equivalences.declared);
    for (const StudyEntry& study : studies) ingest_study(sqlite, study);
    impl_->ingest(sqlite, run_folders(impl_->root), ingested);
  });
  if (left_out != nullptr) *left_out = std::move(ingested.left_out);
  return ingested.added;
}

Table Catalogue::query_matching(const std::string& study, const Expression& where,
                                const std::vector<std::string>& extra) const {
  return guarded(impl_->database.file(), [&] { return query_table(impl_->database.sqlite(), study, where, extra); });
}

Table Catalogue::query(const std::string& study, const std::vector<std::string>& where,
                       const std::vector<std::string>& extra) const {
  return query_matching(study, parse_all(where), extra);
}

Meaning Catalogue::meaning(const std::string& name, const std::string& study) const {
  return guarded(impl_->database.file(), [&] {
    const Names names(impl_->database.sqlite());
    const Name found = names.find(name, study);
    return Meaning{found.text, names.unit(found)};
  });
}

std::vector<std::pair<Path, Labels>> Catalogue::runs(const std::string& study,
                                                     const std::vector<std::string>& where) const {
  return guarded(impl_->database.file(), [&] {
    std::vector<std::pair<Path, Labels>> runs;
    SQLite::Database& sqlite = impl_->database.sqlite();
    for (ListedRun& run : list_runs(sqlite, Names(sqlite), study, parse_all(where))) {
      runs.emplace_back(impl_->root / run.folder, std::move(run.labels));
    }
    return runs;
  });
}

Path Catalogue::find(const std::string& prefix) const {
  return guarded(impl_->database.file(), [&]() -> Path {
    // Behind the last hex digit comes "g".
    SQLite::Statement cases(
        impl_->database.sqlite(),
        "SELECT case_id, folder FROM run WHERE newest = 1 AND case_id >= ?1 AND case_id < ?1 || 'g' "
        "ORDER BY case_id LIMIT 2");
    cases.bind(1, prefix);
    if (!cases.executeStep()) return {};
    const std::string id = cases.getColumn(0).getString();
    const Path folder = impl_->root / cases.getColumn(1).getString();
    if (cases.executeStep()) {
      throw std::invalid_argument(fmt::format("\"{}\" begins several case ids, among them {} and {}", prefix,
                                              id.substr(0, kShownDigits),
                                              cases.getColumn(0).getString().substr(0, kShownDigits)));
    }
    return folder;
  });
}

std::vector<PastCost> Catalogue::costs() const {
  return guarded(impl_->database.file(), [&] { return past_costs(impl_->database.sqlite()); });
}

std::optional<StudyEntry> Catalogue::entry(const std::string& study) const {
  return guarded(impl_->database.file(), [&]() -> std::optional<StudyEntry> {
    SQLite::Database& sqlite = impl_->database.sqlite();
    SQLite::Statement known(sqlite, "SELECT study_id, question, file_sha256 FROM study WHERE name = ?");
    known.bind(1, study);
    if (!known.executeStep()) return {};
    StudyEntry entry{study, known.getColumn(1).getString(), known.getColumn(2).getString(), {}};
    SQLite::Statement cases(sqlite, "SELECT case_id, labels FROM study_case WHERE study_id = ? ORDER BY ordinal");
    cases.bind(1, known.getColumn(0).getInt64());
    while (cases.executeStep()) {
      entry.cases.emplace_back(cases.getColumn(0).getString(), labels_from(cases.getColumn(1).getString()));
    }
    return entry;
  });
}

std::vector<std::string> Catalogue::studies() const {
  return guarded(impl_->database.file(), [&] { return study_names(impl_->database.sqlite()); });
}

}  // namespace seapile::store
