#include "solver/simulation/tip_measures.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <stdexcept>

namespace seapile::simulation {
namespace {

constexpr double kSpacing = 0.02;  // of the points at which stress is taken [m]
constexpr const char *kTaken = "measures/taken", *kTip = "measures/tip", *kPlace = "measures/place";

/// The smallest of the values that 95 % do not exceed.
double percentile_95(std::vector<double> values) {
  if (values.empty()) return TipMeasures::kAbsent;
  const auto k = static_cast<std::ptrdiff_t>(values.size() / 20);
  std::ranges::nth_element(values, values.begin() + k, std::greater<>());
  return values[static_cast<std::size_t>(k)];
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : TipMeasures::kAbsent; }

/// In the triangle ABC: base 2R at the tip's lowest point, apex 2R sin 60 degrees below.
bool in_nose_cone(const grains::Disc& disc, const TipPlace& tip) {
  const double height = std::numbers::sqrt3 * tip.radius, below = tip.lowest.y - disc.y;
  return below >= 0 && below <= height && std::abs(disc.x - tip.lowest.x) <= tip.radius * (1 - below / height);
}

void measure_stress(TipMeasures& measures, std::span<const grains::ContactForce> contacts,
                    std::span<const grains::Disc> discs, const grains::Box& box, const TipPlace& tip) {
  const double reach = 2 * tip.radius;
  const int cells = static_cast<int>(std::ceil(reach / kSpacing));
  const grains::Grid grid{tip.lowest.x - cells * kSpacing, tip.lowest.y - cells * kSpacing, kSpacing, 2 * cells, cells};
  const std::vector<grains::Stress> stress = grains::stress_on_grid(contacts, discs, box, grid);
  std::vector<double> major;
  double shares = 0, loaded = 0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const base::Vec2 point{grid.x0 + (ix + 0.5) * kSpacing, grid.y0 + (iy + 0.5) * kSpacing};
      if (norm(point - tip.lowest) > reach || point.x < box.left || point.x > box.right || point.y < box.base) continue;
      const grains::Stress& s = stress[static_cast<std::size_t>(iy) * grid.nx + ix];
      major.push_back(grains::principal(s).major);
      if (s.xx + s.yy <= 0) continue;
      shares += s.yy / (s.xx + s.yy);
      ++loaded;
    }
  measures.stress_under_tip = percentile_95(std::move(major));
  measures.vertical_stress_share = ratio(shares, loaded);
}

}  // namespace

void measure_motion(TipMeasures& measures, std::span<const grains::Disc> discs, const PlacesBefore& before,
                    const TipPlace& tip) {
  const double way = before.tip - tip.lowest.y;
  if (way < (1 - 1e-6) * kMotionTravel) return;
  double inside = 0, with_pile = 0, moved = 0, lateral = 0, vertical = 0;
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const double across = std::abs(discs[i].x - before.grain[i].x), down = before.grain[i].y - discs[i].y;
    if (in_nose_cone(discs[i], tip)) {
      ++inside;
      if (across < 0.1 * way && std::abs(down - way) <= 0.1 * way) ++with_pile;
    }
    if (across * across + down * down <= 0.01 * way * way) continue;
    ++moved;
    lateral += across;
    vertical += std::abs(down);
  }
  measures.nose_cone = ratio(with_pile, inside);
  measures.set_in_motion = moved;
  measures.lateral_motion = ratio(lateral, vertical);
}

void measure_forces(TipMeasures& measures, std::span<const grains::ContactForce> contacts,
                    std::span<const grains::Disc> discs, const grains::Box& box, const TipPlace& tip) {
  measure_stress(measures, contacts, discs, box, tip);
  std::vector<double> normal;
  double sum = 0;
  for (const grains::ContactForce& c : contacts) {
    if (c.second < 0) continue;
    normal.push_back(c.normal);
    sum += c.normal;
  }
  const double mean = ratio(sum, static_cast<double>(normal.size()));
  measures.contact_force_mean = mean;
  measures.contact_force_p95 = percentile_95(std::move(normal));

  double strong = 0, upright = 0;
  for (const grains::ContactForce& c : contacts) {
    const base::Vec2 from_tip{c.x - tip.lowest.x, c.y - tip.lowest.y};
    if (c.second < 0 || !(c.normal > mean) || from_tip.y > 0 || norm(from_tip) > 4 * tip.radius) continue;
    strong += c.normal;
    upright += c.normal * c.ny * c.ny;
  }
  measures.strong_force_verticality = ratio(upright, strong);
}

