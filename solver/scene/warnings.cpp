#include "solver/scene/warnings.h"

#include "solver/scene/rounded.h"

namespace seapile::scene {

std::vector<std::string> warnings(const SceneSpec& scene) {
  if (!scene.pile) return {};
  const double wall = scene.bed.domain.width / 2 / scene.pile->radius;
  if (wall >= kNearWall) return {};
  return {"boundary_influence: the walls are " + rounded(wall) + " radii from the pile's axis, below " +
          rounded(kNearWall) + ": they may change its resistance"};
}

}  // namespace seapile::scene
