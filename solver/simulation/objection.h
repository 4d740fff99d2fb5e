// What is checked of a step before it is accepted, and by which bounds (bounds.h). Each is asked so that a value that
// is not a number is objected to.
#pragma once

#include "solver/basin/basin.h"
#include "solver/fluid/jet.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/step.h"

namespace seapile::simulation {

/// Of a step that was done: finite places and flow, the longest way of a grain, the contacts' residual; and where the
/// fluid had its step, porosity and the volume of water and grains.
Objection objection(const Simulation& simulation, const StepReport& report);

/// Of a step of a basin: finite flow and surface, volume.
Objection objection(const basin::Basin& basin);

/// Of a step of a jet: finite flow, a surface above the axis that is a graph.
Objection objection(const fluid::Jet& jet);

/// Of a largest overlap [radii of the smaller].
Objection overlap_objection(const Simulation& simulation, double overlap);

/// What the grains have and were given; energies [J/m].
struct EnergyLevel {
  double kinetic = 0, potential = 0, work = 0, push_work = 0, dissipation = 0;
};
EnergyLevel energy_level(const Simulation& simulation);

/// Every velocity and spin is finite.
Objection motion_objection(const EnergyLevel& now);

/// What soft contacts of grains hold as springs of stiffness m_c (2 pi f)^2, m_c = 1/(1/m_i + 1/m_j), in a state that
/// snapshot() took of it [J/m]; 0 of non-smooth ones.
double elastic_energy(const Simulation& simulation, const std::vector<Array>& state);

/// Of the end of a stretch that began with `before` in `start`, from snapshot(): what is too costly for every step.
/// Motion and spins are finite, no overlap is too large, and the grains have gained no energy that nothing has given
/// them: neither the pile, nor the water, nor soft contacts beyond what they held.
Objection stretch_objection(const Simulation& simulation, const EnergyLevel& before, const std::vector<Array>& start);

}  // namespace seapile::simulation
