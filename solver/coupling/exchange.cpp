#include "solver/coupling/exchange.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace seapile::coupling {
namespace {

using fluid::kPressure;
using fluid::kVelocityX;
using fluid::kVelocityY;

/// Four fields at the vertices, side by side: a grain's sums read them in one go.
using Four = std::array<double, 4>;

/// sum_j V_ij f_j of a grain.
Four integral(const Deposit& deposit, std::size_t grain, const std::vector<Four>& field) {
  Four sum{};
  for (std::int32_t k = deposit.first[grain]; k < deposit.first[grain + 1]; ++k) {
    const Four& at = field[deposit.vertex[k]];
    for (int c = 0; c < 4; ++c) sum[c] += deposit.volume[k] * at[c];
  }
  return sum;
}

/// u/phi at a vertex [m/s].
base::Vec2 interstitial(const fluid::Flow& flow, std::size_t v) {
  const auto vertex = static_cast<std::int32_t>(v);
  return (1 / flow.porosity[v]) * base::Vec2{flow.u(vertex, kVelocityX), flow.u(vertex, kVelocityY)};
}

/// g_j: grad p averaged over the vertex [Pa/m].
std::vector<base::Vec2> pressure_gradients(const fluid::Flow& flow, std::span<const double> vertex_volume) {
  std::vector<base::Vec2> g(flow.mesh.vertices());
  for (const auto& t : flow.mesh.triangle) {
    const base::Vec2 a = flow.mesh.position[t[0]], b = flow.mesh.position[t[1]], c = flow.mesh.position[t[2]];
    const double p = flow.u(t[0], kPressure), q = flow.u(t[1], kPressure), r = flow.u(t[2], kPressure);
    // Twice the area times the gradient.
    const base::Vec2 doubled{p * (b.y - c.y) + q * (c.y - a.y) + r * (a.y - b.y),
                             p * (c.x - b.x) + q * (a.x - c.x) + r * (b.x - a.x)};
    for (const std::int32_t v : t) g[v] = g[v] + (1.0 / 6) * doubled;
  }
  for (std::size_t v = 0; v < g.size(); ++v) g[v] = (1 / vertex_volume[v]) * g[v];
  return g;
}

}  // namespace

void set_porosity_rate(fluid::Flow& flow, const fluid::Past& past, fluid::TimeOrder order) {
  struct Level {
    std::vector<double> volume, solid;
  };
  const auto level_of = [&](const std::vector<base::Vec2>& position, const std::vector<double>& porosity) {
    Level level{vertex_volume(flow.mesh.triangle, position), {}};
    for (std::size_t v = 0; v < porosity.size(); ++v) level.solid.push_back(level.volume[v] * (1 - porosity[v]));
    return level;
  };
  const Level now = level_of(flow.mesh.position, flow.porosity);
  const Level before = level_of(past.level[0].position, past.level[0].porosity);
  const bool second = order == fluid::TimeOrder::second && past.level.size() == 2;
  const Level older = second ? level_of(past.level[1].position, past.level[1].porosity) : Level{};
  const double inverse = 1 / past.dt;
  for (std::size_t v = 0; v < flow.porosity.size(); ++v) {
    double grown = now.volume[v] - before.volume[v], filled = now.solid[v] - before.solid[v];
    if (second) {
      grown = 1.5 * grown - 0.5 * (before.volume[v] - older.volume[v]);
      filled = 1.5 * filled - 0.5 * (before.solid[v] - older.solid[v]);
    }
    flow.porosity_rate[v] = inverse * ((1 - flow.porosity[v]) * grown - filled) / now.volume[v];
  }
}

