// What a user types into a shell, with the program in the PATH.
#pragma once

#include <string>

#include "tests/runner/commands/program.h"

namespace seapile::commands {

/// Runs lines of bash in the folder until they end; standard input is empty.
Finished shell(const Workplace& place, const std::string& lines);

/// The same on a terminal of its own, as `out` what it shows: both streams together. Lines end with "\r\n" there.
Finished on_terminal(const Workplace& place, const std::string& lines);

}  // namespace seapile::commands
