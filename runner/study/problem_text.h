#pragma once

#include <string>

#include "solver/base/problem.h"

namespace seapile::study {

/// One line for the user: `file: /json/pointer: what; allowed: ...; did you mean "..."?`. Control characters and
/// ill-formed UTF-8 are shown as escapes and overlong parts are cut, so that no input can disturb a terminal.
std::string sentence(const std::string& file, const base::Problem& problem);

/// Well-formed UTF-8 without control characters.
bool is_printable(const std::string& text);

}  // namespace seapile::study
