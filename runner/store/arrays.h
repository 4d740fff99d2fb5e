// The solver's arrays as datasets: units, meaning, entity and order go along as attributes.
#pragma once

#include <string>
#include <vector>

#include "runner/store/hdf5_file.h"
#include "solver/simulation/array.h"

namespace seapile::store {

/// One dataset per array, named `group`/<name of the array>.
void write_arrays(hdf5::FileWriter& writer, const std::string& group, const std::vector<simulation::Array>& arrays);

/// The arrays of a group, in the order in which they were written, bit for bit.
std::vector<simulation::Array> read_arrays(const hdf5::FileReader& reader, const std::string& group);

/// Writes what is said of an array to its dataset; `order` is its place in its list.
void describe_dataset(hdf5::FileWriter& writer, const std::string& path, const simulation::ArrayInfo& info,
                      std::size_t order);

/// Reads it back; `path` below `group` is the array's name.
simulation::ArrayInfo read_info(const hdf5::FileReader& reader, const std::string& group, const std::string& path);

/// A dataset's values as an array holds them.
simulation::ArrayValues read_values(const hdf5::FileReader& reader, const std::string& path);

hdf5::Number number_of(const simulation::Array& array);
std::size_t value_count(const simulation::Array& array);
/// Throws std::logic_error when the values are not whole rows.
std::size_t row_count(const simulation::Array& array);

}  // namespace seapile::store
