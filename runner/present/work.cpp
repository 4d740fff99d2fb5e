#include "runner/present/work.h"

#include <algorithm>
#include <limits>

#include "solver/pile/pile.h"

namespace seapile::present {

double work_of(const scene::SceneSpec& scene) {
  if (scene.jet) return 1;
  if (scene.basin) return scene.basin->time.duration;
  const pile::PileSpec& pile = *scene.pile;
  double time = pile.duration.value_or(std::numeric_limits<double>::infinity());
  if (pile.depth) time = std::min(time, pile::time_to_reach(pile.driving, *pile.depth));
  return static_cast<double>(scene.bed.grains.count) * time;
}

bool is_fast(const scene::SceneSpec& scene) {
  const double size = scene.bed.grains.radius.min + scene.bed.grains.radius.max;
  const double speed = pile::largest_speed(scene.pile->driving);
  return speed * speed > scene.bed.domain.gravity * size;
}

}  // namespace seapile::present
