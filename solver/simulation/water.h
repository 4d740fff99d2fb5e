// The water of a saturated scene, from its spec, and its step with the grains.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "solver/base/objection.h"
#include "solver/base/profile.h"
#include "solver/basin/basin.h"
#include "solver/basin/pile_force.h"
#include "solver/coupling/coupling_spec.h"
#include "solver/coupling/exchange.h"
#include "solver/coupling/on_mesh.h"
#include "solver/scene/spec.h"
#include "solver/simulation/flow_record.h"

namespace seapile::simulation {

struct Simulation;

/// Sums over the fluid's steps since the last record.
struct WaterGathering {
  std::int64_t steps = 0, sleeve_steps = 0;         ///< with u3 in the water
  base::Vec2 tip_force, sleeve_force, grain_force;  ///< [N/m]
  double face = 0, shoulder = 0, sleeve = 0;        ///< [Pa]
  double lowest_porosity = 1;                       ///< smallest [-]
  double clipped_volume = 0;                        ///< largest [m2]
};

/// Everything that a saturated scene adds to a dry one.
struct Water {
  basin::Basin basin;
  coupling::CouplingSpec coupling;
  coupling::Location location;
  /// The grains on the mesh as it is, where the last step of the fluid expected them to be by now.
  coupling::OnMesh expected = {};
  coupling::Surroundings around = {};  ///< of those, in the flow as it is
  int grain_steps = 1;  ///< of the grains in a step of the fluid
  double buoyancy = 0;  ///< rho/rho_p g, by which the weight of immersed grains is less [m/s2]

  std::vector<base::Vec2> drag = {}, pressure = {};  ///< forces of the last exchange [N/m], (grains)
  std::vector<base::Vec2> velocity = {};  ///< of the grains when the last step of the fluid began [m/s], (grains)
  WaterGathering gathering = {};          ///< since the last record
  WaterGathering recorded = {};  ///< what the last record was made of: one that no step of the fluid is in repeats it
};

/// The basin that a saturated scene's water is, when the pile's tip starts at the height `tip` [m].
basin::BasinSpec basin_of(const scene::SceneSpec& scene, double tip);

/// Water at rest around the grains of a simulation, which has its pile and whose gravity is g (1 - rho/rho_p) already.
/// `grain_density`: rho_p [kg/m3]. Throws mesh::NoMesh.
Water water_around(const Simulation& simulation, const basin::BasinSpec& basin, const coupling::CouplingSpec& coupling,
                   double grain_density);

/// One step of the fluid from the present time, and what it does to the grains during that step (grains.push). Empty
/// when it is done; otherwise why it cannot be, and grains and flow are as they were. `advance_grains`: one step of
/// theirs, for schemes that try it.
base::Objection step_water(Simulation& simulation, const std::function<void(Simulation&)>& advance_grains);

/// A new mesh for the water as it is, where a step of the fluid begins. Throws mesh::NoMesh; the water is then as it
/// was.
void remesh_water(Simulation& simulation);

/// Closes the record of the water since the last one and begins the next.
FlowRecord take_flow_record(Simulation& simulation);

}  // namespace seapile::simulation
