#include "solver/simulation/run.h"

#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <utility>

#include "solver/simulation/build.h"
#include "solver/simulation/drive.h"
#include "solver/simulation/tip_measures.h"

namespace seapile::simulation {

std::vector<NumericsVersion> numerics_versions(const scene::SceneSpec& scene) {
  if (scene.jet) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}};
  if (scene.basin) return {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}};
  std::vector<NumericsVersion> versions = {{"grains", 3}, {"pile", 1}, {"bed", 1}, {"record", 2}};
  if (has_other_contacts(scene)) versions.push_back({"rest", 1});
  if (scene.fluid)
    versions.insert(versions.end(), {{"mesh", 1}, {"fluid", 2}, {"free_surface", 2}, {"basin", 1}, {"coupling", 4}});
  return versions;
}

std::vector<Part> parts(const scene::SceneSpec& scene) { return scene::decisions(scene); }

RunResult run(const scene::SceneSpec& scene, const scene::RecordSpec& record, const Bed& bed,
              const Execution& execution, const std::vector<Array>& resume_from,
              const RecordsSoFar& so_far, const RunHooks& hooks) {
  if (!scene.pile) throw std::invalid_argument("run: the scene has no pile");
  std::vector<Array> state = resume_from;
  Measuring measuring = take_out(state);
  std::optional<Simulation> sim;
  struct Stopped {};
  const auto ended = [](Outcome outcome, std::string reason) {
    RunResult result;
    result.outcome = outcome;
    result.reason = std::move(reason);
    return result;
  };
  try {
    sim = build(scene, bed, execution, state, [&] {
      if (hooks.stop && hooks.stop()) throw Stopped{};
    });
  } catch (const Stopped&) {
    return ended(Outcome::stopped, "stopped on request before its start: it settles anew");
  } catch (const std::system_error&) {  // the machine's trouble and not the scene's, such as no process for the mesher
    throw;
  } catch (const std::runtime_error& error) {  // it does not settle under water, or has no mesh
    return ended(Outcome::diverged, error.what());
  }
  for (const PlacesBefore& before : measuring.open)
    if (before.grain.size() != sim->grains.count())
      throw std::invalid_argument("state: measures/place: of other grains");
  return drive(*sim, scene, record, execution.trying, std::move(measuring), so_far, hooks);
}

}  // namespace seapile::simulation
