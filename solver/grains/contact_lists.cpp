#include "solver/grains/contact_lists.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace seapile::grains {
namespace {

constexpr double kSkin = 0.5;  // gap below which pairs are listed, in largest radii: larger ones rarely help

/// A contact that waits for its lane.
template <class Real>
struct Candidate {
  std::int32_t i, j;
  std::int32_t pair;  ///< index of the pair, or -1 - index of the wall contact
  Real pn, pt;
};

/// Greedy colouring in the order given: each contact takes the lowest colour that neither of its grains has. Walls do
/// not constrain: their points belong to one contact each. Throws when a grain would need more than 64 * Words colours.
template <int Words>
class Colouring {
 public:
  explicit Colouring(std::size_t grain_count) : used_(grain_count) {}

  template <class Real>
  std::int32_t next(const Candidate<Real>& contact) {
    static const std::array<std::uint64_t, Words> kFree{};
    auto& a = used_[contact.i];
    auto* b = contact.pair >= 0 ? &used_[contact.j] : nullptr;
    for (int word = 0; word < Words; ++word) {
      const std::uint64_t taken = a[word] | (b ? (*b)[word] : kFree[word]);
      if (~taken == 0) continue;
      const std::uint64_t bit = ~taken & (taken + 1);
      a[word] |= bit;
      if (b) (*b)[word] |= bit;
      return word * 64 + std::countr_zero(bit);
    }
    throw std::runtime_error("a grain has more than " + std::to_string(64 * Words) + " neighbours");
  }

 private:
  std::vector<std::array<std::uint64_t, Words>> used_;
};

/// Gap of a grain to a wall.
double gap(const Disc& d, Wall wall, const Box& box) {
  switch (wall) {
    case Wall::left: return d.x - box.left - d.radius;
    case Wall::right: return box.right - d.x - d.radius;
    case Wall::base: return d.y - box.base - d.radius;
  }
  throw std::logic_error("unknown wall");
}

/// True when some grain has so many candidates that 64 colours might not do: two grains of 32 can block 62 colours.
template <class Real>
bool has_crowded_grain(const std::vector<Candidate<Real>>& contacts, std::size_t grain_count) {
  std::vector<std::int32_t> degree(grain_count);
  for (const Candidate<Real>& c : contacts) {
    ++degree[c.i];
    if (c.pair >= 0) ++degree[c.j];
  }
  return std::any_of(degree.begin(), degree.end(), [](std::int32_t d) { return d > 32; });
}

struct WallContact {
  Wall wall;
  std::int32_t grain;
  friend auto operator<=>(const WallContact&, const WallContact&) = default;
};

}  // namespace

