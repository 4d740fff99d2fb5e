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

CellGrid::CellGrid(std::span<const Disc> discs, double skin) : discs_(discs), skin_(skin) {
  if (discs.empty()) return;
  double x1 = discs[0].x, y1 = discs[0].y, largest = 0;
  x0_ = x1, y0_ = y1;
  for (const Disc& d : discs) {
    x0_ = std::min(x0_, d.x), x1 = std::max(x1, d.x);
    y0_ = std::min(y0_, d.y), y1 = std::max(y1, d.y);
    largest = std::max(largest, d.radius);
  }
  // Cells no smaller than the longest reach, and not many more cells than grains, however far one has flown.
  const double most = 4 * std::sqrt(static_cast<double>(discs.size())) + 1000;
  edge_ = std::max({2 * largest + skin, (x1 - x0_) / most, (y1 - y0_) / most});
  nx_ = static_cast<std::int32_t>((x1 - x0_) / edge_) + 1;
  ny_ = static_cast<std::int32_t>((y1 - y0_) / edge_) + 1;

  // Counting sort.
  start_.assign(static_cast<std::size_t>(nx_) * ny_ + 1, 0);
  std::vector<std::int32_t> cell(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i) {
    cell[i] = row(discs[i].y) * nx_ + column(discs[i].x);
    ++start_[cell[i] + 1];
  }
  for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
  std::vector<std::int32_t> next(start_.begin(), start_.end() - 1);
  inside_.resize(discs.size());
  for (std::size_t i = 0; i < discs.size(); ++i)
    inside_[next[cell[i]]++] = {discs[i].x, discs[i].y, discs[i].radius + 0.5 * skin, static_cast<std::int32_t>(i)};
}

std::int32_t CellGrid::column(double x) const { return std::min(static_cast<std::int32_t>((x - x0_) / edge_), nx_ - 1); }
std::int32_t CellGrid::row(double y) const { return std::min(static_cast<std::int32_t>((y - y0_) / edge_), ny_ - 1); }

void CellGrid::find_pairs(std::int32_t first, std::int32_t last, std::vector<Pair>& pairs) const {
  std::vector<std::int32_t> found;  // partners of one grain, and behind them what is still to be written over
  for (std::int32_t i = first; i < last; ++i) {
    const Disc& a = discs_[i];
    const double own = a.radius + 0.5 * skin_;
    const std::int32_t cx = column(a.x), cy = row(a.y);
    std::size_t count = 0;
    // The three cells of a row stand side by side. No branch depends on what is found: it could not be foreseen.
    for (std::int32_t y = std::max(cy - 1, 0); y <= std::min(cy + 1, ny_ - 1); ++y) {
      const std::int32_t from = start_[y * nx_ + std::max(cx - 1, 0)];
      const std::int32_t to = start_[y * nx_ + std::min(cx + 1, nx_ - 1) + 1];
      if (found.size() < count + static_cast<std::size_t>(to - from)) found.resize(2 * (count + (to - from)));
      for (std::int32_t k = from; k < to; ++k) {
        const Inside& b = inside_[k];
        const double dx = b.x - a.x, dy = b.y - a.y, reach = own + b.reach;
        found[count] = b.grain;
        count += static_cast<std::size_t>(b.grain > i) & static_cast<std::size_t>(dx * dx + dy * dy < reach * reach);
      }
    }
    // A handful, by insertion.
    for (std::size_t p = 1; p < count; ++p) {
      const std::int32_t grain = found[p];
      std::size_t at = p;
      for (; at > 0 && grain < found[at - 1]; --at) found[at] = found[at - 1];
      found[at] = grain;
    }
    for (std::size_t p = 0; p < count; ++p) pairs.push_back({i, found[p]});
  }
}

std::vector<Pair> neighbour_pairs(std::span<const Disc> discs, double skin) {
  std::vector<Pair> pairs;
  pairs.reserve(discs.size() * 4);
  CellGrid(discs, skin).find_pairs(0, static_cast<std::int32_t>(discs.size()), pairs);
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
