// One description of the simulation's state. Frames, checkpoint, restore, hash and comparison all walk it, so nothing
// can be in the state and missing from a checkpoint.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "solver/simulation/array.h"

namespace seapile::simulation {

struct Simulation;

/// Every array of the state, in a fixed order. Element order of grain arrays is the solver's; "grains/id" says whose.
void describe(const Simulation& simulation, const std::function<void(const ArrayInfo&, ArrayView)>& visit);

/// A copy of every array of the state, in the order of describe().
std::vector<Array> snapshot(const Simulation& simulation);

/// Puts a snapshot back into a simulation built from the same scene: afterwards it continues bit for bit like the one
/// that the snapshot was taken from. Throws std::invalid_argument naming the array that is missing, unknown, or of
/// wrong type, columns or length; the simulation is then unchanged.
void restore(Simulation& simulation, const std::vector<Array>& state);

/// 64-bit hash (XXH3) over the raw bits of every array of the state, names included.
std::uint64_t state_hash(const Simulation& simulation);

/// The first difference between two states ("grains/position[17]: 0.25 against 0.26"), empty when they agree bit for bit.
std::string compare(const std::vector<Array>& a, const std::vector<Array>& b);

}  // namespace seapile::simulation
