#pragma once

#include <string>
#include <vector>

#include "runner/store/hdf5_file.h"
#include "solver/simulation/flow_record.h"
#include "solver/simulation/record.h"

namespace seapile::store {

/// The group of a file that holds a series, by the type of its records.
template <class R>
inline constexpr const char* kSeriesGroup = "/series";
template <>
inline constexpr const char* kSeriesGroup<simulation::FlowRecord> = "/flow_series";

/// One f64 dataset per column of a record, with its units and meaning. A type of records that knows absence (kAbsent)
/// leaves out the columns that are absent from all of them.
template <class R>
void write_series(hdf5::FileWriter& writer, const std::vector<R>& records);

template <class R>
bool has_series(const hdf5::FileReader& reader) {
  return reader.has(std::string(kSeriesGroup<R>) + "/time");
}

/// A column that the file does not have, because it was left out or added to the records later, reads as NaN.
template <class R>
std::vector<R> read_series(const hdf5::FileReader& reader);

}  // namespace seapile::store
