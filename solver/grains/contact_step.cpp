#include "solver/grains/contact_step.h"

#include "solver/grains/body_contacts.h"

namespace seapile::grains {
namespace {

/// The largest of value(grain) over all grains, at least 0; each tile is looked through by the thread that has it.
template <class Real>
double largest(ContactSystem<Real>& system, base::Crew* crew, auto&& value) {
  system.scratch.assign(system.regions.tiles(), 0);
  for_tiles(system.regions, crew, [&](std::int32_t tile) {
    double most = 0;
    const std::int32_t last = system.regions.first_grain(tile + 1);
    for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i) most = std::max(most, value(i));
    system.scratch[tile] = most;
  });
  double most = 0;
  for (const double v : system.scratch) most = std::max(most, v);
  return most;
}

/// True when some pair that is not listed might touch during the coming step.
template <class Real>
bool list_is_worn(ContactSystem<Real>& system, const Grains& grains, double reach, base::Crew* crew) {
  if (system.listed.size() != grains.count()) return true;
  // Cheap bound first: no gap has closed by more than this.
  if (system.closing - system.listed_closing + reach <= system.skin) return false;
  const double longest = largest(system, crew, [&](std::int32_t i) {
    const double dx = grains.disc[i].x - system.listed[i].x, dy = grains.disc[i].y - system.listed[i].y;
    return dx * dx + dy * dy;
  });
  return 2 * std::sqrt(longest) + reach > system.skin;
}

template <class Real>
base::Vec2 velocity(const Motion<Real>& m) {
  return {static_cast<double>(m.vx), static_cast<double>(m.vy)};
}

template <class Real>
base::Vec2 in_doubles(const Push<Real>& push) {
  return {static_cast<double>(push.x), static_cast<double>(push.y)};
}

template <class Real>
double squared_speed(const Motion<Real>& m) {
  const double vx = static_cast<double>(m.vx), vy = static_cast<double>(m.vy);
  return vx * vx + vy * vy;
}

/// The larger of both; NaN when one of them is.
double larger_or_nan(double a, double b) { return a < b || std::isnan(b) ? b : a; }

}  // namespace

template <class Real>
Closing expected_closing(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law,
                         const RigidBody* body, std::span<const double> body_path, base::Crew* crew) {
  const double fastest = largest(system, crew, [&](std::int32_t i) { return squared_speed(system.motion(i)); });
  const double push = grains.push.empty() ? 0 : std::sqrt(largest(system, crew, [&](std::int32_t i) {
    return dot(grains.push[i], grains.push[i]);
  }));
  Closing closing;
  closing.pull = law.gravity + push;
  closing.body_speed = body_path.empty() ? (body ? norm(body->velocity) : 0) : std::abs(body_path.back()) / law.step;
  closing.margin =
      closing.body_speed * law.step + 4 * law.gravity * law.step * law.step + 0.01 * system.smallest_radius;
  // A push that takes a grain farther than the smallest radius ends the run: no list needs to hold what it might reach.
  closing.margin += 4 * std::min(push * law.step * law.step, system.smallest_radius);
  closing.reach = 6 * law.step * std::max(std::sqrt(fastest), closing.body_speed) + closing.margin;
  closing.likely = 2 * law.step * std::sqrt(fastest) + closing.margin;
  return closing;
}

template <class Real>
bool keep_lists(ContactSystem<Real>& system, Grains& grains, const Box& box, RigidBody* body, const Closing& closing,
                double step, base::Crew* crew) {
  // Two grains that may cross the whole skin within this step are looked for farther out; as the skin says less than
  // such a list holds, it wears early. The lists of the body wear by its own path too.
  const double skin = system.skin;
  const bool leaps = closing.likely > skin;
  const bool worn = leaps || list_is_worn(system, grains, std::min(closing.reach, 0.5 * skin), crew);
  if (leaps) system.skin = closing.reach;
  if (worn) list_contacts(system, grains, box, crew);
  if (body && (worn || body->listed_travel + closing.body_speed * step > skin))
    list_body_contacts(*body, grains, 3 * system.skin);
  system.skin = skin;
  place_wall_points(system, grains, box);
  return worn;
}

template <class Real>
void move_places(ContactSystem<Real>& system, Grains& grains, std::int32_t tile, double h) {
  double longest = 0;
  const std::int32_t last = system.regions.first_grain(tile + 1);
  for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i) {
    const Motion<Real>& now = system.motion(i);
    const double dx = static_cast<double>(system.drift(i).dx) + h * static_cast<double>(now.vx);
    const double dy = static_cast<double>(system.drift(i).dy) + h * static_cast<double>(now.vy);
    grains.disc[i].x += dx;
    grains.disc[i].y += dy;
    // A place that is no number makes the path none, too.
    const double square = dx * dx + dy * dy + 0 * (grains.disc[i].x + grains.disc[i].y);
    longest = larger_or_nan(longest, square);
  }
  system.path[tile] = longest;
}

