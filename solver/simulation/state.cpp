#include "solver/simulation/state.h"

#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "solver/grains/contact_lists.h"
#include "solver/simulation/simulation.h"
#include "solver/simulation/step.h"
#include "solver/simulation/water_state.h"

namespace seapile::simulation {
namespace {

using grains::ContactSystem;

constexpr const char* kStepping = "clock/rejected";

template <class T>
ArrayView view(const std::vector<T>& values) {
  return std::span<const T>(values);
}

/// The state as arrays. Structures of mixed content are taken apart here and put together in put(); both walk the same
/// list, so a name cannot be in one and missing in the other without restore() refusing.
struct Parts {
  std::vector<std::pair<ArrayInfo, ArrayValues>> arrays;
  template <class T>
  void add(const char* name, const char* unit, const char* meaning, int columns, Entity entity, std::vector<T> values) {
    arrays.push_back({{name, unit, meaning, columns, entity}, std::move(values)});
  }
};

template <class Real>
void take_contacts(const ContactSystem<Real>& system, std::size_t count, Parts& parts) {
  std::vector<Real> velocity, spin;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& m = system.motion(static_cast<std::int32_t>(i));
    velocity.insert(velocity.end(), {m.vx, m.vy});
    spin.push_back(m.u);
  }
  parts.add("grains/velocity", "m/s", "velocity of the centre", 2, Entity::grain, std::move(velocity));
  parts.add("grains/surface_speed", "m/s", "spin times radius, anticlockwise", 1, Entity::grain, std::move(spin));

  std::vector<double> listed;
  for (const base::Vec2& p : system.listed) listed.insert(listed.end(), {p.x, p.y});
  parts.add("list/position", "m", "places when the neighbour list was made", 2, Entity::grain, std::move(listed));
  std::vector<std::int32_t> pair;
  for (const grains::Pair& p : system.pair) pair.insert(pair.end(), {p.i, p.j});
  parts.add("list/pair", "-", "pairs of the neighbour list", 2, Entity::contact, std::move(pair));
  parts.add("list/slot", "-", "lane of each pair", 1, Entity::contact, system.pair_slot);

