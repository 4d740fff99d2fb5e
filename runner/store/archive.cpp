#include "runner/store/archive.h"

#include <archive.h>
#include <archive_entry.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <stdexcept>
#include <utility>
#include <vector>

namespace seapile::store {

namespace {

constexpr std::size_t kBlock = 10240;  // of a tar since ever
constexpr mode_t kMode = 0644;

std::string words_of(archive* of) {
  const char* text = archive_error_string(of);
  return text == nullptr ? "libarchive gives no reason" : text;
}

/// What a member is that is no plain file.
std::string kind_of(archive_entry* entry) {
  if (archive_entry_hardlink(entry) != nullptr) return "a hard link";
  switch (archive_entry_filetype(entry)) {
    case AE_IFREG:
      return "";
    case AE_IFLNK:
      return "a symbolic link";
    case AE_IFDIR:
      return "a directory";
    case AE_IFCHR:
    case AE_IFBLK:
      return "a device";
    case AE_IFIFO:
      return "a pipe";
    default:
      return "no plain file";
  }
}

}  // namespace

TarWriter::TarWriter(std::filesystem::path file)
    : file_(std::move(file)),
      temporary_(temporary_name(file_)),
      descriptor_(temporary_, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, "create"),
      archive_(archive_write_new(), archive_write_free),
      entry_(archive_entry_new(), archive_entry_free) {
  // An extended header where a size needs one, and nowhere else.
  const bool opened = archive_ && entry_ && archive_write_set_format_pax_restricted(archive_.get()) == ARCHIVE_OK &&
                      archive_write_set_bytes_per_block(archive_.get(), kBlock) == ARCHIVE_OK &&
                      archive_write_set_bytes_in_last_block(archive_.get(), kBlock) == ARCHIVE_OK &&
                      archive_write_open_fd(archive_.get(), descriptor_.get()) == ARCHIVE_OK;
  if (opened) return;
  discard(temporary_);
  throw StoreError(StoreError::Kind::io, fmt::format("cannot begin {}: {}", file_.string(), words_of(archive_.get())));
}

TarWriter::~TarWriter() {
  if (!temporary_.empty()) discard(temporary_);
}

void TarWriter::begin(const std::string& name, std::uint64_t bytes) {
  archive_entry_clear(entry_.get());
  archive_entry_set_pathname(entry_.get(), name.c_str());
  archive_entry_set_filetype(entry_.get(), AE_IFREG);
  archive_entry_set_perm(entry_.get(), kMode);
  archive_entry_set_size(entry_.get(), static_cast<la_int64_t>(bytes));
  archive_entry_set_mtime(entry_.get(), 0, 0);  // Who wrote it, and when, is no part of it.
  if (archive_write_header(archive_.get(), entry_.get()) != ARCHIVE_OK)
    throw StoreError(StoreError::Kind::io,
                     fmt::format("cannot write {}: {}", file_.string(), words_of(archive_.get())));
}

void TarWriter::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const la_ssize_t written = archive_write_data(archive_.get(), bytes.data(), bytes.size());
    if (written <= 0)
      throw StoreError(StoreError::Kind::io,
                       fmt::format("cannot write {}: {}", file_.string(), words_of(archive_.get())));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void TarWriter::publish() {
  if (archive_write_close(archive_.get()) != ARCHIVE_OK)
    throw StoreError(StoreError::Kind::io,
                     fmt::format("cannot write {}: {}", file_.string(), words_of(archive_.get())));
  descriptor_.sync();
  descriptor_.close();
  store::publish(temporary_, file_);
  temporary_.clear();
}

TarReader::TarReader(std::filesystem::path file)
    : file_(std::move(file)),
      descriptor_(file_, O_RDONLY | O_NONBLOCK, "open"),  // A pipe in a file's place must not make us wait.
      archive_(archive_read_new(), archive_read_free) {
  struct stat status {};
  if (::fstat(descriptor_.get(), &status) != 0) throw system_error(StoreError::Kind::io, "look at", file_);
  if (!S_ISREG(status.st_mode)) throw std::invalid_argument(file_.string() + " is no regular file");
  file_bytes_ = static_cast<std::uint64_t>(status.st_size);
  const bool opened = archive_ && archive_read_support_filter_none(archive_.get()) == ARCHIVE_OK &&
                      archive_read_support_format_tar(archive_.get()) == ARCHIVE_OK &&
                      archive_read_open_fd(archive_.get(), descriptor_.get(), kBlock) == ARCHIVE_OK;
  if (!opened) refuse();
}

void TarReader::refuse() const {
  if (!begun_) throw std::invalid_argument(file_.string() + " is no tar file");
  throw std::invalid_argument(fmt::format("{} is damaged or cut off: {}", file_.string(), words_of(archive_.get())));
}

std::optional<TarMember> TarReader::next() {
  archive_entry* entry = nullptr;
  const int code = archive_read_next_header(archive_.get(), &entry);
  if (code == ARCHIVE_EOF) return std::nullopt;
  if (code != ARCHIVE_OK) refuse();
  begun_ = true;
  const char* name = archive_entry_pathname(entry);
  const la_int64_t bytes = archive_entry_size(entry);
  if (name == nullptr || bytes < 0) refuse();
  return TarMember{name, static_cast<std::uint64_t>(bytes), kind_of(entry)};
}

void TarReader::read(const std::function<void(std::string_view)>& take) {
  std::vector<char> buffer(1 << 20);
  while (true) {
    const la_ssize_t got = archive_read_data(archive_.get(), buffer.data(), buffer.size());
    if (got == 0) return;
    if (got < 0) refuse();
    take({buffer.data(), static_cast<std::size_t>(got)});
  }
}

}  // namespace seapile::store
