#include "solver/grains/neighbours.h"

#include <algorithm>
#include <cmath>

namespace seapile::grains {
namespace {

bool close(const Disc& a, const Disc& b, double skin) {
  const double dx = b.x - a.x, dy = b.y - a.y, reach = (a.radius + 0.5 * skin) + (b.radius + 0.5 * skin);
  return dx * dx + dy * dy < reach * reach;
}

}  // namespace

std::vector<Pair> neighbour_pairs(std::span<const Disc> discs, double skin) {
  if (discs.empty()) return {};
  double x0 = discs[0].x, x1 = x0, y0 = discs[0].y, y1 = y0, largest = 0;
  for (const Disc& d : discs) {
    x0 = std::min(x0, d.x), x1 = std::max(x1, d.x);
    y0 = std::min(y0, d.y), y1 = std::max(y1, d.y);
    largest = std::max(largest, d.radius);
  }
  // Cells no smaller than the longest reach, and not many more cells than grains, however far one has flown.
  const double count = static_cast<double>(discs.size());
  const double edge = std::max({2 * largest + skin, (x1 - x0) / (4 * std::sqrt(count) + 1000), (y1 - y0) / (4 * std::sqrt(count) + 1000)});
  const auto nx = static_cast<std::int32_t>((x1 - x0) / edge) + 1;
  const auto ny = static_cast<std::int32_t>((y1 - y0) / edge) + 1;
  const auto column = [&](double x) { return std::min(static_cast<std::int32_t>((x - x0) / edge), nx - 1); };
  const auto row = [&](double y) { return std::min(static_cast<std::int32_t>((y - y0) / edge), ny - 1); };

  // Counting sort of the grains by cell; inside a cell by index. `inside` holds the grains in that order, side by side.
  std::vector<std::int32_t> start(static_cast<std::size_t>(nx) * ny + 1), cell(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i) {
    cell[i] = row(discs[i].y) * nx + column(discs[i].x);
    ++start[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
  struct Inside {
    double x, y, reach;  // reach: radius + skin / 2
    std::int32_t grain;
  };
  std::vector<Inside> inside(discs.size());
  std::vector<std::int32_t> next(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < discs.size(); ++i)
    inside[next[cell[i]]++] = {discs[i].x, discs[i].y, discs[i].radius + 0.5 * skin, static_cast<std::int32_t>(i)};

  // Each pair once: with the rest of the own cell and the next one, and with the three cells of the next row, which
  // stand side by side.
  std::vector<Pair> found;
  found.reserve(discs.size() * 4);
  const auto search = [&](const Inside& a, std::int32_t begin, std::int32_t end) {
    for (std::int32_t k = begin; k < end; ++k) {
      const Inside& b = inside[k];
      const double dx = b.x - a.x, dy = b.y - a.y, reach = a.reach + b.reach;
      if (dx * dx + dy * dy < reach * reach) found.push_back({std::min(a.grain, b.grain), std::max(a.grain, b.grain)});
    }
  };
  for (std::int32_t cy = 0; cy < ny; ++cy)
    for (std::int32_t cx = 0; cx < nx; ++cx) {
      const std::int32_t here = cy * nx + cx;
      const std::int32_t beside = start[here + (cx + 1 < nx ? 2 : 1)];
      const std::int32_t above = cy + 1 < ny ? start[here + nx - (cx > 0 ? 1 : 0)] : 0;
      const std::int32_t above_end = cy + 1 < ny ? start[here + nx + (cx + 1 < nx ? 2 : 1)] : 0;
      for (std::int32_t k = start[here]; k < start[here + 1]; ++k) {
        search(inside[k], k + 1, beside);
        search(inside[k], above, above_end);
      }
    }

  // Ascending: by the first grain through counting, then the few pairs of each.
  std::vector<std::int32_t> first(discs.size() + 1);
  for (const Pair& p : found) ++first[p.i + 1];
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::int32_t> place(first.begin(), first.end() - 1);
  std::vector<Pair> pairs(found.size());
  for (const Pair& p : found) pairs[place[p.i]++] = p;
  for (std::size_t i = 0; i < discs.size(); ++i) std::sort(pairs.begin() + first[i], pairs.begin() + first[i + 1]);
  return pairs;
}

std::vector<Pair> neighbour_pairs_brute_force(std::span<const Disc> discs, double skin) {
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < discs.size(); ++i)
    for (std::size_t j = i + 1; j < discs.size(); ++j)
      if (close(discs[i], discs[j], skin)) pairs.push_back({static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
  return pairs;
}

}  // namespace seapile::grains
