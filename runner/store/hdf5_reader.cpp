#include <xxhash.h>

#include <algorithm>
#include <array>

#include "runner/store/hdf5_types.h"

namespace seapile::store::hdf5 {

namespace {

constexpr OnError kOnError = OnError::close;

/// Beyond this a size is taken for damage, before anything is allocated.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 38;

Handle open_file(const std::filesystem::path& file) {
  initialise();
  const std::string doing = "read " + file.string();
  Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose, kOnError, doing};
  check(H5Pset_file_locking(access.get(), true, true), kOnError, doing);
  check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_SEMI), kOnError, doing);
  Handle opened{H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, kOnError, doing};
  access.close();
  return opened;
}

constexpr std::array kNumbers = {Number::f64, Number::f32, Number::i32, Number::i64, Number::u64, Number::u8};

bool same_type(hid_t type, Number number) { return H5Tequal(type, type_of(number)) > 0; }

}  // namespace

FileReader::FileReader(const std::filesystem::path& file) : file_name_(file.string()), file_(open_file(file)) {}

std::string FileReader::doing(const std::string& what, const std::string& path) const {
  return what + " " + path + " of " + file_name_;
}

void FileReader::damaged(const std::string& what) const {
  throw StoreError(StoreError::Kind::damaged, file_name_ + " is damaged: " + what);
}

bool FileReader::has(const std::string& path) const {
  // H5Lexists asks for one step at a time.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string step = path.substr(0, end);
    if (step == "/" || step.empty()) return true;
    const htri_t there = H5Lexists(file_.get(), step.c_str(), H5P_DEFAULT);
    if (there < 0) fail(StoreError::Kind::damaged, doing("look for", path));
    if (there == 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> FileReader::datasets(const std::string& group) const {
  if (!has(group)) return {};
  struct Found {
    std::string prefix;
    std::vector<std::string> paths;
  } found{group == "/" ? "/" : group + "/", {}};
  const auto take = [](hid_t, const char* name, const H5O_info_t* info, void* data) -> herr_t {
    auto& into = *static_cast<Found*>(data);
    if (info->type == H5O_TYPE_DATASET) into.paths.push_back(into.prefix + name);
    return 0;
  };
  // In the order of the file: to sort, the library makes a table, and frees what it has not set when the file is
  // damaged.
  check(H5Ovisit_by_name2(file_.get(), group.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, take, &found, H5O_INFO_BASIC,
                          H5P_DEFAULT),
        kOnError, doing("list", group));
  std::ranges::sort(found.paths);
  return found.paths;
}

struct FileReader::Opened {
  Handle handle;
  Number number;
  Extents extents;
  std::size_t bytes() const { return extents.count() * size_of(number); }
};

FileReader::Opened FileReader::open_dataset(const std::string& dataset) const {
  const std::string reading = doing("read", dataset);
  Handle opened{H5Dopen2(file_.get(), dataset.c_str(), H5P_DEFAULT), H5Dclose, kOnError, reading};

  Handle type{H5Dget_type(opened.get()), H5Tclose, kOnError, reading};
  const auto number = std::ranges::find_if(kNumbers, [&](Number n) { return same_type(type.get(), n); });
  if (number == kNumbers.end()) damaged(dataset + " is of an unknown type");
  type.close();

  Handle space{H5Dget_space(opened.get()), H5Sclose, kOnError, reading};
  std::array<hsize_t, 2> sizes{};
  const int rank = H5Sget_simple_extent_ndims(space.get());
  if (rank < 1 || rank > 2) damaged(dataset + " has " + std::to_string(rank) + " extents");
  check(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr), kOnError, reading);
  space.close();
  const std::uint64_t row_bytes = size_of(*number) * (rank == 2 ? sizes[1] : 1);
  if (row_bytes == 0 || row_bytes > kMostBytes || sizes[0] > kMostBytes / row_bytes) {
    damaged(dataset + " has impossible extents");
  }
  return {std::move(opened), *number, {sizes[0], sizes[1]}};
}

Number FileReader::number(const std::string& dataset) const {
  Opened opened = open_dataset(dataset);
  opened.handle.close();
  return opened.number;
}

Extents FileReader::extents(const std::string& dataset) const {
  Opened opened = open_dataset(dataset);
  opened.handle.close();
  return opened.extents;
}

Held::Dataset FileReader::found(const std::string& dataset) const {
  Opened opened = open_dataset(dataset);
  std::vector<unsigned char> values(opened.bytes());
  check(H5Dread(opened.handle.get(), type_of(opened.number), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), kOnError,
        doing("read", dataset));
  opened.handle.close();
  return {opened.number, opened.extents, XXH3_64bits(values.data(), values.size())};
}

void FileReader::read_checked(const std::string& dataset, Number number,
                              const std::function<void*(std::size_t)>& room) const {
  Opened opened = open_dataset(dataset);
  if (opened.number != number) damaged(dataset + " is not " + name(number));
  void* values = room(opened.extents.count());
  check(H5Dread(opened.handle.get(), type_of(number), H5S_ALL, H5S_ALL, H5P_DEFAULT, values), kOnError,
        doing("read", dataset));
  opened.handle.close();
  if (attribute<std::uint64_t>(dataset, kHashAttribute) != XXH3_64bits(values, opened.bytes())) {
    damaged("the values of " + dataset + " are not those that were written");
  }
}

Attribute FileReader::any_attribute(const std::string& object, const std::string& name) const {
  const std::string reading = doing("read attribute " + name + " of", object);
  Handle opened{H5Aopen_by_name(file_.get(), object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                kOnError, reading};
  Handle type{H5Aget_type(opened.get()), H5Tclose, kOnError, reading};
  Handle space{H5Aget_space(opened.get()), H5Sclose, kOnError, reading};
  const auto read = [&](void* values) { check(H5Aread(opened.get(), type.get(), values), kOnError, reading); };

  Attribute value;
  const H5S_class_t shape = H5Sget_simple_extent_type(space.get());
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (shape == H5S_SIMPLE && same_type(type.get(), Number::i64) && count >= 0 && count < 65536) {
    read(value.emplace<std::vector<std::int64_t>>(static_cast<std::size_t>(count)).data());
  } else if (shape != H5S_SCALAR) {
    damaged("attribute " + name + " of " + object + " has an unknown shape");
  } else if (same_type(type.get(), Number::i64)) {
    read(&value.emplace<std::int64_t>());
  } else if (same_type(type.get(), Number::u64)) {
    read(&value.emplace<std::uint64_t>());
  } else if (H5Tget_class(type.get()) == H5T_STRING && H5Tis_variable_str(type.get()) == 0) {
    auto& text = value.emplace<std::string>(H5Tget_size(type.get()), '\0');
    read(text.data());
    while (!text.empty() && text.back() == '\0') text.pop_back();
  } else {
    damaged("attribute " + name + " of " + object + " is of an unknown type");
  }
  space.close();
  type.close();
  opened.close();
  return value;
}

}  // namespace seapile::store::hdf5
