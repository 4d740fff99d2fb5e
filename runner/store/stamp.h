#pragma once

#include <string>

#include "runner/store/hdf5_file.h"

namespace seapile::store {

/// Version of the files; raised when a meaning changes, not when something is added. The catalogue has one of its own.
inline constexpr std::int64_t kSchema = 1;

/// Which run a file belongs to, written into its root, so that a file of another run in its place is noticed.
struct Stamp {
  std::string case_id;
  std::string run;
  std::string fingerprint = {};  ///< of everything that a resumed run must agree in; only in files of a running run
};

/// `content` is what the file holds: "series", "grains", ...
void write_stamp(hdf5::FileWriter& writer, const std::string& content, const Stamp& stamp);

/// Throws StoreError::damaged when the file is newer than this program, holds something else, or is of another run.
void check_stamp(const hdf5::FileReader& reader, const std::string& content, const Stamp& stamp);

}  // namespace seapile::store
