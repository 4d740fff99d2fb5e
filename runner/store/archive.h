// Tar files by libarchive, of plain files alone: a name, a size and bytes. The same members give the same bytes,
// whoever writes them and when.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "runner/store/durable.h"

struct archive;
struct archive_entry;

namespace seapile::store {

/// Writes a tar under a temporary name, which publish() replaces by the real one; without it nothing stays.
class TarWriter {
 public:
  /// Throws StoreError.
  explicit TarWriter(std::filesystem::path file);
  ~TarWriter();
  TarWriter(const TarWriter&) = delete;
  TarWriter& operator=(const TarWriter&) = delete;

  /// Begins a member; its bytes follow by write(), as many as were said. Throw StoreError.
  void begin(const std::string& name, std::uint64_t bytes);
  void write(std::string_view bytes);
  void publish();

 private:
  std::filesystem::path file_, temporary_;
  Descriptor descriptor_;
  std::unique_ptr<archive, int (*)(archive*)> archive_;
  std::unique_ptr<archive_entry, void (*)(archive_entry*)> entry_;
};

struct TarMember {
  std::string name;
  std::uint64_t bytes = 0;
  std::string kind;  ///< "" for a plain file; else what it is: "a symbolic link", "a directory"
};

/// Reads a tar that anybody may have written: not compressed, one member after the other. What it cannot read is a
/// std::invalid_argument that says what is wrong with the file; StoreError where the file cannot be opened.
class TarReader {
 public:
  explicit TarReader(std::filesystem::path file);

  std::uint64_t file_bytes() const { return file_bytes_; }
  /// Absent after the last one.
  std::optional<TarMember> next();
  /// Hands over the bytes of the member that next() has given.
  void read(const std::function<void(std::string_view)>& take);

 private:
  [[noreturn]] void refuse() const;

  std::filesystem::path file_;
  Descriptor descriptor_;
  std::uint64_t file_bytes_ = 0;
  std::unique_ptr<archive, int (*)(archive*)> archive_;
  bool begun_ = false;
};

}  // namespace seapile::store