  const auto& blocks = system.blocks;
  std::vector<std::int32_t> bodies, colour, wall;
  std::vector<Real> mass, impulse;
  for (const auto& b : blocks.block)
    for (int lane = 0; lane < grains::kLanes; ++lane) {
      bodies.insert(bodies.end(), {b.i[lane], b.j[lane]});
      mass.push_back(b.mass[lane]);
      impulse.insert(impulse.end(), {b.pn[lane], b.pt[lane]});
    }
  for (const auto& c : blocks.colour) colour.insert(colour.end(), {c.first, c.first_wall, c.last});
  for (std::size_t k = 0; k < blocks.wall.size(); ++k)
    wall.insert(wall.end(), {blocks.wall_grain[k], static_cast<std::int32_t>(blocks.wall[k]), blocks.wall_slot[k]});
  parts.add("blocks/bodies", "-", "places of both bodies of each lane", 2, Entity::contact, std::move(bodies));
  parts.add("blocks/mass", "kg/m", "effective mass of each lane", 1, Entity::contact, std::move(mass));
  parts.add("blocks/impulse", "N s/m", "normal and tangential impulse of the last sub-step", 2, Entity::contact, std::move(impulse));
  parts.add("blocks/wake", "m", "closing at which a resting block is looked at again", 1, Entity::contact, blocks.wake);
  parts.add("blocks/region_colour", "-", "first colour of each region, and the end", 1, Entity::run, blocks.region_colour);
  parts.add("list/closing", "m", "closing so far, and when the list was made", 1, Entity::run,
            std::vector<double>{system.closing, system.listed_closing});
  parts.add("blocks/colour", "-", "first block, first wall block, end of each colour", 3, Entity::run, std::move(colour));
  parts.add("blocks/wall", "-", "grain, wall, lane of each wall contact", 3, Entity::contact, std::move(wall));
  parts.add("blocks/bodies_count", "-", "bodies with points and fillers", 1, Entity::run,
            std::vector<std::int64_t>{blocks.bodies, system.rebuilds});
}

void take_contacts(const grains::AllPairs& system, std::size_t, Parts& parts) {
  std::vector<double> velocity, spin, impulse;
  for (const auto& m : system.body) {
    velocity.insert(velocity.end(), {m.vx, m.vy});
    spin.push_back(m.u);
  }
  std::vector<std::int32_t> bodies;
  for (const grains::KeptContact& c : system.kept) {
    bodies.insert(bodies.end(), {c.first, c.second});
    impulse.insert(impulse.end(), {c.pn, c.pt});
  }
  parts.add("grains/velocity", "m/s", "velocity of the centre", 2, Entity::grain, std::move(velocity));
  parts.add("grains/surface_speed", "m/s", "spin times radius, anticlockwise", 1, Entity::grain, std::move(spin));
  parts.add("pairs/bodies", "-", "grain, and grain, wall or pile", 2, Entity::contact, std::move(bodies));
  parts.add("pairs/impulse", "N s/m", "normal and tangential impulse of the last sub-step", 2, Entity::contact, std::move(impulse));
}

/// `pushed`: with the grains' push and its work, as for grains that have one. `halved`: with what is known of rejected
/// steps, as for a run that has some.
Parts take(const Simulation& sim, bool pushed, bool halved) {
  Parts parts;
  const std::size_t count = sim.grains.count();
  parts.add("clock/step", "-", "steps done", 1, Entity::run, std::vector<std::int64_t>{sim.clock.step});

  std::vector<double> position, radius, origin;
  for (std::size_t i = 0; i < count; ++i) {
    const grains::Disc& d = sim.grains.disc[i];
    position.insert(position.end(), {d.x, d.y});
    radius.push_back(d.radius);
    origin.insert(origin.end(), {sim.origin[i].x, sim.origin[i].y});
  }
  parts.add("grains/id", "-", "name of the grain", 1, Entity::grain, sim.grains.id);
  parts.add("grains/position", "m", "place of the centre", 2, Entity::grain, std::move(position));
  parts.add("grains/radius", "m", "radius", 1, Entity::grain, std::move(radius));
  parts.add("grains/origin", "m", "place at the start", 2, Entity::grain, std::move(origin));
  std::visit([&](const auto& system) { take_contacts(system, count, parts); }, sim.contacts);

  std::vector<double> pile;
  std::vector<std::int32_t> touched;
  std::vector<double> pressed;
  if (sim.pile) {
    const auto& body = sim.pile->body;
    pile = {sim.pile->start, sim.pile->travel, body.position.x, body.position.y, body.velocity.x, body.velocity.y, body.listed_travel};
    for (const auto& c : body.contact) {
      touched.push_back(c.grain);
      pressed.insert(pressed.end(), {c.pn, c.pt});
    }
  }
  parts.add("pile/motion", "m", "start, travel, place (2), velocity (2), path since listed", 1, Entity::run, std::move(pile));
  parts.add("pile/grain", "-", "grains near the pile", 1, Entity::contact, std::move(touched));
  parts.add("pile/impulse", "N s/m", "normal and tangential impulse of the last sub-step", 2, Entity::contact, std::move(pressed));

  const auto& t = sim.totals;
  std::vector<double> totals = {t.left.x, t.left.y, t.right.x, t.right.y, t.base.x, t.base.y, t.body_work, t.dissipation};
  for (const auto& f : t.feature) totals.insert(totals.end(), {f.x, f.y});
  parts.add("totals", "N s/m", "impulses on the walls, work and dissipation [J/m], impulses on the pile", 1, Entity::run, std::move(totals));
  const auto& g = sim.gathering;
  parts.add("gathering", "-", "time, travel, place, residual, overlap, steps since the last record", 1, Entity::run,
            std::vector<double>{g.time, g.travel, g.position, g.residual, g.overlap, static_cast<double>(g.steps)});
  if (halved) {
    parts.add("clock/part", "-", "ticks since the last whole step, halvings", 1, Entity::run,
              std::vector<std::int64_t>{sim.clock.part, sim.clock.halvings});
    Array rejected = as_array(sim.stepping, kStepping);
    parts.arrays.emplace_back(std::move(rejected.info), std::move(rejected.values));
  }
  if (!pushed) return parts;

  std::vector<double> push;
  for (const base::Vec2& a : sim.grains.push) push.insert(push.end(), {a.x, a.y});
  push.resize(2 * count);
  parts.add("grains/push", "m/s2", "acceleration by forces besides gravity and contacts", 2, Entity::grain,
            std::move(push));
  parts.add("push/work", "J/m", "work of the push since the start", 1, Entity::run,
            std::vector<double>{t.push_work});
  return parts;
}

Parts take(const Simulation& sim) { return take(sim, !sim.grains.push.empty(), sim.stepping != Stepping{}); }

bool has(const std::vector<Array>& state, const std::string& name) {
  return std::ranges::any_of(state, [&](const Array& array) { return array.info.name == name; });
}
bool is_pushed(const std::vector<Array>& state) { return has(state, "grains/push"); }
bool is_halved(const std::vector<Array>& state) { return has(state, kStepping); }

/// Hands out the arrays of a snapshot by name, typed.
class Source {
 public:
  explicit Source(const std::vector<Array>& state) : state_(state) {}
  template <class T>
  const std::vector<T>& get(const char* name) const {
    for (const Array& array : state_)
      if (array.info.name == name) return std::get<std::vector<T>>(array.values);
    throw std::logic_error(name);
  }

