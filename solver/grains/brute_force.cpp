#include "solver/grains/brute_force.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "solver/grains/body_contacts.h"

namespace seapile::grains {
namespace {

constexpr std::int32_t kLeft = -1, kRight = -2, kBase = -3, kBody = -4;

struct Contact {
  std::int32_t i = 0, j = 0;  ///< j: grain, wall, or kBody
  std::int32_t feature = 0;   ///< of the rigid body
  double nx = 0, ny = 0, gap = 0, friction = 0;
  double inverse_mass = 0, tangential_inverse_mass = 0;
  double approach = 0;              ///< v_n at the start of the step [m/s]
  double pn = 0, pt = 0;            ///< of this sub-step [N s/m]
  double step_pn = 0, step_pt = 0;  ///< of this step [N s/m]
};

struct Across {
  double normal, tangential;
};

/// Everything of one step, so that its parts can be read one by one.
class Step {
 public:
  Step(AllPairs& system, Grains& grains, const Box& box, const ContactLaw& law, RigidBody* body,
       std::span<const double> body_path, ContactTotals& totals)
      : system_(system),
        grains_(grains),
        box_(box),
        law_(law),
        body_(body),
        path_(body_path),
        totals_(totals),
        h_(law.step / substeps(law)),
        pull_(law.gravity),
        moved_(grains.count()) {
    if (!grains.push.empty() && grains.push.size() != grains.count())
      throw std::logic_error("a push for some grains only");
    double largest = 0;
    for (const base::Vec2& a : grains.push) largest = std::max(largest, norm(a));
    pull_ += largest;
  }

  ContactReport run() {
    ContactReport report;
    detect();
    for (int k = 0; k < substeps(law_); ++k) {
      const std::vector<Motion<double>> before = system_.body;
      const base::Vec2 body_before = body_velocity(k);
      push_freely(k);
      for (const Contact& c : contacts_) apply(c, c.pn, c.pt);
      if (law_.nonsmooth) {
        double change = INFINITY;
        while (report.sweeps < law_.nonsmooth->sweeps && change > law_.nonsmooth->tolerance) {
          change = sweep(rigid_);
          ++report.sweeps;
        }
        report.residual = natural_map();
      } else {
        const double change = sweep(soft_);
        report.residual += change * change / law_.substeps;
        ++report.sweeps;
      }
      account(before, body_before);
      move();
    }
    if (!law_.nonsmooth) {
      report.residual = std::sqrt(report.residual);
      if (law_.restitution > 0) rebound();
    }
    finish(report);
    return report;
  }

 private:
  /// Velocity of the body at the start of sub-step k: a driven one has the one it is driven with.
  base::Vec2 body_velocity(int k) const {
    if (!body_) return {};
    if (path_.empty()) return body_->velocity;
    return {0, -(path_[k] - (k > 0 ? path_[k - 1] : 0.0)) / h_};
  }

  void detect() {
    std::map<std::pair<std::int32_t, std::int32_t>, const KeptContact*> kept;
    for (const KeptContact& k : system_.kept) kept[{k.first, k.second}] = &k;
    const base::Vec2 driven = body_velocity(0);
    const auto add = [&](std::int32_t i, std::int32_t j, double nx, double ny, double gap, double friction,
                         std::int32_t feature = 0) {
      Contact c{i, j, feature, nx, ny, gap, friction};
      const double m = system_.body[i].inverse_mass;
      const double other = j >= 0 ? system_.body[j].inverse_mass : j == kBody ? body_->inverse_mass : 0;
      // The body does not turn, nor do walls: of them only the mass counts along the tangent.
      c.inverse_mass = m + other;
      c.tangential_inverse_mass = (1 + law_.twist) * m + (j >= 0 ? (1 + law_.twist) * other : other);
      c.approach = across(c, system_.body, driven).normal;
      if (const auto k = kept.find({i, j}); k != kept.end()) c.pn = k->second->pn, c.pt = k->second->pt;
      contacts_.push_back(c);
    };
    const auto count = static_cast<std::int32_t>(grains_.count());
    for (std::int32_t i = 0; i < count; ++i) {
      const Disc& a = grains_.disc[i];
      for (std::int32_t j = i + 1; j < count; ++j) {
        const Disc& b = grains_.disc[j];
        const double dx = b.x - a.x, dy = b.y - a.y, distance = std::sqrt(dx * dx + dy * dy);
        add(i, j, dx / distance, dy / distance, distance - a.radius - b.radius, law_.friction_grain);
      }
      add(i, kLeft, -1, 0, a.x - a.radius - box_.left, law_.friction_wall);
      add(i, kRight, 1, 0, box_.right - a.x - a.radius, law_.friction_wall);
      add(i, kBase, 0, -1, a.y - a.radius - box_.base, law_.friction_wall);
      if (!body_) continue;
      const NearestPlace place = nearest_place(*body_, {a.x, a.y});
      add(i, kBody, place.nx, place.ny, place.distance - a.radius, body_->friction, place.feature);
    }
  }

