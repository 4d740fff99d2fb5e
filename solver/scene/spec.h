// What is simulated: value types, complete and const once validated.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solver/base/fields.h"
#include "solver/basin/basin_spec.h"
#include "solver/fluid/jet_spec.h"
#include "solver/grains/grains_spec.h"
#include "solver/pile/pile_spec.h"
#include "solver/scene/fluid_spec.h"
#include "solver/scene/model_spec.h"

namespace seapile::scene {

using base::between;
using base::Field;
using base::later;
using base::part;
using base::positive;
using base::SameAs;

/// The box: x in [-width/2, width/2], y in [0, height], open at the top.
struct DomainSpec {
  double width = 5;       ///< L [m]
  double height = 4;      ///< H [m]
  double gravity = 9.81;  ///< g [m/s2], downwards
  friend bool operator==(const DomainSpec&, const DomainSpec&) = default;
};
void fields(auto& visit, SameAs<DomainSpec> auto& domain) {
  visit(Field{"width", "m", positive(1e4), "width L"}, domain.width);
  visit(Field{"height", "m", positive(1e4), "height H"}, domain.height);
  visit(Field{"gravity", "m/s2", positive(1000), "gravity g, downwards"}, domain.gravity);
}

/// A bed of grains: a case of its own, computed once and shared.
struct BedSpec {
  DomainSpec domain;
  grains::GrainsSpec grains;
  grains::PreparationSpec preparation;
  std::uint64_t seed = 1;  ///< of the random radii and places
  /// Grains read from a CSV file (columns id,x,y,radius; in m) instead of drawn: the file's path, relative to the
  /// study; "" : drawn. In the canonical text stands `file_content` instead.
  std::string file;
  std::string file_content;  ///< SHA-256 of the file's grains in the order of their ids; "" : drawn
  friend bool operator==(const BedSpec&, const BedSpec&) = default;
};
void fields(auto& visit, SameAs<BedSpec> auto& bed) {
  visit(part("domain", "the box"), bed.domain);
  visit(part("grains", "what the bed is made of"), bed.grains);
  visit(part("preparation", "how the bed is brought to rest"), bed.preparation);
  visit(Field{"seed", "-", between(0, 9007199254740991.0), "seed of the random radii and places"}, bed.seed);
  visit(part("file", "CSV file of grains (id,x,y,radius in m), relative to the study; \"\": drawn at random"), bed.file);
}

/// A case: a bed, and what is done to it; or water alone, a jet or a basin, which is a scene by itself.
struct SceneSpec {
  BedSpec bed;
  std::optional<pile::PileSpec> pile;  ///< absent: the bed alone
  std::optional<FluidSpec> fluid;      ///< absent: dry
  grains::ContactSpec contact;         ///< the solver while driving
  std::optional<fluid::JetSpec> jet;   ///< present: the scene is this jet, and there is neither bed nor pile
  std::optional<basin::BasinSpec> basin;  ///< present: the scene is this basin of water, and there is no bed
  ModelSpec model;                        ///< which of the parts described above are built
  friend bool operator==(const SceneSpec&, const SceneSpec&) = default;
};
void fields(auto& visit, SameAs<SceneSpec> auto& scene) {
  visit(part("bed", "the bed, a case of its own"), scene.bed);
  visit(part("pile", "the driven pile; null: the bed alone"), scene.pile);
  visit(part("fluid", "the fluid between and above the grains; null: dry"), scene.fluid);
  visit(part("contact", "the contact solver while driving"), scene.contact);
  visit(later(part("jet", "a jet from a die, instead of all the others; null: none")), scene.jet);
  visit(later(part("basin", "a basin of water without grains, instead of all the others; null: none")), scene.basin);
  visit(later(part("model", "which parts are built: as_needed, yes or no")), scene.model);
}

/// Whether the scene is water alone: no grains, and no bed that it is built on.
inline bool is_water(const SceneSpec& scene) { return scene.jet || scene.basin; }

/// Whether runs of the scene hand out what a RecordSpec asks for.
inline bool is_recorded(const SceneSpec& scene) { return !scene.jet && (scene.basin || scene.pile); }

/// What is kept of a run. Not part of a case's identity: it changes no bit of the simulation.
struct RecordSpec {
  double travel = 5e-4;                    ///< [m] of pile travel between two records
  std::vector<double> frames = {0, 0.2, 0.6, 1.2};  ///< depths d [m] at which a frame is kept
  double window = 10e-3;                   ///< [s] over which the contact forces of a frame are averaged
  double spacing = 0.05;                   ///< [m] of the grid for porosity and stress
  double interval = 0.01;                  ///< [s] between two records of a basin
  std::vector<double> times = {};          ///< [s] at which a frame of a basin is kept, beside its start and its end
  friend bool operator==(const RecordSpec&, const RecordSpec&) = default;
};
void fields(auto& visit, SameAs<RecordSpec> auto& record) {
  visit(Field{"travel", "m", between(1e-7, 10), "pile travel between two records"}, record.travel);
  visit(Field{"frames", "m", between(-10, 1000), "depths at which a frame is kept"}, record.frames);
  visit(Field{"window", "s", between(0, 10), "time over which a frame's contact forces are averaged"}, record.window);
  visit(Field{"spacing", "m", positive(100), "spacing of the grid for porosity and stress"}, record.spacing);
  visit(later(Field{"interval", "s", positive(1e4), "time between two records of a basin"}), record.interval);
  visit(later(Field{"times", "s", between(0, 1e6), "times at which a frame of a basin is kept, beside start and end"}),
        record.times);
}

}  // namespace seapile::scene
