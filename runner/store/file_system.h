// The file system that a store lies on: what it is, whether it can be trusted with a database, and whether it does what
// the seal of a run asks of it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace seapile::store {

struct FileSystem {
  std::string name;                   ///< "ext", "NFS", ...; its number in hex where it has no name here
  bool is_local = true;               ///< no network lies between
  std::uint64_t free_bytes = 0;       ///< for this user
  std::filesystem::path looked_from;  ///< the folder, or the nearest one above it that is there
};

/// Of a folder, which need not be there yet. Throws StoreError.
FileSystem file_system_of(const std::filesystem::path& folder);

/// Does with small files of its own what a store's writers do: writes and syncs one, renames it, keeps a second lock
/// out while it is locked, and removes it again. What did not work, in a sentence; "" when all did.
std::string trial_of_writing(const std::filesystem::path& folder);

}  // namespace seapile::store
