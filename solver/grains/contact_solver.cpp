#include "solver/grains/contact_solver.h"

#include <algorithm>
#include <cmath>

#include "solver/grains/contact_step.h"
#include "solver/grains/nonsmooth.h"
#include "solver/grains/soft_impulses.h"

namespace seapile::grains {

template <class Real>
ContactReport integrate(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                        RigidBody* body, std::span<const double> body_path, bool keep_impulses, ContactTotals& totals,
                        const Team& team, base::Profile& profile) {
  const auto method = law.nonsmooth ? integrate_rigidly<Real> : integrate_softly<Real>;
  return method(system, grains, box, law, body, body_path, keep_impulses, totals, team, profile);
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
OverlapStatistics overlaps(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body, base::Crew* crew) {
  OverlapStatistics statistics;
  const ContactBlocks<Real>& blocks = system.blocks;
  const std::size_t regions = blocks.region_colour.empty() ? 0 : system.regions.count();
  std::vector<std::vector<double>> of_region(regions);
  std::vector<std::int64_t> between_grains(regions);
  const auto collect = [&](std::int32_t region) {
    const BlockRange range = blocks_of(blocks, region);
    of_region[region].reserve(static_cast<std::size_t>(range.last - range.first) * kLanes);
    for (std::int32_t b = range.first; b < range.last; ++b) {
      if (!blocks.active[b]) continue;
      const ContactBlock<Real>& block = blocks.block[b];
      for (int lane = 0; lane < kLanes; ++lane) {
        const double gap = static_cast<double>(block.gap[lane]);
        if (!(block.pn[lane] > 0) && !(gap < 0)) continue;
        const double ri = grains.disc[body_at(block.i[lane])].radius, rj = grains.disc[body_at(block.j[lane])].radius;
        between_grains[region] += rj > 0;
        of_region[region].push_back(std::max(-gap / (rj > 0 ? std::min(ri, rj) : ri), 0.0));
      }
    }
  };
  if (regions > 0) for_regions(system.regions, crew, collect);

  std::vector<double> overlap;
  double sum = 0;
  overlap.reserve(blocks.block.size() * kLanes);
  for (std::size_t region = 0; region < regions; ++region) {
    overlap.insert(overlap.end(), of_region[region].begin(), of_region[region].end());
    statistics.between_grains += between_grains[region];
  }
  if (body)
    for (const BodyContact& c : body->contact)
      if (c.pn > 0 || c.gap < 0) overlap.push_back(std::max(-c.gap / grains.disc[c.grain].radius, 0.0));
  statistics.touching = static_cast<std::int64_t>(overlap.size());
  if (overlap.empty()) return statistics;
  for (const double o : overlap) sum += o;
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
  template OverlapStatistics overlaps(const ContactSystem<Real>&, const Grains&, const RigidBody*, base::Crew*);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
