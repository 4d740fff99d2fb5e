#include "solver/grains/restitution.h"

#include <algorithm>
#include <cmath>

#include "solver/grains/body_contacts.h"

namespace seapile::grains {
namespace {

/// Velocities across a contact between two bodies.
struct Across {
  double normal, tangential;
};

template <class Real>
Across across(const Motion<Real>& a, const Motion<Real>& b, double nx, double ny) {
  const double wx = static_cast<double>(b.vx) - static_cast<double>(a.vx);
  const double wy = static_cast<double>(b.vy) - static_cast<double>(a.vy);
  return {nx * wx + ny * wy, nx * wy - ny * wx - static_cast<double>(a.u) - static_cast<double>(b.u)};
}

template <class Real>
void push(Motion<Real>& a, double px, double py, double pt, double twist) {
  const double m = static_cast<double>(a.inverse_mass);
  a.vx += static_cast<Real>(m * px);
  a.vy += static_cast<Real>(m * py);
  a.u -= static_cast<Real>(twist * m * pt);
}

/// The rebound's impulses; zero when the contact did not close in this step.
struct Bounce {
  double pn = 0, pt = 0;
};

/// `threshold`: what gravity and push alone do within two steps [m/s]. `last`: normal impulse of the last sub-step
/// [N s/m]. A contact that begins to close in it is left touching, with what remained of its approach: the step after
/// would take that for the whole.
Bounce bounce(double approach, Across now, double last, double gap, double normal_mass, double tangential_mass,
              double friction, double threshold, const ContactLaw& law) {
  const bool stopped = last > 0 || now.normal > 0.5 * approach;
  const bool closed = approach < -threshold && stopped && gap < -approach * law.step / law.substeps;
  if (!closed) return {};
  const double pn = std::max(-normal_mass * (now.normal + law.restitution * approach), 0.0);
  return {pn, std::clamp(-tangential_mass * now.tangential, -friction * pn, friction * pn)};
}

/// The energy balance takes gravity's work on the mean velocity of a sub-step; an impulse between two sub-steps shifts the
/// second one's start. `lift`: vertical impulse on a grain [N s/m].
double late_gravity(const ContactLaw& law, double lift) { return 0.5 * law.step / law.substeps * law.gravity * lift; }

/// The same for the push, of whose work this is a part. `second`: a grain, or negative; `p`: impulse on it from the
/// first grain [N s/m].
void late_push(const ContactLaw& law, const Grains& grains, std::int32_t first, std::int32_t second, base::Vec2 p,
               ContactTotals& totals) {
  if (grains.push.empty()) return;
  const double late =
      0.5 * law.step / law.substeps * ((second < 0 ? 0 : dot(grains.push[second], p)) - dot(grains.push[first], p));
  totals.push_work -= late;
  totals.dissipation -= late;
}

Motion<double> as_motion(const RigidBody& body) { return {body.velocity.x, body.velocity.y, 0, body.inverse_mass}; }

}  // namespace

template <class Real>
void remember_approach(ContactSystem<Real>& system, const RigidBody* body, base::Vec2 body_velocity) {
  const ContactBlocks<Real>& blocks = system.blocks;
  system.approach.assign(blocks.block.size() * kLanes, 0);
  for (std::size_t b = 0; b < blocks.block.size(); ++b) {
    if (!blocks.active[b]) continue;
    const ContactBlock<Real>& block = blocks.block[b];
    for (int lane = 0; lane < kLanes; ++lane)
      system.approach[b * kLanes + lane] =
          across(system.motion(body_at(block.i[lane])), system.motion(body_at(block.j[lane])), static_cast<double>(block.nx[lane]),
                 static_cast<double>(block.ny[lane])).normal;
  }
  system.body_approach.clear();
  if (!body) return;
  for (const BodyContact& c : body->contact) {
    const Motion<Real>& grain = system.motion(c.grain);
    system.body_approach.push_back(c.nx * (body_velocity.x - static_cast<double>(grain.vx)) +
                                   c.ny * (body_velocity.y - static_cast<double>(grain.vy)));
  }
}

template <class Real>
void rebound(ContactSystem<Real>& system, const Grains& grains, const ContactLaw& law, double pull, RigidBody* body,
             ContactTotals& totals) {
  const double threshold = 2 * pull * law.step, arms = 1 + law.twist;
  ContactBlocks<Real>& blocks = system.blocks;
  for (const Colour& colour : blocks.colour)
    for (std::int32_t b = colour.first; b < colour.last; ++b) {
      if (!blocks.active[b]) continue;
      ContactBlock<Real>& block = blocks.block[b];
      for (int lane = 0; lane < kLanes; ++lane) {
        const double approach = system.approach[static_cast<std::size_t>(b) * kLanes + lane];
        if (!(approach < 0)) continue;
        const std::int32_t i = body_at(block.i[lane]), j = body_at(block.j[lane]);
        Motion<Real>&first = system.motion(i), &second = system.motion(j);
        const double nx = static_cast<double>(block.nx[lane]), ny = static_cast<double>(block.ny[lane]);
        const Across now = across(first, second, nx, ny);
        const Disc &di = grains.disc[i], &dj = grains.disc[j];
        // Along the step's normal, as the sweeps see it: what a grain moved across opens no contact, and the point of a
        // wall stays where the grain's foot was.
        const double gap = nx * (dj.x - di.x) + ny * (dj.y - di.y) - di.radius - dj.radius;
        const double mass = static_cast<double>(block.mass[lane]);
        const bool wall = b >= colour.first_wall;
        const Bounce p = bounce(approach, now, static_cast<double>(block.pn[lane]), gap, mass, mass / arms,
                                wall ? law.friction_wall : law.friction_grain, threshold, law);
        if (p.pn == 0) continue;
        const double px = p.pn * nx - p.pt * ny, py = p.pn * ny + p.pt * nx;
        push(first, -px, -py, p.pt, law.twist);
        push(second, px, py, p.pt, law.twist);
        totals.dissipation -=
            p.pn * (now.normal + 0.5 * p.pn / mass) + p.pt * (now.tangential + 0.5 * arms * p.pt / mass);
        if (wall) totals.dissipation += late_gravity(law, -py);
        late_push(law, grains, i, wall ? -1 : j, {px, py}, totals);
        blocks.step_impulse[b].normal[lane] += p.pn;
        blocks.step_impulse[b].tangential[lane] += p.pt;
      }
    }
  if (!body) return;
  for (std::size_t k = 0; k < body->contact.size(); ++k) {
    BodyContact& c = body->contact[k];
    if (!(system.body_approach[k] < 0)) continue;
    Motion<Real>& grain = system.motion(c.grain);
    const Motion<double> pile = as_motion(*body);
    const Motion<double> first{static_cast<double>(grain.vx), static_cast<double>(grain.vy), static_cast<double>(grain.u),
                               static_cast<double>(grain.inverse_mass)};
    const Across now = across(first, pile, c.nx, c.ny);
    const double m = first.inverse_mass + body->inverse_mass, mt = arms * first.inverse_mass + body->inverse_mass;
    const Disc& disc = grains.disc[c.grain];
    const double gap = nearest_place(*body, {disc.x, disc.y}).distance - disc.radius;
    const Bounce p = bounce(system.body_approach[k], now, c.pn, gap, 1 / m, 1 / mt, body->friction, threshold, law);
    if (p.pn == 0) continue;
    const double px = p.pn * c.nx - p.pt * c.ny, py = p.pn * c.ny + p.pt * c.nx;
    push(grain, -px, -py, p.pt, law.twist);
    body->velocity = body->velocity + body->inverse_mass * base::Vec2{px, py};
    c.step_pn += p.pn;
    c.step_pt += p.pt;
    totals.feature[c.feature].x += px;
    totals.feature[c.feature].y += py;
    totals.body_work -= px * body->velocity.x + py * body->velocity.y;
    totals.dissipation += late_gravity(law, -py);
    late_push(law, grains, c.grain, -1, {px, py}, totals);
    totals.dissipation -= p.pn * (now.normal + 0.5 * p.pn * m) + p.pt * (now.tangential + 0.5 * p.pt * mt);
  }
}

template void remember_approach(ContactSystem<float>&, const RigidBody*, base::Vec2);
template void remember_approach(ContactSystem<double>&, const RigidBody*, base::Vec2);
template void rebound(ContactSystem<float>&, const Grains&, const ContactLaw&, double, RigidBody*, ContactTotals&);
template void rebound(ContactSystem<double>&, const Grains&, const ContactLaw&, double, RigidBody*, ContactTotals&);

}  // namespace seapile::grains