template <class Real>
void list_contacts(ContactSystem<Real>& system, Grains& grains, const Box& box) {
  const std::size_t count = grains.count();
  const std::span<const Disc> discs(grains.disc.data(), count);
  ContactBlocks<Real>& blocks = system.blocks;

  std::vector<Pair> pairs = neighbour_pairs(discs, system.skin);
  std::vector<WallContact> walls;
  for (const Wall wall : {Wall::left, Wall::right, Wall::base})
    for (std::size_t i = 0; i < count; ++i)
      if (gap(discs[i], wall, box) < system.skin) walls.push_back({wall, static_cast<std::int32_t>(i)});

  // Impulses of the contacts that stay: old and new lists are both ascending.
  std::vector<Candidate<Real>> contacts;
  contacts.reserve(pairs.size() + walls.size());
  std::size_t old = 0;
  for (std::size_t p = 0; p < pairs.size(); ++p) {
    while (old < system.pair.size() && system.pair[old] < pairs[p]) ++old;
    Candidate<Real> c{pairs[p].i, pairs[p].j, static_cast<std::int32_t>(p), 0, 0};
    if (old < system.pair.size() && system.pair[old] == pairs[p]) {
      const std::int32_t slot = system.pair_slot[old];
      c.pn = blocks.block[slot / kLanes].pn[slot % kLanes];
      c.pt = blocks.block[slot / kLanes].pt[slot % kLanes];
    }
    contacts.push_back(c);
  }
  std::size_t old_wall = 0;
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const auto before = [&](std::size_t k) { return WallContact{blocks.wall[k], blocks.wall_grain[k]}; };
    while (old_wall < blocks.wall.size() && before(old_wall) < walls[w]) ++old_wall;
    Candidate<Real> c{walls[w].grain, first_point(count) + static_cast<std::int32_t>(w), -1 - static_cast<std::int32_t>(w), 0, 0};
    if (old_wall < blocks.wall.size() && before(old_wall) == walls[w]) {
      const std::int32_t slot = blocks.wall_slot[old_wall];
      c.pn = blocks.block[slot / kLanes].pn[slot % kLanes];
      c.pt = blocks.block[slot / kLanes].pt[slot % kLanes];
    }
    contacts.push_back(c);
  }

  // Near contacts first: they fill the first blocks of few colours, and blocks of far ones rest until they are needed.
  const double classes[] = {0.02 * system.skin, 0.06 * system.skin, 0.2 * system.skin};
  const auto distance_class = [&](const Candidate<Real>& c) {
    int k = 0;
    if (c.pn > 0) return k;
    if (c.pair < 0) {
      const double g = gap(discs[c.i], walls[-1 - c.pair].wall, box);
      while (k < 3 && g >= classes[k]) ++k;
      return k;
    }
    const Disc &a = discs[c.i], &b = discs[c.j];
    const double square = (b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y), sum = a.radius + b.radius;
    while (k < 3 && square >= (sum + classes[k]) * (sum + classes[k])) ++k;
    return k;
  };
  std::array<std::vector<Candidate<Real>>, 4> by_distance;
  for (const Candidate<Real>& c : contacts) by_distance[distance_class(c)].push_back(c);
  contacts.clear();
  for (const auto& members : by_distance) contacts.insert(contacts.end(), members.begin(), members.end());

  // Contacts by tile (the last one: between tiles) and colour; grain contacts and wall contacts apart.
  using Members = std::vector<std::vector<std::int32_t>>;
  const std::int32_t tiles = tile_count(count);
  std::vector<Members> inner(tiles + 1), outer(tiles + 1);
  const bool crowded = has_crowded_grain(contacts, count);
  Colouring<1> own(crowded ? 0 : count), between(crowded ? 0 : count);
  Colouring<64> own_crowded(crowded ? count : 0), between_crowded(crowded ? count : 0);
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const std::int32_t tile = contacts[c].i / kTileGrains;
    const bool crossing = contacts[c].pair >= 0 && contacts[c].j / kTileGrains != tile;
    const std::int32_t colour = crowded ? (crossing ? between_crowded : own_crowded).next(contacts[c])
                                        : (crossing ? between : own).next(contacts[c]);
    Members& members = (contacts[c].pair >= 0 ? inner : outer)[crossing ? tiles : tile];
    if (static_cast<std::size_t>(colour) >= members.size()) members.resize(colour + 1);
    members[colour].push_back(static_cast<std::int32_t>(c));
  }

  system.pair = std::move(pairs);
  system.pair_slot.assign(system.pair.size(), 0);
  blocks = {};
  blocks.wall_slot.assign(walls.size(), 0);
  for (const WallContact& w : walls) {
    blocks.wall.push_back(w.wall);
    blocks.wall_grain.push_back(w.grain);
  }
  std::int32_t filler = first_point(count) + static_cast<std::int32_t>(walls.size());
  const auto fill = [&](const std::vector<std::int32_t>& members) {
    for (std::size_t first = 0; first < members.size(); first += kLanes) {
      ContactBlock<Real>& block = blocks.block.emplace_back();
      for (int lane = 0; lane < kLanes; ++lane) {
        if (first + lane >= members.size()) {
          block.i[lane] = place_of(filler++);
          block.j[lane] = place_of(filler++);
          continue;
        }
        const Candidate<Real>& c = contacts[members[first + lane]];
        const auto slot = static_cast<std::int32_t>((blocks.block.size() - 1) * kLanes) + lane;
        (c.pair >= 0 ? system.pair_slot[c.pair] : blocks.wall_slot[-1 - c.pair]) = slot;
        block.i[lane] = place_of(c.i);
        block.j[lane] = place_of(c.j);
        block.pn[lane] = c.pn;
        block.pt[lane] = c.pt;
        const double inverse = 1 / grains.mass[c.i] + (c.pair >= 0 ? 1 / grains.mass[c.j] : 0);
        block.mass[lane] = static_cast<Real>(1 / inverse);
      }
    }
  };
  // Per colour: grain contacts, near to far, then wall contacts, each filled up to whole blocks.
  for (std::int32_t tile = 0; tile <= tiles; ++tile) {
    blocks.tile_colour.push_back(static_cast<std::int32_t>(blocks.colour.size()));
    for (std::size_t k = 0; k < std::max(inner[tile].size(), outer[tile].size()); ++k) {
      Colour& c = blocks.colour.emplace_back();
      c.first = static_cast<std::int32_t>(blocks.block.size());
      if (k < inner[tile].size()) fill(inner[tile][k]);
      c.first_wall = static_cast<std::int32_t>(blocks.block.size());
      if (k < outer[tile].size()) fill(outer[tile][k]);
      c.last = static_cast<std::int32_t>(blocks.block.size());
    }
  }
  blocks.wake.assign(blocks.block.size(), 0);
  blocks.bodies = filler;

  system.listed.resize(count);
  for (std::size_t i = 0; i < count; ++i) system.listed[i] = {discs[i].x, discs[i].y};
  system.listed_closing = system.closing;
  ++system.rebuilds;
  refresh_derived(system, grains);
}

