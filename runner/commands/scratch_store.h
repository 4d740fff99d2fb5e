// A store for a while: a folder below a store's root, on the same disk, which is removed at the end.
#pragma once

#include <filesystem>
#include <optional>

#include "runner/store/run_folder.h"

namespace seapile::commands {

class ScratchStore {
 public:
  /// Makes <root>/probe.XXXXXX, and removes those that were left by programs that were killed. Throws
  /// store::StoreError.
  explicit ScratchStore(const std::filesystem::path& root);
  ~ScratchStore();
  ScratchStore(const ScratchStore&) = delete;
  ScratchStore& operator=(const ScratchStore&) = delete;

  const std::filesystem::path& root() const { return root_; }

  /// Copies a sealed run of the store to its place here; one that is here already stays. Throws store::StoreError.
  void take_along(const std::filesystem::path& run_folder) const;

 private:
  std::filesystem::path root_;
  std::optional<store::Claim> claim_;  ///< as long as somebody works here
};

}  // namespace seapile::commands
