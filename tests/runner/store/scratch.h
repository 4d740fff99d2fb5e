#pragma once

#include <filesystem>
#include <string>

namespace seapile::store {

/// A folder of its own, in memory where there is such a place (syncing a disk a hundred thousand times proves no more
/// than syncing memory), removed at the end.
class Scratch {
 public:
  Scratch();
  ~Scratch();
  Scratch(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// An empty folder below.
  std::filesystem::path fresh(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

}  // namespace seapile::store
