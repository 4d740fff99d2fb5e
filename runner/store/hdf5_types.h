#pragma once

#include <bit>
#include <cstddef>

#include "runner/store/hdf5_file.h"

namespace seapile::store::hdf5 {

static_assert(std::endian::native == std::endian::little, "hashes are over little-endian bytes");

/// The HDF5 type of a number, the same in memory and in files, and its size.
hid_t type_of(Number number);
std::size_t size_of(Number number);

inline constexpr const char* kHashAttribute = "xxh3";

}  // namespace seapile::store::hdf5
