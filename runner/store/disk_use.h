// What lies in a store's run folders, file by file, and what it is for. Looks only; links are never followed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace seapile::store {

/// What a file is for, from what is kept for ever to what is only in the way.
enum class Purpose {
  record,      ///< manifest.json with its metrics, dropped.json, log.txt, attempt.json, progress.json
  grains,      ///< bed.h5: what drives start from
  series,      ///< series.h5
  fields,      ///< frames: *.vtkhdf, *.xdmf, surface.h5
  checkpoint,  ///< checkpoint/, segment/, post_mortem.h5: of runs that go on, or have diverged
  leftover,    ///< what was set aside, half written, or left behind when something else was removed
};
inline constexpr std::size_t kPurposes = 6;

/// "record", "grains", "series", "fields", "checkpoints", "leftovers".
const char* name(Purpose purpose);

/// Of a file by its path in a run's folder; absent: no file of ours has such a name.
std::optional<Purpose> purpose_of(const std::string& path);

struct StoredFile {
  std::string path;  ///< relative to the run's folder
  Purpose purpose;
  std::uint64_t bytes;
};

struct StoredRun {
  std::filesystem::path folder;
  std::string case_id, run;
  bool complete = false;                     ///< has a manifest
  bool completed = false;                    ///< and did not diverge
  bool newest = false;                       ///< of the folders of its case
  std::string bed_id, bed_run;               ///< of the bed that it was built on; "" where there is none
  std::filesystem::file_time_type modified;  ///< its manifest; of an incomplete run the folder
  std::vector<StoredFile> files;
  std::vector<std::string> strange;  ///< what is none of ours, or a link: the run is left alone
  std::string trouble;               ///< why it cannot be judged: its manifest is damaged
};

/// The runs of one case, by rising number.
std::vector<StoredRun> runs_on_disk(const std::filesystem::path& case_folder);

/// Those of all cases, by rising case id. Throws StoreError when a folder cannot be read.
std::vector<StoredRun> runs_in_store(const std::filesystem::path& root);

std::uint64_t bytes_of(const StoredRun& run);

/// Bytes of everything below a folder, the catalogue and pictures included.
std::uint64_t bytes_below(const std::filesystem::path& folder);

}  // namespace seapile::store
