// A new mesh for a basin, and the flow on it.
//
// The surface keeps its vertices, so that its heights, and the water's volume, are the same to the last bit. Velocities
// are brought over by projection or interpolation (mesh/transfer.h), pressures by interpolation. Of the divergence that
// this makes on the new mesh the pressure of an instant takes most (left in, it would more than double the force on a
// pile in the next step); the step after begins anew as an Euler step. The force on a pile is off by some 10 % for two
// steps.
#pragma once

#include <functional>

#include "solver/basin/basin.h"
#include "solver/mesh/transfer.h"

namespace seapile::basin {

/// Whether the scene asks for a new mesh now.
bool needs_new_mesh(const Basin& basin);

/// Throws mesh::NoMesh; the basin is then as it was. `suspended`: sets the new flow's porosity, and its rate at vertices
/// at rest; empty: nothing stands in the water.
void remesh(Basin& basin, const std::function<void(fluid::Flow&)>& suspended = {});

/// The unstructured mesh of a basin whose top has the heights of `top` and whose tip stands at `tip`.
mesh::TriangleMesh mesh_for(const BasinSpec& spec, const std::vector<base::Vec2>& right_half_of_top, double tip);

}  // namespace seapile::basin
