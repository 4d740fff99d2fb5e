#include "solver/grains/contact_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "solver/grains/share.h"

namespace seapile::grains {
namespace {

constexpr double kSkin = 0.5;  // gap below which pairs are listed, in largest radii: larger ones rarely help
constexpr double kDistance[] = {0.02, 0.06, 0.2};  // gaps below which contacts are near, in skins
constexpr int kDistances = 4;

/// A contact that waits for its lane.
template <class Real>
struct Candidate {
  std::int32_t i, j;      ///< j of a wall contact: unused
  std::int32_t index;     ///< of the pair, or of the wall contact
  std::int32_t distance;  ///< class: near ones are put first
  bool wall;
  Real pn, pt;
};

struct WallContact {
  Wall wall;
  std::int32_t grain;
  friend auto operator<=>(const WallContact&, const WallContact&) = default;
};

constexpr Wall kWalls[] = {Wall::left, Wall::right, Wall::base};

/// Gap of a grain to a wall.
double gap(const Disc& d, Wall wall, const Box& box) {
  switch (wall) {
    case Wall::left:
      return d.x - box.left - d.radius;
    case Wall::right:
      return box.right - d.x - d.radius;
    case Wall::base:
      return d.y - box.base - d.radius;
  }
  throw std::logic_error("unknown wall");
}

/// Greedy colouring in the order given: each contact takes the lowest colour that neither of its grains has. Walls do
/// not constrain: their points belong to one contact each. Grains are those of [first, first + count).
class Colouring {
 public:
  Colouring(std::int32_t first, std::int32_t count) : first_(first), used_(count) {}

  template <class Real>
  std::int32_t next(const Candidate<Real>& contact) {
    std::uint64_t& a = used_[contact.i - first_];
    std::uint64_t* b = contact.wall ? nullptr : &used_[contact.j - first_];
    const std::uint64_t taken = a | (b ? *b : 0);
    if (~taken != 0) {
      const std::uint64_t bit = ~taken & (taken + 1);
      a |= bit;
      if (b) *b |= bit;
      return std::countr_zero(bit);
    }
    // A crowd: grains of very different sizes.
    for (std::int32_t colour = 64;; ++colour) {
      if (beyond_.contains({contact.i, colour}) || (b && beyond_.contains({contact.j, colour}))) continue;
      beyond_.insert({contact.i, colour});
      if (b) beyond_.insert({contact.j, colour});
      return colour;
    }
  }

 private:
  std::int32_t first_;
  std::vector<std::uint64_t> used_;                         ///< colours below 64, a bit each
  std::set<std::pair<std::int32_t, std::int32_t>> beyond_;  ///< grain and colour, for the others
};

/// Near contacts first: they fill the first blocks of few colours, and blocks of far ones rest until they are needed.
template <class Real>
void sort_by_distance(std::vector<Candidate<Real>>& contacts, std::vector<Candidate<Real>>& scratch) {
  std::array<std::size_t, kDistances + 1> start{};
  for (const Candidate<Real>& c : contacts) ++start[c.distance + 1];
  for (int k = 0; k < kDistances; ++k) start[k + 1] += start[k];
  scratch.resize(contacts.size());
  for (const Candidate<Real>& c : contacts) scratch[start[c.distance]++] = c;
  contacts.swap(scratch);
}

/// What is found from a tile's grains on.
template <class Real>
struct TileList {
  std::vector<Pair> pairs;                         ///< whose first grain is in the tile, ascending
  std::array<std::vector<std::int32_t>, 3> walls;  ///< grains of the tile at each wall, ascending
  std::int32_t first_pair = 0;
  std::array<std::int32_t, 3> first_wall{};
  std::vector<Candidate<Real>> own;           ///< of pairs within the tile, then of walls
  std::vector<Candidate<Real>> crossing;      ///< of pairs with grains of later tiles
  std::vector<std::int32_t> crossing_region;  ///< to which those belong
};

/// The contacts of a region while they are coloured and put into blocks.
template <class Real>
struct Group {
  std::vector<Candidate<Real>> contacts;             ///< near ones first
  std::vector<std::int32_t> colour;                  ///< (contacts)
  std::vector<std::array<std::int32_t, 2>> members;  ///< per colour: contacts of grains, with walls
  std::int32_t blocks = 0, empty_lanes = 0, first_block = 0, first_colour = 0, first_filler = 0;

