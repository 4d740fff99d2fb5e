#include "solver/grains/soft_impulses.h"

#include <numbers>

#include "solver/grains/body_contacts.h"
#include "solver/grains/contact_step.h"
#include "solver/grains/restitution.h"

namespace seapile::grains {
namespace {

/// Soft constraint of frequency f = stiffness/h and damping ratio zeta over a sub-step h (Catto 2011).
Softness<double> softness(const ContactLaw& law, double smallest_radius) {
  const double h = law.step / law.substeps;
  const double omega = 2 * std::numbers::pi * law.stiffness / h;
  const double a1 = 2 * law.damping + h * omega;
  const double a2 = h * omega * a1;
  const double a3 = 1 / (1 + a2);
  return {1 / h, omega / a1, a2 * a3, a3, push_speed(law, smallest_radius), law.twist};
}

template <class Real>
Softness<Real> narrow(const Softness<double>& s) {
  return {static_cast<Real>(s.inverse_h),     static_cast<Real>(s.bias_rate),  static_cast<Real>(s.mass_scale),
          static_cast<Real>(s.impulse_scale), static_cast<Real>(s.push_speed), static_cast<Real>(s.twist)};
}

/// Vertical contact impulse on a tile's grains in the last sub-step [N s/m].
template <class Real>
double last_lift(const ContactSystem<Real>& system, const Grains& grains, std::int32_t tile, double h, double gravity) {
  const double fall = h * gravity;
  double lift = 0;
  const std::int32_t last = system.regions.first_grain(tile + 1);
  for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i)
    lift += grains.mass[i] * (static_cast<double>(system.motion(i).vy - system.before[i].vy) + fall);
  if (system.push.empty()) return lift;
  for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i)
    lift -= grains.mass[i] * h * static_cast<double>(system.push[i].y);
  return lift;
}

}  // namespace

