// A scene as a list of named values: what a catalogue can be asked for.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace seapile::store {

/// One parameter: a number, a text, or neither when that part of the scene is absent.
struct Parameter {
  std::string path;  ///< dotted: "pile.driving.constant.speed"
  std::optional<double> number;
  std::optional<std::string> text;
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// Flattens a scene's JSON. An object whose only member is an object is a choice, and its name stands under the path of
/// the choice ("pile.tip" = "flat"). Of a bed's run only what stands below "bed" is a parameter. Throws
/// std::invalid_argument when the text is no JSON object.
std::vector<Parameter> parameters(const std::string& scene_json, const std::string& kind);

/// The unit of every numeric parameter that a scene of this version can have; "-" for numbers without.
const std::map<std::string, std::string>& parameter_units();

}  // namespace seapile::store
