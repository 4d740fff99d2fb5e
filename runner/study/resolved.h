// The values of a complete scene by their dotted paths, for conditions and for telling what a scene uses.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "runner/study/json_value.h"
#include "solver/scene/spec.h"

namespace seapile::study {

/// That a part is there, whatever is in it.
struct Present {
  friend bool operator==(Present, Present) = default;
};
/// Null, a part, a number, true or false, or a name or text.
using Resolved = std::variant<std::nullptr_t, Present, double, bool, std::string, std::vector<double>>;
using ResolvedScene = std::map<std::string, Resolved>;

/// What a grain file decides: the study must leave it alone.
inline constexpr std::array kDecidedByFile = {"bed.grains.count", "bed.grains.radius", "bed.seed"};

/// What only soft impulses have: for the non-smooth method these members of a contact solver do not exist.
inline constexpr std::array kOfSoftMethod = {"substeps", "stiffness", "damping"};

/// What a record of a basin consists of; a drive's has all the rest.
inline constexpr std::array kRecordOfABasin = {"interval", "times"};

/// The one part that a scene of water alone consists of, "jet" or "basin"; "" where there are grains.
std::string_view water_of(const scene::SceneSpec& scene);

/// Whether a contact solver uses one of its own members.
bool uses(const grains::ContactSpec& contact, std::string_view member);

/// Whether the runs of a scene heed this member of a record.
bool heeds(const scene::SceneSpec& scene, std::string_view member_of_record);

/// Every value of the scene. A variant's path holds the name of its alternative.
ResolvedScene resolve_all(const scene::SceneSpec& scene);

/// Every value that the scene uses: water alone nothing but itself, without a pile no `contact`, with a grain file
/// nothing that the file decides, of a contact solver what its method has, and of `model` what there is a choice about.
ResolvedScene resolve_used(const scene::SceneSpec& scene);

/// The paths that are written in `value`, which stands at `path`: its leaves and empty objects.
std::vector<std::string> written_paths(const Value& value, const std::string& path);

}  // namespace seapile::study
