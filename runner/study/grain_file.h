// Grains of a bed that are read instead of drawn: CSV with the header "id,x,y,radius", lengths in m.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/problem.h"
#include "solver/scene/spec.h"

namespace seapile::study {

struct GrainRow {
  std::int64_t id = 0;
  double x = 0, y = 0, radius = 0;  ///< [m]
};

/// Reads the rows and sorts them by id. Each problem's `what` begins with its line; the pointer is left to the caller.
/// The grains must lie in the box, touching the walls at most as much as a settled bed does.
std::vector<GrainRow> parse_grains(std::string_view csv, const scene::DomainSpec& box, base::Problems& problems);

/// SHA-256 of the rows in the order of their ids: the same for any order and spelling of the file.
std::string grains_content(const std::vector<GrainRow>& rows);

/// What a scene takes from its grain file.
struct GrainFile {
  std::filesystem::path path;
  std::string content;
  std::int64_t count = 0;
  double smallest = 0, largest = 0;  ///< radius [m]
  double top = 0;                    ///< of the highest grain above the base [m]
};

/// Reads the file that a study calls `name`, from the study's folder or below it. Each problem's `what` begins with the
/// name; the pointer is left to the caller.
GrainFile find_grains(const std::filesystem::path& folder, const std::string& name, const scene::DomainSpec& box,
                      base::Problems& problems);

}  // namespace seapile::study
