// The tree of everything that a scene or a record may say, made from the field lists. Dotted paths walk it:
// "pile.tip.conical.apex_angle" passes the alternative's name, as the JSON does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solver/base/fields.h"

namespace seapile::study {

struct SchemaNode {
  enum class Kind { number, integer, boolean, string, choice, numbers, spec, variant };

  base::Field field;  ///< of an alternative: only its key
  Kind kind = Kind::spec;
  bool nullable = false;
  std::vector<std::string> names;    ///< of a choice
  std::vector<SchemaNode> children;  ///< members of a spec, alternatives of a variant
  std::string fallback = {};         ///< what a value is by default, as JSON text; "" of what has members

  const SchemaNode* child(std::string_view key) const;
  std::vector<std::string> child_names() const;
};

const SchemaNode& scene_schema();
const SchemaNode& record_schema();

using Path = std::vector<std::string>;

Path split_path(std::string_view dotted);
/// The path of a JSON pointer that needs no escapes, as those into a scene do: "/pile/depth".
Path split_pointer(std::string_view pointer);
std::string join_path(const Path& path);

/// The node at a path; null when there is none, with the length of the path's longest part that exists in `known`.
const SchemaNode* find_node(const SchemaNode& root, const Path& path, std::size_t& known);

/// Every dotted path below a node, in the order of the field lists.
std::vector<std::string> all_paths(const SchemaNode& root);

}  // namespace seapile::study
