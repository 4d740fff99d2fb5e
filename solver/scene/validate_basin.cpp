// What a basin's fields must be to each other. Every bound that is not plain geometry has its reason beside it.
#include "solver/scene/validate_basin.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "solver/scene/checks.h"
#include "solver/scene/water_checks.h"

namespace seapile::scene {
namespace {

using base::Problems;
using basin::BasinPileSpec;
using basin::BasinSpec;
using basin::StructuredMesh;
using basin::UnstructuredMesh;

const std::string kDriving = "/basin/pile/driving";

/// Height of the pile's shoulder at the start, or that of the bottom [m]: what the surface has to stay above.
double floor_of(const BasinSpec& basin) {
  if (!basin.pile) return 0;
  const double shoulder = basin.depth - basin.pile->start + tip_height(basin.pile->radius, basin.pile->tip);
  return shoulder < basin.depth ? std::max(0.0, shoulder) : 0;  // otherwise the pile is what is wrong
}

/// Across the basin; elements along it where the mesh has no columns.
double columns_of(const BasinSpec& basin) {
  if (const auto* structured = std::get_if<StructuredMesh>(&basin.mesh.pattern))
    return static_cast<double>(structured->columns);
  return basin.width / std::get<UnstructuredMesh>(basin.mesh.pattern).size;
}

void check_mesh(const BasinSpec& basin, Problems& problems) {
  const auto& mesh = basin.mesh;
  if (const auto* structured = std::get_if<StructuredMesh>(&mesh.pattern)) {
    if (structured->columns % 2 != 0) {
      problems.push_back(
          {"/basin/mesh/pattern/structured/columns", "is odd: the mesh is its own mirror image", "an even number", ""});
    }
    if (structured->rows == 1 && structured->bottom_row != 1) {
      problems.push_back({"/basin/mesh/pattern/structured/bottom_row", "is the height of the only row", "1", ""});
    }
    if (basin.pile) {
      problems.push_back(
          {"/basin/mesh/pattern", "is structured, which leaves no room for a pile", "unstructured, or pile null", ""});
    }
    if (mesh.remesh) {
      problems.push_back({"/basin/mesh/remesh", "makes no new mesh where the pattern is structured",
                          "null, or an unstructured pattern", ""});
    }
  } else {
    const auto& unstructured = std::get<UnstructuredMesh>(mesh.pattern);
    check_sizes(unstructured.size, unstructured.pile_size, std::min(basin.width, basin.depth),
                "/basin/mesh/pattern/unstructured", problems);
  }
  if (basin.pile) check_follows_pile(mesh.motion, "/basin/mesh/motion", problems);
  if (!basin.pile && std::holds_alternative<basin::ZonesMotion>(mesh.motion)) {
    problems.push_back(
        {"/basin/mesh/motion", "is zones, which are those around a pile, and there is none", "vertical, elliptic", ""});
  }
}

/// From the tip to the shoulder the pile is under water, and above the bottom, from the start to the end.
void check_pile(const BasinSpec& basin, Problems& problems) {
  const BasinPileSpec& pile = *basin.pile;
  if (2 * pile.radius >= basin.width) {
    problems.push_back(
        {"/basin/pile/radius",
         "makes a pile of " + text(2 * pile.radius, "m") + " that is too wide for a basin of " + text(basin.width, "m"),
         "below " + text(basin.width / 2, "m"), ""});
    return;
  }
  const double shoulder = tip_height(pile.radius, pile.tip);
  const auto [highest, deepest] = tip_range(pile.radius, pile.tip, basin.depth);
  if (highest >= deepest) {
    problems.push_back(
        {"/basin/pile/radius",
         "makes a tip of " + text(shoulder, "m") + ", which water of " + text(basin.depth, "m") + " does not cover",
         "a smaller radius, a blunter tip or deeper water", ""});
    return;
  }
  const Motion way = motion(pile.driving, basin.time.duration);
  const double least = highest + way.up, most = deepest - way.down;
  const std::string allowed =
      least <= most ? "from " + text(least, "m") + " to " + text(most, "m") + " for this driving"
                    : "no start: the pile goes " + text(way.up, "m") + " up and " + text(way.down, "m") + " down";
  if (pile.start < least) {
    problems.push_back({"/basin/pile/start",
                        "lets the tip rise to a depth of " + text(pile.start - way.up, "m") +
                            ", where its shoulder is not under water",
                        allowed, ""});
  } else if (pile.start > most) {
    problems.push_back(
        {"/basin/pile/start",
         "lets the tip go down to " + text(pile.start + way.down, "m") + " in water of " + text(basin.depth, "m"),
         allowed, ""});
  }
}

void check_time(const BasinSpec& basin, Problems& problems) {
  const auto& time = basin.time;
  if (time.duration / time.step > kMostSteps) {
    problems.push_back({"/basin/time/duration",
                        "makes " + text(time.duration / time.step) + " steps of " + text(time.step, "s"),
                        "at most 1e9 steps", ""});
  }
  if (time.step > time.duration) {
    problems.push_back({"/basin/time/step", "is longer than the run", "at most " + text(time.duration, "s"), ""});
  }
  if (basin.pile) check_period(basin.pile->driving, time.step, kDriving, problems);
}

}  // namespace

Problems validate_basin(const BasinSpec& basin) {
  Problems problems;
  check_mesh(basin, problems);
  if (basin.surface) {
    check_surface(*basin.surface, {basin.width, basin.depth, floor_of(basin)}, columns_of(basin), "/basin/surface",
                  problems);
  }
  if (basin.pile) check_pile(basin, problems);
  check_time(basin, problems);
  return problems;
}

Problems validate_record(const RecordSpec& record, const BasinSpec& basin) {
  Problems problems;
  const double duration = basin.time.duration;
  check_frames(record.times, duration, {"times", "time", "is after the end of the run", "s"}, problems);
  if (duration / record.interval > kMostRecords) {
    problems.push_back({"/interval", "makes " + text(duration / record.interval) + " records of " + text(duration, "s"),
                        "at least " + text(duration / kMostRecords, "s"), ""});
  }
  return problems;
}

}  // namespace seapile::scene
