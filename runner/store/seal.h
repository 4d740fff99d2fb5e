#pragma once

#include <filesystem>
#include <functional>

#include "runner/store/hdf5_file.h"

namespace seapile::store {

/// Writes an HDF5 file so that it is either there, complete and verified, or not there at all. After an error the
/// caller's process is to end without another HDF5 call for writing; an earlier file of that name is untouched.
void seal(const std::filesystem::path& file, hdf5::Storage storage,
          const std::function<void(hdf5::FileWriter&)>& write);

}  // namespace seapile::store
