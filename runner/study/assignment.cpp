#include "runner/study/assignment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "runner/study/field_reader.h"
#include "runner/study/nearest.h"
#include "runner/study/scene_tree.h"

namespace seapile::study {
namespace {

using base::Problems;

/// JSON text of a string that may hold anything.
std::string quoted_json(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

/// The path that was probably meant: one that contains all parts of the written one in their order, else the nearest.
std::string nearest_path(const std::string& dotted, const SchemaNode& schema) {
  const std::vector<std::string> paths = all_paths(schema);
  const Path wanted = split_path(dotted);
  for (const std::string& candidate : paths) {
    std::size_t found = 0;
    for (const std::string& token : split_path(candidate)) found += found < wanted.size() && token == wanted[found];
    if (found == wanted.size()) return candidate;
  }
  return nearest(dotted, paths);
}

}  // namespace

bool holds(const Match& match, const ResolvedScene& scene) {
  return std::all_of(match.conditions.begin(), match.conditions.end(), [&](const auto& condition) {
    const auto found = scene.find(condition.first);
    return found != scene.end() && found->second == condition.second;
  });
}

const SchemaNode* node_at(const std::string& dotted, const PlacePtr& place, const SchemaNode& schema,
                          Problems& problems) {
  const Path path = split_path(dotted);
  std::size_t known = 0;
  if (const SchemaNode* node = find_node(schema, path, known)) return node;

  const Path parent(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(known));
  std::size_t ignored = 0;
  const auto names = find_node(schema, parent, ignored)->child_names();
  const bool record = &schema == &record_schema();
  const std::string where = !parent.empty() ? join_path(parent) : record ? "a record" : "a scene";
  const std::string near = nearest_path(dotted, schema);
  problems.push_back({pointer(place), fmt::format("is no path: {} has no \"{}\"", where, path[known].substr(0, 60)),
                      names.empty() ? "nothing below " + where : fmt::format("{}", fmt::join(names, ", ")),
                      (record && !near.empty() ? "record." : "") + near});
  return nullptr;
}

scene::SceneSpec check_value(const Path& path, const Value& value, Problems& problems) {
  Value tree = object_value(value.place);
  assign(tree, scene_schema(), path, value);
  scene::SceneSpec scene;
  read_spec(tree, scene, problems);
  return scene;
}

std::vector<Assignment> read_assignments(const Value& object, Problems& problems) {
  std::vector<Assignment> assignments;
  if (object.kind == Value::Kind::unusable || !is_object(object, problems)) return assignments;
  for (std::size_t i = 0; i < object.items.size(); ++i) {
    const Value& value = object.items[i];
    if (value.kind == Value::Kind::unusable || !node_at(object.keys[i], value.place, scene_schema(), problems))
      continue;
    assignments.push_back({split_path(object.keys[i]), value});
  }
  return assignments;
}

void add_conditions(const Assignment& assignment, Match& match, Problems& problems) {
  const ResolvedScene resolved = resolve_all(check_value(assignment.path, assignment.value, problems));
  for (const std::string& path : written_paths(assignment.value, join_path(assignment.path))) {
    if (const auto found = resolved.find(path); found != resolved.end()) match.conditions.emplace_back(*found);
  }
}

Match read_match(const Value& object, Problems& problems) {
  Match match{object.place, {}};
  if (object.kind == Value::Kind::object && object.items.empty()) {
    problems.push_back({pointer(object.place), "is empty: it would match every case", "at least one path", ""});
  }
  for (const Assignment& assignment : read_assignments(object, problems)) add_conditions(assignment, match, problems);
  return match;
}

std::optional<Assignment> read_setting(const std::string& text, Problems& problems) {
  const std::size_t equals = text.find('=');
  const std::string dotted = text.substr(0, equals);
  const PlacePtr place = root_place("--set " + dotted);
  if (equals == std::string::npos || dotted.empty()) {
    problems.push_back({pointer(place), "has no \"path=value\"", "as in --set pile.depth=0.3", ""});
    return {};
  }

  const std::string written = text.substr(equals + 1);
  Problems as_json;
  Value value = read_json(written, place->token, as_json);
  if (!as_json.empty()) {
    // What looks like JSON is wrong JSON; the rest is text, which passes the same reader in quotes.
    const bool number = !written.empty() && written.find_first_not_of("0123456789+-.eE") == std::string::npos;
    const bool opened = !written.empty() && std::string_view("{[\"").find(written.front()) != std::string_view::npos;
    if (!number && !opened) {
      as_json.clear();
      value = read_json(quoted_json(written), place->token, as_json);
    }
    problems.insert(problems.end(), as_json.begin(), as_json.end());
    if (!as_json.empty()) return {};
  }

  const bool record = dotted.compare(0, 7, "record.") == 0;
  const std::string below = record ? dotted.substr(7) : dotted;
  if (!node_at(below, place, record ? record_schema() : scene_schema(), problems)) return {};
  Path path = split_path(below);
  path.insert(path.begin(), record ? "record" : "scene");
  return Assignment{std::move(path), std::move(value)};
}

}  // namespace seapile::study
