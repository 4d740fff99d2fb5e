// What a scene's fields must be to each other. Every bound that is not plain geometry has its reason beside it.
#include "solver/scene/validate.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "solver/scene/checks.h"
#include "solver/scene/validate_basin.h"
#include "solver/scene/validate_fluid.h"

namespace seapile::scene {
namespace {

using base::Problems;
using std::numbers::pi;

// The grid that finds contacts has cells of the largest diameter: a smaller ratio of radii keeps its cells from holding
// more grains than are worth testing.
constexpr double kLargestRatio = 100;
// Solid fraction of discs poured loosely is above it, so what fits at this fraction also fits before it is settled.
constexpr double kLoosest = 0.75;
// Solid fraction of a usual bed; with it the height of a bed is estimated, on the high side.
constexpr double kUsual = 0.80;
// A step of the brute-force solver at this count takes as long as one of blocks at 100,000.
constexpr std::int64_t kMostBruteForce = 500;
constexpr double kMostCells = 1e7;
const std::string kDriving = "/pile/driving";

/// Mean area of a disc whose radius is uniform between the two bounds [m2].
double mean_area(const grains::RadiusSpec& r) { return pi * (r.min * r.min + r.min * r.max + r.max * r.max) / 3; }

/// Area of all grains [m2].
double grain_area(const grains::GrainsSpec& grains) {
  return static_cast<double>(grains.count) * mean_area(grains.radius);
}

bool from_file(const BedSpec& bed) { return !bed.file.empty() || !bed.file_content.empty(); }

/// Height of a bed that is drawn [m].
double estimated_height(const BedSpec& bed) {
  return grain_area(bed.grains) / (bed.preparation.solid_fraction.value_or(kUsual) * bed.domain.width);
}

void check_grains(const BedSpec& bed, Problems& problems) {
  const auto& radius = bed.grains.radius;
  const DomainSpec& box = bed.domain;
  if (radius.min > radius.max) {
    problems.push_back({"/bed/grains/radius/min", "is larger than radius.max", "at most " + text(radius.max, "m"), ""});
    return;
  }
  if (radius.max > kLargestRatio * radius.min) {
    problems.push_back({"/bed/grains/radius/max", "is more than 100 times radius.min",
                        "at most " + text(kLargestRatio * radius.min, "m"), ""});
  }
  const double smaller_side = std::min(box.width, box.height);
  if (2 * radius.max > smaller_side) {
    problems.push_back(
        {"/bed/grains/radius/max", "makes a grain larger than the box", "at most " + text(smaller_side / 2, "m"), ""});
    return;
  }
  const double room = kLoosest * box.width * box.height;
  if (!from_file(bed) && grain_area(bed.grains) > room) {
    const double most = std::floor(room / mean_area(radius));
    problems.push_back({"/bed/grains/count",
                        "makes more grains than fit: " + text(grain_area(bed.grains), "m2") + " of discs in a box of " +
                            text(box.width * box.height, "m2"),
                        "at most " + text(most) + " of these radii in this box", ""});
  }
}

void check_solver(const grains::ContactSpec& contact, std::int64_t count, const std::string& pointer,
                  Problems& problems) {
  if (contact.solver != grains::Solver::brute_force || count <= kMostBruteForce) return;
  problems.push_back({pointer + "/solver",
                      "compares all grains with all: " + text(static_cast<double>(count)) + " are too many",
                      "brute_force for at most " + text(static_cast<double>(kMostBruteForce)) + " grains", ""});
}

void check_settling(const BedSpec& bed, Problems& problems) {
  const auto& preparation = bed.preparation;
  if (preparation.longest / preparation.contact.step > kMostSteps) {
    problems.push_back({"/bed/preparation/contact/step", "makes more than 1e9 steps of the longest settling time",
                        "at least " + text(preparation.longest / kMostSteps, "s"), ""});
  }
}

void check_pile_shape(const pile::PileSpec& pile, const BedSpec& bed, Problems& problems) {
  // Two of the largest grains pass between pile and wall on each side.
  const double widest = (bed.domain.width - 8 * bed.grains.radius.max) / 2;
  if (pile.radius >= widest) {
    problems.push_back({"/pile/radius",
                        "makes a pile of " + text(2 * pile.radius, "m") + " that is too wide for a box of " +
                            text(bed.domain.width, "m"),
                        widest > 0 ? "below " + text(widest, "m") : "no pile fits into this box", ""});
    return;
  }
  if (const double length = tip_height(pile.radius, pile.tip); length > bed.domain.height) {
    const double sharpest = 2 * std::atan(pile.radius / bed.domain.height) * 180 / pi;
    problems.push_back({"/pile/tip/conical/apex_angle",
                        "makes a tip of " + text(length, "m") + ", longer than the box is high",
                        "at least " + text(sharpest, "deg"), ""});
  }
}

void check_pile_end(const pile::PileSpec& pile, const BedSpec& bed, std::optional<double> bed_height,
                    Problems& problems) {
  if (!pile.depth && !pile.duration) {
    problems.push_back(
        {"/pile/depth", "and duration are both null: the run would not end", "a depth, a duration, or both", ""});
    return;
  }

  if (pile.depth && !pile.duration) {
    if (const auto* sine = std::get_if<pile::SinusoidalDriving>(&pile.driving)) {
      // It starts above the highest grain under it: two grains above the mean surface are granted.
      const double stroke = std::max(0.0, sine->speed) / (pi * sine->frequency);
      const double needed = *pile.depth + 4 * bed.grains.radius.max;
      if (stroke < needed) {
        problems.push_back({"/pile/depth",
                            "is never reached: the sine's stroke is " + text(stroke, "m") + ", and " +
                                text(needed, "m") + " are needed from the start above the grains",
                            "a smaller depth, or a duration", ""});
        return;
      }
    } else if (mean_speed(pile.driving) <= 0) {
      problems.push_back({driving_pointer(kDriving, pile.driving, "speed"),
                          "never reaches the depth, the only end of this run", "more than 0 m/s, or a duration", ""});
      return;
    }
  }

  if (bed_height && pile.depth && *pile.depth > *bed_height) {
    problems.push_back({"/pile/depth", "is deeper than the bed, about " + text(*bed_height, "m") + " high",
                        "at most " + text(*bed_height, "m"), ""});
  } else if (bed_height && !pile.depth && motion(pile.driving, *pile.duration).down > *bed_height) {
    problems.push_back({"/pile/duration",
                        "takes the pile down by " + text(motion(pile.driving, *pile.duration).down, "m") +
                            ", through a bed that is about " + text(*bed_height, "m") + " high",
                        "a shorter duration, or a depth as the end", ""});
  }
}

void check_pile_steps(const SceneSpec& scene, Problems& problems) {
  const pile::PileSpec& pile = *scene.pile;
  const double step = scene.contact.step;
  const double time = duration(pile);
  if (std::isfinite(time) && time / step > kMostSteps) {
    const bool by_time = pile.duration && *pile.duration <= time;
    problems.push_back({by_time ? "/pile/duration" : driving_pointer(kDriving, pile.driving, "speed"),
                        "makes a run of " + text(time, "s") + ", " + text(time / step) + " steps of " + text(step, "s"),
                        "at most 1e9 steps", ""});
  }

  // A pile that passes a whole grain between two detections of contacts goes through it.
  const double smallest = scene.bed.grains.radius.min;
  if (const double speed = largest_speed(pile.driving); speed * step > smallest) {
    problems.push_back(
        {"/contact/step",
         "lets the pile move by " + text(speed * step, "m") + " in one step, more than the smallest radius",
         "at most " + text(smallest / speed, "s"), ""});
  }
  check_period(pile.driving, step, kDriving, problems);
}

/// Depth that the pile does not pass [m].
double deepest(const pile::PileSpec& pile) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double by_time = pile.duration ? motion(pile.driving, *pile.duration).down : kInfinity;
  return std::min(pile.depth.value_or(kInfinity), by_time);
}

/// The way of the scene's pile; absent where the bed's height is not known, or the pile has none.
std::optional<WayIntoBed> way_into_bed(const SceneSpec& scene, std::optional<double> bed_height) {
  if (!scene.pile || !bed_height) return {};
  const pile::PileSpec& pile = *scene.pile;
  // Above the highest grain under it, as in check_pile_end(); of a file that height is known.
  const double above = from_file(scene.bed) ? 0 : 4 * scene.bed.grains.radius.max;
  const double time = duration(pile), down = deepest(pile);
  if (!std::isfinite(down)) return {};
  return WayIntoBed{*bed_height, *bed_height + above, std::isfinite(time) ? motion(pile.driving, time).up : 0, down,
                    time};
}

}  // namespace

