#include "runner/store/seal.h"

#include "runner/store/durable.h"

namespace seapile::store {

namespace {

/// Reads everything back and says what differs from what was held; empty: nothing.
std::string difference(const std::filesystem::path& file, const hdf5::Held& held) {
  hdf5::FileReader reader(file);
  std::string found;
  if (reader.datasets("/").size() != held.datasets.size()) found = "number of datasets";
  for (const auto& [path, dataset] : held.datasets) {
    const hdf5::Held::Dataset on_disk = reader.found(path);
    if (on_disk.number != dataset.number || on_disk.extents != dataset.extents) found = "shape of " + path;
    if (on_disk.xxh3 != dataset.xxh3) found = "values of " + path;
  }
  for (const auto& [place, value] : held.attributes) {
    if (reader.any_attribute(place.first, place.second) != value) found = place.second + " of " + place.first;
  }
  reader.close();
  return found;
}

/// Return codes alone do not do: a full disk has given files whose last rows read as zeros, every code a success.
void compare(const std::filesystem::path& file, const hdf5::Held& held) {
  std::string found;
  try {
    found = difference(file, held);
  } catch (const StoreError& error) {
    found = error.what();
  }
  if (!found.empty()) {
    throw StoreError(StoreError::Kind::verify, file.string() + " does not read back as written: " + found);
  }
}

}  // namespace

void seal(const std::filesystem::path& file, hdf5::Storage storage,
          const std::function<void(hdf5::FileWriter&)>& write) {
  const std::filesystem::path temporary = temporary_name(file);
  try {
    hdf5::FileWriter writer(temporary, storage);
    write(writer);
    const hdf5::Held held = writer.close();
    sync_file(temporary);
    compare(temporary, held);
    publish(temporary, file);
  } catch (...) {
    discard(temporary);
    throw;
  }
}

}  // namespace seapile::store
