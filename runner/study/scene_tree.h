// A scene as JSON while it is put together: the base, and over it what axes, conditions and command line say. Every
// value keeps its own place, so that a problem of the finished scene points at the text that caused it.
#pragma once

#include <string>

#include "runner/study/json_value.h"
#include "runner/study/schema.h"

namespace seapile::study {

/// Puts a value at a path of the tree; parts on the way that are not written yet are made. Returns "" or, when the
/// scene has no such place, why: "pile.tip is flat". A way through something of a wrong type is made anew.
std::string assign(Value& tree, const SchemaNode& schema, const Path& path, const Value& value);

/// Whether the tree says something at the path itself.
bool is_written(const Value& tree, const Path& path);

/// The place of a problem that was found in the finished scene: where the value at a path was written, or would have
/// been. Elements of arrays are named by their index.
std::string written_at(const Value& tree, const Path& path);

/// A value with its unit, on one line: "0.06 m/s", "conical(apex_angle=60 deg)", "null".
std::string value_text(const Value& value, const SchemaNode& node);

/// The value as `--set` takes it: a text as it is, everything else as JSON.
std::string setting_text(const Value& value);

}  // namespace seapile::study
