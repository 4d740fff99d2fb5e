#include "solver/coupling/exchange.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace seapile::coupling {
namespace {

using fluid::kPressure;
using fluid::kVelocityX;
using fluid::kVelocityY;

/// Calls f(vertex, V_ij) for a grain.
void each_share(const Deposit& deposit, std::size_t grain, auto&& f) {
  for (std::int32_t k = deposit.first[grain]; k < deposit.first[grain + 1]; ++k)
    f(static_cast<std::size_t>(deposit.vertex[k]), deposit.volume[k]);
}

/// u/phi at the vertices [m/s].
std::vector<base::Vec2> interstitial(const fluid::Flow& flow) {
  std::vector<base::Vec2> velocity(flow.mesh.vertices());
  for (std::size_t v = 0; v < velocity.size(); ++v) {
    const auto vertex = static_cast<std::int32_t>(v);
    velocity[v] = (1 / flow.porosity[v]) * base::Vec2{flow.u(vertex, kVelocityX), flow.u(vertex, kVelocityY)};
  }
  return velocity;
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
  const std::vector<base::Vec2> between = interstitial(flow);
  std::vector<double> gamma(velocity.size(), 0);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double volume = deposit.immersed[i];
    if (!(volume > 0)) continue;
    double phi = 0;
    base::Vec2 fluid;
    each_share(deposit, i, [&](std::size_t v, double share) {
      phi += share * flow.porosity[v];
      fluid = fluid + share * between[v];
    });
    phi /= volume;
    const double slip = phi * norm((1 / volume) * fluid - velocity[i]), radius = disc[i].radius;
    gamma[i] = std::min(1.0, volume / (std::numbers::pi * radius * radius)) *
               drag_coefficient(law, flow.fluid, 2 * radius, phi, slip);
  }
  return gamma;
}

void put_grains(fluid::Flow& flow, const Deposit& deposit, std::span<const double> vertex_volume,
                std::span<const double> kept, const Suspended& grains, double dt) {
  const std::size_t vertices = flow.mesh.vertices();
  std::vector<double> resistance(vertices, 0);  // B_j
  std::vector<base::Vec2> momentum(vertices);
  std::ranges::fill(flow.mobility, 0.0);
  std::ranges::fill(flow.response, 0.0);
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    const double volume = deposit.immersed[i];
    if (!(volume > 0)) continue;
    const double moves = dt * volume / grains.mass[i];  // volume carried per force
    each_share(deposit, i, [&](std::size_t v, double share) {
      const double gamma = grains.drag[i] * (share / volume);
      resistance[v] += gamma;
      momentum[v] = momentum[v] + gamma * grains.velocity[i];
      flow.mobility[v] += moves * share * kept[v];
      flow.response[v] += moves * gamma;
    });
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const double phi = flow.porosity[v], volume = vertex_volume[v];
    flow.drag[v] = resistance[v] / (volume * phi);
    flow.carried[v] = resistance[v] > 0 ? (phi / resistance[v]) * momentum[v] : base::Vec2{};
    flow.mobility[v] /= volume;
    flow.response[v] /= volume * phi;
  }
}

Forces forces_on(const Deposit& deposit, const fluid::Flow& flow, std::span<const double> vertex_volume,
                 std::span<const double> kept, const Suspended& grains) {
  const std::vector<base::Vec2> between = interstitial(flow), gradient = pressure_gradients(flow, vertex_volume);
  Forces forces{std::vector<base::Vec2>(grains.mass.size()), std::vector<base::Vec2>(grains.mass.size())};
  for (std::size_t i = 0; i < grains.mass.size(); ++i) {
    const double volume = deposit.immersed[i];
    if (!(volume > 0)) continue;
    base::Vec2 fluid;
    each_share(deposit, i, [&](std::size_t v, double share) {
      fluid = fluid + (share / volume) * between[v];
      forces.pressure[i] = forces.pressure[i] - (share * kept[v]) * gradient[v];
    });
    forces.drag[i] = grains.drag[i] * (fluid - grains.velocity[i]);
  }
  return forces;
}

}  // namespace seapile::coupling
