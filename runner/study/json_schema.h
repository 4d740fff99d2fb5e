// The study file as a JSON Schema, made from the field lists, so that an editor completes and checks what is typed.
#pragma once

#include <string>

namespace seapile::study {

/// The schema (draft 7) of a study file as JSON text. It accepts whatever the program accepts; what it cannot say
/// (relations between values, files, dimensions of units, keys that are there twice) the program still refuses.
std::string study_json_schema();

}  // namespace seapile::study
