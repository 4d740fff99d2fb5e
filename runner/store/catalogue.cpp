#include "runner/store/catalogue.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "runner/store/database.h"
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

/// Every run folder below the root that has a manifest, in a fixed order.
std::vector<Path> run_folders(const Path& root) {
  std::vector<Path> folders;
  for (const Path& folder : entries(root / "cases")) {
    if (!is_case_id(folder.filename().string()) || std::filesystem::is_symlink(folder)) continue;
    for (const std::string& run : complete_runs(folder)) folders.push_back(folder / run);
  }
  return folders;
}

}  // namespace

struct Catalogue::Impl {
  Path root;
  Database database;

  template <class Work>
  auto transact(Work&& work) {
    return guarded(database.file(), [&] {
      SQLite::Transaction transaction(database.sqlite(), SQLite::TransactionBehavior::IMMEDIATE);
      work(database.sqlite());
      transaction.commit();
    });
  }

  void ingest(SQLite::Database& sqlite, const Path& run_folder, const Manifest& manifest) const {
    const Path relative = std::filesystem::absolute(run_folder)
                              .lexically_normal()
                              .lexically_relative(std::filesystem::absolute(root).lexically_normal());
    if (relative.empty() || *relative.begin() == "..") {
      throw std::invalid_argument(run_folder.string() + " is not below " + root.string());
    }
    ingest_run(sqlite, relative.generic_string(), manifest);
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

std::size_t Catalogue::rebuild(std::vector<std::string>* left_out) {
  std::size_t count = 0;
  const std::vector<StudyEntry> studies = read_studies(impl_->root);
  impl_->transact([&](SQLite::Database& sqlite) {
    sqlite.exec("DELETE FROM run; DELETE FROM kase; DELETE FROM study;");
    for (const StudyEntry& study : studies) ingest_study(sqlite, study);
    for (const Path& folder : run_folders(impl_->root)) {
      try {
        impl_->ingest(sqlite, folder, read_complete(folder));
        ++count;
      } catch (const StoreError& error) {
        if (left_out != nullptr) left_out->push_back(error.what());
      }
    }
  });
  return count;
}

Table Catalogue::query(const std::string& study, const std::vector<std::string>& where,
                       const std::vector<std::string>& extra) const {
  return guarded(impl_->database.file(), [&] { return query_table(impl_->database.sqlite(), study, where, extra); });
}

std::vector<std::pair<Path, Labels>> Catalogue::runs(const std::string& study,
                                                     const std::vector<std::string>& where) const {
  return guarded(impl_->database.file(), [&] {
    std::vector<std::pair<Path, Labels>> runs;
    for (ListedRun& run : list_runs(impl_->database.sqlite(), study, where)) {
      runs.emplace_back(impl_->root / run.folder, std::move(run.labels));
    }
    return runs;
  });
}

Path Catalogue::find(const std::string& prefix) const {
  return guarded(impl_->database.file(), [&]() -> Path {
    // Behind the last hex digit comes "g".
    SQLite::Statement cases(impl_->database.sqlite(),
                            "SELECT case_id, (SELECT folder FROM run WHERE run.case_id = kase.case_id "
                            "ORDER BY number DESC LIMIT 1) FROM kase WHERE case_id >= ?1 AND case_id < ?1 || 'g'");
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
  return guarded(impl_->database.file(), [&] {
    std::vector<std::string> names;
    SQLite::Statement all(impl_->database.sqlite(), "SELECT name FROM study ORDER BY name");
    while (all.executeStep()) names.push_back(all.getColumn(0).getString());
    return names;
  });
}

}  // namespace seapile::store
