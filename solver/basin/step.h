// One step of a basin in time.
//
//   1 pile      moves to its new place
//   2 surface   moves with the water                                        surface_flux.h, fluid/free_surface.h
//   3 mesh      follows both, with one mesh velocity                        mesh/motion.h
//               and what stands in the water is found on it                 Suspension
//   4 flow      is solved on the moved domain                               fluid/advance.h
//   5 mesh      is made anew where its triangles have become bad, and the flow brought over     remesh.h
//
// Thesis, Algorithm 1, in the order that keeps mass and mesh velocity consistent (physics 8.20): the thesis solves
// first and moves afterwards. 2 to 4 depend on each other: they are iterated together (`iterated`), or 2 and 3 go first
// with the velocities before, extrapolated. Both conserve volume with the conservative update.
#pragma once

#include <functional>

#include "solver/base/objection.h"
#include "solver/base/profile.h"
#include "solver/basin/basin.h"

namespace seapile::basin {

/// What stands in the water and is not its own: grains, that its owner moves. Empty functions: nothing.
struct Suspension {
  /// On the moved domain, each time it has been placed: sets the flow's porosity, the rate of it at the moving vertices,
  /// drag and answer.
  std::function<void(Basin&)> moved;
  /// When the flow is solved, before a new mesh is made.
  std::function<void(const Basin&)> solved;
  /// On a new mesh at the same time, with nothing remembered: sets porosity, and its rate where vertices are at rest.
  std::function<void(fluid::Flow&)> remeshed;
};

/// Empty when the step is done; otherwise why it cannot be, and the basin is as it was before, but for what its solver
/// has learnt (fluid::FlowSolver).
base::Objection step(Basin& basin, base::Profile& profile, const Suspension& suspension = {});

}  // namespace seapile::basin
