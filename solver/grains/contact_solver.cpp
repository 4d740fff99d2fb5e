#include "solver/grains/contact_solver.h"

#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include "solver/grains/body_contacts.h"
#include "solver/grains/contact_lists.h"
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
  // An overlap is corrected by at most a tenth of the smallest radius per step.
  return {1 / h, omega / a1, a2 * a3, a3, 0.1 * smallest_radius / law.step};
}

template <class Real>
Softness<Real> narrow(const Softness<double>& s) {
  return {static_cast<Real>(s.inverse_h), static_cast<Real>(s.bias_rate), static_cast<Real>(s.mass_scale),
          static_cast<Real>(s.impulse_scale), static_cast<Real>(s.push_speed)};
}

/// True when some pair that is not listed might touch during the coming step.
template <class Real>
bool list_is_worn(const ContactSystem<Real>& system, const Grains& grains, double reach) {
  if (system.listed.size() != grains.count()) return true;
  // Cheap bound first: no gap has closed by more than this.
  if (system.closing - system.listed_closing + reach <= system.skin) return false;
  double longest = 0;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    const double dx = grains.disc[i].x - system.listed[i].x, dy = grains.disc[i].y - system.listed[i].y;
    longest = std::max(longest, dx * dx + dy * dy);
  }
  return 2 * std::sqrt(longest) + reach > system.skin;
}

template <class Real>
double squared_speed(const Motion<Real>& m) {
  const double vx = static_cast<double>(m.vx), vy = static_cast<double>(m.vy);
  return vx * vx + vy * vy;
}

/// The larger of both; NaN when one of them is.
double larger_or_nan(double a, double b) { return a < b || std::isnan(b) ? b : a; }

/// Acceleration of a free body but for its contacts.
base::Vec2 body_push(const RigidBody& body, const ContactLaw& law) {
  return body.inverse_mass * body.force + base::Vec2{0, -law.gravity};
}

/// The impulse that a body's contacts keep from the sub-step before.
base::Vec2 kept_impulse(const RigidBody& body) {
  base::Vec2 kept;
  for (const BodyContact& c : body.contact) kept = kept + base::Vec2{c.pn * c.nx - c.pt * c.ny, c.pn * c.ny + c.pt * c.nx};
  return kept;
}

/// First block of a tile's own contacts; of the contacts between tiles when `tile` is the number of tiles.
template <class Real>
std::int32_t first_block(const ContactBlocks<Real>& blocks, std::int32_t tile) {
  const std::int32_t colour = blocks.tile_colour[tile];
  return colour < static_cast<std::int32_t>(blocks.colour.size()) ? blocks.colour[colour].first
                                                                  : static_cast<std::int32_t>(blocks.block.size());
}

/// Adds the seconds since the last lap to a part; only the first thread of a team measures.
class Laps {
 public:
  Laps(base::Profile& profile, bool measures) : profile_(profile), measures_(measures) {
    if (measures_) last_ = Clock::now();
  }
  void lap(std::size_t part) {
    if (!measures_) return;
    const auto now = Clock::now();
    profile_.add(part, std::chrono::duration<double>(now - last_).count());
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  base::Profile& profile_;
  bool measures_;
  Clock::time_point last_;
};

}  // namespace

