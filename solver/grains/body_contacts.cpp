#include "solver/grains/body_contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace seapile::grains {

NearestPlace nearest_place(const RigidBody& body, base::Vec2 centre) {
  const base::Vec2 p = centre - body.position;

  // Outside: the nearest point of any edge. Inside: the edge that is nearest to being crossed.
  NearestPlace outside{std::numeric_limits<double>::infinity(), 0, 0, 0};
  NearestPlace inside{-std::numeric_limits<double>::infinity(), 0, 0, 0};
  bool within = true;
  for (const base::Segment& edge : body.outline) {
    const base::Vec2 along = edge.to - edge.from;
    const double length = norm(along);
    const base::Vec2 outward = (1 / length) * base::Vec2{along.y, -along.x};
    const double height = dot(p - edge.from, outward);
    if (height >= 0) within = false;
    if (height > inside.distance) inside = {height, -outward.x, -outward.y, edge.feature};

    const double share = dot(p - edge.from, along) / (length * length);
    const base::Vec2 foot = share <= 0 ? edge.from : share >= 1 ? edge.to : edge.from + share * along;
    const base::Vec2 to_body = foot - p;
    const double distance = norm(to_body);
    if (distance < outside.distance || (distance == outside.distance && edge.feature < outside.feature))
      outside = distance > 0 ? NearestPlace{distance, to_body.x / distance, to_body.y / distance, edge.feature}
                             : NearestPlace{0, -outward.x, -outward.y, edge.feature};
  }
  return within ? inside : outside;
}

void list_body_contacts(RigidBody& body, const Grains& grains, double skin) {
  std::vector<BodyContact> listed;
  std::size_t old = 0;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const Disc& disc = grains.disc[i];
    if (nearest_place(body, {disc.x, disc.y}).distance - disc.radius >= skin) continue;
    BodyContact contact;
    contact.grain = static_cast<std::int32_t>(i);
    while (old < body.contact.size() && body.contact[old].grain < contact.grain) ++old;
    if (old < body.contact.size() && body.contact[old].grain == contact.grain) contact = body.contact[old];
    listed.push_back(contact);
  }
  body.contact = std::move(listed);
  body.listed_travel = 0;
}

template <class Real>
void detect_body_contacts(RigidBody& body, const Grains& grains, ContactSystem<Real>& system) {
  for (BodyContact& contact : body.contact) {
    const Disc& disc = grains.disc[contact.grain];
    const NearestPlace place = nearest_place(body, {disc.x, disc.y});
    contact.feature = place.feature;
    contact.nx = place.nx;
    contact.ny = place.ny;
    contact.gap = place.distance - disc.radius;
    contact.step_pn = contact.step_pt = 0;
    const double m = static_cast<double>(system.motion(contact.grain).inverse_mass);
    Before<Real>& change = system.before[contact.grain];
    change.vx -= static_cast<Real>(m * (contact.pn * contact.nx - contact.pt * contact.ny));
    change.vy -= static_cast<Real>(m * (contact.pn * contact.ny + contact.pt * contact.nx));
    change.u -= static_cast<Real>(system.twist * m * contact.pt);
  }
}

template <class Real>
BodySweep sweep_body_contacts(RigidBody& body, ContactSystem<Real>& system, const Softness<double>& soft,
                              ContactTotals& totals) {
  BodySweep sums;
  const base::Vec2 path = body.moved;
  for (BodyContact& c : body.contact) {
    Motion<Real>& grain = system.motion(c.grain);
    const Drift<Real>& d = system.drift(c.grain);
    const double m = static_cast<double>(grain.inverse_mass);
    const double normal_mass = 1 / (m + body.inverse_mass),
                 tangential_mass = 1 / ((1 + system.twist) * m + body.inverse_mass);
    const double gap = c.gap + c.nx * (path.x - static_cast<double>(d.dx)) + c.ny * (path.y - static_cast<double>(d.dy));
    const double wx = body.velocity.x - static_cast<double>(grain.vx), wy = body.velocity.y - static_cast<double>(grain.vy);
    const double vn = c.nx * wx + c.ny * wy;
    const double vt = c.nx * wy - c.ny * wx - static_cast<double>(grain.u);

    sums.kept = sums.kept + base::Vec2{c.pn * c.nx - c.pt * c.ny, c.pn * c.ny + c.pt * c.nx};

    const bool open = gap > 0;
    const double bias = open ? gap * soft.inverse_h : std::max(gap * soft.bias_rate, -soft.push_speed);
    const double wanted = c.pn - normal_mass * (open ? 1.0 : soft.mass_scale) * (vn + bias) - (open ? 0.0 : soft.impulse_scale) * c.pn;
    const double pn = std::max(wanted, 0.0), cone = body.friction * pn;
    const double pt = std::clamp(c.pt - tangential_mass * vt, -cone, cone);
    const double dpn = pn - c.pn, dpt = pt - c.pt;
    c.pn = pn;
    c.pt = pt;
    c.step_pn += pn;
    c.step_pt += pt;

    const double px = dpn * c.nx - dpt * c.ny, py = dpn * c.ny + dpt * c.nx;
    grain.vx -= static_cast<Real>(m * px);
    grain.vy -= static_cast<Real>(m * py);
    grain.u -= static_cast<Real>(system.twist * m * dpt);
    body.velocity = body.velocity + body.inverse_mass * base::Vec2{px, py};

    const double dvn = dpn / normal_mass, dvt = dpt / tangential_mass;
    sums.work += dpn * (vn + 0.5 * dvn) + dpt * (vt + 0.5 * dvt);
    sums.residual += dvn * dvn;

    // The grain presses the body with (pn n + pt t).
    Impulse& felt = totals.feature[c.feature];
    const double fx = pn * c.nx - pt * c.ny, fy = pn * c.ny + pt * c.nx;
    felt.x += fx;
    felt.y += fy;
    sums.felt = sums.felt + base::Vec2{fx, fy};
  }
  return sums;
}

template void detect_body_contacts(RigidBody&, const Grains&, ContactSystem<float>&);
template void detect_body_contacts(RigidBody&, const Grains&, ContactSystem<double>&);
template BodySweep sweep_body_contacts(RigidBody&, ContactSystem<float>&, const Softness<double>&, ContactTotals&);
template BodySweep sweep_body_contacts(RigidBody&, ContactSystem<double>&, const Softness<double>&, ContactTotals&);

}  // namespace seapile::grains
