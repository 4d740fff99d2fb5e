#include "runner/store/parameters.h"

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <type_traits>
#include <variant>

#include "solver/scene/spec.h"

namespace seapile::store {

namespace {

using Json = nlohmann::ordered_json;

void flatten(const std::string& path, const Json& json, std::vector<Parameter>& into) {
  if (json.is_object()) {
    const bool is_choice = json.size() == 1 && json.front().is_object();
    if (is_choice && !path.empty()) into.push_back({path, {}, json.begin().key()});
    for (const auto& [key, value] : json.items()) flatten(path.empty() ? key : path + "." + key, value, into);
  } else if (json.is_number()) {
    into.push_back({path, json.get<double>(), {}});
  } else if (json.is_null()) {
    into.push_back({path, {}, {}});
  } else {
    into.push_back({path, {}, json.is_string() ? json.get<std::string>() : json.dump()});
  }
}

/// Walks the field lists of the specs, into every choice and every part that may be absent.
struct UnitCollector {
  std::map<std::string, std::string>& units;
  std::string prefix;

  template <class Member>
  void operator()(const base::Field& field, const Member& member) const {
    const std::string path = prefix.empty() ? std::string(field.key) : prefix + "." + std::string(field.key);
    collect(path, std::string(field.unit), member);
  }

  template <class Member>
  void collect(const std::string& path, const std::string& unit, const Member&) const {
    const UnitCollector below{units, path};
    if constexpr (requires(Member & spec) { fields(below, spec); }) {
      const Member spec{};
      fields(below, spec);
    } else if (!unit.empty()) {
      units.emplace(path, unit);
    }
  }

  template <class Member>
  void collect(const std::string& path, const std::string& unit, const std::optional<Member>&) const {
    collect(path, unit, Member{});
  }

  template <class... Choices>
  void collect(const std::string& path, const std::string& unit, const std::variant<Choices...>&) const {
    (collect(path + "." + Choices::kName, unit, Choices{}), ...);
  }
};

}  // namespace

std::vector<Parameter> parameters(const std::string& scene_json, const std::string& kind) {
  const Json scene = Json::parse(scene_json, nullptr, false);
  if (!scene.is_object()) throw std::invalid_argument("a scene is no JSON object");
  std::vector<Parameter> all;
  flatten("", scene, all);
  if (kind == "bed") std::erase_if(all, [](const Parameter& p) { return !p.path.starts_with("bed."); });
  return all;
}

const std::map<std::string, std::string>& parameter_units() {
  static const std::map<std::string, std::string> all = [] {
    std::map<std::string, std::string> units;
    const scene::SceneSpec scene;
    const UnitCollector top{units, ""};
    fields(top, scene);
    return units;
  }();
  return all;
}

}  // namespace seapile::store