std::vector<Array> arrays_of(const Measuring& measuring) {
  std::vector<Array> arrays;
  if (!measuring.taken.empty()) {
    std::vector<double> rows;
    for (const TipMeasures& m : measuring.taken) {
      rows.push_back(m.asked);
      columns([&](const char*, const char*, const char*, double value) { rows.push_back(value); }, m);
    }
    const int width = static_cast<int>(rows.size() / measuring.taken.size());
    arrays.push_back({{kTaken, "-", "depth and measures of each frame so far", width, Entity::run}, std::move(rows)});
  }
  if (measuring.open.empty()) return arrays;
  std::vector<double> tip, place;
  for (const PlacesBefore& before : measuring.open) {
    tip.push_back(before.tip);
    for (const base::Vec2& p : before.grain) place.insert(place.end(), {p.x, p.y});
  }
  arrays.push_back(
      {{kTip, "m", "height of the tip that each coming frame compares with", 1, Entity::run}, std::move(tip)});
  arrays.push_back({{kPlace, "m", "places of all grains at each of these heights", 2, Entity::run}, std::move(place)});
  return arrays;
}

Measuring take_out(std::vector<Array>& checkpoint) {
  const auto taken_out = [&](const char* name) {
    const auto found = std::ranges::find(checkpoint, name, [](const Array& array) { return array.info.name; });
    if (found == checkpoint.end()) return std::vector<double>{};
    auto* values = std::get_if<std::vector<double>>(&found->values);
    if (!values) throw std::invalid_argument(std::string("state: ") + name + ": of another type");
    std::vector<double> held = std::move(*values);
    checkpoint.erase(found);
    return held;
  };
  Measuring measuring;
  const std::vector<double> rows = taken_out(kTaken), tip = taken_out(kTip), place = taken_out(kPlace);
  auto next = rows.begin();
  while (next != rows.end()) {
    TipMeasures& m = measuring.taken.emplace_back();
    std::ptrdiff_t width = 1;
    columns([&](const char*, const char*, const char*, double) { ++width; }, m);
    if (rows.end() - next < width) throw std::invalid_argument(std::string("state: ") + kTaken + ": of other columns");
    m.asked = *next++;
    columns([&](const char*, const char*, const char*, double& value) { value = *next++; }, m);
  }
  if (tip.empty() ? !place.empty() : place.size() % (2 * tip.size()) != 0)
    throw std::invalid_argument(std::string("state: ") + kPlace + ": of another length");
  for (std::size_t k = 0; k < tip.size(); ++k) {
    PlacesBefore& before = measuring.open.emplace_back();
    before.tip = tip[k];
    const std::size_t width = place.size() / tip.size();
    for (std::size_t i = k * width; i < (k + 1) * width; i += 2) before.grain.push_back({place[i], place[i + 1]});
  }
  return measuring;
}

std::vector<Metric> metrics_of(std::span<const TipMeasures> taken) {
  std::vector<Metric> metrics;
  for (std::size_t k = 0; k < taken.size(); ++k) {
    const std::string depth = depth_text(taken[k].asked);
    // Frames within 0.1 mm share their name: the first has it.
    const auto of_this_name = [&](const TipMeasures& other) { return depth_text(other.asked) == depth; };
    if (std::ranges::any_of(taken.first(k), of_this_name)) continue;
    columns(
        [&](const char* name, const char* unit, const char* meaning, double value) {
          if (std::isfinite(value)) metrics.push_back({std::string(name) + "_" + depth, value, unit, meaning});
        },
        taken[k]);
  }
  return metrics;
}

std::string depth_text(double depth) {
  const long tenths = std::lround(std::abs(depth) * 1e4);
  std::string digits = std::to_string(10000 + tenths % 10000).substr(1);
  while (digits.size() > 2 && digits.back() == '0') digits.pop_back();
  return (depth < 0 && tenths > 0 ? "-" : "") + std::to_string(tenths / 10000) + "." + digits;
}

}  // namespace seapile::simulation