  void give_colours(std::int32_t first_grain, std::int32_t grain_count) {
    Colouring colouring(first_grain, grain_count);
    for (const Candidate<Real>& c : contacts) {
      const std::int32_t k = colouring.next(c);
      if (static_cast<std::size_t>(k) >= members.size()) members.resize(k + 1);
      ++members[k][c.wall];
      colour.push_back(k);
    }
    for (const auto& kinds : members)
      for (const std::int32_t count : kinds) {
        blocks += (count + kLanes - 1) / kLanes;
        empty_lanes += (kLanes - count % kLanes) % kLanes;
      }
  }
};

/// The list that is being replaced, and what is needed to find contacts for a new one.
template <class Real>
class Lister {
 public:
  Lister(const ContactSystem<Real>& system, const Grains& grains, const Box& box)
      : old_(system),
        regions_(system.regions),
        grains_(grains),
        box_(box),
        grid_({grains.disc.data(), grains.count()}, system.skin) {}

  /// Pairs and wall contacts of a tile.
  void find(std::int32_t tile, TileList<Real>& list) const {
    const std::int32_t first = regions_.first_grain(tile), last = regions_.first_grain(tile + 1);
    list.pairs.reserve(4 * kTileGrains);
    grid_.find_pairs(first, last, list.pairs);
    for (int wall = 0; wall < 3; ++wall)
      for (std::int32_t i = first; i < last; ++i)
        if (gap(grains_.disc[i], kWalls[wall], box_) < old_.skin) list.walls[wall].push_back(i);
  }

  /// Contacts of a tile from its pairs and walls, with the impulses of those that stay.
  void collect(std::int32_t tile, TileList<Real>& list) const {
    // Old and new lists are both ascending.
    auto old = std::lower_bound(old_.pair.begin(), old_.pair.end(), Pair{regions_.first_grain(tile), -1});
    for (std::size_t p = 0; p < list.pairs.size(); ++p) {
      const Pair pair = list.pairs[p];
      while (old != old_.pair.end() && *old < pair) ++old;
      Candidate<Real> c{pair.i, pair.j, list.first_pair + static_cast<std::int32_t>(p), 0, false, 0, 0};
      if (old != old_.pair.end() && *old == pair) keep_impulse(old_.pair_slot[old - old_.pair.begin()], c);
      c.distance = c.pn > 0 ? 0 : distance_of(pair);
      const std::int32_t other = regions_.tile_of(pair.j);
      if (other == tile) {
        list.own.push_back(c);
      } else {
        list.crossing.push_back(c);
        list.crossing_region.push_back(regions_.holding(tile, other));
      }
    }
    for (int wall = 0; wall < 3; ++wall) {
      std::size_t old_wall = 0;
      const auto before = [&](std::size_t k) { return WallContact{old_.blocks.wall[k], old_.blocks.wall_grain[k]}; };
      for (std::size_t w = 0; w < list.walls[wall].size(); ++w) {
        const WallContact contact{kWalls[wall], list.walls[wall][w]};
        while (old_wall < old_.blocks.wall.size() && before(old_wall) < contact) ++old_wall;
        Candidate<Real> c{contact.grain, 0, list.first_wall[wall] + static_cast<std::int32_t>(w), 0, true, 0, 0};
        if (old_wall < old_.blocks.wall.size() && before(old_wall) == contact)
          keep_impulse(old_.blocks.wall_slot[old_wall], c);
        const double g = gap(grains_.disc[contact.grain], contact.wall, box_);
        while (c.pn == 0 && c.distance < kDistances - 1 && g >= kDistance[c.distance] * old_.skin) ++c.distance;
        list.own.push_back(c);
      }
    }
  }

  /// Contacts of a region, in colours.
  void group(std::int32_t region, const std::vector<TileList<Real>>& lists, Group<Real>& group) const {
    const Region& r = regions_[region];
    if (r.is_tile())
      group.contacts = lists[r.first_tile].own;
    else
      for (std::int32_t tile = r.first_tile; tile < r.last_tile; ++tile)
        for (std::size_t k = 0; k < lists[tile].crossing.size(); ++k)
          if (lists[tile].crossing_region[k] == region) group.contacts.push_back(lists[tile].crossing[k]);
    std::vector<Candidate<Real>> scratch;
    sort_by_distance(group.contacts, scratch);
    const std::int32_t first = regions_.first_grain(r.first_tile);
    group.give_colours(first, regions_.first_grain(r.last_tile) - first);
  }

 private:
  void keep_impulse(std::int32_t slot, Candidate<Real>& c) const {
    c.pn = old_.blocks.block[slot / kLanes].pn[slot % kLanes];
    c.pt = old_.blocks.block[slot / kLanes].pt[slot % kLanes];
  }
  int distance_of(Pair pair) const {
    const Disc &a = grains_.disc[pair.i], &b = grains_.disc[pair.j];
    const double square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y), sum = a.radius + b.radius;
    int k = 0;
    while (k < kDistances - 1 && square >= (sum + kDistance[k] * old_.skin) * (sum + kDistance[k] * old_.skin)) ++k;
    return k;
  }

