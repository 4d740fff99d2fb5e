#include "runner/study/scene_tree.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "runner/study/unit.h"

namespace seapile::study {
namespace {

using Kind = Value::Kind;

/// Makes `value`, which stands at a schema node, an object that can take the member `key`; or says why it cannot.
std::string open_for(Value& value, const SchemaNode& node, const std::string& key) {
  if (value.kind == Kind::null) return "null";
  if (node.kind == SchemaNode::Kind::variant) {
    if (value.kind == Kind::string) {
      if (value.text != key) return value.text;
      const PlacePtr place = value.place;
      value = object_value(place);
      value.put(key, object_value(place));
    } else if (value.kind == Kind::object && !value.keys.empty() && value.keys.front() != key) {
      return value.keys.front();
    }
  }
  if (value.kind != Kind::object) value = object_value(value.place);
  return "";
}

}  // namespace

std::string assign(Value& tree, const SchemaNode& schema, const Path& path, const Value& value) {
  Value* at = &tree;
  const SchemaNode* node = &schema;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string& key = path[i];
    if (const std::string is = open_for(*at, *node, key); !is.empty()) {
      return fmt::format("{} is {}", join_path(Path(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(i))), is);
    }
    if (i + 1 == path.size()) {
      at->put(key, value);
    } else {
      Value* next = at->find(key);
      at = next ? next : &at->put(key, object_value(place_in(at->place, key)));
      node = node->child(key);
    }
  }
  return "";
}

namespace {

/// The value at the longest part of a path that is written, and the length of that part.
std::pair<const Value*, std::size_t> deepest_written(const Value& tree, const Path& path) {
  const Value* at = &tree;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Value* next = nullptr;
    if (at->kind == Kind::object) next = at->find(path[i]);
    if (at->kind == Kind::array) {
      const auto index = static_cast<std::size_t>(std::stoul(path[i]));
      if (index < at->items.size()) next = &at->items[index];
    }
    if (!next) return {at, i};
    at = next;
  }
  return {at, path.size()};
}

}  // namespace

bool is_written(const Value& tree, const Path& path) { return deepest_written(tree, path).second == path.size(); }

std::string written_at(const Value& tree, const Path& path) {
  const auto [value, length] = deepest_written(tree, path);
  std::string text = pointer(value->place);
  // A name ("conical") has no members to point at; an object has them, written or not.
  if (value->kind == Kind::object) {
    for (std::size_t i = length; i < path.size(); ++i) text += "/" + path[i];
  }
  return text;
}

namespace {

/// Adds a part's members as they are written, those of parts within it by their paths: "time.step=0.5 ms".
void add_members(std::string& text, const std::string& before, const Value& part, const SchemaNode& node) {
  for (std::size_t i = 0; i < part.items.size(); ++i) {
    const SchemaNode* child = node.child(part.keys[i]);
    if (!child) continue;
    const Value& member = part.items[i];
    if (member.kind == Kind::object && !member.items.empty() && child->kind != SchemaNode::Kind::variant)
      add_members(text, before + part.keys[i] + ".", member, *child);
    else
      text += fmt::format("{}{}{}={}", text.empty() ? "" : ", ", before, part.keys[i], value_text(member, *child));
  }
}

nlohmann::ordered_json as_json(const Value& value) {
  nlohmann::ordered_json json;
  switch (value.kind) {
    case Kind::boolean:
      json = value.truth;
      break;
    case Kind::number:
      json = value.number;
      if (value.number == std::floor(value.number) && std::abs(value.number) < 1e15)
        json = static_cast<std::int64_t>(value.number);
      break;
    case Kind::string:
      json = value.text;
      break;
    case Kind::array:
      json = nlohmann::ordered_json::array();
      for (const Value& item : value.items) json.push_back(as_json(item));
      break;
    case Kind::object:
      json = nlohmann::ordered_json::object();
      for (std::size_t i = 0; i < value.items.size(); ++i) json[value.keys[i]] = as_json(value.items[i]);
      break;
    case Kind::null:
    case Kind::unusable:
      break;
  }
  return json;
}

}  // namespace

std::string value_text(const Value& value, const SchemaNode& node) {
  switch (value.kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return value.truth ? "true" : "false";
    case Kind::number: {
      const std::string_view unit = node.field.unit;
      return number_text(value.number) + (unit.empty() || unit == "-" ? "" : fmt::format(" {}", unit));
    }
    case Kind::string:
      return value.text;
    case Kind::object: {
      if (node.kind == SchemaNode::Kind::variant && !value.items.empty()) {
        const SchemaNode* child = node.child(value.keys[0]);
        const std::string text = child ? value_text(value.items[0], *child) : "default";
        return value.keys[0] + (text == "default" ? "" : "(" + text + ")");
      }
      std::string members;
      add_members(members, "", value, node);
      return members.empty() ? "default" : members;
    }
    case Kind::array:
    case Kind::unusable:
      break;
  }
  return "";
}

std::string setting_text(const Value& value) { return value.kind == Kind::string ? value.text : as_json(value).dump(); }

}  // namespace seapile::study
