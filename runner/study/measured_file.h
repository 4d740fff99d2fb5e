// A recorded frontier: the table that `runner trade STUDY --format csv` wrote, beside the study in measured/.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seapile::study {

/// One row: what it is called, and its numbers by their columns' names without units; empty fields are left out.
struct MeasuredRow {
  std::string variant;
  std::map<std::string, double> number;
};

/// Where the record of a study lies: measured/NAME.csv beside it.
std::filesystem::path measured_path(const std::filesystem::path& study_file, const std::string& name);

/// Throws BadInput with all problems at once.
std::vector<MeasuredRow> read_measured(const std::filesystem::path& file);

}  // namespace seapile::study
