#include "runner/study/schema.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>

#include "runner/study/field_reader.h"
#include "runner/study/unit.h"
#include "solver/scene/spec.h"

namespace seapile::study {
namespace {

using Kind = SchemaNode::Kind;

template <class Spec>
std::vector<SchemaNode> members();

/// What a member is by default, as JSON text.
template <class T>
std::string fallback_of(const T& member) {
  if constexpr (kIsOptional<T>) {
    return member ? fallback_of(*member) : "null";
  } else if constexpr (kIsVariant<T>) {
    return fmt::format("\"{}\"", alternative_names(member)[member.index()]);
  } else if constexpr (std::is_same_v<T, bool>) {
    return member ? "true" : "false";
  } else if constexpr (std::is_arithmetic_v<T>) {
    return number_text(static_cast<double>(member));
  } else if constexpr (std::is_same_v<T, std::string>) {
    return fmt::format("\"{}\"", member);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    std::vector<std::string> numbers;
    for (const double number : member) numbers.push_back(number_text(number));
    return fmt::format("[{}]", fmt::join(numbers, ", "));
  } else if constexpr (std::is_enum_v<T>) {
    return fmt::format("\"{}\"", enum_names<T>()[static_cast<std::size_t>(member)]);
  } else {
    return "";
  }
}

template <class T>
SchemaNode node_of(const base::Field& field) {
  SchemaNode node;
  node.field = field;
  if constexpr (kIsOptional<T>) {
    node = node_of<typename T::value_type>(field);
    node.nullable = true;
  } else if constexpr (kIsVariant<T>) {
    node.kind = Kind::variant;
    const auto add = [&]<class... Ts>(const std::variant<Ts...>*) {
      (node.children.push_back({base::part(Ts::kName, ""), Kind::spec, false, {}, members<Ts>()}), ...);
    };
    add(static_cast<const T*>(nullptr));
  } else if constexpr (std::is_same_v<T, double>) {
    node.kind = Kind::number;
  } else if constexpr (std::is_same_v<T, std::int64_t> || std::is_same_v<T, std::uint64_t>) {
    node.kind = Kind::integer;
  } else if constexpr (std::is_same_v<T, bool>) {
    node.kind = Kind::boolean;
  } else if constexpr (std::is_same_v<T, std::string>) {
    node.kind = Kind::string;
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    node.kind = Kind::numbers;
  } else if constexpr (std::is_enum_v<T>) {
    node.kind = Kind::choice;
    node.names = enum_names<T>();
  } else {
    node.kind = Kind::spec;
    node.children = members<T>();
  }
  return node;
}

template <class Spec>
std::vector<SchemaNode> members() {
  std::vector<SchemaNode> nodes;
  const auto visit = [&](const base::Field& field, auto& member) {
    nodes.push_back(node_of<std::remove_cvref_t<decltype(member)>>(field));
    nodes.back().fallback = fallback_of(member);
  };
  Spec spec;
  fields(visit, spec);
  return nodes;
}

void collect_paths(const SchemaNode& node, const std::string& prefix, std::vector<std::string>& paths) {
  for (const SchemaNode& child : node.children) {
    paths.push_back(prefix + std::string(child.field.key));
    collect_paths(child, paths.back() + ".", paths);
  }
}

Path split(std::string_view text, char separator) {
  Path path;
  for (std::size_t start = 0;;) {
    const std::size_t end = text.find(separator, start);
    path.emplace_back(text.substr(start, end == std::string_view::npos ? end : end - start));
    if (end == std::string_view::npos) return path;
    start = end + 1;
  }
}

}  // namespace

const SchemaNode* SchemaNode::child(std::string_view key) const {
  const auto found = std::find_if(children.begin(), children.end(), [&](const auto& c) { return c.field.key == key; });
  return found == children.end() ? nullptr : &*found;
}

std::vector<std::string> SchemaNode::child_names() const {
  std::vector<std::string> result;
  for (const SchemaNode& node : children) result.emplace_back(node.field.key);
  return result;
}

const SchemaNode& scene_schema() {
  static const SchemaNode root{base::part("", ""), Kind::spec, false, {}, members<scene::SceneSpec>()};
  return root;
}

const SchemaNode& record_schema() {
  static const SchemaNode root{base::part("", ""), Kind::spec, false, {}, members<scene::RecordSpec>()};
  return root;
}

Path split_path(std::string_view dotted) { return split(dotted, '.'); }

Path split_pointer(std::string_view pointer) { return split(pointer.substr(1), '/'); }

std::string join_path(const Path& path) {
  std::string dotted;
  for (const std::string& token : path) dotted += (dotted.empty() ? "" : ".") + token;
  return dotted;
}

const SchemaNode* find_node(const SchemaNode& root, const Path& path, std::size_t& known) {
  const SchemaNode* node = &root;
  for (known = 0; known < path.size(); ++known) {
    const SchemaNode* next = node->child(path[known]);
    if (!next) return nullptr;
    node = next;
  }
  return node;
}

std::vector<std::string> all_paths(const SchemaNode& root) {
  std::vector<std::string> paths;
  collect_paths(root, "", paths);
  return paths;
}

}  // namespace seapile::study
