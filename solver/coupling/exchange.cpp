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

/// Fields at the vertices, side by side: a grain's sums read them in one go.
template <std::size_t kFields>
using Fields = std::array<double, kFields>;

/// sum_j V_ij f_j of a grain.
template <std::size_t kFields>
Fields<kFields> integral(const Deposit& deposit, std::size_t grain, const std::vector<Fields<kFields>>& field) {
  Fields<kFields> sum{};
  for (std::int32_t k = deposit.first[grain]; k < deposit.first[grain + 1]; ++k) {
    const Fields<kFields>& at = field[deposit.vertex[k]];
    for (std::size_t c = 0; c < kFields; ++c) sum[c] += deposit.volume[k] * at[c];
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

void set_porosity_rate(fluid::Flow& flow, const fluid::Past& past, fluid::TimeOrder order,
                       const VertexVolumes& volume) {
  const bool second = order == fluid::TimeOrder::second && past.level.size() == 2;
  const std::vector<double> older =
      second ? vertex_volume(flow.mesh.triangle, past.level[1].position) : std::vector<double>{};
  const auto& [now, before] = volume;
  const double inverse = 1 / past.dt;
  for (std::size_t v = 0; v < flow.porosity.size(); ++v) {
    const double solid = before[v] * (1 - past.level[0].porosity[v]);
    double grown = now[v] - before[v], filled = now[v] * (1 - flow.porosity[v]) - solid;
    if (second) {
      grown = 1.5 * grown - 0.5 * (before[v] - older[v]);
      filled = 1.5 * filled - 0.5 * (solid - older[v] * (1 - past.level[1].porosity[v]));
    }
    flow.porosity_rate[v] = inverse * ((1 - flow.porosity[v]) * grown - filled) / now[v];
  }
}

Surroundings surroundings(const fluid::Flow& flow, const Deposit& deposit) {
  std::vector<Fields<3>> field(flow.mesh.vertices());
  for (std::size_t v = 0; v < field.size(); ++v) {
    const base::Vec2 between = interstitial(flow, v);
    field[v] = {between.x, between.y, flow.porosity[v]};
  }
  const std::size_t grains = deposit.immersed.size();
  Surroundings around{std::vector<double>(grains, 1), std::vector<base::Vec2>(grains)};
  for (std::size_t i = 0; i < grains; ++i) {
    if (!(deposit.immersed[i] > 0)) continue;
    const auto [x, y, porosity] = integral(deposit, i, field);
    const double per_volume = 1 / deposit.immersed[i];
    around.porosity[i] = porosity * per_volume;
    around.velocity[i] = {x * per_volume, y * per_volume};
  }
  return around;
}

std::vector<double> drag_coefficients(const DragSpec& law, const fluid::Properties& fluid, const Surroundings& around,
                                      std::span<const double> immersed, std::span<const grains::Disc> disc,
                                      std::span<const base::Vec2> velocity) {
  const std::size_t grains = velocity.size();
  std::vector<double> diameter(grains), slip(grains), gamma(grains);
  for (std::size_t i = 0; i < grains; ++i) {
    diameter[i] = 2 * disc[i].radius;
    slip[i] = around.porosity[i] * norm(around.velocity[i] - velocity[i]);
  }
  drag_coefficients(law, fluid, diameter, around.porosity, slip, gamma);
  for (std::size_t i = 0; i < grains; ++i)
    gamma[i] *= std::min(1.0, immersed[i] / (std::numbers::pi * disc[i].radius * disc[i].radius));
  return gamma;
}

std::vector<Load> load(const Deposit& deposit, const Suspended& grains, double dt, std::size_t vertices) {
  std::vector<Load> sums(vertices);
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    const double volume = deposit.immersed[i];
    if (!(volume > 0)) continue;
    const double gamma = grains.drag[i] / volume, moves = dt * volume / grains.mass[i];
    const base::Vec2 momentum = gamma * grains.velocity[i];
    for (std::int32_t k = deposit.first[i]; k < deposit.first[i + 1]; ++k) {
      Load& sum = sums[deposit.vertex[k]];
      const double share = deposit.volume[k];
      sum.solid += share;
      sum.resistance += share * gamma;
      sum.momentum_x += share * momentum.x;
      sum.momentum_y += share * momentum.y;
      sum.moved += share * moves;
      sum.answered += share * (moves * gamma);
    }
  }
  return sums;
}

void put_grains(fluid::Flow& flow, std::span<const Load> load, std::span<const double> vertex_volume,
                std::span<const double> kept) {
  for (std::size_t v = 0; v < load.size(); ++v) {
    const Load& sum = load[v];
    const double per_volume = 1 / vertex_volume[v], per_fluid = per_volume / flow.porosity[v];
    flow.drag[v] = sum.resistance * per_fluid;
    flow.carried[v] = sum.resistance > 0
                          ? (flow.porosity[v] / sum.resistance) * base::Vec2{sum.momentum_x, sum.momentum_y}
                          : base::Vec2{};
    flow.mobility[v] = sum.moved * kept[v] * per_volume;
    flow.response[v] = sum.answered * per_fluid;
  }
}

Forces forces_on(const Deposit& deposit, const fluid::Flow& flow, std::span<const double> vertex_volume,
                 std::span<const double> kept, const Suspended& grains) {
  const std::vector<base::Vec2> gradient = pressure_gradients(flow, vertex_volume);
  std::vector<Fields<5>> field(flow.mesh.vertices());
  for (std::size_t v = 0; v < field.size(); ++v) {
    const base::Vec2 between = interstitial(flow, v), borne = kept[v] * gradient[v];
    field[v] = {between.x, between.y, flow.porosity[v], borne.x, borne.y};
  }
  const std::size_t count = grains.mass.size();
  Forces forces{std::vector<base::Vec2>(count),
                std::vector<base::Vec2>(count),
                {std::vector<double>(count, 1), std::vector<base::Vec2>(count)}};
  for (std::size_t i = 0; i < count; ++i) {
    if (!(deposit.immersed[i] > 0)) continue;
    const auto [x, y, porosity, borne_x, borne_y] = integral(deposit, i, field);
    const double per_volume = 1 / deposit.immersed[i];
    forces.around.porosity[i] = porosity * per_volume;
    forces.around.velocity[i] = {x * per_volume, y * per_volume};
    forces.drag[i] = grains.drag[i] * (forces.around.velocity[i] - grains.velocity[i]);
    forces.pressure[i] = {-borne_x, -borne_y};
  }
  return forces;
}

}  // namespace seapile::coupling
