#include "solver/simulation/build.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>

#include "solver/grains/packing.h"
#include "solver/pile/pile.h"
#include "solver/scene/analysis.h"
#include "solver/simulation/settle.h"
#include "solver/simulation/state.h"

namespace seapile::simulation {
namespace {

grains::Team team_of(const Execution& execution) {
  return {execution.threads > 1 ? std::make_shared<base::Crew>(execution.threads) : nullptr, instructions_of(execution.simd)};
}

grains::ContactLaw law_of(const scene::BedSpec& bed, const grains::ContactSpec& contact) {
  grains::ContactLaw law;
  law.gravity = bed.domain.gravity;
  law.friction_grain = bed.grains.friction.grain;
  law.friction_wall = bed.grains.friction.wall;
  law.restitution = bed.grains.restitution;
  law.step = contact.step;
  law.substeps = static_cast<int>(contact.substeps);
  law.stiffness = contact.stiffness;
  law.damping = contact.damping;
  if (const auto* method = std::get_if<grains::NonSmoothMethod>(&contact.method))
    law.nonsmooth = {static_cast<int>(method->sweeps), method->tolerance, method->correction};
  return law;
}

/// g (1 - rho/rho_p) [m/s2]; g when the scene is dry.
double weight_in_fluid(const scene::SceneSpec& scene) {
  const double g = scene.bed.domain.gravity;
  return scene.fluid ? g * (1 - scene.fluid->density / scene.bed.grains.density) : g;
}

/// Grains that do not spin have an infinite moment of inertia.
double twist_of(const scene::ModelSpec& model) {
  return model.rotation == scene::Rotation::yes ? grains::ContactLaw{}.twist : 0;
}

Simulation enclosed(const scene::BedSpec& bed, const grains::ContactSpec& contact, grains::Grains grains,
                    const Execution& execution) {
  Simulation sim;
  sim.clock.dt = contact.step;
  sim.box = {-bed.domain.width / 2, bed.domain.width / 2, 0};
  sim.law = law_of(bed, contact);
  sim.grains = std::move(grains);
  if (contact.solver == grains::Solver::brute_force)
    sim.contacts.emplace<grains::AllPairs>();
  else if (contact.precision == grains::Precision::double_)
    sim.contacts.emplace<grains::ContactSystem<double>>();
  std::visit([&](auto& system) { enclose(system, sim.grains); }, sim.contacts);
  for (std::size_t i = 0; i < sim.grains.count(); ++i)
    sim.origin.push_back({sim.grains.disc[i].x, sim.grains.disc[i].y});
  sim.surface = grains::bed_surface({sim.grains.disc.data(), sim.grains.count()}, sim.box.left, sim.box.right);
  sim.totals.feature.resize(2);
  sim.team = team_of(execution);
  return sim;
}

template <class T>
const std::vector<T>& values(const std::vector<Array>& arrays, const std::string& name) {
  for (const Array& array : arrays)
    if (array.info.name == name)
      if (const auto* held = std::get_if<std::vector<T>>(&array.values)) return *held;
  throw std::invalid_argument("the bed has no array " + name + " of the expected type");
}

/// f of a contact, to whose square its stiffness is proportional [1/s].
double frequency(const grains::ContactSpec& contact) {
  return contact.stiffness * static_cast<double>(contact.substeps) / contact.step;
}

/// By how much more than in a drive contacts damp while a bed sinks on softer ones than its own: as a column the bed is
/// close to critically damped then, and rests after a third of the time.
constexpr double kSinkingDamping = 5;

bool is_soft(const grains::ContactSpec& contact) { return std::holds_alternative<grains::SoftMethod>(contact.method); }

/// The grains of a scene at its start, where the bed's do not rest: the bed's packing, settled again on the scene's
/// contacts and under its weight in the fluid, so that all runs are of one packing. As arrays: what is built of them
/// knows nothing of how they came to rest.
std::vector<Array> rested(const scene::SceneSpec& scene, const Bed& bed, const Execution& execution,
                          const std::function<void()>& settling) {
  Simulation sim = enclosed(scene.bed, scene.contact, grains_of(bed.grains, scene.bed.grains.density), execution);
  sim.law.gravity = weight_in_fluid(scene);
  sim.law.twist = twist_of(scene.model);
  std::optional<Easing> easing;
  if (has_other_contacts(scene)) {
    const double ratio = frequency(scene.bed.preparation.contact) / frequency(scene.contact);
    if (ratio < 1)
      easing.emplace(ratio * scene.contact.stiffness);
    else
      sim.law.damping *= kSinkingDamping;
  }
  std::vector<Record> unused;
  const auto tell = [&](double) {
    if (settling) settling();
  };
  settle(sim, scene.bed.preparation.longest, execution.trying, unused, tell, easing);
  return arrays_of(sim.grains);
}

/// The same, from a snapshot of the run: its origins are where it began.
std::vector<Array> origins_of(const std::vector<Array>& state) {
  std::vector<Array> start;
  for (const Array& array : state) {
    if (array.info.name != "grains/id" && array.info.name != "grains/origin" && array.info.name != "grains/radius")
      continue;
    start.push_back(array);
    if (array.info.name == "grains/origin") start.back().info.name = "grains/position";
  }
  return start;
}

}  // namespace

bool has_other_contacts(const scene::SceneSpec& scene) {
  const grains::ContactSpec &bed = scene.bed.preparation.contact, &drive = scene.contact;
  return scene.pile && is_soft(bed) && is_soft(drive) && std::abs(frequency(drive) / frequency(bed) - 1) > 1e-9;
}

Simulation build_bed(const scene::BedSpec& bed, grains::Grains grains, double friction, const Execution& execution) {
  Simulation sim = enclosed(bed, bed.preparation.contact, std::move(grains), execution);
  sim.law.friction_grain = friction;
  return sim;
}

Simulation build(const scene::SceneSpec& asked, const Bed& bed, const Execution& execution,
                 const std::vector<Array>& resume_from, const std::function<void()>& settling) {
  const scene::SceneSpec scene = scene::as_built(asked);
  const std::vector<Array> start = !scene.fluid && !has_other_contacts(scene) ? bed.grains
                                   : resume_from.empty()                      ? rested(scene, bed, execution, settling)
                                                                              : origins_of(resume_from);
  Simulation sim = enclosed(scene.bed, scene.contact, grains_of(start, scene.bed.grains.density), execution);
  sim.law.gravity = weight_in_fluid(scene);
  sim.law.twist = twist_of(scene.model);
  if (static_cast<std::int64_t>(sim.grains.count()) != scene.bed.grains.count)
    throw std::invalid_argument("the bed has " + std::to_string(sim.grains.count()) + " grains, the scene " +
                                std::to_string(scene.bed.grains.count));
  if (!scene.pile) return sim;

  Pile& pile = sim.pile.emplace();
  pile.spec = *scene.pile;
  // Above the highest grain under it, by a hundredth of the smallest grain.
  double highest = 0, smallest = scene.bed.grains.radius.max;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) {
    const grains::Disc& d = sim.grains.disc[i];
    smallest = std::min(smallest, d.radius);
    if (std::abs(d.x) < pile.spec.radius + d.radius) highest = std::max(highest, d.y + d.radius);
  }
  pile.start = highest + 0.01 * smallest;
  // The sleeve is longer than anything it can pass.
  pile.body.outline = pile::outline(pile.spec, 2 * (scene.bed.domain.height + pile::tip_height(pile.spec)) + highest);
  pile.body.friction = pile.spec.friction;
  pile.body.position = {0, pile.start};
  sim.gathering.position = pile.start;
  if (scene.fluid) sim.water.emplace(water_around(sim, basin_of(scene, pile.start), scene.fluid->coupling, scene.bed.grains.density));
  if (!resume_from.empty()) restore(sim, resume_from);
  return sim;
}