  Across across(const Contact& c, const std::vector<Motion<double>>& motion, base::Vec2 body) const {
    const Motion<double>& a = motion[c.i];
    double wx = -a.vx, wy = -a.vy, spin = a.u;
    if (c.j >= 0) wx += motion[c.j].vx, wy += motion[c.j].vy, spin += motion[c.j].u;
    if (c.j == kBody) wx += body.x, wy += body.y;
    return {c.nx * wx + c.ny * wy, c.nx * wy - c.ny * wx - spin};
  }
  Across across(const Contact& c) const { return across(c, system_.body, body_ ? body_->velocity : base::Vec2{}); }

  void push_freely(int k) {
    for (std::size_t i = 0; i < system_.body.size(); ++i) {
      Motion<double>& m = system_.body[i];
      if (!grains_.push.empty()) m.vx += h_ * grains_.push[i].x;
      m.vy += h_ * ((grains_.push.empty() ? 0 : grains_.push[i].y) - law_.gravity);
    }
    if (!body_) return;
    body_->velocity = body_velocity(k);
    if (path_.empty())
      body_->velocity = body_->velocity + h_ * (body_->inverse_mass * body_->force + base::Vec2{0, -law_.gravity});
  }

  void apply(const Contact& c, double pn, double pt) {
    const double px = pn * c.nx - pt * c.ny, py = pn * c.ny + pt * c.nx;
    const auto push = [&](Motion<double>& m, double sign) {
      m.vx += sign * m.inverse_mass * px;
      m.vy += sign * m.inverse_mass * py;
      m.u -= law_.twist * m.inverse_mass * pt;
    };
    push(system_.body[c.i], -1);
    if (c.j >= 0) push(system_.body[c.j], 1);
    if (c.j == kBody) body_->velocity = body_->velocity + body_->inverse_mass * base::Vec2{px, py};
  }

  /// The normal impulse that solves a contact by itself.
  double soft_normal(const Contact& c, double vn) const {
    const base::Vec2 other = c.j >= 0 ? moved_[c.j] : c.j == kBody ? body_->moved : base::Vec2{};
    const double gap = c.gap + c.nx * (other.x - moved_[c.i].x) + c.ny * (other.y - moved_[c.i].y);
    if (gap > 0) return std::max(0.0, c.pn - (vn + gap / h_) / c.inverse_mass);
    // Catto's soft constraint: implicit Euler of a damped spring of frequency f = stiffness / h.
    const double omega = 2 * std::numbers::pi * law_.stiffness / h_;
    const double a1 = 2 * law_.damping + h_ * omega, a2 = h_ * omega * a1;
    const double push = std::max(omega / a1 * gap, -push_speed(law_, system_.smallest_radius));
    return std::max(0.0, c.pn - a2 / (1 + a2) * (vn + push) / c.inverse_mass - c.pn / (1 + a2));
  }
  double rigid_normal(const Contact& c, double vn) const {
    double wanted = std::min(-c.gap / h_, push_speed(law_, system_.smallest_radius));
    const bool impact = c.approach < -2 * pull_ * law_.step && c.gap + h_ * c.approach < 0;
    if (law_.restitution > 0 && impact) wanted = std::max(wanted, -law_.restitution * c.approach);
    return std::max(0.0, c.pn + (wanted - vn) / c.inverse_mass);
  }
  double friction(const Contact& c, double pn, double vt) const {
    return std::clamp(c.pt - vt / c.tangential_inverse_mass, -c.friction * pn, c.friction * pn);
  }

  using Normal = double (Step::*)(const Contact&, double) const;
  static constexpr Normal soft_ = &Step::soft_normal, rigid_ = &Step::rigid_normal;