template <class Real>
const Push<Real>* hold_push(ContactSystem<Real>& system, const Grains& grains) {
  system.push.resize((grains.push.size() + 3) / 4 * 4);
  system.push_sums.assign(grains.push.empty() ? 0 : system.regions.tiles(), {});
  return system.push.empty() ? nullptr : system.push.data();
}

template <class Real>
void lay_out_push(ContactSystem<Real>& system, const Grains& grains, std::int32_t tile) {
  if (system.push.empty()) return;
  double power = 0;
  const std::int32_t last = system.regions.first_grain(tile + 1);
  for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i) {
    system.push[i] = {static_cast<Real>(grains.push[i].x), static_cast<Real>(grains.push[i].y)};
    power += grains.mass[i] * dot(in_doubles(system.push[i]), velocity(system.motion(i)));
  }
  system.push_sums[tile].power = power;
}

template <class Real>
void sum_push(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law, std::int32_t tile) {
  if (system.push.empty()) return;
  const double h = law.step / substeps(law);
  double path = 0, power = 0, thrust = 0;
  const std::int32_t last = system.regions.first_grain(tile + 1);
  for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i) {
    const base::Vec2 push = grains.mass[i] * in_doubles(system.push[i]), v = velocity(system.motion(i));
    const Drift<Real>& drift = system.drift(i);
    path += dot(push, base::Vec2{static_cast<double>(drift.dx), static_cast<double>(drift.dy)} + h * v);
    power += dot(push, v);
    thrust += dot(push, in_doubles(system.push[i]) + base::Vec2{0, -law.gravity});
  }
  PushSums& sums = system.push_sums[tile];
  const double gained = power - sums.power;
  sums.work = path - 0.5 * h * gained;
  sums.shared = 0.5 * h * (gained - law.step * thrust);
}

void move_body(RigidBody& body) {
  body.position = body.position + body.moved;
  body.listed_travel += norm(body.moved);
  body.moved = {};
}

template <class Real>
void close_step(ContactSystem<Real>& system, ContactTotals& totals, ContactReport& report) {
  const ContactBlocks<Real>& blocks = system.blocks;
  for (std::size_t k = 0; k < blocks.wall.size(); ++k) {
    const std::int32_t slot = blocks.wall_slot[k];
    const double pn = blocks.step_impulse[slot / kLanes].normal[slot % kLanes];
    const double pt = blocks.step_impulse[slot / kLanes].tangential[slot % kLanes];
    // n points from the grain to the wall, t = (-n_y, n_x).
    if (blocks.wall[k] == Wall::left) totals.left.x -= pn, totals.left.y -= pt;
    if (blocks.wall[k] == Wall::right) totals.right.x += pn, totals.right.y += pt;
    if (blocks.wall[k] == Wall::base) totals.base.y -= pn, totals.base.x += pt;
  }
  double longest = 0;
  for (const double p : system.path) longest = larger_or_nan(longest, p);
  report.longest_path = std::sqrt(longest);
  system.closing += 2 * report.longest_path;
  report.finite = std::isfinite(longest);
}

base::Vec2 body_push(const RigidBody& body, const ContactLaw& law) {
  return body.inverse_mass * body.force + base::Vec2{0, -law.gravity};
}

base::Vec2 kept_impulse(const RigidBody& body) {
  base::Vec2 kept;
  for (const BodyContact& c : body.contact)
    kept = kept + base::Vec2{c.pn * c.nx - c.pt * c.ny, c.pn * c.ny + c.pt * c.nx};
  return kept;
}

template <class Real>
void keep_step_impulses(ContactBlocks<Real>& blocks, std::int32_t first, std::int32_t last, bool afresh) {
  for (std::int32_t b = first; b < last; ++b) {
    if (afresh) blocks.step_impulse[b] = {};
    for (int lane = 0; lane < kLanes; ++lane) {
      blocks.step_impulse[b].normal[lane] += static_cast<double>(blocks.block[b].pn[lane]);
      blocks.step_impulse[b].tangential[lane] += static_cast<double>(blocks.block[b].pt[lane]);
    }
  }
}

#define SEAPILE_INSTANTIATE(Real)                                                                             \
  template Closing expected_closing(ContactSystem<Real>&, const Grains&, const ContactLaw&, const RigidBody*, \
                                    std::span<const double>, base::Crew*);                                    \
  template const Push<Real>* hold_push(ContactSystem<Real>&, const Grains&);                                  \
  template void lay_out_push(ContactSystem<Real>&, const Grains&, std::int32_t);                              \
  template void sum_push(ContactSystem<Real>&, const Grains&, const ContactLaw&, std::int32_t);               \
  template bool keep_lists(ContactSystem<Real>&, Grains&, const Box&, RigidBody*, const Closing&, double,     \
                           base::Crew*);                                                                      \
  template void move_places(ContactSystem<Real>&, Grains&, std::int32_t, double);                             \
  template void close_step(ContactSystem<Real>&, ContactTotals&, ContactReport&);                             \
  template void keep_step_impulses(ContactBlocks<Real>&, std::int32_t, std::int32_t, bool);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
