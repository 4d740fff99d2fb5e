#pragma once

#include <string>
#include <vector>

#include "runner/store/hdf5_file.h"
#include "solver/simulation/record.h"

namespace seapile::store {

/// One f64 dataset per column of a record below `group`, with its units and meaning.
void write_series(hdf5::FileWriter& writer, const std::string& group, const std::vector<simulation::Record>& records);

/// A column that the file does not have yet, because it was added to the records later, reads as NaN.
std::vector<simulation::Record> read_series(const hdf5::FileReader& reader, const std::string& group);

}  // namespace seapile::store
