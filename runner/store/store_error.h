#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace seapile::store {

/// The world failed: disk full, file damaged, permission. One sentence with the path and the system's reason.
struct StoreError : std::runtime_error {
  enum class Kind { io, sync, verify, damaged, locked };
  StoreError(Kind kind, const std::string& sentence);
  Kind kind;
};

/// The error of a system call that has just failed: "cannot write /a/b: No space left on device", from errno.
StoreError system_error(StoreError::Kind kind, const std::string& doing, const std::filesystem::path& path);

}  // namespace seapile::store
