#include "solver/grains/deposit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "solver/base/random.h"

namespace seapile::grains {
namespace {

/// Streams of random numbers.
enum : std::uint32_t { kRadii = 0, kAcross = 1, kUp = 2 };

constexpr double kLatticeRoom = 1.02;  // cell over largest diameter

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
  Grains grains;
  for (const auto& [index, k] : order) {
    const GivenGrain& g = given[k];
    grains.id.push_back(g.id);
    grains.disc.push_back({g.x, g.y, g.radius, 0});
    grains.mass.push_back(density * std::numbers::pi * g.radius * g.radius);
  }
  return grains;
}

Grains deposit(const GrainsSpec& spec, const Box& box, std::uint64_t seed) {
  const double width = box.right - box.left;
  const auto columns = std::max<std::int64_t>(1, static_cast<std::int64_t>(width / (2 * spec.radius.max * kLatticeRoom)));
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
