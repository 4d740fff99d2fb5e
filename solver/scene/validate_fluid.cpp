// What the fluid of a saturated scene must be to its bed and its pile.
#include "solver/scene/validate_fluid.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "solver/scene/water_checks.h"

namespace seapile::scene {
namespace {

using base::Problems;

const std::string kFluid = "/fluid";
// What a whole number of the grains' steps may be missed by, relative to the fluid's.
constexpr double kWhole = 1e-9;

/// Fluid and grains meet at the ends of the fluid's steps.
void check_step(const SceneSpec& scene, Problems& problems) {
  const double step = scene.fluid->time.step, grains = scene.contact.step;
  const double below = std::floor(step / grains), above = std::ceil(step / grains);
  const double nearest = std::max(1.0, std::round(step / grains));
  if (std::abs(step - nearest * grains) <= kWhole * step) return;
  std::string allowed = text(std::max(1.0, above) * grains, "s");
  if (below >= 1) allowed = text(below * grains, "s") + " or " + allowed;
  problems.push_back({kFluid + "/time/step",
                      "is no whole number of the grains' steps of " + text(grains, "s") + " (contact.step)", allowed,
                      ""});
}

/// The least depth that covers the tip from its lowest point, which is `height` above the bottom, to its shoulder [m].
double least_depth(const pile::PileSpec& pile, double height) {
  // tip_range() is linear in the depth.
  const double none = tip_range(pile.radius, pile.tip, 0).least, one = tip_range(pile.radius, pile.tip, 1).least;
  return (height + none) / (1 - (one - none));
}

/// From its start to its end the tip is under the fluid, up to its shoulder, and above the bottom.
void check_depth(const SceneSpec& scene, const WayIntoBed& way, Problems& problems) {
  const FluidSpec& fluid = *scene.fluid;
  const pile::PileSpec& pile = *scene.pile;
  if (const double least = least_depth(pile, way.start + way.up); fluid.depth < least) {
    const double box = scene.bed.domain.height;
    problems.push_back({kFluid + "/depth",
                        "does not cover the pile's shoulder, which is at a height of " +
                            text(way.start + way.up + tip_height(pile.radius, pile.tip), "m") + " when it is highest",
                        least <= box ? "from " + text(least, "m") + " to " + text(box, "m")
                                     : "none in this box: at least " + text(least, "m"),
                        ""});
    return;
  }
  const double lowest = fluid.depth - tip_range(pile.radius, pile.tip, fluid.depth).most;
  if (way.surface - way.deepest >= lowest) return;
  const bool by_depth = pile.depth && *pile.depth <= way.deepest;
  problems.push_back({by_depth ? "/pile/depth" : "/pile/duration",
                      "takes the tip down to " + text(way.surface - way.deepest, "m") +
                          " above the bottom, where the fluid's mesh has no room",
                      by_depth ? "at most " + text(way.surface - lowest, "m")
                               : "a shorter duration: the tip stays " + text(lowest, "m") + " above the bottom",
                      ""});
}

}  // namespace

Problems validate_fluid(const SceneSpec& scene, const std::optional<WayIntoBed>& way) {
  Problems problems;
  const FluidSpec& fluid = *scene.fluid;
  const DomainSpec& box = scene.bed.domain;
  if (!scene.pile) {
    problems.push_back({kFluid, "is there without a pile: a bed alone is prepared dry", "null, or a pile", ""});
    return problems;
  }
  const pile::PileSpec& pile = *scene.pile;
  if (const double grains = scene.bed.grains.density; fluid.density >= grains)
    problems.push_back({kFluid + "/density",
                        "is no less than that of the grains: they are not heavier than the fluid, and no bed rests",
                        "less than " + text(grains, "kg/m3"), ""});
  check_step(scene, problems);
  check_period(pile.driving, fluid.time.step, "/pile/driving", problems);
  check_sizes(fluid.mesh.size, fluid.mesh.pile_size, std::min(box.width, fluid.depth), kFluid + "/mesh", problems);
  check_follows_pile(fluid.mesh.motion, kFluid + "/mesh/motion", problems);
  double floor = 0;
  if (fluid.depth > box.height) {
    problems.push_back({kFluid + "/depth", "is more than the box is high", "at most " + text(box.height, "m"), ""});
  } else if (way) {
    check_depth(scene, *way, problems);
    const double shoulder = way->start + tip_height(pile.radius, pile.tip);
    if (shoulder < fluid.depth) floor = shoulder;  // otherwise the depth is what is wrong
  }
  if (way && fluid.time.step > way->duration) {
    problems.push_back({kFluid + "/time/step", "is longer than the run", "at most " + text(way->duration, "s"), ""});
  }
  if (fluid.surface) {
    check_surface(*fluid.surface, {box.width, fluid.depth, floor}, box.width / fluid.mesh.size, kFluid + "/surface",
                  problems);
  }
  return problems;
}

}  // namespace seapile::scene
