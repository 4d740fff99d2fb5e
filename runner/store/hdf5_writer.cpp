#include <xxhash.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "runner/store/hdf5_types.h"

namespace seapile::store::hdf5 {

namespace {

constexpr std::uint64_t kChunkBytes = 64 * 1024;
constexpr unsigned kCompression = 4;  // Level of gzip: beyond it time grows and files of doubles do not shrink.
constexpr OnError kOnError = OnError::abandon;

Handle property_list(hid_t kind, const std::string& doing) { return {H5Pcreate(kind), H5Pclose, kOnError, doing}; }

/// For creating objects that do not remember when: the same content makes the same bytes, whenever it is written.
Handle timeless(hid_t kind, const std::string& doing) {
  Handle list = property_list(kind, doing);
  check(H5Pset_obj_track_times(list.get(), false), kOnError, doing);
  return list;
}

Handle space_of(Extents extents, const std::string& doing) {
  const hsize_t sizes[] = {extents.rows, extents.columns};
  return {H5Screate_simple(extents.columns == 0 ? 1 : 2, sizes, nullptr), H5Sclose, kOnError, doing};
}

/// Selects rows [first, first + rows).
void select_rows(const Handle& space, Extents extents, std::uint64_t first, std::uint64_t rows,
                 const std::string& doing) {
  const hsize_t start[] = {first, 0};
  const hsize_t count[] = {rows, extents.columns};
  check(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start, nullptr, count, nullptr), kOnError, doing);
}

Handle create_file(const std::filesystem::path& file) {
  initialise();
  const std::string doing = "create " + file.string();
  Handle access = property_list(H5P_FILE_ACCESS, doing);
  // The newest layout of 1.10 has a checksum on every piece of metadata.
  check(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V110, H5F_LIBVER_V110), kOnError, doing);
  check(H5Pset_file_locking(access.get(), true, true), kOnError, doing);
  check(H5Pset_fclose_degree(access.get(), H5F_CLOSE_SEMI), kOnError, doing);
  // Truncating instead would empty a file that another process is writing before its lock is looked at.
  Handle creation = timeless(H5P_FILE_CREATE, doing);
  Handle created{H5Fcreate(file.c_str(), H5F_ACC_EXCL, creation.get(), access.get()), H5Fclose, kOnError, doing};
  creation.close();
  access.close();
  return created;
}

}  // namespace

struct FileWriter::Dataset {
  Dataset(Handle opened, Number format, Extents size) : handle(std::move(opened)), number(format), extents(size) {}

  Handle handle;
  Number number;
  Extents extents;
  std::uint64_t written = 0;  ///< values so far
  std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> hash{XXH3_createState(), XXH3_freeState};
};

FileWriter::FileWriter(const std::filesystem::path& file, Storage storage)
    : file_name_(file.string()), storage_(storage), file_(create_file(file)) {}

FileWriter::~FileWriter() = default;

