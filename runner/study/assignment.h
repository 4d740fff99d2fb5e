// Values at dotted paths, as axes, conditions and the command line name them.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runner/study/json_value.h"
#include "runner/study/resolved.h"
#include "runner/study/schema.h"
#include "solver/base/problem.h"
#include "solver/scene/spec.h"

namespace seapile::study {

/// A value to be put at a path of the scene.
struct Assignment {
  Path path;
  Value value;
};

/// Holds for a case in which every path has its value.
struct Match {
  PlacePtr place;
  std::vector<std::pair<std::string, Resolved>> conditions;
};

bool holds(const Match& match, const ResolvedScene& scene);

/// The schema's node at a dotted path; null after a problem at `place` that names the nearest path.
const SchemaNode* node_at(const std::string& dotted, const PlacePtr& place, const SchemaNode& schema,
                          base::Problems& problems);

/// Checks a value for a path of the scene by reading it as the only thing that a scene says; gives that scene.
scene::SceneSpec check_value(const Path& path, const Value& value, base::Problems& problems);

/// The members of an object of dotted paths of the scene. Unknown paths are reported, values not yet looked at.
std::vector<Assignment> read_assignments(const Value& object, base::Problems& problems);

/// Makes a match hold only where a path has a value.
void add_conditions(const Assignment& assignment, Match& match, base::Problems& problems);

/// An object of dotted paths and the values they must have.
Match read_match(const Value& object, base::Problems& problems);

/// "path=value" of the command line, with the value as strict JSON, or as the text of a string where it does not look
/// like JSON. Its path is "scene" or "record" and then the path therein. Absent after a problem.
std::optional<Assignment> read_setting(const std::string& text, base::Problems& problems);

}  // namespace seapile::study