grains::Grains grains_of(const std::vector<Array>& arrays, double density) {
  const auto& id = values<std::int64_t>(arrays, "grains/id");
  const auto& position = values<double>(arrays, "grains/position");
  const auto& radius = values<double>(arrays, "grains/radius");
  if (position.size() != 2 * id.size() || radius.size() != id.size())
    throw std::invalid_argument("the bed's arrays differ in length");
  std::vector<grains::GivenGrain> given;
  for (std::size_t k = 0; k < id.size(); ++k) given.push_back({id[k], position[2 * k], position[2 * k + 1], radius[k]});
  return grains::arrange(std::move(given), density);
}

std::vector<Array> arrays_of(const grains::Grains& grains) {
  std::vector<std::size_t> order(grains.count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return grains.id[a] < grains.id[b]; });
  std::vector<std::int64_t> id;
  std::vector<double> position, radius;
  for (const std::size_t k : order) {
    id.push_back(grains.id[k]);
    position.insert(position.end(), {grains.disc[k].x, grains.disc[k].y});
    radius.push_back(grains.disc[k].radius);
  }
  return {{{"grains/id", "-", "name of the grain", 1, Entity::grain}, std::move(id)},
          {{"grains/position", "m", "place of the centre", 2, Entity::grain}, std::move(position)},
          {{"grains/radius", "m", "radius", 1, Entity::grain}, std::move(radius)}};
}

base::InstructionSet instructions_of(Simd simd) {
  switch (simd) {
    case Simd::best: break;
    case Simd::generic: return base::InstructionSet::generic;
    case Simd::avx2: return base::InstructionSet::avx2;
    case Simd::avx512: return base::InstructionSet::avx512;
  }
  return base::fastest();
}

const char* simd_in_use(Simd simd) {
  switch (instructions_of(simd)) {
    case base::InstructionSet::avx2: return "avx2";
    case base::InstructionSet::avx512: return "avx512";
    case base::InstructionSet::generic: break;
  }
  return "generic";
}

}  // namespace seapile::simulation
