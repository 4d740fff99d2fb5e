// One state of the scene, in the forms that other codes read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/peers/overlaps.h"
#include "solver/scene/spec.h"
#include "solver/simulation/array.h"

namespace seapile::peers {

/// The scene at one moment.
struct State {
  std::vector<Disc> discs;           ///< rows in the order of the ids
  std::vector<double> vx, vy, spin;  ///< [m/s], [rad/s] anticlockwise
  double pile_y = 0;                 ///< height of the apex [m]
  double surface = 0;                ///< of the bed before it was driven into [m]
};

/// From a checkpoint's arrays (solver/simulation/state.h); `precision` is that of the contact solver. The surface is
/// left for the caller to fill.
State state_of(const std::vector<simulation::Array>& checkpoint, grains::Precision precision);

/// A number of the JSON file beside the state, for scripts.
struct Fact {
  std::string name;
  double value;
};

/// Data file for `atom_style sphere` (LAMMPS) and `granular` (LIGGGHTS): spheres whose density gives each the mass of
/// its disc per metre. Three types, all grains of the first; the others are for walls and pile.
void write_data(const std::filesystem::path& path, const State& state, const scene::BedSpec& bed);

/// The pile's outline drawn out in z, as an STL text file, at its place in the state.
void write_stl(const std::filesystem::path& path, const State& state, const std::vector<base::Segment>& outline);

void write_facts(const std::filesystem::path& path, const std::vector<Fact>& facts);

/// Reads what write_facts wrote; a name that is missing throws std::runtime_error with one sentence.
double fact(const std::filesystem::path& path, const std::string& name);

}  // namespace seapile::peers