  const ContactSystem<Real>& old_;
  const Regions& regions_;
  const Grains& grains_;
  const Box& box_;
  CellGrid grid_;
};

/// Puts a group's contacts into its blocks: per colour those of grains, near to far, then those with walls, each filled
/// up to whole blocks.
template <class Real>
void fill(const Group<Real>& group, const Grains& grains, ContactSystem<Real>& system) {
  ContactBlocks<Real>& blocks = system.blocks;
  std::fill_n(blocks.block.begin() + group.first_block, group.blocks, ContactBlock<Real>{});
  std::vector<std::array<std::int32_t, 2>> next(group.members.size());  // lane at which the next contact goes
  std::int32_t block = group.first_block, filler = group.first_filler;
  for (std::size_t k = 0; k < group.members.size(); ++k) {
    Colour& colour = blocks.colour[group.first_colour + k];
    for (const int wall : {0, 1}) {
      (wall ? colour.first_wall : colour.first) = block;
      next[k][wall] = block * kLanes;
      const std::int32_t count = group.members[k][wall], last = block + (count + kLanes - 1) / kLanes;
      for (std::int32_t slot = block * kLanes + count; slot < last * kLanes; ++slot) {
        blocks.block[slot / kLanes].i[slot % kLanes] = place_of(filler++);
        blocks.block[slot / kLanes].j[slot % kLanes] = place_of(filler++);
      }
      block = last;
    }
    colour.last = block;
  }
  for (std::size_t n = 0; n < group.contacts.size(); ++n) {
    const Candidate<Real>& c = group.contacts[n];
    const std::int32_t slot = next[group.colour[n]][c.wall]++;
    (c.wall ? blocks.wall_slot : system.pair_slot)[c.index] = slot;
    ContactBlock<Real>& b = blocks.block[slot / kLanes];
    const int lane = slot % kLanes;
    b.i[lane] = place_of(c.i);
    b.j[lane] = place_of(c.wall ? first_point(grains.count()) + c.index : c.j);
    b.pn[lane] = c.pn;
    b.pt[lane] = c.pt;
    b.mass[lane] = static_cast<Real>(1 / (1 / grains.mass[c.i] + (c.wall ? 0 : 1 / grains.mass[c.j])));
  }
}

/// The bodies after the grains, and what there is of each block. Fillers do not move and stand in pairs one apart, so
/// that their normal is a number.
template <class Real>
void place_fillers(ContactSystem<Real>& system, Grains& grains) {
  const std::size_t count = grains.count();
  const ContactBlocks<Real>& blocks = system.blocks;
  const std::size_t bodies = (static_cast<std::size_t>(blocks.bodies) + 3) / 4 * 4;
  system.group.resize(bodies / 4);
  for (std::size_t body = count; body < bodies; ++body) system.motion(static_cast<std::int32_t>(body)) = {};
  system.before.resize(bodies);
  std::fill(system.before.begin() + static_cast<std::ptrdiff_t>(count), system.before.end(), Before<Real>{});
  grains.disc.resize(bodies);
  std::fill(grains.disc.begin() + static_cast<std::ptrdiff_t>(count), grains.disc.end(), Disc{});
  for (std::size_t body = first_point(count) + blocks.wall.size() + 1; body < bodies; body += 2)
    grains.disc[body].x = 1;
  system.blocks.active.assign(blocks.block.size(), 1);
  system.blocks.step_impulse.resize(blocks.block.size());
}

}  // namespace