void FileWriter::group(const std::string& path) {
  if (path.empty() || !groups_.insert(path).second) return;
  group(path.substr(0, path.rfind('/')));
  const std::string doing = "create group " + path + " in " + file_name_;
  Handle creation = timeless(H5P_GROUP_CREATE, doing);
  Handle group{H5Gcreate2(file_.get(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose, kOnError,
               doing};
  group.close();
  creation.close();
}

void FileWriter::create(const std::string& path, Number number, Extents extents) {
  const std::string doing = "create " + path + " in " + file_name_;
  group(path.substr(0, path.rfind('/')));
  Handle space = space_of(extents, doing);
  Handle creation = timeless(H5P_DATASET_CREATE, doing);
  if (storage_ == Storage::packed && extents.count() > 0) {
    const std::uint64_t row_bytes = size_of(number) * std::max<std::uint64_t>(extents.columns, 1);
    const hsize_t chunk[] = {std::clamp<std::uint64_t>(kChunkBytes / row_bytes, 1, extents.rows), extents.columns};
    check(H5Pset_chunk(creation.get(), extents.columns == 0 ? 1 : 2, chunk), kOnError, doing);
    check(H5Pset_shuffle(creation.get()), kOnError, doing);
    check(H5Pset_deflate(creation.get(), kCompression), kOnError, doing);
    check(H5Pset_fletcher32(creation.get()), kOnError, doing);
  }
  Handle created{
      H5Dcreate2(file_.get(), path.c_str(), type_of(number), space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose, kOnError, doing};
  creation.close();
  space.close();
  auto dataset = std::make_unique<Dataset>(std::move(created), number, extents);
  XXH3_64bits_reset(dataset->hash.get());
  datasets_.emplace(path, std::move(dataset));
}

std::uint64_t FileWriter::append(const std::string& path, Number number, const void* values, std::size_t count) {
  const auto found = datasets_.find(path);
  if (found == datasets_.end()) throw std::logic_error(path + " is filled before it is created");
  Dataset& dataset = *found->second;
  const std::uint64_t columns = std::max<std::uint64_t>(dataset.extents.columns, 1);
  if (number != dataset.number || count % columns != 0 || dataset.written + count > dataset.extents.count()) {
    throw std::logic_error("values do not fit into " + path);
  }
  if (count > 0) {
    const std::string doing = "write " + path + " in " + file_name_;
    const std::uint64_t first = dataset.written / columns, rows = count / columns;
    Handle space = space_of(dataset.extents, doing);
    select_rows(space, dataset.extents, first, rows, doing);
    Handle memory = space_of({rows, dataset.extents.columns}, doing);
    check(H5Dwrite(dataset.handle.get(), type_of(number), memory.get(), space.get(), H5P_DEFAULT, values), kOnError,
          doing);
    memory.close();
    space.close();
  }
  dataset.written += count;
  XXH3_64bits_update(dataset.hash.get(), values, count * size_of(number));
  return XXH3_64bits(values, count * size_of(number));
}

void FileWriter::window(const std::string& path, const std::string& source, std::uint64_t first, Extents extents,
                        std::uint64_t xxh3) {
  const Dataset& from = *datasets_.at(source);
  const std::uint64_t columns = std::max<std::uint64_t>(from.extents.columns, 1), rows = extents.count() / columns;
  if (extents.count() % columns != 0 || first + rows > from.extents.rows) {
    throw std::logic_error(path + " is no window onto rows of " + source);
  }
  const std::string doing = "create " + path + " in " + file_name_;
  group(path.substr(0, path.rfind('/')));
  Handle space = space_of(extents, doing);
  Handle creation = timeless(H5P_DATASET_CREATE, doing);
  if (extents.count() > 0) {  // A window onto nothing is an empty dataset of its own.
    Handle rows_of_source = space_of(from.extents, doing);
    select_rows(rows_of_source, from.extents, first, rows, doing);
    check(H5Pset_virtual(creation.get(), space.get(), ".", source.c_str(), rows_of_source.get()), kOnError, doing);
    rows_of_source.close();
  }
  Handle created{H5Dcreate2(file_.get(), path.c_str(), type_of(from.number), space.get(), H5P_DEFAULT, creation.get(),
                            H5P_DEFAULT),
                 H5Dclose, kOnError, doing};
  put_attribute(created.get(), kHashAttribute, xxh3, doing);
  created.close();
  creation.close();
  space.close();
  held_.datasets.emplace(path, Held::Dataset{from.number, extents, xxh3});
}

void FileWriter::attribute(const std::string& object, const std::string& name, const Attribute& value) {
  const std::string doing = "write attribute " + name + " of " + object + " in " + file_name_;
  Handle opened{H5Oopen(file_.get(), object.c_str(), H5P_DEFAULT), H5Oclose, kOnError, doing};
  put_attribute(opened.get(), name, value, doing);
  opened.close();
  held_.attributes.insert_or_assign({object, name}, value);
}

void FileWriter::put_attribute(hid_t object, const std::string& name, const Attribute& value,
                               const std::string& doing) {
  const auto put = [&](hid_t type, const void* values, const std::size_t* count) {
    Handle space =
        count == nullptr ? Handle{H5Screate(H5S_SCALAR), H5Sclose, kOnError, doing} : space_of({*count, 0}, doing);
    Handle created{H5Acreate2(object, name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, kOnError,
                   doing};
    check(H5Awrite(created.get(), type, values), kOnError, doing);
    created.close();
    space.close();
  };
  if (const auto* text = std::get_if<std::string>(&value)) {
    // Of fixed length: texts of variable length lie in HDF5's global heap, which has no checksum.
    Handle type{H5Tcopy(H5T_C_S1), H5Tclose, kOnError, doing};
    check(H5Tset_size(type.get(), std::max<std::size_t>(text->size(), 1)), kOnError, doing);
    check(H5Tset_strpad(type.get(), H5T_STR_NULLPAD), kOnError, doing);
    const bool ascii = std::ranges::all_of(*text, [](char c) { return static_cast<unsigned char>(c) < 128; });
    check(H5Tset_cset(type.get(), ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8), kOnError, doing);
    put(type.get(), text->c_str(), nullptr);
    type.close();
  } else if (const auto* list = std::get_if<std::vector<std::int64_t>>(&value)) {
    const std::size_t count = list->size();
    put(type_of(Number::i64), list->data(), &count);
  } else if (const auto* whole = std::get_if<std::uint64_t>(&value)) {
    put(type_of(Number::u64), whole, nullptr);
  } else {
    put(type_of(Number::i64), &std::get<std::int64_t>(value), nullptr);
  }
}

Held FileWriter::close() {
  for (auto& [path, dataset] : datasets_) {
    if (dataset->written != dataset->extents.count()) throw std::logic_error(path + " is not filled");
    const std::uint64_t hash = XXH3_64bits_digest(dataset->hash.get());
    put_attribute(dataset->handle.get(), kHashAttribute, hash, "write the hash of " + path + " in " + file_name_);
    held_.datasets.emplace(path, Held::Dataset{dataset->number, dataset->extents, hash});
  }
  check(H5Fflush(file_.get(), H5F_SCOPE_GLOBAL), kOnError, "flush " + file_name_);
  for (auto& [path, dataset] : datasets_) dataset->handle.close();
  if (H5Fget_obj_count(file_.get(), H5F_OBJ_ALL | H5F_OBJ_LOCAL) != 1) {
    throw std::logic_error("something in " + file_name_ + " was not closed");
  }
  file_.close();
  return std::move(held_);
}

}  // namespace seapile::store::hdf5