std::vector<double> drag_coefficients(const DragSpec& law, const fluid::Flow& flow, const Deposit& deposit,
                                      std::span<const grains::Disc> disc, std::span<const base::Vec2> velocity) {
  std::vector<Four> field(flow.mesh.vertices());
  for (std::size_t v = 0; v < field.size(); ++v) {
    const base::Vec2 between = interstitial(flow, v);
    field[v] = {flow.porosity[v], between.x, between.y, 0};
  }
  const std::size_t grains = velocity.size();
  std::vector<double> diameter(grains), porosity(grains), slip(grains), gamma(grains);
  for (std::size_t i = 0; i < grains; ++i) {
    const Four sum = integral(deposit, i, field);
    // Grains that are not in the fluid slip as if they were alone in it.
    const bool inside = deposit.immersed[i] > 0;
    const double per_volume = inside ? 1 / deposit.immersed[i] : 0;
    diameter[i] = 2 * disc[i].radius;
    porosity[i] = inside ? sum[0] * per_volume : 1;
    const base::Vec2 relative = base::Vec2{sum[1] * per_volume, sum[2] * per_volume} - velocity[i];
    slip[i] = dot(relative, relative);
  }
  for (std::size_t i = 0; i < grains; ++i) slip[i] = porosity[i] * std::sqrt(slip[i]);
  drag_coefficients(law, flow.fluid, diameter, porosity, slip, gamma);
  for (std::size_t i = 0; i < grains; ++i)
    gamma[i] *= std::min(1.0, deposit.immersed[i] / (std::numbers::pi * disc[i].radius * disc[i].radius));
  return gamma;
}

void put_grains(fluid::Flow& flow, const Deposit& deposit, std::span<const double> vertex_volume,
                std::span<const double> kept, const Suspended& grains, double dt) {
  // What a grain adds to: B_j, momentum x and y, volume moved per force by pressure and by drag; a cache line.
  struct alignas(64) Sums {
    std::array<double, 6> of;
  };
  std::vector<Sums> sums(flow.mesh.vertices());
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    const double volume = deposit.immersed[i];
    if (!(volume > 0)) continue;
    const double gamma = grains.drag[i] / volume, moves = dt * volume / grains.mass[i];
    const base::Vec2 momentum = gamma * grains.velocity[i];
    const std::array<double, 6> each = {gamma, momentum.x, momentum.y, moves, moves * gamma, 0};
    for (std::int32_t k = deposit.first[i]; k < deposit.first[i + 1]; ++k) {
      std::array<double, 6>& sum = sums[deposit.vertex[k]].of;
      for (int c = 0; c < 6; ++c) sum[c] += deposit.volume[k] * each[c];
    }
  }
  for (std::size_t v = 0; v < sums.size(); ++v) {
    const auto& [resistance, momentum_x, momentum_y, moved, response, unused] = sums[v].of;
    const double per_volume = 1 / vertex_volume[v], per_fluid = per_volume / flow.porosity[v];
    flow.drag[v] = resistance * per_fluid;
    flow.carried[v] =
        resistance > 0 ? (flow.porosity[v] / resistance) * base::Vec2{momentum_x, momentum_y} : base::Vec2{};
    flow.mobility[v] = moved * kept[v] * per_volume;
    flow.response[v] = response * per_fluid;
  }
}

Forces forces_on(const Deposit& deposit, const fluid::Flow& flow, std::span<const double> vertex_volume,
                 std::span<const double> kept, const Suspended& grains) {
  const std::vector<base::Vec2> gradient = pressure_gradients(flow, vertex_volume);
  std::vector<Four> field(flow.mesh.vertices());
  for (std::size_t v = 0; v < field.size(); ++v) {
    const base::Vec2 between = interstitial(flow, v), borne = kept[v] * gradient[v];
    field[v] = {between.x, between.y, borne.x, borne.y};
  }
  Forces forces{std::vector<base::Vec2>(grains.mass.size()), std::vector<base::Vec2>(grains.mass.size())};
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    if (!(deposit.immersed[i] > 0)) continue;
    const Four sum = integral(deposit, i, field);
    const double per_volume = 1 / deposit.immersed[i];
    forces.drag[i] = grains.drag[i] * (base::Vec2{sum[0] * per_volume, sum[1] * per_volume} - grains.velocity[i]);
    forces.pressure[i] = {-sum[2], -sum[3]};
  }
  return forces;
}

}  // namespace seapile::coupling