 private:
  const std::vector<Array>& state_;
};

template <class Real>
void put_contacts(ContactSystem<Real>& system, grains::Grains& grains, const Source& source) {
  const auto& pair = source.get<std::int32_t>("list/pair");
  system.pair.clear();
  for (std::size_t k = 0; k < pair.size(); k += 2) system.pair.push_back({pair[k], pair[k + 1]});
  system.pair_slot = source.get<std::int32_t>("list/slot");
  const auto& listed = source.get<double>("list/position");
  system.listed.clear();
  for (std::size_t k = 0; k < listed.size(); k += 2) system.listed.push_back({listed[k], listed[k + 1]});

  auto& blocks = system.blocks;
  blocks = {};
  const auto& bodies = source.get<std::int32_t>("blocks/bodies");
  const auto& mass = source.get<Real>("blocks/mass");
  const auto& impulse = source.get<Real>("blocks/impulse");
  blocks.block.resize(mass.size() / grains::kLanes);
  for (std::size_t k = 0; k < mass.size(); ++k) {
    auto& b = blocks.block[k / grains::kLanes];
    const std::size_t lane = k % grains::kLanes;
    b.i[lane] = bodies[2 * k];
    b.j[lane] = bodies[2 * k + 1];
    b.mass[lane] = mass[k];
    b.pn[lane] = impulse[2 * k];
    b.pt[lane] = impulse[2 * k + 1];
  }
  const auto& colour = source.get<std::int32_t>("blocks/colour");
  for (std::size_t k = 0; k < colour.size(); k += 3) blocks.colour.push_back({colour[k], colour[k + 1], colour[k + 2]});
  const auto& wall = source.get<std::int32_t>("blocks/wall");
  for (std::size_t k = 0; k < wall.size(); k += 3) {
    blocks.wall_grain.push_back(wall[k]);
    blocks.wall.push_back(static_cast<grains::Wall>(wall[k + 1]));
    blocks.wall_slot.push_back(wall[k + 2]);
  }
  blocks.wake = source.get<double>("blocks/wake");
  blocks.region_colour = source.get<std::int32_t>("blocks/region_colour");
  system.closing = source.get<double>("list/closing")[0];
  system.listed_closing = source.get<double>("list/closing")[1];
  const auto& counts = source.get<std::int64_t>("blocks/bodies_count");
  blocks.bodies = static_cast<std::int32_t>(counts[0]);
  system.rebuilds = counts[1];

  refresh_derived(system, grains);
  const auto& velocity = source.get<Real>("grains/velocity");
  const auto& spin = source.get<Real>("grains/surface_speed");
  for (std::size_t i = 0; i < grains.count(); ++i) {
    auto& m = system.motion(static_cast<std::int32_t>(i));
    m.vx = velocity[2 * i];
    m.vy = velocity[2 * i + 1];
    m.u = spin[i];
  }
}

void put_contacts(grains::AllPairs& system, grains::Grains&, const Source& source) {
  const auto& velocity = source.get<double>("grains/velocity");
  const auto& spin = source.get<double>("grains/surface_speed");
  for (std::size_t i = 0; i < system.body.size(); ++i) {
    system.body[i].vx = velocity[2 * i];
    system.body[i].vy = velocity[2 * i + 1];
    system.body[i].u = spin[i];
  }
  const auto& bodies = source.get<std::int32_t>("pairs/bodies");
  const auto& impulse = source.get<double>("pairs/impulse");
  system.kept.clear();
  for (std::size_t k = 0; k < bodies.size(); k += 2)
    system.kept.push_back({bodies[k], bodies[k + 1], impulse[k], impulse[k + 1]});
}

std::size_t size(const ArrayValues& values) {
  return std::visit([](const auto& v) { return v.size(); }, values);
}

/// Throws unless the lists of a snapshot fit each other: every lane is a pair, a wall contact, or two fillers.
template <class Real>
void check_lists(const Source& source, std::size_t grain_count) {
  const std::size_t lanes = source.get<Real>("blocks/mass").size(), pairs = source.get<std::int32_t>("list/slot").size();
  const auto& wall = source.get<std::int32_t>("blocks/wall");
  const auto& colour = source.get<std::int32_t>("blocks/colour");
  const auto& region_colour = source.get<std::int32_t>("blocks/region_colour");
  const auto rows = [&](bool fit, const char* name) {
    if (!fit) throw std::invalid_argument(std::string("state: ") + name + ": does not fit the other arrays of the list");
  };
  rows(source.get<std::int32_t>("list/pair").size() == 2 * pairs, "list/pair");
  rows(lanes % grains::kLanes == 0, "blocks/mass");
  rows(source.get<std::int32_t>("blocks/bodies").size() == 2 * lanes, "blocks/bodies");
  rows(source.get<Real>("blocks/impulse").size() == 2 * lanes, "blocks/impulse");
  rows(source.get<double>("blocks/wake").size() * grains::kLanes == lanes, "blocks/wake");
  rows(source.get<double>("pile/impulse").size() == 2 * source.get<std::int32_t>("pile/grain").size(), "pile/impulse");
  const bool listed = !source.get<double>("list/position").empty();
  rows(listed || lanes == 0, "list/position");
  if (!listed) return;
  rows(region_colour.size() == static_cast<std::size_t>(grains::Regions(grain_count).count()) + 1, "blocks/region_colour");
  rows(lanes == 0 ? colour.empty() : !colour.empty() && static_cast<std::size_t>(colour.back()) * grains::kLanes == lanes, "blocks/colour");
  const std::size_t walls = wall.size() / 3;
  rows(pairs + walls <= lanes &&
           source.get<std::int64_t>("blocks/bodies_count")[0] ==
               grains::first_point(grain_count) + static_cast<std::int64_t>(walls + 2 * (lanes - pairs - walls)),
       "blocks/wall");
}

/// Throws unless `state` could be the state of this simulation.
void check(const Simulation& sim, const std::vector<Array>& state) {
  const Parts mine = take(sim, is_pushed(state), is_halved(state));
  const auto refuse = [](const std::string& name, const char* why) { throw std::invalid_argument("state: " + name + ": " + why); };
  for (std::size_t k = 0; k < std::max(mine.arrays.size(), state.size()); ++k) {
    if (k >= state.size()) refuse(mine.arrays[k].first.name, "missing");
    if (k >= mine.arrays.size() || state[k].info.name != mine.arrays[k].first.name) refuse(state[k].info.name, "unknown or out of order");
    const auto& [info, values] = mine.arrays[k];
    if (state[k].values.index() != values.index()) refuse(info.name, "of another type");
    if (state[k].info.columns != info.columns || size(state[k].values) % info.columns != 0) refuse(info.name, "of other columns");
    const bool fixed = info.entity == Entity::grain || info.name == "pile/motion" || info.name == "totals" ||
                       info.name == "push/work" || info.name == "gathering" || info.name == "clock/step" ||
                       info.name == "clock/part" || info.name == kStepping || info.name == "blocks/bodies_count" ||
                       info.name == "list/closing";
    const bool never_listed = info.name == "list/position" && (size(values) == 0 || size(state[k].values) == 0);
    if (fixed && !never_listed && size(state[k].values) != size(values)) refuse(info.name, "of another length");
  }
  for (const Array& array : state) {
    const bool identity = array.info.name == "grains/id" || array.info.name == "grains/radius";
    for (const auto& [info, values] : mine.arrays)
      if (identity && info.name == array.info.name && values != array.values) refuse(info.name, "of other grains");
  }
  const Source source(state);
  if (std::holds_alternative<ContactSystem<float>>(sim.contacts)) check_lists<float>(source, sim.grains.count());
  if (std::holds_alternative<ContactSystem<double>>(sim.contacts)) check_lists<double>(source, sim.grains.count());
  if (std::holds_alternative<grains::AllPairs>(sim.contacts) &&
      source.get<std::int32_t>("pairs/bodies").size() != source.get<double>("pairs/impulse").size())
    refuse("pairs/impulse", "does not fit the pairs");
}

}  // namespace