template <class Real>
ContactReport integrate(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                        RigidBody* body, std::span<const double> body_path, bool keep_impulses, ContactTotals& totals,
                        const Team& team, base::Profile& profile) {
  const std::size_t in_list = profile.index("neighbour list"), in_detection = profile.index("contact detection"),
                    in_tiles = profile.index("sweeps in tiles"), in_between = profile.index("sweeps between tiles"),
                    in_pile = profile.index("pile contacts"), in_places = profile.index("places");
  const ContactKernels<Real>& kernel = contact_kernels<Real>(team.instructions);
  const double h = law.step / law.substeps;
  const Softness<double> soft = softness(law, system.smallest_radius);
  const Softness<Real> soft_real = narrow<Real>(soft);
  const std::size_t count = grains.count();
  ContactReport report;
  Laps serial(profile, true);

  // How far a gap may close within this step: both bodies at three times the largest speed, along both axes. `margin` is
  // the part of it that does not come from their own velocities.
  double fastest = 0;
  for (std::size_t i = 0; i < count; ++i) fastest = std::max(fastest, squared_speed(system.motion(static_cast<std::int32_t>(i))));
  const double body_speed = body_path.empty() ? (body ? norm(body->velocity) : 0) : std::abs(body_path.back()) / law.step;
  const double margin = body_speed * law.step + 4 * law.gravity * law.step * law.step + 0.01 * system.smallest_radius;
  const double reach = 6 * law.step * std::max(std::sqrt(fastest), body_speed) + margin;

  // Lists, when they are worn; those of the body wear by its own path too. Two grains that may cross the whole skin
  // within this step are looked for farther out; as the skin says less than such a list holds, it wears early.
  const bool leaps = 2 * law.step * std::sqrt(fastest) + margin > system.skin;
  if (leaps || list_is_worn(system, grains, std::min(reach, 0.5 * system.skin))) {
    const double skin = system.skin;
    if (leaps) system.skin = reach;
    list_contacts(system, grains, box);
    if (body) list_body_contacts(*body, grains, 3 * system.skin);
    system.skin = skin;
    report.rebuilt = true;
  } else if (body && body->listed_travel + body_speed * law.step > system.skin) {
    list_body_contacts(*body, grains, 3 * system.skin);
  }
  place_wall_points(system, grains, box);
  serial.lap(in_list);

  ContactBlocks<Real>& blocks = system.blocks;
  const std::int32_t groups = first_point(count) / 4, tiles = tile_count(count);
  const auto colours = static_cast<std::int32_t>(blocks.colour.size()), first_between = blocks.tile_colour[tiles];
  const auto chunks_in = [&](std::int32_t colour) {
    const Colour& c = blocks.colour[colour];
    return (c.first_wall - c.first + kBlocksPerChunk - 1) / kBlocksPerChunk;
  };
  std::int32_t between_chunks = 0;
  for (std::int32_t colour = first_between; colour < colours; ++colour) between_chunks += chunks_in(colour);
  system.sweep_sums.assign(first_between + between_chunks, {});
  system.body_sums.assign(tiles, {});
  system.path.assign(tiles, 0);
  const Nearness near{margin, law.step, system.closing, reach};
  BodySweep body_sweep;
  base::Vec2 body_before;  // velocity of the body at the start of the sub-step
  double kept_work = 0;    // of the body's kept impulses on its own motion, as the grains feel them [J/m]

  const auto refresh = [&](std::int32_t first, std::int32_t last) {
    kernel.refresh(blocks.block.data(), blocks.active.data(), blocks.wake.data(), first, last, grains.disc.data(),
                   system.group.data(), system.before.data(), near);
  };
  const auto sweep = [&](std::int32_t first, std::int32_t last, double friction, SweepSums& sums) {
    kernel.sweep(blocks.block.data(), blocks.active.data(), first, last, system.group.data(),
                 static_cast<Real>(friction), soft_real, &sums);
  };
  const auto keep = [&](std::int32_t first, std::int32_t last, bool afresh) {
    for (std::int32_t b = first; b < last; ++b) {
      if (afresh) blocks.step_impulse[b] = {};
      for (int lane = 0; lane < kLanes; ++lane) {
        blocks.step_impulse[b].normal[lane] += static_cast<double>(blocks.block[b].pn[lane]);
        blocks.step_impulse[b].tangential[lane] += static_cast<double>(blocks.block[b].pt[lane]);
      }
    }
  };

#pragma omp parallel num_threads(team.threads) if (team.threads > 1)
  {
    const int me = omp_get_thread_num(), all = omp_get_num_threads();
    const auto meet = [all] {
      if (all == 1) return;  // A barrier of one would still be a system call.
#pragma omp barrier
    };
    Laps laps(profile, me == 0);
    // A thread keeps its tiles, so that they stay in its cache.
    const std::int32_t first_tile = tiles * me / all, last_tile = tiles * (me + 1) / all;
    const auto groups_from = [&](std::int32_t tile) { return std::min(tile * (kTileGrains / 4), groups); };
    // So does it with the contacts between tiles, as far as their grains are its own.
    const auto for_chunks_between = [&](std::int32_t colour, auto&& work) {
      const Colour& c = blocks.colour[colour];
      for (std::int32_t k = 0; k < chunks_in(colour); ++k) {
        const std::int32_t first = c.first + k * kBlocksPerChunk;
        const std::int32_t tile = body_at(blocks.block[first].i[0]) / kTileGrains;
        if (first_tile <= tile && tile < last_tile) work(k, first, std::min(first + kBlocksPerChunk, c.first_wall));
      }
    };

    // Detection: normals and gaps, and the velocity change by the impulses kept from the last step.
    for (std::int32_t tile = first_tile; tile < last_tile; ++tile) {
      for (std::int32_t i = 4 * groups_from(tile); i < 4 * groups_from(tile + 1); ++i)
        system.before[i] = {0, 0, 0, system.before[i].half_mass};
      refresh(first_block(blocks, tile), first_block(blocks, tile + 1));
    }
    meet();
    for (std::int32_t colour = first_between; colour < colours; ++colour) {
      for_chunks_between(colour, [&](std::int32_t, std::int32_t first, std::int32_t last) { refresh(first, last); });
      meet();
    }
#pragma omp master
    {
      if (body) detect_body_contacts(*body, grains, system);
      if (law.restitution > 0) {
        const base::Vec2 driven{0, body_path.empty() ? 0 : -body_path.front() / h};
        remember_approach(system, body, body && body_path.empty() ? body->velocity : driven);
      }
    }
    meet();
    laps.lap(in_detection);

    for (int k = 0; k < law.substeps; ++k) {
      // Tile by tile: gravity and warm start, then the contacts inside the tile, while its bodies are in the cache.
      for (std::int32_t tile = first_tile; tile < last_tile; ++tile) {
        (k == 0 ? kernel.begin : kernel.advance)(system.group.data(), system.before.data(), groups_from(tile),
                                                 groups_from(tile + 1), static_cast<Real>(h),
                                                 static_cast<Real>(law.gravity), &system.body_sums[tile]);
        for (std::int32_t colour = blocks.tile_colour[tile]; colour < blocks.tile_colour[tile + 1]; ++colour) {
          const Colour& c = blocks.colour[colour];
          sweep(c.first, c.first_wall, law.friction_grain, system.sweep_sums[colour]);
          if (c.first_wall < c.last) sweep(c.first_wall, c.last, law.friction_wall, system.sweep_sums[colour]);
          keep(keep_impulses ? c.first : c.first_wall, c.last, k == 0);
        }
      }
      // The rigid body's own velocity: prescribed, or by gravity, its force and its warm start.
#pragma omp master
      if (body) {
        body_before = body->velocity;
        if (!body_path.empty())
          body->velocity = {0, -(body_path[k] - (k > 0 ? body_path[k - 1] : 0.0)) / h};
        else
          body->velocity = body->velocity + h * body_push(*body, law) + body->inverse_mass * kept_impulse(*body);
      }
      meet();
      laps.lap(in_tiles);

      // Contacts between tiles, colour by colour.
      std::int32_t first_sum = first_between;
      for (std::int32_t colour = first_between; colour < colours; ++colour) {
        for_chunks_between(colour, [&](std::int32_t c, std::int32_t first, std::int32_t last) {
          sweep(first, last, law.friction_grain, system.sweep_sums[first_sum + c]);
          if (keep_impulses) keep(first, last, k == 0);
        });
        first_sum += chunks_in(colour);
        meet();
      }
      laps.lap(in_between);

#pragma omp master
      if (body) {
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
      meet();
      laps.lap(in_pile);
    }

    // Places: the path of the step is added in double.
    for (std::int32_t tile = first_tile; tile < last_tile; ++tile) {
      double longest = 0, lift = 0;
      for (std::int32_t i = 4 * groups_from(tile); i < std::min(4 * groups_from(tile + 1), static_cast<std::int32_t>(count)); ++i) {
        const Motion<Real>& now = system.motion(i);
        const double dx = static_cast<double>(system.drift(i).dx) + h * static_cast<double>(now.vx);
        const double dy = static_cast<double>(system.drift(i).dy) + h * static_cast<double>(now.vy);
        grains.disc[i].x += dx;
        grains.disc[i].y += dy;
        // A place that is no number makes the path none, too.
        const double square = dx * dx + dy * dy + 0 * (grains.disc[i].x + grains.disc[i].y);
        longest = larger_or_nan(longest, square);
        lift += grains.mass[i] * (static_cast<double>(now.vy - system.before[i].vy) + h * law.gravity);
      }
      system.body_sums[tile].lift += lift;
      system.path[tile] = longest;
    }
    laps.lap(in_places);
  }

  if (body) {
    body->position = body->position + body->moved;
    body->listed_travel += norm(body->moved);
    body->moved = {};
  }
  if (law.restitution > 0) rebound(system, grains, law, body, totals);

  // Ordered sums.
  double sweep_work = 0, residual = 0, warm_work = 0, lift = 0, longest = 0;
  for (const SweepSums& s : system.sweep_sums) sweep_work += s.work, residual += s.residual;
  for (const BodySums& s : system.body_sums) warm_work += s.work, lift += s.lift;
  for (const double p : system.path) longest = larger_or_nan(longest, p);
  // The impulses' work on the mean of the velocities at both ends of a sub-step (formulation.md 2.6).
  totals.dissipation += kept_work - warm_work - sweep_work - body_sweep.work - 0.5 * h * law.gravity * lift;
  std::int64_t touching = 0;
  for (std::size_t k = 0; k < blocks.block.size(); ++k)
    if (blocks.active[k])
      for (int lane = 0; lane < kLanes; ++lane) touching += blocks.block[k].pn[lane] > 0;
  report.residual = touching > 0 ? std::sqrt((residual + body_sweep.residual) / (static_cast<double>(touching) * law.substeps)) : 0;

  for (std::size_t k = 0; k < blocks.wall.size(); ++k) {
    const std::int32_t slot = blocks.wall_slot[k];
    const double pn = blocks.step_impulse[slot / kLanes].normal[slot % kLanes];
    const double pt = blocks.step_impulse[slot / kLanes].tangential[slot % kLanes];
    // n points from the grain to the wall, t = (-n_y, n_x).
    if (blocks.wall[k] == Wall::left) totals.left.x -= pn, totals.left.y -= pt;
    if (blocks.wall[k] == Wall::right) totals.right.x += pn, totals.right.y += pt;
    if (blocks.wall[k] == Wall::base) totals.base.y -= pn, totals.base.x += pt;
  }
  report.longest_path = std::sqrt(longest);
  system.closing += 2 * report.longest_path;
  report.finite = std::isfinite(longest);
  return report;
}

template <class Real>
std::vector<TouchingContact> touching_contacts(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body) {
  std::vector<TouchingContact> touching;
  const ContactBlocks<Real>& blocks = system.blocks;
  const auto add = [&](std::int32_t first, std::int32_t second, double size, std::int32_t slot) {
    const ContactBlock<Real>& block = blocks.block[slot / kLanes];
    const int lane = slot % kLanes;
    const double gap = static_cast<double>(block.gap[lane]), pn = blocks.step_impulse[slot / kLanes].normal[lane];
    if (!blocks.active[slot / kLanes] || !(pn > 0)) return;
    const Disc& disc = grains.disc[first];
    const double nx = static_cast<double>(block.nx[lane]), ny = static_cast<double>(block.ny[lane]);
    touching.push_back({first, second, disc.x + nx * (disc.radius + 0.5 * gap), disc.y + ny * (disc.radius + 0.5 * gap),
                        nx, ny, -gap / size, pn, blocks.step_impulse[slot / kLanes].tangential[lane]});
  };
  for (std::size_t p = 0; p < system.pair.size(); ++p) {
    const auto [i, j] = system.pair[p];
    add(i, j, std::min(grains.disc[i].radius, grains.disc[j].radius), system.pair_slot[p]);
  }
  for (std::size_t w = 0; w < blocks.wall.size(); ++w)
    add(blocks.wall_grain[w], -1 - static_cast<std::int32_t>(blocks.wall[w]), grains.disc[blocks.wall_grain[w]].radius,
        blocks.wall_slot[w]);
  if (body)
    for (const BodyContact& c : body->contact) {
      if (!(c.step_pn > 0)) continue;
      const Disc& disc = grains.disc[c.grain];
      const double arm = disc.radius + 0.5 * c.gap;
      touching.push_back({c.grain, -4 - c.feature, disc.x + c.nx * arm, disc.y + c.ny * arm, c.nx, c.ny,
                          -c.gap / disc.radius, c.step_pn, c.step_pt});
    }
  return touching;
}

template <class Real>
OverlapStatistics overlaps(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body) {
  OverlapStatistics statistics;
  std::vector<double> overlap;
  double sum = 0;
  overlap.reserve(system.blocks.block.size() * kLanes / 2);
  for (std::size_t b = 0; b < system.blocks.block.size(); ++b) {
    if (!system.blocks.active[b]) continue;
    const ContactBlock<Real>& block = system.blocks.block[b];
    for (int lane = 0; lane < kLanes; ++lane) {
      const double gap = static_cast<double>(block.gap[lane]);
      if (!(block.pn[lane] > 0) && !(gap < 0)) continue;
      const double ri = grains.disc[body_at(block.i[lane])].radius, rj = grains.disc[body_at(block.j[lane])].radius;
      overlap.push_back(-gap / (rj > 0 ? std::min(ri, rj) : ri));
    }
  }
  if (body)
    for (const BodyContact& c : body->contact)
      if (c.pn > 0 || c.gap < 0) overlap.push_back(-c.gap / grains.disc[c.grain].radius);
  statistics.touching = static_cast<std::int64_t>(overlap.size());
  if (overlap.empty()) return statistics;
  for (double& o : overlap) sum += o = std::max(o, 0.0);
  statistics.mean = sum / static_cast<double>(overlap.size());
  // The smallest overlap that 99.9 % do not exceed: the k-th largest.
  const auto k = static_cast<std::ptrdiff_t>(overlap.size() / 1000);
  // Seldom more than a hundredth lies above four times the mean, and the k largest among it.
  auto last = std::partition(overlap.begin(), overlap.end(), [&](double o) { return o > 4 * statistics.mean; });
  if (last - overlap.begin() <= k) last = overlap.end();
  std::nth_element(overlap.begin(), overlap.begin() + k, last, std::greater<>());
  statistics.p999 = overlap[k];
  statistics.max = *std::max_element(overlap.begin(), overlap.begin() + k + 1);
  return statistics;
}

#define SEAPILE_INSTANTIATE(Real)                                                                                     \
  template ContactReport integrate(ContactSystem<Real>&, Grains&, const Box&, const ContactLaw&, RigidBody*,           \
                                   std::span<const double>, bool, ContactTotals&, const Team&, base::Profile&);             \
  template std::vector<TouchingContact> touching_contacts(const ContactSystem<Real>&, const Grains&, const RigidBody*); \
  template OverlapStatistics overlaps(const ContactSystem<Real>&, const Grains&, const RigidBody*);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
