// HDF5 files as the store uses them: datasets of numbers with one or two extents, attributes, and windows onto rows of
// another dataset. Every dataset carries the XXH3 of its values as the attribute "xxh3", which every read checks.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "runner/store/hdf5_handle.h"

namespace seapile::store::hdf5 {

/// Formats of the numbers in a file, little-endian.
enum class Number { f64, f32, i32, i64, u64, u8 };
const char* name(Number number);

template <class T>
constexpr Number number_of();
template <>
constexpr Number number_of<double>() {
  return Number::f64;
}
template <>
constexpr Number number_of<float>() {
  return Number::f32;
}
template <>
constexpr Number number_of<std::int32_t>() {
  return Number::i32;
}
template <>
constexpr Number number_of<std::int64_t>() {
  return Number::i64;
}
template <>
constexpr Number number_of<std::uint64_t>() {
  return Number::u64;
}
template <>
constexpr Number number_of<std::uint8_t>() {
  return Number::u8;
}

/// Rows, and values per row; no columns: one extent only.
struct Extents {
  std::uint64_t rows = 0;
  std::uint64_t columns = 0;
  std::uint64_t count() const { return columns == 0 ? rows : rows * columns; }
  friend bool operator==(const Extents&, const Extents&) = default;
};

using Attribute = std::variant<std::int64_t, std::uint64_t, std::string, std::vector<std::int64_t>>;

/// plain: as in memory, for files that live as long as a run. packed: in chunks, shuffled, compressed, and with a
/// checksum of its own (fletcher32) that every HDF5 reader checks.
enum class Storage { plain, packed };

/// What was handed to the library, to be compared with what is on the disk.
struct Held {
  struct Dataset {
    Number number;
    Extents extents;
    std::uint64_t xxh3;
  };
  std::map<std::string, Dataset> datasets;
  std::map<std::pair<std::string, std::string>, Attribute> attributes;  ///< by object and name
};

/// A file being written under a name that nothing has yet.
class FileWriter {
 public:
  FileWriter(const std::filesystem::path& file, Storage storage);
  FileWriter(const FileWriter&) = delete;
  ~FileWriter();

  /// Creates a group and those above it, where they are not there yet; so does every dataset.
  void group(const std::string& path);
  void attribute(const std::string& object, const std::string& name, const Attribute& value);

  /// A dataset of final extents, to be filled by append() from its first row on.
  void create(const std::string& path, Number number, Extents extents);
  /// Returns the XXH3 of these values.
  template <class T>
  std::uint64_t append(const std::string& path, std::span<const T> values) {
    return append(path, number_of<T>(), values.data(), values.size());
  }
  template <class T>
  void dataset(const std::string& path, Extents extents, const std::vector<T>& values) {
    create(path, number_of<T>(), extents);
    append(path, std::span<const T>(values));
  }
  /// A dataset that shows rows of another one from `first` on (an HDF5 virtual dataset); its extents may share the
  /// values of whole rows out in another way. `xxh3` as append() returned it for them.
  void window(const std::string& path, const std::string& source, std::uint64_t first, Extents extents,
              std::uint64_t xxh3);

  /// Flushes and closes everything, every return code checked.
  Held close();

 private:
  struct Dataset;
  std::uint64_t append(const std::string& path, Number number, const void* values, std::size_t count);
  void put_attribute(hid_t object, const std::string& name, const Attribute& value, const std::string& doing);

  std::string file_name_;
  Storage storage_;
  Handle file_;
  std::set<std::string> groups_;
  std::map<std::string, std::unique_ptr<Dataset>> datasets_;
  Held held_;
};

/// A file being read. close() is to be called at the end; an error on the way closes it too.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& file);
  FileReader(const FileReader&) = delete;
  void close() { file_.close(); }

  bool has(const std::string& path) const;
  /// Paths of all datasets at and below a group, sorted; none when there is no such group.
  std::vector<std::string> datasets(const std::string& group) const;

  Number number(const std::string& dataset) const;
  Extents extents(const std::string& dataset) const;
  /// What is there, with the XXH3 of the values as they are read now, without regard to the attribute.
  Held::Dataset found(const std::string& dataset) const;

  /// All values. Throws when they are of another type or not those that were written.
  template <class T>
  std::vector<T> read(const std::string& dataset) const {
    std::vector<T> values;
    read_checked(dataset, number_of<T>(), [&](std::size_t count) {
      values.resize(count);
      return values.data();
    });
    return values;
  }

  /// Throws when the attribute is missing or of another type.
  template <class T>
  T attribute(const std::string& object, const std::string& name) const {
    const Attribute value = any_attribute(object, name);
    if (const T* typed = std::get_if<T>(&value)) return *typed;
    damaged("attribute " + name + " of " + object + " is of another type");
  }
  Attribute any_attribute(const std::string& object, const std::string& name) const;

  [[noreturn]] void damaged(const std::string& what) const;

 private:
  struct Opened;
  Opened open_dataset(const std::string& dataset) const;
  /// `room` makes room for so many values and says where.
  void read_checked(const std::string& dataset, Number number, const std::function<void*(std::size_t)>& room) const;
  std::string doing(const std::string& what, const std::string& path) const;

  std::string file_name_;
  Handle file_;
};

}  // namespace seapile::store::hdf5
