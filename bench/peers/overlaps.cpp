#include "bench/peers/overlaps.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <stdexcept>
#include <string>

namespace seapile::peers {
namespace {

double distance(const base::Segment& s, double x, double y) {
  const double dx = s.to.x - s.from.x, dy = s.to.y - s.from.y;
  const double along = std::clamp(((x - s.from.x) * dx + (y - s.from.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
  return std::hypot(x - s.from.x - along * dx, y - s.from.y - along * dy);
}

/// Discs by cells: those of cell c are disc[first[c]] to disc[first[c + 1]].
struct Cells {
  int columns = 1, rows = 1;
  std::vector<std::size_t> first, disc;
};

Cells into_cells(const std::vector<Disc>& discs, double width) {
  const auto [left, right] =
      std::minmax_element(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.x < b.x; });
  const auto [low, high] =
      std::minmax_element(discs.begin(), discs.end(), [](const Disc& a, const Disc& b) { return a.y < b.y; });
  Cells cells;
  cells.columns = 1 + static_cast<int>((right->x - left->x) / width);
  cells.rows = 1 + static_cast<int>((high->y - low->y) / width);
  std::vector<std::size_t> cell(discs.size());
  cells.first.assign(static_cast<std::size_t>(cells.columns) * static_cast<std::size_t>(cells.rows) + 1, 0);
  for (std::size_t i = 0; i < discs.size(); ++i) {
    const int column = static_cast<int>((discs[i].x - left->x) / width);
    const int row = static_cast<int>((discs[i].y - low->y) / width);
    cell[i] = static_cast<std::size_t>(row * cells.columns + column);
    ++cells.first[cell[i] + 1];
  }
  std::partial_sum(cells.first.begin(), cells.first.end(), cells.first.begin());
  std::vector<std::size_t> next(cells.first.begin(), cells.first.end() - 1);
  cells.disc.resize(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i) cells.disc[next[cell[i]]++] = i;
  return cells;
}

/// visit(i, j) for each pair of discs in the same cell or in touching ones, once.
void each_pair(const Cells& cells, const std::function<void(std::size_t, std::size_t)>& visit) {
  constexpr int kAhead[][2] = {{1, 0}, {-1, 1}, {0, 1}, {1, 1}};
  for (int row = 0; row < cells.rows; ++row)
    for (int column = 0; column < cells.columns; ++column) {
      const auto here = static_cast<std::size_t>(row * cells.columns + column);
      for (std::size_t a = cells.first[here]; a < cells.first[here + 1]; ++a) {
        for (std::size_t b = a + 1; b < cells.first[here + 1]; ++b) visit(cells.disc[a], cells.disc[b]);
        for (const auto& [dx, dy] : kAhead) {
          if (column + dx < 0 || column + dx >= cells.columns || row + dy >= cells.rows) continue;
          const auto there = static_cast<std::size_t>((row + dy) * cells.columns + column + dx);
          for (std::size_t b = cells.first[there]; b < cells.first[there + 1]; ++b) visit(cells.disc[a], cells.disc[b]);
        }
      }
    }
}

}  // namespace

Overlaps overlaps(const std::vector<Disc>& discs, const Surroundings& around) {
  Overlaps result;
  if (discs.empty()) return result;
  std::vector<double> found;
  const auto add = [&](double overlap, double radius) {
    if (overlap > 0) found.push_back(overlap / radius);
  };

  double largest = 0;
  for (const Disc& d : discs) largest = std::max(largest, d.radius);
  each_pair(into_cells(discs, 2 * largest), [&](std::size_t i, std::size_t j) {
    const Disc &a = discs[i], &b = discs[j];
    add(a.radius + b.radius - std::hypot(b.x - a.x, b.y - a.y), std::min(a.radius, b.radius));
  });
  for (const Disc& d : discs) {
    add(d.radius - (d.x - around.left), d.radius);
    add(d.radius - (around.right - d.x), d.radius);
    add(d.radius - (d.y - around.base), d.radius);
    // The pile is one body that is convex where grains are: the nearest point of its outline is the contact.
    double nearest = 2 * d.radius;
    for (const base::Segment& s : around.outline)
      nearest = std::min(nearest, distance(s, d.x - around.pile_x, d.y - around.pile_y));
    add(d.radius - nearest, d.radius);
  }

  if (found.empty()) return result;
  result.contacts = static_cast<double>(found.size());
  result.mean = std::accumulate(found.begin(), found.end(), 0.0) / result.contacts;
  const auto k = static_cast<std::ptrdiff_t>(found.size() / 1000);
  std::nth_element(found.begin(), found.begin() + k, found.end(), std::greater<>());
  result.p999 = found[static_cast<std::size_t>(k)];
  result.max = *std::max_element(found.begin(), found.begin() + k + 1);
  return result;
}

Overlaps over_moments(const std::vector<Overlaps>& moments) {
  Overlaps sum;
  if (moments.empty()) return sum;
  for (const Overlaps& m : moments) {
    sum.p999 += m.p999, sum.mean += m.mean, sum.contacts += m.contacts;
    sum.max = std::max(sum.max, m.max);
  }
  const auto count = static_cast<double>(moments.size());
  sum.p999 /= count, sum.mean /= count, sum.contacts /= count;
  return sum;
}

bool read_snapshot(std::istream& dump, Snapshot& snapshot) {
  const auto expect = [&](const char* item) {
    std::string line;
    std::getline(dump, line);
    if (!line.starts_with(item))
      throw std::runtime_error("the dump has \"" + line + "\" where \"" + item + "\" belongs");
  };
  std::string line;
  if (dump.peek() == std::istream::traits_type::eof()) return false;
  expect("ITEM: TIMESTEP");
  dump >> snapshot.step;
  std::getline(dump, line);
  expect("ITEM: NUMBER OF ATOMS");
  std::size_t count = 0;
  dump >> count;
  std::getline(dump, line);
  expect("ITEM: BOX BOUNDS");
  for (int k = 0; k < 3; ++k) std::getline(dump, line);
  expect("ITEM: ATOMS id x y radius");
  snapshot.discs.resize(count);
  for (Disc& d : snapshot.discs) {
    long id = 0;
    dump >> id >> d.x >> d.y >> d.radius;
  }
  if (!dump) throw std::runtime_error("the dump ends within step " + std::to_string(snapshot.step));
  std::getline(dump, line);
  return true;
}

}  // namespace seapile::peers