  double rms(double sum) const {
    const auto touching = std::ranges::count_if(contacts_, [](const Contact& c) { return c.pn > 0; });
    return touching > 0 ? std::sqrt(sum / static_cast<double>(touching)) : 0;
  }

  /// One Gauss-Seidel sweep; rms velocity that it changed: normal, and for the non-smooth method tangential as well.
  double sweep(Normal normal) {
    double sum = 0;
    for (Contact& c : contacts_) {
      const Across v = across(c);
      const double pn = (this->*normal)(c, v.normal), pt = friction(c, pn, v.tangential);
      const double dvn = c.inverse_mass * (pn - c.pn), dvt = c.tangential_inverse_mass * (pt - c.pt);
      sum += dvn * dvn + (law_.nonsmooth ? dvt * dvt : 0);
      apply(c, pn - c.pn, pt - c.pt);
      c.pn = pn, c.pt = pt;
    }
    return rms(sum);
  }

  /// What solving every contact by itself would change, from one and the same state.
  double natural_map() const {
    double sum = 0;
    for (const Contact& c : contacts_) {
      const Across v = across(c);
      const double pn = rigid_normal(c, v.normal);
      const double dvn = c.inverse_mass * (pn - c.pn);
      const double dvt = c.tangential_inverse_mass * (friction(c, pn, v.tangential) - c.pt);
      sum += dvn * dvn + dvt * dvt;
    }
    return rms(sum);
  }

  /// Impulses, and their work on the mean of the velocities at both ends of the sub-step.
  void account(const std::vector<Motion<double>>& before, base::Vec2 body_before) {
    for (Contact& c : contacts_) {
      c.step_pn += c.pn, c.step_pt += c.pt;
      const Across v0 = across(c, before, body_before), v1 = across(c);
      totals_.dissipation -=
          0.5 * (c.pn * (v0.normal + v1.normal) + c.pt * (v0.tangential + v1.tangential));
      if (c.j != kBody) continue;
      const base::Vec2 press{c.pn * c.nx - c.pt * c.ny, c.pn * c.ny + c.pt * c.nx};
      totals_.body_work -= 0.5 * dot(press, body_before + body_->velocity);
    }
    for (std::size_t i = 0; i < grains_.push.size(); ++i) {
      const Motion<double>&m0 = before[i], &m1 = system_.body[i];
      totals_.push_work += 0.5 * h_ * grains_.mass[i] * dot(grains_.push[i], {m0.vx + m1.vx, m0.vy + m1.vy});
    }
  }

  void move() {
    for (std::size_t i = 0; i < moved_.size(); ++i)
      moved_[i] = moved_[i] + h_ * base::Vec2{system_.body[i].vx, system_.body[i].vy};
    if (body_) body_->moved = body_->moved + h_ * body_->velocity;
  }

  /// After the soft sub-steps, contacts that closed in this step leave with e times their speed of approach.
  void rebound() {
    for (Contact& c : contacts_) {
      const Across v = across(c);
      const base::Vec2 other = c.j >= 0 ? moved_[c.j] : c.j == kBody ? body_->moved : base::Vec2{};
      const double gap = c.gap + c.nx * (other.x - moved_[c.i].x) + c.ny * (other.y - moved_[c.i].y);
      const bool impact = c.approach < -2 * pull_ * law_.step;
      const bool stopped = c.pn > 0 || v.normal > 0.5 * c.approach;
      if (!impact || !stopped || gap >= -c.approach * h_) continue;
      const double pn = std::max(0.0, -(v.normal + law_.restitution * c.approach) / c.inverse_mass);
      const double pt = std::clamp(-v.tangential / c.tangential_inverse_mass, -c.friction * pn, c.friction * pn);
      apply(c, pn, pt);
      c.step_pn += pn, c.step_pt += pt;
      const Across after = across(c);
      totals_.dissipation -= 0.5 * (pn * (v.normal + after.normal) + pt * (v.tangential + after.tangential));
      const base::Vec2 press{pn * c.nx - pt * c.ny, pn * c.ny + pt * c.nx};
      if (c.j == kBody) totals_.body_work -= dot(press, body_->velocity);
      // The balance takes gravity's work, and the push's, on the mean velocity of a sub-step; this shifts the next
      // one's start.
      if (c.j < 0) totals_.dissipation -= 0.5 * h_ * law_.gravity * press.y;
      if (grains_.push.empty()) continue;
      const double late = 0.5 * h_ * dot((c.j < 0 ? base::Vec2{} : grains_.push[c.j]) - grains_.push[c.i], press);
      totals_.push_work -= late;
      totals_.dissipation -= late;
    }
  }