void describe(const Simulation& sim, const std::function<void(const ArrayInfo&, ArrayView)>& visit) {
  for (const Array& array : snapshot(sim))
    std::visit([&](const auto& v) { visit(array.info, view(v)); }, array.values);
}

std::vector<Array> snapshot(const Simulation& sim) {
  std::vector<Array> state;
  Parts parts = take(sim);
  for (auto& [info, values] : parts.arrays) state.push_back({std::move(info), std::move(values)});
  if (!sim.water) return state;
  for (Array& array : snapshot(*sim.water)) state.push_back(std::move(array));
  return state;
}

void restore(Simulation& sim, const std::vector<Array>& all) {
  std::vector<Array> state;
  std::ranges::copy_if(all, std::back_inserter(state), [](const Array& array) { return !is_of_water(array); });
  check(sim, state);
  if (!sim.water && state.size() < all.size()) throw std::invalid_argument("state: it is of a saturated scene");
  if (sim.water) restore(*sim.water, all);
  const Source source(state);
  const auto& position = source.get<double>("grains/position");
  const auto& origin = source.get<double>("grains/origin");

  sim.clock.step = source.get<std::int64_t>("clock/step")[0];
  sim.clock.part = 0;
  int halvings = 0;
  sim.stepping = stepping_of(state, kStepping);
  if (is_halved(state)) {
    const auto& part = source.get<std::int64_t>("clock/part");
    sim.clock.part = static_cast<int>(part[0]);
    halvings = static_cast<int>(part[1]);
  }
  take_halvings(sim, halvings);
  for (std::size_t i = 0; i < sim.grains.count(); ++i) {
    sim.grains.disc[i].x = position[2 * i];
    sim.grains.disc[i].y = position[2 * i + 1];
    sim.origin[i] = {origin[2 * i], origin[2 * i + 1]};
  }
  std::visit([&](auto& system) { put_contacts(system, sim.grains, source); }, sim.contacts);

  if (sim.pile) {
    const auto& pile = source.get<double>("pile/motion");
    auto& body = sim.pile->body;
    sim.pile->start = pile[0];
    sim.pile->travel = pile[1];
    body.position = {pile[2], pile[3]};
    body.velocity = {pile[4], pile[5]};
    body.listed_travel = pile[6];
    const auto& touched = source.get<std::int32_t>("pile/grain");
    const auto& pressed = source.get<double>("pile/impulse");
    body.contact.assign(touched.size(), {});
    for (std::size_t k = 0; k < touched.size(); ++k) {
      body.contact[k].grain = touched[k];
      body.contact[k].pn = pressed[2 * k];
      body.contact[k].pt = pressed[2 * k + 1];
    }
  }
  const auto& t = source.get<double>("totals");
  sim.totals.left = {t[0], t[1]};
  sim.totals.right = {t[2], t[3]};
  sim.totals.base = {t[4], t[5]};
  sim.totals.body_work = t[6];
  sim.totals.dissipation = t[7];
  for (std::size_t k = 0; k < sim.totals.feature.size(); ++k) sim.totals.feature[k] = {t[8 + 2 * k], t[9 + 2 * k]};
  const auto& g = source.get<double>("gathering");
  sim.gathering = {g[0], g[1], g[2], g[3], g[4], static_cast<std::int64_t>(g[5])};
  sim.grains.push.clear();
  sim.totals.push_work = 0;
  if (!is_pushed(state)) return;
  const auto& push = source.get<double>("grains/push");
  for (std::size_t i = 0; i < sim.grains.count(); ++i) sim.grains.push.push_back({push[2 * i], push[2 * i + 1]});
  sim.totals.push_work = source.get<double>("push/work")[0];
}

