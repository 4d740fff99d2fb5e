// Which parts of the model are built: as the scene's own numbers say, or as the study does.
#pragma once

#include "solver/base/fields.h"

namespace seapile::scene {

/// Whether a part that the scene describes is built.
enum class Choice {
  as_needed,  ///< where leaving it out would change the answer (solver/scene/analysis.h)
  yes,        ///< whatever the numbers say
  no,         ///< likewise
};

/// Whether grains spin. Never decided: no number of a scene says what it changes.
enum class Rotation {
  yes,
  no,  ///< omega = 0 and I infinite: a contact moves both centres alone, and slides where it would roll
};

}  // namespace seapile::scene

namespace seapile::base {

template <>
struct EnumNames<scene::Choice> {
  static constexpr const char* values[] = {"as_needed", "yes", "no"};
};
template <>
struct EnumNames<scene::Rotation> {
  static constexpr const char* values[] = {"yes", "no"};
};

}  // namespace seapile::base

namespace seapile::scene {

/// What a scene has and is not built with is as if it had not been written. A `yes` adds nothing that it has not.
struct ModelSpec {
  Choice free_surface = Choice::as_needed;     ///< no: an open top at a fixed height
  Choice surface_tension = Choice::as_needed;  ///< no: gamma = 0, and no film
  Choice convection = Choice::as_needed;       ///< no: v.grad v is not computed
  Choice remeshing = Choice::as_needed;        ///< no: the first mesh is kept
  Rotation rotation = Rotation::yes;           ///< of the grains while the pile is driven; beds are settled with it
  friend bool operator==(const ModelSpec&, const ModelSpec&) = default;
};
void fields(auto& visit, base::SameAs<ModelSpec> auto& model) {
  using base::later;
  using base::part;
  visit(later(part("free_surface", "the free surface; no: an open top at a fixed height")), model.free_surface);
  visit(later(part("surface_tension", "surface tension; no: none, whatever its value")), model.surface_tension);
  visit(later(part("convection", "v.grad v in the momentum equation; no: the unsteady Stokes equations")),
        model.convection);
  visit(later(part("remeshing", "new meshes; no: the first one is kept")), model.remeshing);
  visit(later(part("rotation", "whether grains spin while the pile is driven")), model.rotation);
}

}  // namespace seapile::scene
