#include "runner/study/resolved.h"

#include <algorithm>
#include <cstdint>

#include "runner/study/field_reader.h"
#include "runner/study/schema.h"
#include "solver/scene/analysis.h"

namespace seapile::study {
namespace {

template <class T>
void resolve_member(const T& member, const std::string& path, ResolvedScene& resolved) {
  const auto resolve_fields = [&resolved](const auto& spec, const std::string& prefix) {
    resolved[prefix] = Present{};
    const auto visit = [&](const base::Field& field, const auto& inner) {
      resolve_member(inner, (prefix.empty() ? "" : prefix + ".") + std::string(field.key), resolved);
    };
    fields(visit, spec);
  };
  if constexpr (kIsOptional<T>) {
    if (member) {
      resolve_member(*member, path, resolved);
    } else {
      resolved[path] = nullptr;
    }
  } else if constexpr (kIsVariant<T>) {
    std::visit(
        [&](const auto& alternative) {
          const std::string name = std::remove_cvref_t<decltype(alternative)>::kName;
          resolve_fields(alternative, path + "." + name);
          resolved[path] = name;
        },
        member);
  } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string> ||
                       std::is_same_v<T, std::vector<double>>) {
    resolved[path] = member;
  } else if constexpr (std::is_arithmetic_v<T>) {
    resolved[path] = static_cast<double>(member);
  } else if constexpr (std::is_enum_v<T>) {
    resolved[path] = enum_names<T>()[static_cast<std::size_t>(member)];
  } else {
    resolve_fields(member, path);
  }
}

void erase_part(ResolvedScene& resolved, const std::string& path) {
  std::erase_if(resolved, [&](const auto& entry) {
    return entry.first == path || entry.first.compare(0, path.size() + 1, path + ".") == 0;
  });
}

}  // namespace

std::string_view water_of(const scene::SceneSpec& scene) {
  if (scene.jet) return "jet";
  return scene.basin ? "basin" : "";
}

bool heeds(const scene::SceneSpec& scene, std::string_view member_of_record) {
  const bool of_basin = std::ranges::find(kRecordOfABasin, member_of_record) != kRecordOfABasin.end();
  return of_basin == scene.basin.has_value();
}

bool uses(const grains::ContactSpec& contact, std::string_view member) {
  if (member == "precision") return contact.solver == grains::Solver::blocks;
  const bool soft = std::holds_alternative<grains::SoftMethod>(contact.method);
  return soft || std::ranges::find(kOfSoftMethod, member) == kOfSoftMethod.end();
}

ResolvedScene resolve_all(const scene::SceneSpec& scene) {
  ResolvedScene resolved;
  resolve_member(scene, "", resolved);
  return resolved;
}

ResolvedScene resolve_used(const scene::SceneSpec& scene) {
  ResolvedScene resolved = resolve_all(scene);
  const auto drop_without_choice = [&](const base::Field& field, const auto&) {
    if (!scene::has_choice(scene, field.key)) erase_part(resolved, "model." + std::string(field.key));
  };
  fields(drop_without_choice, scene.model);
  if (const std::string_view water = water_of(scene); !water.empty()) {
    for (const std::string& part : scene_schema().child_names()) {
      if (part != water && part != "model") erase_part(resolved, part);
    }
    return resolved;
  }
  const auto drop_unused = [&](const grains::ContactSpec& contact, const std::string& path) {
    const auto visit = [&](const base::Field& field, const auto&) {
      if (!uses(contact, field.key)) erase_part(resolved, path + "." + std::string(field.key));
    };
    fields(visit, contact);
  };
  drop_unused(scene.contact, "contact");
  drop_unused(scene.bed.preparation.contact, "bed.preparation.contact");
  if (!scene.pile) erase_part(resolved, "contact");
  if (!scene.bed.file.empty()) {
    for (const char* path : kDecidedByFile) erase_part(resolved, path);
  }
  return resolved;
}

std::vector<std::string> written_paths(const Value& value, const std::string& path) {
  if (value.kind != Value::Kind::object || value.items.empty()) return {path};
  std::vector<std::string> paths;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const auto below = written_paths(value.items[i], path + "." + value.keys[i]);
    paths.insert(paths.end(), below.begin(), below.end());
  }
  return paths;
}

}  // namespace seapile::study