  void finish(ContactReport& report) {
    system_.kept.clear();
    system_.touching.clear();
    system_.overlap = {};
    std::vector<double> overlap;
    for (const Contact& c : contacts_) {
      const Disc& disc = grains_.disc[c.i];
      const double size = c.j >= 0 ? std::min(disc.radius, grains_.disc[c.j].radius) : disc.radius;
      const double arm = disc.radius + 0.5 * c.gap;
      if (c.pn > 0) system_.kept.push_back({c.i, c.j, c.pn, c.pt});
      if (c.pn > 0 || c.gap < 0) {
        overlap.push_back(std::max(0.0, -c.gap / size));
        system_.overlap.between_grains += c.j >= 0;
      }
      if (c.step_pn > 0)
        system_.touching.push_back({c.i, c.j == kBody ? kBody - c.feature : c.j, disc.x + c.nx * arm,
                                    disc.y + c.ny * arm, c.nx, c.ny, -c.gap / size, c.step_pn, c.step_pt});
      const double px = c.step_pn * c.nx - c.step_pt * c.ny, py = c.step_pn * c.ny + c.step_pt * c.nx;
      Impulse* felt = c.j == kLeft    ? &totals_.left
                      : c.j == kRight ? &totals_.right
                      : c.j == kBase  ? &totals_.base
                      : c.j == kBody  ? &totals_.feature[c.feature]
                                      : nullptr;
      if (felt) felt->x += px, felt->y += py;
    }
    std::ranges::sort(overlap, std::greater<>());
    system_.overlap.touching = static_cast<std::int64_t>(overlap.size());
    if (!overlap.empty()) {
      system_.overlap.max = overlap.front();
      system_.overlap.p999 = overlap[overlap.size() / 1000];
      for (const double o : overlap) system_.overlap.mean += o / static_cast<double>(overlap.size());
    }
    for (std::size_t i = 0; i < moved_.size(); ++i) {
      grains_.disc[i].x += moved_[i].x;
      grains_.disc[i].y += moved_[i].y;
      report.finite = report.finite && std::isfinite(grains_.disc[i].x + grains_.disc[i].y);
      report.longest_path = std::max(report.longest_path, norm(moved_[i]));
    }
    if (!body_) return;
    body_->position = body_->position + body_->moved;
    body_->moved = {};
  }

  AllPairs& system_;
  Grains& grains_;
  const Box& box_;
  const ContactLaw& law_;
  RigidBody* body_;
  std::span<const double> path_;
  ContactTotals& totals_;
  double h_;
  double pull_;                    ///< gravity and the largest push together [m/s2]
  std::vector<base::Vec2> moved_;  ///< path of each grain since the start of the step [m]
  std::vector<Contact> contacts_;
};

}  // namespace

void enclose(AllPairs& system, Grains& grains) {
  grains.disc.resize(grains.count());
  system = {};
  for (std::size_t i = 0; i < grains.count(); ++i) {
    system.body.push_back({0, 0, 0, 1 / grains.mass[i]});
    const double radius = grains.disc[i].radius;
    system.smallest_radius = i == 0 ? radius : std::min(system.smallest_radius, radius);
  }
}

ContactReport integrate(AllPairs& system, Grains& grains, const Box& box, const ContactLaw& law, RigidBody* body,
                        std::span<const double> body_path, bool, ContactTotals& totals, const Team&, base::Profile& profile) {
  const base::Stopwatch watch(profile, profile.index("all pairs"));
  return Step(system, grains, box, law, body, body_path, totals).run();
}

std::vector<TouchingContact> touching_contacts(const AllPairs& system, const Grains&, const RigidBody*) {
  return system.touching;
}

Energy energy(const AllPairs& system, const Grains& grains, double gravity, double base, base::Crew*) {
  Energy sum;
  for (std::size_t i = 0; i < grains.count(); ++i)
    sum = sum + energy_of(system.body[i], grains.mass[i], grains.disc[i].y - base, gravity);
  return sum;
}

OverlapStatistics overlaps(const AllPairs& system, const Grains&, const RigidBody*, base::Crew*) { return system.overlap; }

}  // namespace seapile::grains
