#include "runner/store/file_system.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/vfs.h>

#include <array>

#include "runner/store/durable.h"

namespace seapile::store {
namespace {

namespace fs = std::filesystem;

struct Known {
  unsigned long magic;  ///< statfs(2)
  const char* name;
  bool is_local;
};

constexpr std::array kKnown = {
    Known{0x6969UL, "NFS", false},      Known{0x517BUL, "SMB", false},        Known{0xFF534D42UL, "CIFS", false},
    Known{0xFE534D42UL, "SMB2", false}, Known{0x0BD00BD0UL, "Lustre", false}, Known{0x65735546UL, "FUSE", false},
    Known{0x5346414FUL, "AFS", false},  Known{0x47504653UL, "GPFS", false},   Known{0x19830326UL, "BeeGFS", false},
    Known{0xEF53UL, "ext", true},       Known{0x58465342UL, "XFS", true},     Known{0x9123683EUL, "Btrfs", true},
    Known{0x01021994UL, "tmpfs", true}, Known{0x794C7630UL, "overlay", true}, Known{0x2FC12FC1UL, "ZFS", true},
    Known{0xF2F52010UL, "F2FS", true},
};

fs::path nearest_there(const fs::path& folder) {
  fs::path there = fs::absolute(folder).lexically_normal();
  std::error_code ignored;  // What may not be looked at is as good as not there.
  while (!fs::is_directory(there, ignored) && there.has_relative_path()) there = there.parent_path();
  return there;
}

}  // namespace

FileSystem file_system_of(const fs::path& folder) {
  FileSystem system;
  system.looked_from = nearest_there(folder);
  struct statfs status {};
  if (::statfs(system.looked_from.c_str(), &status) != 0)
    throw system_error(StoreError::Kind::io, "look at", system.looked_from);
  const unsigned long magic = static_cast<unsigned long>(status.f_type) & 0xffffffffUL;
  system.name = fmt::format("0x{:x}", magic);
  for (const Known& known : kKnown) {
    if (known.magic == magic) system.name = known.name, system.is_local = known.is_local;
  }
  system.free_bytes = static_cast<std::uint64_t>(status.f_bavail) * static_cast<std::uint64_t>(status.f_bsize);
  return system;
}

std::string trial_of_writing(const fs::path& folder) {
  const fs::path trial = folder / "trial", temporary = temporary_name(trial), named = temporary_name(trial);
  std::string trouble;
  try {
    Descriptor written(temporary, O_WRONLY | O_CREAT | O_EXCL, "write");
    written.write("a trial of runner doctor, to be removed\n");
    written.sync();
    written.close();
    publish(temporary, named);
    const auto held = try_lock(named);
    if (!held) trouble = fmt::format("{}: a new file could not be locked", folder.string());
    if (held && try_lock(named)) trouble = fmt::format("{}: two had the lock of one file", folder.string());
  } catch (const StoreError& error) {
    trouble = error.what();
  }
  discard(temporary);
  discard(named);
  return trouble;
}

}  // namespace seapile::store
