#include "solver/scene/analysis.h"

#include <algorithm>
#include <stdexcept>

#include "solver/scene/checks.h"
#include "solver/scene/predictions.h"
#include "solver/scene/rounded.h"

namespace seapile::scene {
namespace {

using basin::SurfaceSpec;

Decision plain(const char* name, bool built, std::string reason) { return {name, built, std::move(reason)}; }

/// A part that the scene has, by its number. `below`: needed up to the threshold; otherwise from it on.
Decision judged(const char* name, Choice choice, Criterion criterion, bool below) {
  const bool needed = below ? criterion.number <= criterion.threshold : criterion.number >= criterion.threshold;
  Decision decision{name, needed, {}, choice == Choice::as_needed ? By::scene : By::asked, {}};
  if (choice != Choice::as_needed) decision.built = choice == Choice::yes;
  const std::string is = "the " + criterion.quantity + " is " + rounded(criterion.number);
  const char* side = needed == below ? "not above " : "above ";
  if (!below) side = needed ? "not below " : "below ";
  decision.reason = choice == Choice::as_needed ? is + ", " + side + rounded(criterion.threshold)
                                                : std::string("the study says ") + (decision.built ? "yes" : "no") +
                                                      ": \"model." + name + "\"; " + is;
  decision.criterion = std::move(criterion);
  return decision;
}

Decision convection(const SceneSpec& scene, const Predictions& predicted) {
  return judged("convection", scene.model.convection,
                {"Reynolds number", predicted.reynolds, kSmallReynolds, predicted.reynolds, "velocities and forces"},
                false);
}

Decision free_surface(const std::optional<SurfaceSpec>& surface, bool pile, const ModelSpec& model,
                      const Predictions& predicted) {
  if (!surface) return plain("free_surface", false, "the top is fixed: \"surface\" is null");
  if (pile)
    return judged("free_surface", model.free_surface,
                  {"change of the surface over the depth", *predicted.surface_change, kSmallSurfaceChange,
                   *predicted.surface_change, "pressure of the water on the tip, by rho g H"},
                  false);
  Decision decision = plain("free_surface", model.free_surface != Choice::no, "the water's top moves");
  if (model.free_surface == Choice::as_needed) return decision;
  decision.by = By::asked;
  decision.reason = std::string("the study says ") + (decision.built ? "yes" : "no") + ": \"model.free_surface\"";
  return decision;
}

Decision surface_tension(const std::optional<SurfaceSpec>& surface, bool free, const ModelSpec& model,
                         const Predictions& predicted) {
  if (!free) return plain("surface_tension", false, "there is no free surface");
  if (surface->tension == 0) return plain("surface_tension", false, "the surface has none: \"tension\" is 0");
  return judged("surface_tension", model.surface_tension,
                {"Bond number", *predicted.bond, kLargeBond, 0.5 / *predicted.bond, "frequency of a wave"}, true);
}

Decision remeshing(bool wanted, const ModelSpec& model, const Predictions& predicted) {
  if (!wanted) return plain("remeshing", false, "the scene has none: \"remesh\" is null");
  return judged("remeshing", model.remeshing,
                {"way of pile and surface over the finest edge", predicted.mesh_travel, kSmallMeshTravel,
                 2 * predicted.mesh_travel, "shape quality of a triangle"},
                false);
}

Decision mesh_motion(bool free, bool pile_moves) {
  if (pile_moves) return plain("mesh_motion", true, "the mesh follows the pile");
  if (free) return plain("mesh_motion", true, "the mesh follows the surface");
  return plain("mesh_motion", false, "neither its top nor a pile moves");
}

/// The parts of water in a box, in the order of decisions(), from "mesh" to "surface_tension".
struct WaterParts {
  const std::optional<SurfaceSpec>& surface;
  bool remesh;
  const pile::Driving* driving;  ///< null: no pile
};
void add_water(std::vector<Decision>& list, const SceneSpec& scene, const WaterParts& water, const char* why) {
  const Predictions predicted = *predictions(scene);
  const Decision surface = free_surface(water.surface, water.driving != nullptr, scene.model, predicted);
  list.push_back(plain("mesh", true, "the fluid lives on it"));
  list.push_back(mesh_motion(surface.built, water.driving && largest_speed(*water.driving) > 0));
  list.push_back(remeshing(water.remesh, scene.model, predicted));
  list.push_back(plain("fluid", true, why));
  list.push_back(convection(scene, predicted));
  list.push_back(surface);
  list.push_back(surface_tension(water.surface, surface.built, scene.model, predicted));
}

std::vector<Decision> of_jet(const SceneSpec& scene) {
  const char* jet = "the scene is a jet of fluid";
  const Predictions predicted = *predictions(scene);
  std::vector<Decision> list;
  for (const char* name : {"grains", "walls", "pile", "rotation", "restitution"})
    list.push_back(plain(name, false, jet));
  list.push_back(plain("mesh", true, "the fluid lives on it"));
  list.push_back(plain("mesh_motion", true, "the mesh follows the surface"));
  list.push_back(plain("remeshing", false, "a jet keeps its mesh"));
  list.push_back(plain("fluid", true, jet));
  list.push_back(convection(scene, predicted));
  list.push_back(plain("free_surface", true, "the jet finds its own shape"));
  list.push_back(scene.jet->capillary ? judged("surface_tension", scene.model.surface_tension,
                                               {"capillary number", *predicted.capillary, kLargeCapillary,
                                                1 / *predicted.capillary, "swell ratio"},
                                               true)
                                      : plain("surface_tension", false, "the jet has none: \"capillary\" is null"));
  list.push_back(plain("coupling", false, jet));
  return list;
}

std::vector<Decision> of_basin(const SceneSpec& scene) {
  const char* water = "the scene is a basin of water";
  const basin::BasinSpec& basin = *scene.basin;
  std::vector<Decision> list;
  for (const char* name : {"grains", "walls"}) list.push_back(plain(name, false, water));
  list.push_back(plain("pile", basin.pile.has_value(),
                       basin.pile ? "the basin has a pile" : "the basin has none: \"pile\" is null"));
  for (const char* name : {"rotation", "restitution"}) list.push_back(plain(name, false, water));
  add_water(list, scene, {basin.surface, basin.mesh.remesh.has_value(), basin.pile ? &basin.pile->driving : nullptr},
            water);
  list.push_back(plain("coupling", false, water));
  return list;
}

Decision rotation(const SceneSpec& scene) {
  if (!scene.pile || scene.model.rotation == Rotation::yes) return plain("rotation", true, "grains spin");
  return {"rotation", false, "the study says no: \"model.rotation\"", By::asked};
}

std::vector<Decision> of_grains(const SceneSpec& scene) {
  std::vector<Decision> list = {
      plain("grains", true, "the bed has " + std::to_string(scene.bed.grains.count) + " grains"),
      plain("walls", true, "the box holds the grains"),
      plain("pile", scene.pile.has_value(), scene.pile ? "the scene drives a pile" : "the scene is the bed alone"),
      rotation(scene),
      plain("restitution", scene.bed.grains.restitution > 0,
            scene.bed.grains.restitution > 0 ? "the grains rebound" : "the coefficient of restitution is 0")};
  if (!scene.fluid) {
    for (const char* name :
         {"mesh", "mesh_motion", "remeshing", "fluid", "convection", "free_surface", "surface_tension", "coupling"})
      list.push_back(plain(name, false, "the scene is dry: \"fluid\" is null"));
    return list;
  }
  add_water(list, scene,
            {scene.fluid->surface, scene.fluid->mesh.remesh.has_value(), scene.pile ? &scene.pile->driving : nullptr},
            "the scene is saturated");
  list.push_back(plain("coupling", true, "grains and fluid act on each other"));
  return list;
}

/// Takes out of a basin or a fluid what is left out.
void strip(std::optional<SurfaceSpec>& surface, std::optional<basin::RemeshSpec>& remesh, fluid::Convection& convection,
           const ModelSpec& model) {
  if (model.free_surface == Choice::no) surface.reset();
  if (surface && model.surface_tension == Choice::no) surface->tension = 0;
  if (model.remeshing == Choice::no) remesh.reset();
  if (model.convection == Choice::no) convection = fluid::Convection::omitted;
}

}  // namespace

std::vector<Decision> decisions(const SceneSpec& scene) {
  if (scene.jet) return of_jet(scene);
  return scene.basin ? of_basin(scene) : of_grains(scene);
}

SceneSpec as_built(const SceneSpec& scene) {
  SceneSpec built = scene;
  const std::vector<Decision> list = decisions(scene);
  const auto decided = [&](const char* name) {
    const auto found = std::ranges::find(list, name, &Decision::name);
    if (found == list.end()) throw std::logic_error(std::string("no decision about ") + name);
    return found->built ? Choice::yes : Choice::no;
  };
  built.model.free_surface = decided("free_surface");
  built.model.surface_tension = decided("surface_tension");
  built.model.convection = decided("convection");
  built.model.remeshing = decided("remeshing");
  if (built.jet) {
    if (built.model.surface_tension == Choice::no) built.jet->capillary.reset();
    if (built.model.convection == Choice::no) built.jet->convection = fluid::Convection::omitted;
  } else if (built.basin) {
    strip(built.basin->surface, built.basin->mesh.remesh, built.basin->convection, built.model);
  } else if (built.fluid) {
    strip(built.fluid->surface, built.fluid->mesh.remesh, built.fluid->convection, built.model);
  }
  return built;
}

bool has_choice(const SceneSpec& scene, std::string_view member) {
  if (scene.jet) return member == "surface_tension" || member == "convection";
  if (scene.basin) return member != "rotation";
  return scene.pile && (scene.fluid || member == "rotation");
}

}  // namespace seapile::scene
