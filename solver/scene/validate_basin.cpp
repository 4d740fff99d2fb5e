// What a basin's fields must be to each other. Every bound that is not plain geometry has its reason beside it.
#include "solver/scene/validate_basin.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <variant>

#include "solver/scene/checks.h"

namespace seapile::scene {
namespace {

using base::Problems;
using basin::BasinPileSpec;
using basin::BasinSpec;
using basin::StructuredMesh;
using basin::UnstructuredMesh;

const std::string kDriving = "/basin/pile/driving";
// Shares of the depth that stay between the pile's shoulder and the surface at rest, which would flood it otherwise,
// and between its tip and the bottom, where the mesh would have no room.
constexpr double kLeastOverShoulder = 1e-3;
constexpr double kLeastUnderTip = 1e-2;
// A wave whose half has fewer columns than these is not the one that was asked for.
constexpr double kFewestColumns = 4;
// Lowest value of sin(s)/s, and where it is.
constexpr double kLowestHump = -0.21723362821122166;
constexpr double kPlaceOfLowestHump = 4.4934094579090642;

/// What lifts the surface at the start, per metre of its amplitude: the lowest and the highest.
struct Shape {
  double lowest = 0, highest = 0;
};

Shape shape_of(const basin::FlatSurface&, double) { return {}; }

Shape shape_of(const basin::HumpSurface& hump, double width) {
  const double end = width / (2 * hump.width);
  return {end < kPlaceOfLowestHump ? std::sin(end) / end : kLowestHump, 1};
}

Shape shape_of(const basin::CosineSurface&, double) { return {-1, 1}; }

double amplitude_of(const basin::FlatSurface&) { return 0; }
double amplitude_of(const auto& wave) { return wave.amplitude; }

/// Lowest height of the surface above the rest level at the start [m].
double lowest_start(const basin::InitialSurface& initial, double width) {
  return std::visit(
      [&](const auto& wave) {
        const Shape shape = shape_of(wave, width);
        const double amplitude = amplitude_of(wave);
        return std::min(amplitude * shape.lowest, amplitude * shape.highest);
      },
      initial);
}

/// Height of the pile's shoulder at the start, or that of the bottom [m]: what the surface has to stay above.
double floor_of(const BasinSpec& basin) {
  if (!basin.pile) return 0;
  const double shoulder = basin.depth - basin.pile->start + tip_height(basin.pile->radius, basin.pile->tip);
  return shoulder < basin.depth ? std::max(0.0, shoulder) : 0;  // otherwise the pile is what is wrong
}

void check_start(const BasinSpec& basin, Problems& problems) {
  const auto& initial = basin.surface->initial;
  const double floor = floor_of(basin), room = basin.depth - floor;
  if (lowest_start(initial, basin.width) > -room) return;
  const char* name = std::visit([](const auto& wave) { return std::decay_t<decltype(wave)>::kName; }, initial);
  const Shape shape = std::visit([&](const auto& wave) { return shape_of(wave, basin.width); }, initial);
  std::string allowed = "more than " + text(-room / shape.highest, "m");
  if (shape.lowest < 0) allowed += ", less than " + text(room / -shape.lowest, "m");
  problems.push_back(
      {std::string("/basin/surface/initial/") + name + "/amplitude",
       floor > 0 ? "lets the surface start below the pile's shoulder" : "lets the surface start at or below the bottom",
       allowed, ""});
}

/// Columns of the mesh over one half wave of a cosine, or elements along it.
void check_wave(const BasinSpec& basin, Problems& problems) {
  const auto* wave = std::get_if<basin::CosineSurface>(&basin.surface->initial);
  if (!wave) return;
  const auto* structured = std::get_if<StructuredMesh>(&basin.mesh.pattern);
  const double columns = structured ? static_cast<double>(structured->columns)
                                    : basin.width / std::get<UnstructuredMesh>(basin.mesh.pattern).size;
  const double most = std::floor(columns / kFewestColumns);
  if (static_cast<double>(wave->mode) <= most) return;
  problems.push_back({"/basin/surface/initial/cosine/mode",
                      "has fewer than 4 columns of the mesh per half wave: " + text(columns) + " across the basin",
                      most >= 1 ? "at most " + text(most) + ", or a finer mesh" : "a finer mesh", ""});
}

void check_surface(const BasinSpec& basin, Problems& problems) {
  check_start(basin, problems);
  check_wave(basin, problems);
  if (basin.surface->volume_correction && basin.surface->scheme == basin::SurfaceScheme::conservative) {
    problems.push_back({"/basin/surface/volume_correction",
                        "has nothing to correct: the conservative scheme loses no volume", "false, or another scheme",
                        ""});
  }
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
    if (unstructured.pile_size > unstructured.size) {
      problems.push_back({"/basin/mesh/pattern/unstructured/pile_size", "is larger than the size far from the pile",
                          "at most " + text(unstructured.size, "m"), ""});
    }
    const double side = std::min(basin.width, basin.depth);
    if (unstructured.size > side) {
      problems.push_back(
          {"/basin/mesh/pattern/unstructured/size", "is larger than the basin", "at most " + text(side, "m"), ""});
    }
  }
  if (basin.pile && std::holds_alternative<basin::VerticalMotion>(mesh.motion)) {
    problems.push_back(
        {"/basin/mesh/motion", "is vertical, which follows a surface, not a pile", "zones, elliptic", ""});
  }
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
  const double highest = shoulder + kLeastOverShoulder * basin.depth;
  const double deepest = (1 - kLeastUnderTip) * basin.depth;
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
  if (basin.surface) check_surface(basin, problems);
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
