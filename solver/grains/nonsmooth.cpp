#include "solver/grains/nonsmooth.h"

#include "solver/grains/body_contacts.h"
#include "solver/grains/contact_step.h"

namespace seapile::grains {
namespace {

/// What v_n + bias >= 0 asks of a contact.
class Bias {
 public:
  /// `pull`: of gravity and push [m/s2].
  Bias(const ContactLaw& law, double pull, double smallest_radius)
      : law_(law), pull_(pull), inverse_step_(1 / law.step), push_(grains::push_speed(law, smallest_radius)) {}

  /// `approach`: v_n at the start of the step.
  double operator()(double gap, double approach) const {
    const double bias = std::max(gap * inverse_step_, -push_);
    // What gravity and push alone do within two steps is no impact.
    const bool impact = approach < -2 * pull_ * law_.step && gap + law_.step * approach < 0;
    return law_.restitution > 0 && impact ? std::min(bias, law_.restitution * approach) : bias;
  }

 private:
  const ContactLaw& law_;
  double pull_, inverse_step_, push_;
};

template <class Real>
void set_bias(ContactSystem<Real>& system, const Bias& bias, bool restitution, std::int32_t first, std::int32_t last) {
  for (std::int32_t b = first; b < last; ++b) {
    if (!system.blocks.active[b]) continue;
    const ContactBlock<Real>& block = system.blocks.block[b];
    for (int lane = 0; lane < kLanes; ++lane) {
      double approach = 0;
      if (restitution) {
        const Motion<Real>&mi = system.motion(body_at(block.i[lane])), &mj = system.motion(body_at(block.j[lane]));
        approach = static_cast<double>(block.nx[lane] * (mj.vx - mi.vx) + block.ny[lane] * (mj.vy - mi.vy));
      }
      system.iterate[b].bias[lane] = static_cast<Real>(bias(static_cast<double>(block.gap[lane]), approach));
    }
  }
}

/// Nesterov's momentum, which begins anew when the residual grows.
class Momentum {
 public:
  /// The momentum with which the next sweep starts.
  double next(double residual) {
    if (residual > last_) theta_ = 1;
    last_ = residual;
    const double square = theta_ * theta_, theta = 0.5 * (std::sqrt(square * square + 4 * square) - square);
    const double momentum = theta_ * (1 - theta_) / (square + theta);
    theta_ = theta;
    return momentum;
  }

