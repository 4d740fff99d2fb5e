// A run as one file, to be sent and computed once more: a tar that holds what its store holds of it, under the same
// names, so that an unpacked bundle is a store.
//
//   bundle.json                               the sealed index: every other member with its size and SHA-256
//   cases/<case id>/<nnnn>/manifest.json ...  the run, and that of the bed it was built on
//   grains/<content>.csv                      the grains of a bed that were read from a file
//
// What is left out of a run is named in its dropped.json (dropped.h), so that every manifest is the one that was
// sealed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "runner/store/run_folder.h"

namespace seapile::store {

inline constexpr const char* kBundleFile = "bundle.json";

/// Version of the bundle's index.
inline constexpr int kBundleSchema = 1;

struct BundledRun {
  std::filesystem::path folder;
  Manifest manifest;
};

/// Grains that a scene names by a file.
struct BundledGrains {
  std::string content;  ///< as the scene has it
  std::filesystem::path file;
};

struct Bundle {
  BundledRun run;
  std::optional<BundledRun> bed;        ///< of a drive
  std::optional<BundledGrains> grains;  ///< absent: they are drawn
};

/// Where a store keeps the grains of a file: "grains/<content>.csv".
std::string grains_path(const std::string& content);

/// Writes a bundle, whole or not at all, in place of what has that name. Frames go along where `with_fields`;
/// everything else that is sealed goes along always. The same runs give the same bytes. Throws StoreError: ::damaged
/// when a sealed file is not what it was.
void write_bundle(const std::filesystem::path& file, const Bundle& bundle, bool with_fields);

/// Unpacks a bundle into an empty folder, every member checked against the index and every file of a run against its
/// manifest. Throws std::invalid_argument, one sentence with the file and the member, for what is no bundle, damaged,
/// or newer than this program; StoreError when it cannot be read or unpacked.
Bundle read_bundle(const std::filesystem::path& file, const std::filesystem::path& folder);

/// A sentence about what was unpacked into the folder, as one about the bundle: the folder means nothing to a reader.
std::string said_of_bundle(std::string sentence, const std::filesystem::path& file,
                           const std::filesystem::path& folder);

}  // namespace seapile::store