Problems validate(const SceneSpec& scene, std::optional<double> bed_height) {
  Problems problems;
  if (scene.jet) return problems;
  if (scene.basin) return validate_basin(*scene.basin);
  check_grains(scene.bed, problems);
  check_settling(scene.bed, problems);
  check_solver(scene.bed.preparation.contact, scene.bed.grains.count, "/bed/preparation/contact", problems);
  if (scene.pile) check_solver(scene.contact, scene.bed.grains.count, "/contact", problems);
  if (scene.pile) {
    if (!bed_height && !from_file(scene.bed)) bed_height = estimated_height(scene.bed);
    check_pile_shape(*scene.pile, scene.bed, problems);
    check_pile_end(*scene.pile, scene.bed, bed_height, problems);
    check_pile_steps(scene, problems);
  }
  if (scene.fluid) {
    const Problems of_fluid = validate_fluid(scene, way_into_bed(scene, bed_height));
    problems.insert(problems.end(), of_fluid.begin(), of_fluid.end());
  }
  return problems;
}

Problems validate(const RecordSpec& record, const SceneSpec& scene) {
  Problems problems;
  if (!is_recorded(scene)) return problems;
  if (scene.basin) return validate_record(record, *scene.basin);
  const pile::PileSpec& pile = *scene.pile;
  const DomainSpec& box = scene.bed.domain;

  check_frames(record.frames, deepest(pile), {"frames", "depth", "is deeper than the pile goes", "m"}, problems);

  if (const double time = duration(pile); std::isfinite(time)) {
    const double path = motion(pile.driving, time).path;
    if (path / record.travel > kMostRecords) {
      problems.push_back({"/travel",
                          "makes " + text(path / record.travel) + " records of " + text(path, "m") + " of travel",
                          "at least " + text(path / kMostRecords, "m"), ""});
    }
  }

  const double cells = (box.width / record.spacing) * (box.height / record.spacing);
  if (cells > kMostCells) {
    problems.push_back({"/spacing", "makes a grid of " + text(cells) + " cells",
                        "at least " + text(std::sqrt(box.width * box.height / kMostCells), "m"), ""});
  }
  if (record.spacing > std::min(box.width, box.height)) {
    problems.push_back(
        {"/spacing", "is larger than the box", "at most " + text(std::min(box.width, box.height), "m"), ""});
  }
  return problems;
}

}  // namespace seapile::scene