 private:
  double theta_ = 1, last_ = 0;
};

/// Velocities across a contact of the body.
struct Across {
  double normal, tangential;
};
template <class Vector>
Across across(const BodyContact& c, base::Vec2 body, const Vector& grain) {
  const double wx = body.x - static_cast<double>(grain.vx), wy = body.y - static_cast<double>(grain.vy);
  return {c.nx * wx + c.ny * wy, c.nx * wy - c.ny * wx - static_cast<double>(grain.u)};
}

/// The impulses that solve one contact of the body for given velocities.
struct Impulses {
  double pn, pt;
};
Impulses solved(const BodyContact& c, double friction, double pn, double pt, Across v, double mass, double tangential_mass) {
  const double new_pn = std::max(pn - mass * (v.normal + c.bias), 0.0), cone = friction * new_pn;
  return {new_pn, std::clamp(pt - tangential_mass * v.tangential, -cone, cone)};
}

/// One sweep over the body's contacts, by rising grain.
template <class Real>
void solve_body(RigidBody& body, ContactSystem<Real>& system, double momentum, SolveSums& sums) {
  for (BodyContact& c : body.contact) {
    Motion<Real>& grain = system.motion(c.grain);
    const double m = static_cast<double>(grain.inverse_mass);
    const double inverse = m + body.inverse_mass, tangential_inverse = (1 + system.twist) * m + body.inverse_mass;
    const double pn = c.pn + momentum * (c.pn - c.old_pn), pt = c.pt + momentum * (c.pt - c.old_pt);
    const Impulses p =
        solved(c, body.friction, pn, pt, across(c, body.velocity, grain), 1 / inverse, 1 / tangential_inverse);
    const double dpn = p.pn - pn, dpt = p.pt - pt;
    c.old_pn = c.pn, c.old_pt = c.pt;
    c.pn = p.pn, c.pt = p.pt;

    const double px = dpn * c.nx - dpt * c.ny, py = dpn * c.ny + dpt * c.nx;
    grain.vx -= static_cast<Real>(m * px);
    grain.vy -= static_cast<Real>(m * py);
    grain.u -= static_cast<Real>(system.twist * m * dpt);
    body.velocity = body.velocity + body.inverse_mass * base::Vec2{px, py};
    sums.residual += (inverse * dpn) * (inverse * dpn) + (tangential_inverse * dpt) * (tangential_inverse * dpt);
    sums.touching += c.pn > 0;
  }
}

/// Residual and work of the body's contacts at the end of a step; the impulse that the body has felt.
template <class Real>
base::Vec2 assess_body(RigidBody& body, base::Vec2 body_before, const ContactSystem<Real>& system, SolveSums& sums,
                       ContactTotals& totals) {
  base::Vec2 felt;
  for (BodyContact& c : body.contact) {
    const double m = static_cast<double>(system.motion(c.grain).inverse_mass);
    const double inverse = m + body.inverse_mass, tangential_inverse = (1 + system.twist) * m + body.inverse_mass;
    const Across v = across(c, body.velocity, system.motion(c.grain));
    const Across before = across(c, body_before, system.before[c.grain]);
    const Impulses p = solved(c, body.friction, c.pn, c.pt, v, 1 / inverse, 1 / tangential_inverse);
    const double dvn = inverse * (p.pn - c.pn), dvt = tangential_inverse * (p.pt - c.pt);
    sums.residual += dvn * dvn + dvt * dvt;
    sums.touching += c.pn > 0;
    sums.work += 0.5 * (c.pn * (v.normal + before.normal) + c.pt * (v.tangential + before.tangential));

    c.step_pn = c.pn, c.step_pt = c.pt;
    const base::Vec2 press{c.pn * c.nx - c.pt * c.ny, c.pn * c.ny + c.pt * c.nx};
    totals.feature[c.feature].x += press.x;
    totals.feature[c.feature].y += press.y;
    felt = felt + press;
  }
  return felt;
}

SolveSums sum_of(const std::vector<SolveSums>& parts) {
  SolveSums sum;
  for (const SolveSums& s : parts) sum.residual += s.residual, sum.touching += s.touching, sum.work += s.work;
  return sum;
}

double rms(const SolveSums& sum) { return sum.touching > 0 ? std::sqrt(sum.residual / sum.touching) : 0; }

}  // namespace

template <class Real>
ContactReport integrate_rigidly(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                                RigidBody* body, std::span<const double> body_path, bool keep_impulses,
                                ContactTotals& totals, const Team& team, base::Profile& profile) {
  const std::size_t in_list = profile.index("neighbour list"), in_detection = profile.index("contact detection"),
                    in_sweeps = profile.index("sweeps"), in_waiting = profile.index("waiting"),
                    in_pile = profile.index("pile contacts"), in_places = profile.index("places");
  const ContactKernels<Real>& kernel = contact_kernels<Real>(team.instructions);
  const double dt = law.step;
  const bool restitution = law.restitution > 0;
  ContactReport report;
  Laps serial(profile);
  system.twist = law.twist;

  const Closing closing = expected_closing(system, grains, law, body, body_path, team.crew.get());
  report.rebuilt = keep_lists(system, grains, box, body, closing, dt, team.crew.get());
  serial.lap(in_list);

  const Bias bias(law, closing.pull, system.smallest_radius);
  ContactBlocks<Real>& blocks = system.blocks;
  const Regions& regions = system.regions;
  system.iterate.resize(blocks.block.size());
  std::vector<SolveSums> sums(blocks.colour.size() + 1);  // the last one: of the body
  system.body_sums.assign(regions.tiles(), {});  // begin() fills them; the warm start is no work of its own here
  system.path.assign(regions.tiles(), 0);
  const Push<Real>* const grain_push = hold_push(system, grains);
  const Nearness near{closing.margin, dt, system.closing, closing.reach, law.twist};

  const base::Vec2 body_before = !body_path.empty() ? base::Vec2{0, -body_path.back() / dt}
                                 : body             ? body->velocity
                                                    : base::Vec2{};
  base::Vec2 old_body_velocity;
  Momentum nesterov;
  double momentum = 0;
  bool solved = false;

  const auto refresh = [&](std::int32_t first, std::int32_t last) {
    kernel.refresh(blocks.block.data(), blocks.active.data(), blocks.wake.data(), first, last, grains.disc.data(),
                   system.group.data(), system.before.data(), near);
    set_bias(system, bias, restitution, first, last);
  };
  const auto solve = [&](std::int32_t first, std::int32_t last, double friction, SolveSums& sum) {
    kernel.solve(blocks.block.data(), system.iterate.data(), blocks.active.data(), first, last, system.group.data(),
                 static_cast<Real>(friction), static_cast<Real>(law.twist), static_cast<Real>(momentum), &sum);
  };
  const auto assess = [&](std::int32_t first, std::int32_t last, double friction, SolveSums& sum) {
    kernel.assess(blocks.block.data(), system.iterate.data(), blocks.active.data(), first, last, system.group.data(),
                  system.before.data(), static_cast<Real>(friction), static_cast<Real>(law.twist), &sum);
  };

  base::together(team.crew.get(), [&](int me, int threads) {
    Worker worker(regions, team.crew.get(), me, threads, profile, in_waiting);
    /// Calls work(first, last, friction, sum) for every run of a region's blocks.
    const auto for_runs = [&](std::int32_t region, auto&& work) {
      for (std::int32_t colour = blocks.region_colour[region]; colour < blocks.region_colour[region + 1]; ++colour) {
        const Colour& c = blocks.colour[colour];
        work(c.first, c.first_wall, law.friction_grain, sums[colour]);
        if (c.first_wall < c.last) work(c.first_wall, c.last, law.friction_wall, sums[colour]);
      }
    };

    // Detection: normals, gaps, what is asked of each contact, and what the kept impulses do.
    detect(worker, in_detection, system, refresh);
    if (worker.leads() && body) {
      detect_body_contacts(*body, grains, system);
      for (BodyContact& c : body->contact)
        c.bias = bias(c.gap, restitution ? across(c, body_before, system.motion(c.grain)).normal : 0);
      body->velocity = body_before;
      if (body_path.empty())
        body->velocity = body->velocity + dt * body_push(*body, law) + body->inverse_mass * kept_impulse(*body);
      old_body_velocity = body->velocity;
    }
    worker.meet(in_detection);
    for (std::int32_t tile = worker.first_tile; tile < worker.last_tile; ++tile) {
      lay_out_push(system, grains, tile);
      kernel.begin(system.group.data(), system.before.data(), grain_push, regions.first_group(tile),
                   regions.first_group(tile + 1), static_cast<Real>(dt), static_cast<Real>(law.gravity),
                   &system.body_sums[tile]);
    }
    worker.lap(in_detection);

    while (!solved) {
      worker.climb(in_sweeps, [&](std::int32_t region) {
        const Region& r = regions[region];
        if (r.is_tile())
          kernel.extrapolate(system.group.data(), regions.first_group(r.first_tile), regions.first_group(r.last_tile),
                             static_cast<Real>(momentum));
        for_runs(region, solve);
      });

      if (worker.leads()) {
        if (body) {
          const base::Vec2 now = body->velocity;
          if (body_path.empty()) body->velocity = now + momentum * (now - old_body_velocity);
          old_body_velocity = now;
          solve_body(*body, system, momentum, sums.back());
        }
        const double change = rms(sum_of(sums));
        std::ranges::fill(sums, SolveSums{});
        momentum = nesterov.next(change);
        solved = ++report.sweeps >= law.nonsmooth->sweeps || change <= law.nonsmooth->tolerance;
      }
      worker.meet(in_pile);
    }

    // What is left, and what was done.
    worker.each([&](std::int32_t region) {
      for_runs(region, assess);
      for (std::int32_t colour = blocks.region_colour[region]; colour < blocks.region_colour[region + 1]; ++colour)
        keep_step_impulses(blocks, keep_impulses ? blocks.colour[colour].first : blocks.colour[colour].first_wall,
                           blocks.colour[colour].last, true);
    });
    worker.meet(in_places);
    for (std::int32_t tile = worker.first_tile; tile < worker.last_tile; ++tile) {
      for (std::int32_t group = regions.first_group(tile); group < regions.first_group(tile + 1); ++group)
        for (Drift<Real>& drift : system.group[group].drift) drift = {};
      move_places(system, grains, tile, dt);
      sum_push(system, grains, law, tile);
    }
    worker.lap(in_places);
  });

  if (body) {
    const base::Vec2 felt = assess_body(*body, body_before, system, sums.back(), totals);
    totals.body_work -= 0.5 * dot(felt, body_before + body->velocity);
    body->moved = dt * body->velocity;
    move_body(*body);
  }
  close_step(system, totals, report);
  const SolveSums sum = sum_of(sums);
  totals.dissipation -= sum.work;
  for (const PushSums& s : system.push_sums) totals.push_work += s.work;
  report.residual = rms(sum);
  return report;
}

#define SEAPILE_INSTANTIATE(Real)                                                                                      \
  template ContactReport integrate_rigidly(ContactSystem<Real>&, Grains&, const Box&, const ContactLaw&, RigidBody*,   \
                                           std::span<const double>, bool, ContactTotals&, const Team&, base::Profile&);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