std::uint64_t state_hash(const Simulation& sim) {
  XXH3_state_t* hash = XXH3_createState();
  XXH3_64bits_reset(hash);
  describe(sim, [&](const ArrayInfo& info, ArrayView values) {
    XXH3_64bits_update(hash, info.name.data(), info.name.size());
    std::visit([&](const auto& v) { XXH3_64bits_update(hash, v.data(), v.size_bytes()); }, values);
  });
  const std::uint64_t digest = XXH3_64bits_digest(hash);
  XXH3_freeState(hash);
  return digest;
}

std::string compare(const std::vector<Array>& a, const std::vector<Array>& b) {
  for (std::size_t k = 0; k < std::max(a.size(), b.size()); ++k) {
    if (k >= a.size() || k >= b.size()) return (k < a.size() ? a : b)[k].info.name + ": only in one of the two";
    const std::string& name = a[k].info.name;
    if (name != b[k].info.name || a[k].values.index() != b[k].values.index()) return name + " against " + b[k].info.name;
    std::string difference;
    std::visit(
        [&](const auto& left) {
          const auto& right = std::get<std::decay_t<decltype(left)>>(b[k].values);
          if (left.size() != right.size()) {
            difference = name + ": " + std::to_string(left.size()) + " against " + std::to_string(right.size()) + " values";
            return;
          }
          for (std::size_t n = 0; n < left.size(); ++n)
            if (std::memcmp(&left[n], &right[n], sizeof left[n]) != 0) {
              difference = name + "[" + std::to_string(n) + "]: " + std::to_string(left[n]) + " against " + std::to_string(right[n]);
              return;
            }
        },
        a[k].values);
    if (!difference.empty()) return difference;
  }
  return {};
}

}  // namespace seapile::simulation
