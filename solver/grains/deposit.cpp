#include "solver/grains/deposit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "solver/base/random.h"
#include "solver/grains/neighbours.h"
#include "solver/grains/regions.h"

namespace seapile::grains {
namespace {

/// Streams of random numbers.
enum : std::uint32_t { kRadii = 0, kAcross = 1, kUp = 2 };

constexpr double kLatticeRoom = 1.02;  // cell over largest diameter
constexpr double kBorder = 0.5;        // gap over largest radius below which grains are neighbours

/// Place of a cell (x, y) along the Hilbert curve through a square of 2^16 x 2^16 cells (Hilbert 1891).
std::uint64_t hilbert_index(std::uint32_t x, std::uint32_t y) {
  std::uint64_t index = 0;
  for (std::uint32_t s = 1U << 15; s > 0; s >>= 1) {
    const std::uint32_t right = (x & s) ? 1 : 0, up = (y & s) ? 1 : 0;
    index += static_cast<std::uint64_t>(s) * s * ((3 * right) ^ up);
    if (up) continue;
    if (right) {
      x = 0xffff - (x & 0xffff);
      y = 0xffff - (y & 0xffff);
    }
    std::swap(x, y);
  }
  return index;
}

/// Of each grain, the largest region cut in half across whose cut it has a neighbour, or -1.
std::vector<std::int32_t> largest_cut(std::span<const Disc> discs, const Regions& regions) {
  double largest = 0;
  for (const Disc& d : discs) largest = std::max(largest, d.radius);
  std::vector<std::int32_t> cut(discs.size(), -1);
  for (const auto& [i, j] : neighbour_pairs(discs, kBorder * largest)) {
    const std::int32_t region = regions.holding(regions.tile_of(i), regions.tile_of(j));
    if (regions[region].first_half < 0) continue;
    cut[i] = std::max(cut[i], region);
    cut[j] = std::max(cut[j], region);
  }
  return cut;
}

/// Puts the grains at a cut together at the start of their tile: a thread that fetches them from another fetches
/// nothing else.
std::vector<std::size_t> borders_first(std::span<const Disc> discs) {
  const Regions regions(discs.size());
  const std::vector<std::int32_t> cut = largest_cut(discs, regions);
  std::vector<std::size_t> order(discs.size());
  std::iota(order.begin(), order.end(), 0);
  for (std::int32_t tile = 0; tile < regions.tiles(); ++tile)
    std::stable_sort(order.begin() + regions.first_grain(tile), order.begin() + regions.first_grain(tile + 1),
                     [&](std::size_t a, std::size_t b) { return cut[a] > cut[b]; });
  return order;
}

}  // namespace

Grains arrange(std::vector<GivenGrain> given, double density) {
  double x0 = 0, y0 = 0, size = 0;
  if (!given.empty()) x0 = given[0].x, y0 = given[0].y;
  for (const GivenGrain& g : given) x0 = std::min(x0, g.x), y0 = std::min(y0, g.y);
  for (const GivenGrain& g : given) size = std::max({size, g.x - x0, g.y - y0});
  const double scale = size > 0 ? 65535 / size : 0;
  std::vector<std::pair<std::uint64_t, std::size_t>> order;
  for (std::size_t k = 0; k < given.size(); ++k)
    order.emplace_back(hilbert_index(static_cast<std::uint32_t>((given[k].x - x0) * scale),
                                     static_cast<std::uint32_t>((given[k].y - y0) * scale)),
                       k);
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : given[a.second].id < given[b.second].id;
  });
  base::AlignedVector<Disc> discs;
  for (const auto& [index, k] : order) discs.push_back({given[k].x, given[k].y, given[k].radius, 0});
  Grains grains;
  for (const std::size_t along : borders_first(discs)) {
    const GivenGrain& g = given[order[along].second];
    grains.id.push_back(g.id);
    grains.disc.push_back({g.x, g.y, g.radius, 0});
    grains.mass.push_back(density * std::numbers::pi * g.radius * g.radius);
  }
  return grains;
}

Grains deposit(const GrainsSpec& spec, const Box& box, std::uint64_t seed) {
  const double width = box.right - box.left;
  const auto columns =
      std::max<std::int64_t>(1, static_cast<std::int64_t>(width / (2 * spec.radius.max * kLatticeRoom)));
  const double pitch = width / static_cast<double>(columns);
  const double row_height = 2 * spec.radius.max * kLatticeRoom;
  std::vector<GivenGrain> given;
  for (std::int64_t id = 0; id < spec.count; ++id) {
    const auto index = static_cast<std::uint64_t>(id);
    const double r = base::uniform(spec.radius.min, spec.radius.max, seed, kRadii, index);
    const double room_x = pitch / 2 - r, room_y = row_height / 2 - r;
    given.push_back({id,
                     box.left + pitch * (static_cast<double>(id % columns) + 0.5) +
                         base::uniform(-room_x, room_x, seed, kAcross, index),
                     box.base + row_height * (static_cast<double>(id / columns) + 0.5) +
                         base::uniform(-room_y, room_y, seed, kUp, index),
                     r});
  }
  return arrange(std::move(given), spec.density);
}

}  // namespace seapile::grains
