// The series of many runs as one tidy table: a row per record, what tells the cases apart repeated on every row.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "runner/present/statistics.h"
#include "runner/present/table.h"

namespace seapile::present {

/// A run to be written, and how to read its series when its turn comes.
struct CurveSource {
  std::string case_id, run;
  Labels labels;
  std::filesystem::path run_folder;
  std::filesystem::path bed_folder = {};  ///< the run of a drive's bed
};

/// Runs that differ by their packing alone, under what else sets their case apart.
struct PackedCase {
  Labels labels;
  std::vector<CurveSource> packings;
};

/// In the order of first occurrence.
std::vector<PackedCase> packed(const std::vector<CurveSource>& sources);

/// Which series of a run: that of the grains, that of the water, or of drives into a saturated bed both, row by row.
enum class Series { grains, water, both };

/// The names of a series' columns, in their order. Of both, those of the grains come first, and a column of the fluid
/// whose name the grains have too is named "fluid:kinetic_energy".
std::vector<std::string> column_names(Series series);

/// Those of them that some record of some run has, and all of the grains'. Throws store::StoreError.
std::vector<std::string> held_columns(const std::vector<CurveSource>& sources, Series series);

/// The unit of a column. Throws std::logic_error when there is none of that name.
std::string unit_of(Series series, const std::string& column);

/// The values of some columns in all records of a run, column by column; those of the fluid are NaN in a dry run.
/// Throws store::StoreError.
std::vector<std::vector<double>> read_columns(const CurveSource& source, Series series,
                                              const std::vector<std::string>& columns);

/// A cell of CSV, with every digit of a number.
std::string cell_text(const store::Cell& cell);

/// Writes CSV: "case", "run", the labels, then the columns of the records in the order in which they are named, units
/// in the header. One run is in memory at a time. Throws store::StoreError when a series cannot be read or the file not
/// be written.
void write_curves(const std::vector<CurveSource>& sources, Series series, const std::vector<std::string>& columns,
                  std::FILE* out);

/// Writes CSV: a row per case, the seed apart, and bin of depth (kBinWidth) that all its packings have. Columns: the
/// labels, "depth[m]" (the middle of the bin), "n", "mean[Pa]", "low[Pa]", "high[Pa]": tip resistance and the interval
/// of its mean, empty for one packing. `sources`: completed drives. Throws as write_curves() does.
void write_bands(const std::vector<CurveSource>& sources, std::FILE* out, double level = kLevel);

}  // namespace seapile::present
