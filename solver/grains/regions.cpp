#include "solver/grains/regions.h"

#include <algorithm>

namespace seapile::grains {

Regions::Regions(std::size_t grain_count) : grains_(static_cast<std::int32_t>(grain_count)) {
  if (grains_ == 0) return;
  // As many tiles as can be halved twice, so that two or four threads have equal shares.
  tiles_ = (grains_ + kTileGrains - 1) / kTileGrains;
  const std::int32_t unit = tiles_ > 8 ? 4 : tiles_ > 1 ? 2 : 1;
  tiles_ = (tiles_ + unit - 1) / unit * unit;
  tile_grains_ = (grains_ + 4 * tiles_ - 1) / (4 * tiles_) * 4;
  of_tile_.resize(tiles_);
  add(0, tiles_);
}

std::int32_t Regions::add(std::int32_t first_tile, std::int32_t last_tile) {
  Region region{first_tile, last_tile, -1};
  if (last_tile - first_tile > kUncutTiles) {
    const std::int32_t cut = (first_tile + last_tile + 1) / 2;
    region.first_half = add(first_tile, cut);
    add(cut, last_tile);
  } else if (!region.is_tile()) {
    for (std::int32_t tile = first_tile; tile < last_tile; ++tile) add(tile, tile + 1);
  }
  region_.push_back(region);
  if (region.is_tile()) of_tile_[first_tile] = count() - 1;
  return count() - 1;
}

std::int32_t Regions::first_inside(std::int32_t region) const { return of_tile_[region_[region].first_tile]; }

std::int32_t Regions::holding(std::int32_t a, std::int32_t b) const {
  if (a == b) return of_tile_[a];
  const auto [low, high] = std::minmax(a, b);
  std::int32_t region = count() - 1;
  while (region_[region].first_half >= 0) {
    const std::int32_t cut = region_[region_[region].first_half].last_tile;
    if (low < cut && cut <= high) break;
    region = high < cut ? region_[region].first_half : second_half(region);
  }
  return region;
}

}  // namespace seapile::grains
