#include "solver/grains/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "solver/grains/contact_step.h"
#include "solver/grains/nonsmooth.h"
#include "solver/grains/soft_impulses.h"

namespace seapile::grains {

template <class Real>
ContactReport integrate(ContactSystem<Real>& system, Grains& grains, const Box& box, const ContactLaw& law,
                        RigidBody* body, std::span<const double> body_path, bool keep_impulses, ContactTotals& totals,
                        const Team& team, base::Profile& profile) {
  if (!grains.push.empty() && grains.push.size() != grains.count())
    throw std::logic_error("a push for some grains only");
  const auto method = law.nonsmooth ? integrate_rigidly<Real> : integrate_softly<Real>;
  return method(system, grains, box, law, body, body_path, keep_impulses, totals, team, profile);
}

template <class Real>
std::vector<TouchingContact> touching_contacts(const ContactSystem<Real>& system, const Grains& grains,
                                               const RigidBody* body) {
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

namespace {

/// Overlaps of a region's touching contacts, as shares of the smaller radius.
struct RegionOverlaps {
  std::int64_t touching = 0, between_grains = 0;
  double sum = 0;
  std::vector<double> largest;  ///< as many as may be among the largest thousandth of all, in no order
};

template <class Real>
RegionOverlaps overlaps_of(const ContactBlocks<Real>& blocks, const Grains& grains, std::int32_t region,
                           std::size_t keep) {
  RegionOverlaps found;
  const BlockRange range = blocks_of(blocks, region);
  found.largest.reserve(static_cast<std::size_t>(range.last - range.first) * kLanes);
  for (std::int32_t b = range.first; b < range.last; ++b) {
    if (!blocks.active[b]) continue;
    const ContactBlock<Real>& block = blocks.block[b];
    for (int lane = 0; lane < kLanes; ++lane) {
      const double gap = static_cast<double>(block.gap[lane]);
      if (!(block.pn[lane] > 0) && !(gap < 0)) continue;
      const double ri = grains.disc[body_at(block.i[lane])].radius, rj = grains.disc[body_at(block.j[lane])].radius;
      found.between_grains += rj > 0;
      found.largest.push_back(std::max(-gap / (rj > 0 ? std::min(ri, rj) : ri), 0.0));
      found.sum += found.largest.back();
    }
  }
  found.touching = static_cast<std::int64_t>(found.largest.size());
  if (found.largest.size() > keep) {
    std::nth_element(found.largest.begin(), found.largest.begin() + static_cast<std::ptrdiff_t>(keep),
                     found.largest.end(), std::greater<>());
    found.largest.resize(keep);
  }
  return found;
}

}  // namespace

template <class Real>
OverlapStatistics overlaps(const ContactSystem<Real>& system, const Grains& grains, const RigidBody* body,
                           base::Crew* crew) {
  const ContactBlocks<Real>& blocks = system.blocks;
  const std::size_t at_most = blocks.block.size() * kLanes + (body ? body->contact.size() : 0),
                    keep = at_most / 1000 + 1;
  std::vector<RegionOverlaps> parts(blocks.region_colour.empty() ? 0 : system.regions.count());
  if (!parts.empty())
    for_regions(system.regions, crew, [&](std::int32_t r) { parts[r] = overlaps_of(blocks, grains, r, keep); });
  if (body) {
    RegionOverlaps& of_body = parts.emplace_back();
    for (const BodyContact& c : body->contact)
      if (c.pn > 0 || c.gap < 0) of_body.largest.push_back(std::max(-c.gap / grains.disc[c.grain].radius, 0.0));
    for (const double o : of_body.largest) of_body.sum += o;
    of_body.touching = static_cast<std::int64_t>(of_body.largest.size());
  }

  OverlapStatistics statistics;
  double sum = 0;
  std::vector<double> largest;
  for (const RegionOverlaps& part : parts) {
    statistics.touching += part.touching;
    statistics.between_grains += part.between_grains;
    sum += part.sum;
    largest.insert(largest.end(), part.largest.begin(), part.largest.end());
  }
  if (statistics.touching == 0) return statistics;
  statistics.mean = sum / static_cast<double>(statistics.touching);
  // The smallest overlap that 99.9 % do not exceed: the k-th largest.
  const auto k = static_cast<std::ptrdiff_t>(statistics.touching / 1000);
  std::nth_element(largest.begin(), largest.begin() + k, largest.end(), std::greater<>());
  statistics.p999 = largest[k];
  statistics.max = *std::max_element(largest.begin(), largest.begin() + k + 1);
  return statistics;
}

template <class Real>
Energy energy(const ContactSystem<Real>& system, const Grains& grains, double gravity, double base, base::Crew* crew) {
  std::vector<Energy> parts(system.regions.tiles());
  for_tiles(system.regions, crew, [&](std::int32_t tile) {
    const std::int32_t last = system.regions.first_grain(tile + 1);
    for (std::int32_t i = system.regions.first_grain(tile); i < last; ++i)
      parts[tile] = parts[tile] + energy_of(system.motion(i), grains.mass[i], grains.disc[i].y - base, gravity);
  });
  Energy sum;
  for (const Energy& part : parts) sum = sum + part;
  return sum;
}

#define SEAPILE_INSTANTIATE(Real)                                                                                \
  template ContactReport integrate(ContactSystem<Real>&, Grains&, const Box&, const ContactLaw&, RigidBody*,     \
                                   std::span<const double>, bool, ContactTotals&, const Team&, base::Profile&);  \
  template std::vector<TouchingContact> touching_contacts(const ContactSystem<Real>&, const Grains&,             \
                                                          const RigidBody*);                                     \
  template OverlapStatistics overlaps(const ContactSystem<Real>&, const Grains&, const RigidBody*, base::Crew*); \
  template Energy energy(const ContactSystem<Real>&, const Grains&, double, double, base::Crew*);
SEAPILE_INSTANTIATE(float)
SEAPILE_INSTANTIATE(double)
#undef SEAPILE_INSTANTIATE

}  // namespace seapile::grains
