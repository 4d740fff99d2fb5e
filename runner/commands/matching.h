// What the user wrote of runs that are to be found.
#pragma once

#include <string>
#include <vector>

#include "runner/store/catalogue.h"

namespace seapile::commands {

/// All of several match expressions, their values in SI units: "speed > 0.2 m/s" compares with 0.2. Throws UsageError.
store::Expression matching(const store::Catalogue& catalogue, const std::string& study,
                           const std::vector<std::string>& texts);

/// Whether a word of the command line is the file of a study.
bool is_study_file(const std::string& word);

}  // namespace seapile::commands
