#include "runner/store/durable.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <random>
#include <utility>
#include <vector>

#include "runner/store/run_folder.h"

namespace seapile::store {

namespace {

using Kind = StoreError::Kind;

constexpr std::string_view kTemporarySuffix = ".temporary";

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

}  // namespace

Descriptor::Descriptor(const std::filesystem::path& path, int flags, const char* doing)
    : path_(path), descriptor_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) throw system_error(Kind::io, doing, path);
}

Descriptor::Descriptor(Descriptor&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Descriptor::~Descriptor() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void Descriptor::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) throw system_error(Kind::io, "write", path_);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void Descriptor::sync() {
  // Never tried twice: after a failed fsync the kernel may have dropped the pages, and the next one would succeed.
  if (::fsync(descriptor_) != 0) throw system_error(Kind::sync, "sync", path_);
}

void Descriptor::close() {
  if (::close(release()) != 0) throw system_error(Kind::io, "close", path_);
}

int Descriptor::release() { return std::exchange(descriptor_, -1); }

std::filesystem::path temporary_name(const std::filesystem::path& file) {
  // The number tells apart the writers of one process, the random part those that died with our process id.
  static std::atomic<unsigned> count{0};
  char tail[64];
  std::snprintf(tail, sizeof tail, ".%d.%u.%08x", static_cast<int>(::getpid()), count++, std::random_device{}());
  return folder_of(file) / ("." + file.filename().string() + tail + std::string(kTemporarySuffix));
}

bool is_temporary(const std::filesystem::path& file) { return file.filename().string().ends_with(kTemporarySuffix); }

bool is_there(const std::filesystem::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return true;
  if (errno != ENOENT && errno != ENOTDIR) throw system_error(Kind::io, "look at", path);
  return false;
}

std::vector<std::filesystem::path> entries(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> found;
  if (!is_there(folder)) return found;
  try {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) found.push_back(entry.path());
  } catch (const std::filesystem::filesystem_error& error) {
    throw StoreError(Kind::io, "cannot list " + folder.string() + ": " + error.code().message());
  }
  std::ranges::sort(found);
  return found;
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (folder.empty() || std::filesystem::is_directory(folder, ignored)) return;
  make_folder(folder.parent_path());
  if (::mkdir(folder.c_str(), 0777) != 0) {
    // Another process may have been faster.
    if (errno != EEXIST || !std::filesystem::is_directory(folder, ignored)) {
      throw system_error(Kind::io, "create the folder", folder);
    }
  }
  sync_folder(folder_of(folder));
}

void sync_file(const std::filesystem::path& file) {
  Descriptor descriptor(file, O_RDONLY | O_NOFOLLOW, "open");
  descriptor.sync();
  descriptor.close();
}

void sync_folder(const std::filesystem::path& folder) {
  Descriptor descriptor(folder, O_RDONLY | O_DIRECTORY, "open");
  descriptor.sync();
  descriptor.close();
}

void publish(const std::filesystem::path& temporary, const std::filesystem::path& file) {
  // Root may put a file in the place of a device, which is nobody's wish.
  struct stat status {};
  if (::lstat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode) &&
      !S_ISLNK(status.st_mode))
    throw StoreError(Kind::io, "cannot write " + file.string() + ": it is there, and no regular file");
  if (::rename(temporary.c_str(), file.c_str()) != 0) throw system_error(Kind::io, "give its name to", file);
  sync_folder(folder_of(file));
}

void discard(const std::filesystem::path& temporary) noexcept { ::unlink(temporary.c_str()); }

void read_pieces(const std::filesystem::path& file, const std::function<void(std::string_view)>& take) {
  Descriptor descriptor(file, O_RDONLY | O_NONBLOCK, "open");  // A pipe in a file's place must not make us wait.
  struct stat status {};
  if (::fstat(descriptor.get(), &status) != 0) throw system_error(Kind::io, "look at", file);
  if (!S_ISREG(status.st_mode)) throw StoreError(Kind::io, "cannot read " + file.string() + ": it is no regular file");
  std::vector<char> buffer(1 << 20);
  while (true) {
    const ssize_t got = ::read(descriptor.get(), buffer.data(), buffer.size());
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw system_error(Kind::io, "read", file);
    if (got == 0) break;
    take({buffer.data(), static_cast<std::size_t>(got)});
  }
  descriptor.close();
}

std::string read_text(const std::filesystem::path& file) {
  std::string text;
  read_pieces(file, [&](std::string_view piece) { text += piece; });
  return text;
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = temporary_name(file);
  try {
    Descriptor descriptor(temporary, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "create");
    descriptor.write(text);
    descriptor.sync();
    descriptor.close();
    if (read_text(temporary) != text) throw StoreError(Kind::verify, file.string() + " does not read back as written");
    publish(temporary, file);
  } catch (...) {
    discard(temporary);
    throw;
  }
}

std::optional<Descriptor> try_lock(const std::filesystem::path& file) {
  while (true) {
    Descriptor descriptor(file, O_RDWR | O_CREAT | O_NOFOLLOW, "open the lock");
    while (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) {
      if (errno == EWOULDBLOCK) return std::nullopt;
      if (errno != EINTR) throw system_error(Kind::io, "lock", file);
    }
    // Somebody may have removed or replaced the file between open and flock: then the lock is on a file without a name.
    struct stat held {
    }, named{};
    if (::fstat(descriptor.get(), &held) != 0) throw system_error(Kind::io, "look at", file);
    if (::stat(file.c_str(), &named) == 0 && held.st_ino == named.st_ino && held.st_dev == named.st_dev) {
      return descriptor;
    }
  }
}

}  // namespace seapile::store