template <class Real>
void list_contacts(ContactSystem<Real>& system, Grains& grains, const Box& box, base::Crew* crew) {
  const Regions& regions = system.regions;
  const std::int32_t tiles = regions.tiles();
  const Lister<Real> lister(system, grains, box);
  std::vector<TileList<Real>> lists(tiles);
  for_tiles(regions, crew, [&](std::int32_t tile) { lister.find(tile, lists[tile]); });

  // Numbers of pairs and wall contacts: pairs by tile, walls by wall and then by tile, so that both lists ascend.
  std::int32_t pairs = 0, walls = 0;
  for (TileList<Real>& list : lists) {
    list.first_pair = pairs;
    pairs += static_cast<std::int32_t>(list.pairs.size());
  }
  for (int wall = 0; wall < 3; ++wall)
    for (TileList<Real>& list : lists) {
      list.first_wall[wall] = walls;
      walls += static_cast<std::int32_t>(list.walls[wall].size());
    }

  for_tiles(regions, crew, [&](std::int32_t tile) { lister.collect(tile, lists[tile]); });
  std::vector<Group<Real>> groups(regions.count());
  for_regions(regions, crew, [&](std::int32_t region) { lister.group(region, lists, groups[region]); });

  // Places of the groups' blocks, colours and fillers.
  ContactBlocks<Real>& blocks = system.blocks;
  blocks.region_colour.clear();
  std::int32_t block = 0, colour = 0, filler = first_point(grains.count()) + walls;
  for (Group<Real>& group : groups) {
    blocks.region_colour.push_back(colour);
    group.first_block = block;
    group.first_colour = colour;
    group.first_filler = filler;
    block += group.blocks;
    colour += static_cast<std::int32_t>(group.members.size());
    filler += 2 * group.empty_lanes;
  }
  blocks.region_colour.push_back(colour);
  blocks.block.resize(block);  // each region's thread clears its own
  blocks.colour.assign(colour, {});
  blocks.wake.assign(block, 0);
  blocks.bodies = filler;
  blocks.wall.clear();
  blocks.wall_grain.clear();
  for (int wall = 0; wall < 3; ++wall)
    for (const TileList<Real>& list : lists)
      for (const std::int32_t grain : list.walls[wall]) {
        blocks.wall.push_back(kWalls[wall]);
        blocks.wall_grain.push_back(grain);
      }
  blocks.wall_slot.assign(walls, 0);
  system.pair.resize(pairs);
  system.pair_slot.assign(pairs, 0);

  for_regions(regions, crew, [&](std::int32_t region) { fill(groups[region], grains, system); });
  system.listed.resize(grains.count());
  for_tiles(regions, crew, [&](std::int32_t tile) {
    std::copy(lists[tile].pairs.begin(), lists[tile].pairs.end(), system.pair.begin() + lists[tile].first_pair);
    const std::int32_t last = regions.first_grain(tile + 1);
    for (std::int32_t i = regions.first_grain(tile); i < last; ++i)
      system.listed[i] = {grains.disc[i].x, grains.disc[i].y};
  });

  system.listed_closing = system.closing;
  ++system.rebuilds;
  place_fillers(system, grains);
}

template <class Real>
void refresh_derived(ContactSystem<Real>& system, Grains& grains) {
  const std::size_t count = grains.count();
  system.regions = Regions(count);
  place_fillers(system, grains);
  system.smallest_radius = 0;
  for (std::size_t i = 0; i < count; ++i) {
    system.before[i].half_mass = static_cast<Real>(0.5 * grains.mass[i]);
    system.motion(static_cast<std::int32_t>(i)).inverse_mass = static_cast<Real>(1 / grains.mass[i]);
    const double r = grains.disc[i].radius;
    system.smallest_radius = i == 0 ? r : std::min(system.smallest_radius, r);
  }
}

template <class Real>
void enclose(ContactSystem<Real>& system, Grains& grains) {
  double largest = 0;
  for (std::size_t i = 0; i < grains.count(); ++i) largest = std::max(largest, grains.disc[i].radius);
  system.skin = kSkin * largest;
  system.closing = system.listed_closing = 0;
  system.group.clear();
  system.blocks = {};
  system.blocks.bodies = first_point(grains.count());
  system.pair.clear();
  system.pair_slot.clear();
  system.listed.clear();
  refresh_derived(system, grains);
}

template <class Real>
void place_wall_points(const ContactSystem<Real>& system, Grains& grains, const Box& box) {
  const std::size_t count = grains.count();
  for (std::size_t k = 0; k < system.blocks.wall.size(); ++k) {
    const Disc& grain = grains.disc[system.blocks.wall_grain[k]];
    Disc& foot = grains.disc[first_point(count) + k];
    switch (system.blocks.wall[k]) {
      case Wall::left:
        foot.x = box.left, foot.y = grain.y;
        break;
      case Wall::right:
        foot.x = box.right, foot.y = grain.y;
        break;
      case Wall::base:
        foot.x = grain.x, foot.y = box.base;
        break;
    }
  }
}

template void list_contacts(ContactSystem<float>&, Grains&, const Box&, base::Crew*);
template void list_contacts(ContactSystem<double>&, Grains&, const Box&, base::Crew*);
template void refresh_derived(ContactSystem<float>&, Grains&);
template void refresh_derived(ContactSystem<double>&, Grains&);
template void enclose(ContactSystem<float>&, Grains&);
template void enclose(ContactSystem<double>&, Grains&);
template void place_wall_points(const ContactSystem<float>&, Grains&, const Box&);
template void place_wall_points(const ContactSystem<double>&, Grains&, const Box&);

}  // namespace seapile::grains
