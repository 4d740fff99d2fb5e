#include "solver/simulation/run.h"

#include <optional>

#include "solver/simulation/build.h"
#include "solver/simulation/drive.h"
#include "solver/simulation/tip_measures.h"

namespace seapile::simulation {

std::vector<NumericsVersion> numerics_versions(const scene::SceneSpec& scene) {
  if (scene.jet) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}};
  if (scene.basin) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}};
  std::vector<NumericsVersion> versions = {{"grains", 3}, {"pile", 1}, {"bed", 1}, {"record", 2}};
  if (scene.fluid)
    versions.insert(versions.end(), {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}, {"coupling", 4}});
  return versions;
}

std::vector<Part> parts(const scene::SceneSpec& scene) {
  if (is_water(scene)) {
    const std::string water = scene.jet ? "the scene is a jet of fluid" : "the scene is a basin of water";
    const bool pile = !scene.jet && scene.basin->pile, free = scene.jet || scene.basin->surface;
    return {{"grains", false, water},
            {"walls", false, water},
            {"pile", pile,
             scene.jet ? water
             : pile    ? "the basin has a pile"
                       : "the basin has none: \"pile\" is null"},
            {"restitution", false, water},
            {"mesh", true, "the fluid lives on it"},
            {"fluid", true, water},
            {"free_surface", free,
             scene.jet ? "the jet finds its own shape"
             : free    ? "the water's top moves"
                       : "the top is fixed: \"surface\" is null"},
            {"coupling", false, water}};
  }
  const bool wet = scene.fluid.has_value(), free = wet && scene.fluid->surface;
  const std::string dry = "the scene is dry: \"fluid\" is null";
  return {{"grains", true, "the bed has " + std::to_string(scene.bed.grains.count) + " grains"},
          {"walls", true, "the box holds the grains"},
          {"pile", scene.pile.has_value(), scene.pile ? "the scene drives a pile" : "the scene is the bed alone"},
          {"restitution", scene.bed.grains.restitution > 0,
           scene.bed.grains.restitution > 0 ? "the grains rebound" : "the coefficient of restitution is 0"},
          {"mesh", wet, wet ? "the fluid lives on it" : dry},
          {"fluid", wet, wet ? "the scene is saturated" : dry},
          {"free_surface", free,
           !wet   ? dry
           : free ? "the fluid's top moves"
                  : "the top is fixed: \"surface\" is null"},
          {"coupling", wet, wet ? "grains and fluid act on each other" : dry}};
}

RunResult run(const scene::SceneSpec& scene, const scene::RecordSpec& record, const Bed& bed,
              const Execution& execution, const std::vector<Array>& resume_from,
              const RecordsSoFar& so_far, const RunHooks& hooks) {
  if (!scene.pile) throw std::invalid_argument("run: the scene has no pile");
  std::vector<Array> state = resume_from;
  Measuring measuring = take_out(state);
  std::optional<Simulation> sim;
  try {
    sim = build(scene, bed, execution, state);
  } catch (const std::runtime_error& error) {  // it does not settle under water, or has no mesh
    RunResult result;
    result.outcome = Outcome::diverged;
    result.reason = error.what();
    return result;
  }
  for (const PlacesBefore& before : measuring.open)
    if (before.grain.size() != sim->grains.count())
      throw std::invalid_argument("state: measures/place: of other grains");
  return drive(*sim, scene, record, execution.trying, std::move(measuring), so_far, hooks);
}

}  // namespace seapile::simulation