template <class Real>
ContactReport integrate_softly(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                               RigidBody* body, std::span<const double> body_path, bool keep_impulses,
                               ContactTotals& totals, const Team& team, base::Profile& profile) {
  const std::size_t in_list = profile.index("neighbour list"), in_detection = profile.index("contact detection"),
                    in_sweeps = profile.index("sweeps"), in_waiting = profile.index("waiting"),
                    in_pile = profile.index("pile contacts"), in_places = profile.index("places");
  const ContactKernels<Real>& kernel = contact_kernels<Real>(team.instructions);
  const double h = law.step / law.substeps;
  const Softness<double> soft = softness(law, system.smallest_radius);
  const Softness<Real> soft_real = narrow<Real>(soft);
  ContactReport report;
  report.sweeps = law.substeps;
  Laps serial(profile);
  system.twist = law.twist;

  const Closing closing = expected_closing(system, grains, law, body, body_path, team.crew.get());
  report.rebuilt = keep_lists(system, grains, box, body, closing, law.step, team.crew.get());
  serial.lap(in_list);

  ContactBlocks<Real>& blocks = system.blocks;
  const Regions& regions = system.regions;
  system.sweep_sums.assign(blocks.colour.size(), {});
  system.body_sums.assign(regions.tiles(), {});
  system.path.assign(regions.tiles(), 0);
  const Push<Real>* const grain_push = hold_push(system, grains);
  const Nearness near{closing.margin, law.step, system.closing, closing.reach, law.twist};
  BodySweep body_sweep;
  base::Vec2 body_before;  // velocity of the body at the start of the sub-step
  std::atomic<std::int64_t> touching = 0;
  double kept_work = 0;  // of the body's kept impulses on its own motion, as the grains feel them [J/m]

  const auto refresh = [&](std::int32_t first, std::int32_t last) {
    kernel.refresh(blocks.block.data(), blocks.active.data(), blocks.wake.data(), first, last, grains.disc.data(),
                   system.group.data(), system.before.data(), near);
  };
  const auto sweep = [&](std::int32_t first, std::int32_t last, double friction, SweepSums& sums) {
    kernel.sweep(blocks.block.data(), blocks.active.data(), first, last, system.group.data(),
                 static_cast<Real>(friction), soft_real, &sums);
  };

  base::together(team.crew.get(), [&](int me, int threads) {
    Worker worker(regions, team.crew.get(), me, threads, profile, in_waiting);

    // Detection: normals and gaps, and the velocity change by the impulses kept from the last step.
    detect(worker, in_detection, system, refresh);
    for (std::int32_t tile = worker.first_tile; tile < worker.last_tile; ++tile) lay_out_push(system, grains, tile);
    if (worker.leads()) {
      if (body) detect_body_contacts(*body, grains, system);
      if (law.restitution > 0) {
        const base::Vec2 driven{0, body_path.empty() ? 0 : -body_path.front() / h};
        remember_approach(system, body, body && body_path.empty() ? body->velocity : driven);
      }
    }
    worker.meet(in_detection);

    for (int k = 0; k < law.substeps; ++k) {
      // A tile begins with gravity, push and warm start, then come its contacts, while its bodies are in the cache.
      worker.climb(in_sweeps, [&](std::int32_t region) {
        const Region& r = regions[region];
        if (r.is_tile())
          (k == 0 ? kernel.begin : kernel.advance)(system.group.data(), system.before.data(), grain_push,
                                                   regions.first_group(r.first_tile), regions.first_group(r.last_tile),
                                                   static_cast<Real>(h), static_cast<Real>(law.gravity),
                                                   &system.body_sums[r.first_tile]);
        for (std::int32_t colour = blocks.region_colour[region]; colour < blocks.region_colour[region + 1]; ++colour) {
          const Colour& c = blocks.colour[colour];
          sweep(c.first, c.first_wall, law.friction_grain, system.sweep_sums[colour]);
          if (c.first_wall < c.last) sweep(c.first_wall, c.last, law.friction_wall, system.sweep_sums[colour]);
          keep_step_impulses(blocks, keep_impulses ? c.first : c.first_wall, c.last, k == 0);
        }
      });

      // The rigid body: its own velocity, prescribed, or by gravity, its force and its warm start; then its contacts.
      if (worker.leads() && body) {
        body_before = body->velocity;
        if (!body_path.empty())
          body->velocity = {0, -(body_path[k] - (k > 0 ? body_path[k - 1] : 0.0)) / h};
        else
          body->velocity = body->velocity + h * body_push(*body, law) + body->inverse_mass * kept_impulse(*body);
        const BodySweep s = sweep_body_contacts(*body, system, soft, totals);
        body_sweep.work += s.work;
        body_sweep.residual += s.residual;
        if (!body_path.empty()) {
          totals.body_work -= dot(s.felt, body->velocity);
          kept_work -= dot(s.kept, body->velocity);
        } else {
          // A free body's impulses work on the mean of its velocities at both ends of the sub-step, as a grain's do.
          const base::Vec2 push = h * body_push(*body, law);
          totals.body_work -= 0.5 * dot(s.felt, body_before + body->velocity);
          kept_work -= dot(s.kept, body_before + push + 0.5 * body->inverse_mass * s.kept) - 0.5 * dot(s.felt, push);
        }
        body->moved = body->moved + h * body->velocity;
      }
      worker.meet(in_pile);
    }

    std::int64_t own_touching = 0;
    for (std::int32_t tile = worker.first_tile; tile < worker.last_tile; ++tile) {
      move_places(system, grains, tile, h);
      system.body_sums[tile].lift += last_lift(system, grains, tile, h, law.gravity);
      sum_push(system, grains, law, tile);
    }
    worker.each([&](std::int32_t region) { own_touching += touching_in(blocks, region); });
    touching += own_touching;
    worker.lap(in_places);
  });

  if (body) move_body(*body);
  if (law.restitution > 0) rebound(system, grains, law, closing.pull, body, totals);
  close_step(system, totals, report);

  // Ordered sums.
  double sweep_work = 0, residual = 0, warm_work = 0, lift = 0;
  for (const SweepSums& s : system.sweep_sums) sweep_work += s.work, residual += s.residual;
  for (const BodySums& s : system.body_sums) warm_work += s.work, lift += s.lift;
  // The impulses' work on the mean of the velocities at both ends of a sub-step (formulation.md 2.6).
  totals.dissipation += kept_work - warm_work - sweep_work - body_sweep.work - 0.5 * h * law.gravity * lift;
  for (const PushSums& s : system.push_sums) totals.dissipation += s.shared, totals.push_work += s.work;
  if (touching > 0)
    report.residual = std::sqrt((residual + body_sweep.residual) / (static_cast<double>(touching) * law.substeps));
  return report;
}

#define SEAPILE_INSTANTIATE(Real)                                                                                   \
  template ContactReport integrate_softly(ContactSystem<Real>&, Grains&, const Box&, const ContactLaw&, RigidBody*, \
                                          std::span<const double>, bool, ContactTotals&, const Team&, base::Profile&);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
