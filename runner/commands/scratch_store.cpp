#include "runner/commands/scratch_store.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>
#include <utility>

#include "runner/store/durable.h"
#include "runner/store/layout.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "probe.";

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
  throw store::StoreError(store::StoreError::Kind::io, fmt::format("{}: {}", path.string(), why));
}

/// Of programs that could not remove them any more.
void sweep(const fs::path& root) {
  for (const fs::path& entry : store::entries(root)) {
    if (!entry.filename().string().starts_with(kPrefix) || fs::is_symlink(entry) || !fs::is_directory(entry)) continue;
    // One without a lock is being made this moment, or is none of ours.
    if (!store::is_there(entry / "lock") || !store::Claim::take(entry)) continue;
    std::error_code ignored;
    fs::remove_all(entry, ignored);
  }
}

}  // namespace

ScratchStore::ScratchStore(const fs::path& root) {
  sweep(root);
  std::string name = (root / (std::string(kPrefix) + "XXXXXX")).string();
  if (::mkdtemp(name.data()) == nullptr) fail(name, std::strerror(errno));
  root_ = name;
  if (auto claim = store::Claim::take(root_)) claim_.emplace(std::move(*claim));
}

ScratchStore::~ScratchStore() {
  std::error_code ignored;
  fs::remove_all(root_, ignored);
}

void ScratchStore::take_along(const fs::path& run_folder) const {
  const fs::path to = root_ / "cases" / run_folder.parent_path().filename() / run_folder.filename();
  if (store::is_there(to / store::kManifestFile)) return;
  store::make_folder(to.parent_path());
  std::error_code error;
  fs::copy(run_folder, to, fs::copy_options::recursive, error);
  if (error) fail(run_folder, "cannot be copied: " + error.message());
}

}  // namespace seapile::commands
