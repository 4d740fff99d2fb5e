#include "runner/present/zone_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "runner/present/arrays.h"
#include "runner/present/pile_outline.h"
#include "runner/store/store_error.h"

namespace seapile::present {
namespace {

using base::Vec2;

constexpr double kHair = 1e-9;  ///< [m], for cells that end where a band does

const pile::PileSpec& pile_of(const ZoneOfRun& run) {
  if (!run.scene.pile) throw std::logic_error("a frame of a scene without a pile");
  return *run.scene.pile;
}

double tip_of(const ZoneOfRun& run) { return run.surface - run.after.depth; }

/// Half the width that the pile has below a height: it grows from the tip upwards.
double half_width_below(double height, const std::vector<Vec2>& outline) {
  double half = 0;
  for (std::size_t i = 0; i + 1 < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[i + 1];
    const Vec2 &low = a.y < b.y ? a : b, &high = a.y < b.y ? b : a;
    if (low.y >= height) continue;
    const double share = high.y > height ? (height - low.y) / (high.y - low.y) : 1;
    half = std::max({half, std::abs(low.x), std::abs(low.x + share * (high.x - low.x))});
  }
  return half;
}

/// The cells that count, by their distance.
struct Ring {
  std::vector<std::size_t> cells;
  double distance = 0;  ///< mean of the cells' centres
};

std::vector<Ring> rings(const ZoneOfRun& run, const View& band) {
  const simulation::Frame::Grid& grid = run.after.grid;
  const double half = grid.spacing / 2, wall = run.scene.bed.domain.width / 2;
  const std::vector<Vec2> outline = pile_outline(pile_of(run), tip_of(run), band.top + grid.spacing);
  std::map<long, Ring> by_distance;
  for (int j = 0; j < grid.ny; ++j) {
    const double y = grid.y0 + (j + 0.5) * grid.spacing;
    if (y - half < band.bottom - kHair || y + half > band.top + kHair) continue;
    const double pile = half_width_below(y + half - kHair, outline);
    for (int i = 0; i < grid.nx; ++i) {
      const double distance = std::abs(grid.x0 + (i + 0.5) * grid.spacing);
      if (distance < band.left - kHair || distance > band.right + kHair || distance + half > wall + kHair) continue;
      if (distance - half < pile - kHair) continue;
      Ring& ring = by_distance[std::lround(std::floor(distance / grid.spacing + kHair))];
      ring.cells.push_back(static_cast<std::size_t>(j * grid.nx + i));
      ring.distance += distance;
    }
  }
  std::vector<Ring> list;
  for (auto& [place, ring] : by_distance) {
    ring.distance /= static_cast<double>(ring.cells.size());
    list.push_back(std::move(ring));
  }
  return list;
}

std::vector<double> values_of(ZoneQuantity quantity, const simulation::Frame& frame) {
  if (quantity == ZoneQuantity::porosity) return values<double>(frame.cells, "cells/porosity");
  const bool vertical = quantity == ZoneQuantity::vertical_stress;
  const auto& all = values<double>(frame.cells, vertical ? "cells/stress" : "cells/principal_stress");
  std::vector<double> list;  // xx, yy, xy of each cell; or its major and minor principal stress
  for (std::size_t k = vertical ? 1 : 0; k < all.size(); k += vertical ? 3 : 2) list.push_back(all[k]);
  return list;
}

std::vector<double> means(const std::vector<double>& cells, const std::vector<Ring>& rings) {
  std::vector<double> list;
  for (const Ring& ring : rings) {
    double sum = 0;
    for (const std::size_t k : ring.cells) sum += cells.at(k);
    list.push_back(sum / static_cast<double>(ring.cells.size()));
  }
  return list;
}

std::optional<double> reach_of(const std::vector<double>& distance, const ZoneCurve& curve) {
  std::vector<double> change;
  for (std::size_t k = 0; k < distance.size(); ++k) change.push_back(std::abs(curve.after[k] - curve.before[k]));
  const double faint = kFaintChange * *std::ranges::max_element(change);
  std::size_t beyond = distance.size();
  while (beyond > 0 && change[beyond - 1] < faint) --beyond;
  if (faint <= 0 || beyond == distance.size()) return std::nullopt;
  const std::size_t last = beyond - 1;  // There is one: the largest change itself is not below its share.
  const double part = (change[last] - faint) / (change[last] - change[beyond]);
  return distance[last] + part * (distance[beyond] - distance[last]);
}

void check_grids(const ZoneOfRun& run) {
  const auto &a = run.before.grid, &b = run.after.grid;
  if (a.x0 == b.x0 && a.y0 == b.y0 && a.spacing == b.spacing && a.nx == b.nx && a.ny == b.ny) return;
  throw store::StoreError(store::StoreError::Kind::damaged, "the frames of a run differ in their cells");
}

}  // namespace

View default_band(const ZoneOfRun& run) {
  const double tip = tip_of(run), half = kZoneHalfHeight * pile_of(run).radius;
  return {0, run.scene.bed.domain.width / 2, std::max(0.0, tip - half), std::min(run.surface, tip + half)};
}

ZoneFigure zone_figure(const std::vector<ZoneOfRun>& runs, const std::optional<View>& band) {
  ZoneFigure figure;
  for (const ZoneOfRun& run : runs) {
    check_grids(run);
    ZonePanel panel{run.title, run.after.depth, pile_of(run).radius, band.value_or(default_band(run)), {}, {}};
    const std::vector<Ring> at = rings(run, panel.band);
    if (at.empty()) {
      throw std::invalid_argument(fmt::format(
          "no cell of {:g} m lies beside the pile, {:g} to {:g} m from its axis and {:.4g} to {:.4g} m above the base",
          run.after.grid.spacing, panel.band.left, panel.band.right, panel.band.bottom, panel.band.top));
    }
    for (const Ring& ring : at) panel.distance.push_back(ring.distance);
    for (std::size_t q = 0; q < kZoneQuantities; ++q) {
      ZoneCurve& curve = panel.curves[q];
      curve.before = means(values_of(static_cast<ZoneQuantity>(q), run.before), at);
      curve.after = means(values_of(static_cast<ZoneQuantity>(q), run.after), at);
      curve.reach = reach_of(panel.distance, curve);
    }
    figure.runs.push_back(std::move(panel));
  }
  return figure;
}

store::Table zone_table(const ZoneFigure& figure) {
  store::Table table;
  const auto add = [&](const std::string& name, const std::string& unit) {
    table.columns.push_back(name);
    table.units.push_back(unit);
  };
  add("run", "");
  add("depth", "m");
  add("distance", "m");
  constexpr std::array<const char*, kZoneQuantities> kNames = {"porosity", "stress_yy", "stress_major"};
  for (const char* name : kNames) {
    const std::string unit = name == kNames[0] ? "-" : "Pa";
    add(fmt::format("{}_before", name), unit);
    add(fmt::format("{}_after", name), unit);
    add(fmt::format("{}_reach", name), "m");
  }
  for (const ZonePanel& run : figure.runs) {
    for (std::size_t k = 0; k < run.distance.size(); ++k) {
      std::vector<store::Cell> row = {run.title, run.depth, run.distance[k]};
      for (const ZoneCurve& curve : run.curves) {
        row.emplace_back(curve.before[k]);
        row.emplace_back(curve.after[k]);
        curve.reach ? row.emplace_back(*curve.reach) : row.emplace_back();
      }
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

}  // namespace seapile::present
