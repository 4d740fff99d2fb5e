// Which parts of the solver a scene needs, decided from numbers that it predicts, and what leaving others out costs.
//
// A part is left out only when the number that says so (solver/scene/predictions.h) is past its threshold and the study
// does not force it (solver/scene/model_spec.h). What each claims to change at most, and tests/solver/simulation/
// model_test.cpp measures:
//
//   surface tension   Bo > 1e3     a wave's frequency, sqrt(1 + 1/Bo) - 1 < 1/(2 Bo)
//                     Ca > 1e3     a jet's swell ratio, 1/Ca: gamma's stresses by those of friction
//   free surface      s < 1e-3     the water's pressure on the tip by rho g H, s: what the surface's height would add
//   convection        Re < 1e-3    velocities and forces, Re: inertia by friction
//   remeshing         w < 1e-2     the shape quality of a triangle, 2 w: a vertex moves by w of an edge
//
// Neglected: resonance of the basin with a vibration, contact lines, drops. A free surface without a pile is what its
// scene is about, and stays.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/scene/spec.h"

namespace seapile::scene {

inline constexpr double kLargeBond = 1e3, kLargeCapillary = 1e3, kSmallSurfaceChange = 1e-3, kSmallReynolds = 1e-3,
                        kSmallMeshTravel = 1e-2;

/// The number that a part is needed by.
struct Criterion {
  std::string quantity;  ///< "Bond number"
  double number;         ///< of this scene
  double threshold;      ///< from which on, or up to which, the part is needed
  double bound;          ///< relative change of the answer that leaving it out stays below
  std::string answer;    ///< "frequency of a wave"
};

/// Who says whether a part is built.
enum class By {
  scene,  ///< what it consists of, and its numbers
  asked,  ///< its `model`
};

/// A part of the solver, and whether a scene is built with it.
struct Decision {
  /// "grains", "walls", "pile", "rotation", "restitution", "mesh", "mesh_motion", "remeshing", "fluid", "convection",
  /// "free_surface", "surface_tension", "coupling"
  std::string name;
  bool built = false;
  std::string reason;  ///< one sentence: why it is built, or left out
  By by = By::scene;
  std::optional<Criterion> criterion = {};  ///< absent: no number is asked, the scene has the part or has it not
};

/// Of all parts, in a fixed order. The scene is valid.
std::vector<Decision> decisions(const SceneSpec& scene);

/// The scene without the parts that are left out: what a run is built from. Its `model` forces what was decided, so
/// that it is decided once.
SceneSpec as_built(const SceneSpec& scene);

/// Whether scenes of this kind have what a member of `model` chooses about; otherwise it is no part of the case.
bool has_choice(const SceneSpec& scene, std::string_view member_of_model);

}  // namespace seapile::scene