template <class Real>
void refresh_derived(ContactSystem<Real>& system, Grains& grains) {
  const std::size_t count = grains.count();
  ContactBlocks<Real>& blocks = system.blocks;
  const std::size_t bodies = (static_cast<std::size_t>(blocks.bodies) + 3) / 4 * 4;

  // Bodies after the grains do not move; fillers stand in pairs one apart, so that their normal is a number.
  system.group.resize(bodies / 4);
  for (std::size_t body = count; body < bodies; ++body) system.motion(static_cast<std::int32_t>(body)) = {};
  system.before.assign(bodies, {});
  for (std::size_t i = 0; i < count; ++i) {
    system.before[i].half_mass = static_cast<Real>(0.5 * grains.mass[i]);
    system.motion(static_cast<std::int32_t>(i)).inverse_mass = static_cast<Real>(1 / grains.mass[i]);
  }
  grains.disc.resize(count);
  grains.disc.resize(bodies);
  for (std::size_t body = first_point(count) + blocks.wall.size() + 1; body < bodies; body += 2) grains.disc[body].x = 1;

  blocks.active.assign(blocks.block.size(), 1);
  blocks.step_impulse.assign(blocks.block.size(), {});
  system.smallest_radius = 0;
  for (std::size_t i = 0; i < count; ++i)
    system.smallest_radius = i == 0 ? grains.disc[i].radius : std::min(system.smallest_radius, grains.disc[i].radius);
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
      case Wall::left: foot.x = box.left, foot.y = grain.y; break;
      case Wall::right: foot.x = box.right, foot.y = grain.y; break;
      case Wall::base: foot.x = grain.x, foot.y = box.base; break;
    }
  }
}

template void list_contacts(ContactSystem<float>&, Grains&, const Box&);
template void list_contacts(ContactSystem<double>&, Grains&, const Box&);
template void refresh_derived(ContactSystem<float>&, Grains&);
template void refresh_derived(ContactSystem<double>&, Grains&);
template void enclose(ContactSystem<float>&, Grains&);
template void enclose(ContactSystem<double>&, Grains&);
template void place_wall_points(const ContactSystem<float>&, Grains&, const Box&);
template void place_wall_points(const ContactSystem<double>&, Grains&, const Box&);

}  // namespace seapile::grains
