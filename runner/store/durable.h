// Files and folders that survive: every system call is checked, and a name appears only when what stands behind it
// has reached the disk.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runner/store/store_error.h"

namespace seapile::store {

/// A file descriptor. A failed close is an error (it may be the first word of a failed write), so close() is called by
/// hand; the destructor only tidies up after another error.
class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags, const char* doing);
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&&) = delete;
  ~Descriptor();

  int get() const { return descriptor_; }
  void write(std::string_view bytes);
  void sync();
  void close();
  /// Hands the descriptor over to the caller.
  int release();

 private:
  std::filesystem::path path_;
  int descriptor_;
};

/// A name beside `file` that no other writer uses, and whether a name is of that kind.
std::filesystem::path temporary_name(const std::filesystem::path& file);
bool is_temporary(const std::filesystem::path& file);

/// Whether there is anything of that name; a link is followed.
bool is_there(const std::filesystem::path& path);

/// What is in a folder, sorted by name; nothing when there is no such folder.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);

/// Creates a folder and those above it; each new name is synced into the folder that holds it.
void make_folder(const std::filesystem::path& folder);

/// Forces what was written under a name to the disk.
void sync_file(const std::filesystem::path& file);
void sync_folder(const std::filesystem::path& folder);

/// Gives a complete and synced file its name, and syncs the name.
void publish(const std::filesystem::path& temporary, const std::filesystem::path& file);

/// Removes a file after a failure; whether that works is of no interest any more.
void discard(const std::filesystem::path& temporary) noexcept;

/// Hands a file's bytes over, piece by piece.
void read_pieces(const std::filesystem::path& file, const std::function<void(std::string_view)>& take);
std::string read_text(const std::filesystem::path& file);

/// An exclusive flock on a file, created if missing and never removed; held until the descriptor is closed or the
/// process dies. Absent when another process holds it.
std::optional<Descriptor> try_lock(const std::filesystem::path& file);

}  // namespace seapile::store
