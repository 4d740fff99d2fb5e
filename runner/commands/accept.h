#pragma once

#include <string>

#include "runner/commands/checked.h"

namespace seapile::commands {

/// Writes our own values of the checked metrics of one case ("all": of every checked case) into the study's file of
/// accepted values, all of them or none, and says so. Returns the exit code. `id`: of a case of the study, or how it
/// begins. Throws UsageError and store::StoreError.
int accept_values(const study::Study& study, const CheckedCases& cases, const std::string& id, const std::string& note);

}  // namespace seapile::commands
