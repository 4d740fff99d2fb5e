// The contact kernels lane by lane, as slow and obvious as their formulas: what each instruction set must equal bit by
// bit.
#pragma once

#include <cmath>
#include <limits>

#include "solver/grains/contact_kernels.h"

namespace seapile::grains::scalar {

template <class Real>
Motion<Real>& motion(BodyGroup<Real>* bodies, std::int32_t place) {
  return bodies[body_at(place) / 4].motion[body_at(place) % 4];
}
template <class Real>
Drift<Real>& drift(BodyGroup<Real>* bodies, std::int32_t place) {
  return bodies[body_at(place) / 4].drift[body_at(place) % 4];
}

template <class Real>
Real larger(Real a, Real b) {
  return a > b ? a : b;
}

template <class Real>
void refresh(ContactBlock<Real>* blocks, std::uint8_t* active, double* wake, std::int32_t first, std::int32_t last,
             const Disc* disc, BodyGroup<Real>* bodies, Before<Real>* warm, const Nearness& near) {
  for (std::int32_t b = first; b < last; ++b) {
    ContactBlock<Real>& block = blocks[b];
    if (near.closing + near.reach < wake[b]) {
      for (int lane = 0; lane < kLanes && active[b]; ++lane) block.pn[lane] = block.pt[lane] = 0;
      active[b] = 0;
      continue;
    }
    active[b] = 0;
    Real least = std::numeric_limits<Real>::max();
    for (int lane = 0; lane < kLanes; ++lane) {
      const Disc &di = disc[body_at(block.i[lane])], &dj = disc[body_at(block.j[lane])];
      const double x = dj.x - di.x, y = dj.y - di.y, reach = di.radius + dj.radius, square = x * x + y * y;
      const Real distance = std::sqrt(static_cast<Real>(square)), inverse = 1 / distance;
      block.nx[lane] = static_cast<Real>(x) * inverse;
      block.ny[lane] = static_cast<Real>(y) * inverse;
      block.gap[lane] = static_cast<Real>(square - reach * reach) / (distance + static_cast<Real>(reach));
      if (!(block.mass[lane] > 0)) continue;

      const Motion<Real>&a = motion(bodies, block.i[lane]), &c = motion(bodies, block.j[lane]);
      const Real speed = std::abs(c.vx - a.vx) + std::abs(c.vy - a.vy), gap = block.gap[lane];
      if (gap - static_cast<Real>(near.margin) - static_cast<Real>(2 * near.time) * speed < 0) active[b] = 1;
      least = gap < least ? gap : least;
    }
    wake[b] = near.closing + static_cast<double>(least);
    for (int lane = 0; lane < kLanes; ++lane) {
      if (!active[b]) {
        block.pn[lane] = block.pt[lane] = 0;
        continue;
      }
      const Real nx = block.nx[lane], ny = block.ny[lane], pn = block.pn[lane], pt = block.pt[lane];
      const Real px = pn * nx - pt * ny, py = pn * ny + pt * nx;
      Before<Real>&a = warm[body_at(block.i[lane])], &c = warm[body_at(block.j[lane])];
      const Real ma = motion(bodies, block.i[lane]).inverse_mass, mc = motion(bodies, block.j[lane]).inverse_mass;
      a = {a.vx - ma * px, a.vy - ma * py, a.u - ma * (pt + pt), a.half_mass};
      c = {c.vx + mc * px, c.vy + mc * py, c.u - mc * (pt + pt), c.half_mass};
    }
  }
}

template <class Real>
void sweep(ContactBlock<Real>* blocks, const std::uint8_t* active, std::int32_t first, std::int32_t last,
           BodyGroup<Real>* bodies, Real friction, const Softness<Real>& soft, SweepSums* chunk) {
  Real work[kLanes] = {}, residual[kLanes] = {};
  for (std::int32_t b = first; b < last; ++b)
    for (int lane = 0; lane < kLanes && active[b]; ++lane) {
      ContactBlock<Real>& block = blocks[b];
      Motion<Real>&a = motion(bodies, block.i[lane]), &c = motion(bodies, block.j[lane]);
      const Drift<Real>&da = drift(bodies, block.i[lane]), &dc = drift(bodies, block.j[lane]);
      const Real nx = block.nx[lane], ny = block.ny[lane], mass = block.mass[lane];
      const Real gap = block.gap[lane] + (nx * (dc.dx - da.dx) + ny * (dc.dy - da.dy));
      const Real wx = c.vx - a.vx, wy = c.vy - a.vy;
      const Real vn = nx * wx + ny * wy, vt = (nx * wy - ny * wx) - (a.u + c.u);

      const bool open = gap > 0;
      const Real bias = open ? gap * soft.inverse_h : larger(gap * soft.bias_rate, -soft.push_speed);
      const Real scale = open ? Real(1) : soft.mass_scale, memory = open ? Real(0) : soft.impulse_scale;
      const Real pn = block.pn[lane], new_pn = larger(pn - mass * scale * (vn + bias) - memory * pn, Real(0));
      const Real pt = block.pt[lane], cone = friction * new_pn, stick = pt - mass * (Real(1) / Real(3)) * vt;
      const Real held = larger(stick, Real(0) - cone), new_pt = held < cone ? held : cone;
      const Real dpn = new_pn - pn, dpt = new_pt - pt;
      block.pn[lane] = new_pn;
      block.pt[lane] = new_pt;

      const Real px = dpn * nx - dpt * ny, py = dpn * ny + dpt * nx, sum = a.inverse_mass + c.inverse_mass;
      a = {a.vx - a.inverse_mass * px, a.vy - a.inverse_mass * py, a.u - a.inverse_mass * (dpt + dpt), a.inverse_mass};
      c = {c.vx + c.inverse_mass * px, c.vy + c.inverse_mass * py, c.u - c.inverse_mass * (dpt + dpt), c.inverse_mass};

      const Real dvn = sum * dpn, dvt = (sum + sum + sum) * dpt;
      work[lane] = work[lane] + dpn * (vn + Real(0.5) * dvn) + dpt * (vt + Real(0.5) * dvt);
      residual[lane] = residual[lane] + dvn * dvn;
    }
  double sum_work = 0, sum_residual = 0;
  for (int lane = 0; lane < kLanes; ++lane) {
    sum_work += static_cast<double>(work[lane]);
    sum_residual += static_cast<double>(residual[lane]);
  }
  chunk->work += sum_work;
  chunk->residual += sum_residual;
}

/// What solving one contact by itself gives at the present velocities, from the impulses pn and pt.
template <class Real>
struct Solved {
  Real pn, pt, vn, vt;  ///< new impulses; velocities across the contact
};
template <class Real>
Solved<Real> solved(const ContactBlock<Real>& block, Real bias, int lane, const Motion<Real>& a, const Motion<Real>& c,
                    Real pn, Real pt, Real friction) {
  const Real nx = block.nx[lane], ny = block.ny[lane], mass = block.mass[lane];
  const Real wx = c.vx - a.vx, wy = c.vy - a.vy;
  const Real vn = nx * wx + ny * wy, vt = (nx * wy - ny * wx) - (a.u + c.u);
  const Real new_pn = larger(pn - mass * (vn + bias), Real(0)), cone = friction * new_pn;
  const Real held = larger(pt - mass * (Real(1) / Real(3)) * vt, Real(0) - cone);
  return {new_pn, held < cone ? held : cone, vn, vt};
}

template <class Real>
void add_sum(const Real (&lane)[kLanes], double& sum) {
  double own = 0;
  for (int k = 0; k < kLanes; ++k) own += static_cast<double>(lane[k]);
  sum += own;
}

template <class Real>
void solve(ContactBlock<Real>* blocks, Iterate<Real>* iterates, const std::uint8_t* active, std::int32_t first,
           std::int32_t last, BodyGroup<Real>* bodies, Real friction, Real momentum, SolveSums* sums) {
  Real residual[kLanes] = {}, touching[kLanes] = {};
  for (std::int32_t b = first; b < last; ++b)
    for (int lane = 0; lane < kLanes && active[b]; ++lane) {
      ContactBlock<Real>& block = blocks[b];
      Iterate<Real>& iterate = iterates[b];
      Motion<Real>&a = motion(bodies, block.i[lane]), &c = motion(bodies, block.j[lane]);
      const Real pn = block.pn[lane] + momentum * (block.pn[lane] - iterate.old_pn[lane]);
      const Real pt = block.pt[lane] + momentum * (block.pt[lane] - iterate.old_pt[lane]);
      const Solved<Real> p = solved(block, iterate.bias[lane], lane, a, c, pn, pt, friction);
      iterate.old_pn[lane] = block.pn[lane], iterate.old_pt[lane] = block.pt[lane];
      block.pn[lane] = p.pn, block.pt[lane] = p.pt;

      const Real nx = block.nx[lane], ny = block.ny[lane], dpn = p.pn - pn, dpt = p.pt - pt;
      const Real px = dpn * nx - dpt * ny, py = dpn * ny + dpt * nx, sum = a.inverse_mass + c.inverse_mass;
      a = {a.vx - a.inverse_mass * px, a.vy - a.inverse_mass * py, a.u - a.inverse_mass * (dpt + dpt), a.inverse_mass};
      c = {c.vx + c.inverse_mass * px, c.vy + c.inverse_mass * py, c.u - c.inverse_mass * (dpt + dpt), c.inverse_mass};
      const Real dvn = sum * dpn, dvt = (sum + sum + sum) * dpt;
      residual[lane] = residual[lane] + (dvn * dvn + dvt * dvt);
      touching[lane] = touching[lane] + (p.pn > 0 ? Real(1) : Real(0));
    }
  add_sum(residual, sums->residual);
  add_sum(touching, sums->touching);
}

template <class Real>
void assess(const ContactBlock<Real>* blocks, const Iterate<Real>* iterates, const std::uint8_t* active,
            std::int32_t first, std::int32_t last, BodyGroup<Real>* bodies, const Before<Real>* before, Real friction,
            SolveSums* sums) {
  Real residual[kLanes] = {}, touching[kLanes] = {}, work[kLanes] = {};
  for (std::int32_t b = first; b < last; ++b)
    for (int lane = 0; lane < kLanes && active[b]; ++lane) {
      const ContactBlock<Real>& block = blocks[b];
      const Motion<Real>&a = motion(bodies, block.i[lane]), &c = motion(bodies, block.j[lane]);
      const Real pn = block.pn[lane], pt = block.pt[lane];
      const Solved<Real> p = solved(block, iterates[b].bias[lane], lane, a, c, pn, pt, friction);
      const Real sum = a.inverse_mass + c.inverse_mass, dvn = sum * (p.pn - pn), dvt = (sum + sum + sum) * (p.pt - pt);
      residual[lane] = residual[lane] + (dvn * dvn + dvt * dvt);
      touching[lane] = touching[lane] + (pn > 0 ? Real(1) : Real(0));
      const Before<Real>&oa = before[body_at(block.i[lane])], &oc = before[body_at(block.j[lane])];
      const Real nx = block.nx[lane], ny = block.ny[lane], ox = oc.vx - oa.vx, oy = oc.vy - oa.vy;
      const Real on = nx * ox + ny * oy, ot = (nx * oy - ny * ox) - (oa.u + oc.u);
      work[lane] = work[lane] + Real(0.5) * (pn * (p.vn + on) + pt * (p.vt + ot));
    }
  add_sum(residual, sums->residual);
  add_sum(touching, sums->touching);
  add_sum(work, sums->work);
}

template <class Real>
void extrapolate(BodyGroup<Real>* bodies, std::int32_t first, std::int32_t last, Real momentum) {
  for (std::int32_t group = first; group < last; ++group)
    for (int body = 0; body < 4; ++body) {
      Motion<Real>& m = bodies[group].motion[body];
      Drift<Real>& old = bodies[group].drift[body];
      const Motion<Real> now = m;
      m = {now.vx + momentum * (now.vx - old.dx), now.vy + momentum * (now.vy - old.dy),
           now.u + momentum * (now.u - old.du), now.inverse_mass};
      old = {now.vx, now.vy, now.u, now.inverse_mass};
    }
}

/// Both starts of a sub-step. Four bodies of a group have sums of their own, as have vx, vy and u.
template <class Real>
void start(bool first_substep, BodyGroup<Real>* bodies, Before<Real>* before, const Push<Real>* push,
           std::int32_t first, std::int32_t last, Real h, Real gravity, BodySums* chunk) {
  Real work[kLanes] = {}, lift[kLanes] = {};
  for (std::int32_t group = first; group < last; ++group)
    for (int body = 0; body < 4; ++body) {
      Motion<Real>& m = bodies[group].motion[body];
      Drift<Real>& d = bodies[group].drift[body];
      Before<Real>& old = before[4 * group + body];
      if (first_substep)
        d = {};
      else
        d = {d.dx + h * m.vx, d.dy + h * m.vy, d.du + h * m.u, d.unused};
      const auto one = [&](Real& v, Real& kept, Real fall, Real weight, int number) {
        const Real now = v, change = now - kept, contact = first_substep ? kept : change - fall, from = now + fall;
        v = first_substep ? from + contact : now + change;
        kept = now;
        const Real half_mass = weight * old.half_mass;
        work[4 * body + number] = work[4 * body + number] + half_mass * contact * (from + from + contact);
        lift[4 * body + number] = lift[4 * body + number] + (half_mass + half_mass) * contact;
      };
      const Push<Real> a = push ? push[4 * group + body] : Push<Real>{};
      one(m.vx, old.vx, h * a.x, Real(1), 0);
      one(m.vy, old.vy, -gravity * h + h * a.y, Real(1), 1);
      one(m.u, old.u, Real(0), Real(0.5), 2);
    }
  double sum_work = 0, sum_lift = 0;
  for (int k = 0; k < kLanes; ++k) {
    sum_work += static_cast<double>(work[k]);
    if (k % 4 == 1) sum_lift += static_cast<double>(lift[k]);
  }
  chunk->work += sum_work;
  if (!first_substep) chunk->lift += sum_lift;
}

}  // namespace seapile::grains::scalar
