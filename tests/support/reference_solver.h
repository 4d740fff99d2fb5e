// Sub-stepped soft sequential impulses, slow and obvious: every grain against every other, in natural order, in double,
// without lists, colours, blocks or threads. The production solver is measured against it.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "solver/grains/body_contacts.h"
#include "solver/grains/contact_solver.h"

namespace seapile::support {

struct ReferenceSolver {
  struct Grain {
    grains::Disc disc;
    double mass = 0;
    double vx = 0, vy = 0, u = 0;  // u = r omega
  };

  grains::Box box;
  grains::ContactLaw law;
  std::vector<Grain> grain;
  std::optional<grains::RigidBody> body;                             // prescribed: `body_speed` downwards
  double body_speed = 0;                                             // [m/s]
  std::map<std::pair<int, int>, std::pair<double, double>> impulse;  // (pn, pt) of the last sub-step, by bodies

  static constexpr int kLeft = -1, kRight = -2, kBase = -3, kBody = -4;

  void step() {
    std::vector<Contact> contacts = detect();
    const double h = law.step / law.substeps;
    double smallest = grain[0].disc.radius;
    for (const Grain& g : grain) smallest = std::min(smallest, g.disc.radius);
    std::vector<base::Vec2> path(grain.size());
    for (int k = 0; k < law.substeps; ++k) {
      for (Grain& g : grain) g.vy -= h * law.gravity;
      if (body) body->velocity = {0, -body_speed};
      for (const Contact& c : contacts) apply(c, c.pn, c.pt);
      for (Contact& c : contacts) solve(c, path, k * h, h, 0.1 * smallest / law.step);
      for (std::size_t i = 0; i < grain.size(); ++i) path[i] = path[i] + h * base::Vec2{grain[i].vx, grain[i].vy};
    }
    for (std::size_t i = 0; i < grain.size(); ++i) {
      grain[i].disc.x += path[i].x;
      grain[i].disc.y += path[i].y;
    }
    if (body) body->position.y -= body_speed * law.step;
    impulse.clear();
    for (const Contact& c : contacts) impulse[{c.i, c.j}] = {c.pn, c.pt};
  }

 private:
  struct Contact {
    int i, j;  // second: grain, wall or body
    double nx, ny, gap, friction;
    double pn = 0, pt = 0;
  };

  std::vector<Contact> detect() const {
    std::vector<Contact> contacts;
    const auto add = [&](int i, int j, double nx, double ny, double gap, double friction) {
      Contact c{i, j, nx, ny, gap, friction};
      if (const auto kept = impulse.find({i, j}); kept != impulse.end()) std::tie(c.pn, c.pt) = kept->second;
      contacts.push_back(c);
    };
    const int count = static_cast<int>(grain.size());
    for (int i = 0; i < count; ++i) {
      const grains::Disc& a = grain[i].disc;
      for (int j = i + 1; j < count; ++j) {
        const grains::Disc& b = grain[j].disc;
        const double dx = b.x - a.x, dy = b.y - a.y, distance = std::sqrt(dx * dx + dy * dy);
        add(i, j, dx / distance, dy / distance, distance - a.radius - b.radius, law.friction_grain);
      }
      add(i, kLeft, -1, 0, a.x - a.radius - box.left, law.friction_wall);
      add(i, kRight, 1, 0, box.right - a.x - a.radius, law.friction_wall);
      add(i, kBase, 0, -1, a.y - a.radius - box.base, law.friction_wall);
      if (body) {
        const grains::NearestPlace place = nearest_place(*body, {a.x, a.y});
        add(i, kBody, place.nx, place.ny, place.distance - a.radius, body->friction);
      }
    }
    return contacts;
  }

  void apply(const Contact& c, double pn, double pt) {
    const double px = pn * c.nx - pt * c.ny, py = pn * c.ny + pt * c.nx;
    const auto push = [&](Grain& g, double sign) {
      g.vx += sign * px / g.mass;
      g.vy += sign * py / g.mass;
      g.u -= 2 * pt / g.mass;
    };
    push(grain[c.i], -1);
    if (c.j >= 0) push(grain[c.j], 1);
  }

  /// `time`: since the start of the step, at the start of the sub-step.
  void solve(Contact& c, const std::vector<base::Vec2>& path, double time, double h, double push_speed) {
    const Grain& a = grain[c.i];
    double wx = -a.vx, wy = -a.vy, spin = a.u, inverse_mass = 1 / a.mass;
    base::Vec2 moved = -1.0 * path[c.i];
    if (c.j >= 0) {
      const Grain& b = grain[c.j];
      wx += b.vx, wy += b.vy, spin += b.u, inverse_mass += 1 / b.mass;
      moved = moved + path[c.j];
    } else if (c.j == kBody) {
      wx += body->velocity.x, wy += body->velocity.y;
      moved = moved + time * body->velocity;
    }
    const double mass = 1 / inverse_mass, gap = c.gap + c.nx * moved.x + c.ny * moved.y;
    const double vn = c.nx * wx + c.ny * wy, vt = c.nx * wy - c.ny * wx - spin;

    // Catto's soft constraint, implicit Euler of a damped spring of frequency f = stiffness / h over a sub-step.
    const double omega = 2 * std::numbers::pi * law.stiffness / h, zeta = law.damping;
    const double a1 = 2 * zeta + h * omega, a2 = h * omega * a1;
    double dpn = 0;
    if (gap > 0)
      dpn = -mass * (vn + gap / h);
    else
      dpn = -mass * a2 / (1 + a2) * (vn + std::max(omega / a1 * gap, -push_speed)) - c.pn / (1 + a2);
    dpn = std::max(dpn, -c.pn);
    c.pn += dpn;
    const double pt = std::clamp(c.pt - mass / 3 * vt, -c.friction * c.pn, c.friction * c.pn), dpt = pt - c.pt;
    c.pt = pt;
    apply(c, dpn, dpt);
  }
};

}  // namespace seapile::support
