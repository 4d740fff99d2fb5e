// How a bed is shared out: into tiles, and into regions of them.
//
// Grains stand in memory along a Hilbert curve, so that a run of them is a compact piece of the bed. The bed is cut in
// half, each half again, and so on down to regions of a few tiles; a tile is a region, too. A contact belongs to the
// smallest region that holds both of its grains. Regions of which none holds another share no grain: threads work on
// them side by side, and a thread that has done both halves of a region goes on with the contacts across the cut. Where
// the cuts are depends on the number of grains alone, so no number of threads changes the order in which contacts are
// solved.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace seapile::grains {

/// Most grains of a tile: its bodies (16 KB in single precision) stay in the nearest cache during a sweep.
inline constexpr std::int32_t kTileGrains = 512;

/// Most tiles of a region that is not cut in half: fewer would leave more lanes of its blocks empty.
inline constexpr std::int32_t kUncutTiles = 3;

/// Tiles [first_tile, last_tile).
struct Region {
  std::int32_t first_tile = 0, last_tile = 0;
  std::int32_t first_half = -1;  ///< index of the first half; -1: a tile, or tiles that are not cut in half
  bool is_tile() const { return last_tile - first_tile == 1; }
};

/// Tiles and regions of a bed of so many grains.
class Regions {
 public:
  Regions() = default;
  explicit Regions(std::size_t grain_count);

  std::int32_t tiles() const { return tiles_; }
  /// Tile of a grain.
  std::int32_t tile_of(std::int32_t grain) const { return grain / tile_grains_; }
  /// First grain of a tile, or of what stands behind the last one; a multiple of four but for the end of all. Of many
  /// grains the last tiles may have none.
  std::int32_t first_grain(std::int32_t tile) const { return std::min(tile * tile_grains_, grains_); }
  /// The same for groups of four bodies.
  std::int32_t first_group(std::int32_t tile) const { return (first_grain(tile) + 3) / 4; }

  /// Number of regions; each stands behind all that it holds, and the last one is the bed.
  std::int32_t count() const { return static_cast<std::int32_t>(region_.size()); }
  const Region& operator[](std::int32_t region) const { return region_[region]; }
  std::int32_t second_half(std::int32_t region) const { return region - 1; }
  /// First of the regions that stand in a row in front of a region because it holds them; the region itself for a tile.
  std::int32_t first_inside(std::int32_t region) const;
  /// Index of the region that is a tile and nothing else.
  std::int32_t of_tile(std::int32_t tile) const { return of_tile_[tile]; }
  /// The smallest region that holds two tiles, given in any order.
  std::int32_t holding(std::int32_t a, std::int32_t b) const;

 private:
  std::int32_t grains_ = 0, tiles_ = 0, tile_grains_ = 4;
  std::vector<Region> region_;
  std::vector<std::int32_t> of_tile_;

  std::int32_t add(std::int32_t first_tile, std::int32_t last_tile);
};

}  // namespace seapile::grains
