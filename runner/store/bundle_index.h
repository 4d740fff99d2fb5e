// bundle.json, the first member of a bundle: what the others are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store {

struct BundleIndex {
  std::string case_id, run;
  std::string bed_id, bed_run;     ///< "" where there is no bed
  std::vector<FileEntry> members;  ///< every other member, by rising name
};

/// The text of bundle.json: JSON that seals itself.
std::string index_text(const BundleIndex& index);

/// Reads it back. `where` is named in errors. Throws StoreError::damaged.
BundleIndex parse_index(const std::string& text, const std::filesystem::path& where);

/// Where a store keeps a run: "cases/<case id>/<nnnn>/".
std::string run_path(const std::string& case_id, const std::string& run);

/// Why a bundle can have no member of that name, as the end of a sentence; empty: it can.
std::string objection_to_name(const std::string& name);

}  // namespace seapile::store
