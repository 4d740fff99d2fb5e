// What grains and fluid give each other, counted on both sides: in the equations that the fluid solves, and on the
// grains. Flows, grains and meshes are random; grains overlap, stick out of the mesh, lie beside it, and fill vertices
// until their porosity is cut.
#include "solver/coupling/exchange.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "solver/fluid/residual.h"
#include "tests/solver/coupling/meshes.h"

namespace seapile::coupling {
namespace {

using base::uniform;
using base::Vec2;
using fluid::kPressure;
using grains::Disc;

constexpr double kStep = 2e-3, kLeast = 0.1, kGrainDensity = 1500;

/// What rounding leaves of sums of some 1e4 terms, by the sum of their sizes; 1e-15 is seen.
constexpr double kRounding = 1e-13;

std::vector<Disc> random_discs(int count, std::uint64_t seed) {
  std::vector<Disc> discs;
  for (int i = 0; i < count; ++i) {
    // A third of them in a corner, where they fill more than there is.
    const double most = i % 3 == 0 ? 0.25 : 1.03;
    discs.push_back(
        {uniform(-0.03, most, seed, 0, i), uniform(-0.03, most, seed, 1, i), uniform(0.011, 0.019, seed, 2, i), 0});
  }
  discs[5] = {3, 3, 0.015, 0};
  return discs;
}

/// A random flow, with grains put into it as a step of the fluid does.
struct Scene {
  Scene(const Scene&) = delete;  // it views itself
  explicit Scene(std::uint64_t seed, Kernel kernel = Kernel::disc, double least = kLeast)
      : flow(fluid::at_rest(shaken(1, 1), {1000, 1e-3})), discs(random_discs(600, seed)) {
    Location location(flow.mesh);
    on = deposit(flow.mesh, location, discs, kernel);
    volume = vertex_volume(flow.mesh);
    porosity = coupling::porosity(solid_volume(on, volume.size()), volume, least);
    flow.porosity = porosity.phi;
    for (std::size_t k = 0; k < flow.unknown.size(); ++k)
      flow.unknown[k] = uniform(-1, 1, seed, 3, k) * (k % 3 == kPressure ? 100 : 0.1);
    for (std::size_t i = 0; i < discs.size(); ++i) {
      const double mass = kGrainDensity * std::numbers::pi * discs[i].radius * discs[i].radius;
      masses.push_back(mass);
      velocities.push_back({uniform(-0.2, 0.2, seed, 4, i), uniform(-0.2, 0.2, seed, 5, i)});
      const double gamma = uniform(0.1, 50, seed, 6, i);
      drags.push_back(gamma * mass / (mass + kStep * gamma));
    }
    grains = {masses, drags, velocities};
    put_grains(flow, load(on, grains, kStep, volume.size()), volume, porosity.kept);
  }
  Vec2 u(std::size_t v) const { return {flow.unknown[3 * v], flow.unknown[3 * v + 1]}; }
  Forces forces() const { return forces_on(on, flow, volume, porosity.kept, grains); }
  /// V_ij, (vertices).
  std::vector<double> row(std::size_t grain) const {
    std::vector<double> row(volume.size(), 0);
    for (std::int32_t k = on.first[grain]; k < on.first[grain + 1]; ++k) row[on.vertex[k]] = on.volume[k];
    return row;
  }

  fluid::Flow flow;
  std::vector<Disc> discs;
  Deposit on;
  std::vector<double> volume;
  Porosity porosity;
  std::vector<double> masses, drags;
  std::vector<Vec2> velocities;
  Suspended grains;  ///< views of these
};

double largest(Vec2 a) { return std::max(std::abs(a.x), std::abs(a.y)); }

struct Sum {
  Vec2 value;
  double size = 0;
  void add(Vec2 a) { value = value + a, size += largest(a); }
};
Sum sum_of(const std::vector<Vec2>& terms) {
  Sum sum;
  for (const Vec2& a : terms) sum.add(a);
  return sum;
}

/// Sum of the fluid's momentum equations: the momentum that the fluid loses inside.
Sum lost_by_fluid(const fluid::Flow& flow) {
  std::vector<double> residual(flow.unknown.size());
  fluid::residual_of(flow, fluid::TimeScheme{}, flow.unknown, residual);
  Sum sum;
  for (std::size_t v = 0; v < flow.mesh.vertices(); ++v) sum.add({residual[3 * v], residual[3 * v + 1]});
  return sum;
}

struct Case {
  std::uint64_t seed;
  Kernel kernel;
  double least;
};
const Case kCases[] = {
    {1, Kernel::disc, kLeast}, {2, Kernel::disc, 0.5}, {3, Kernel::hat, kLeast}, {4, Kernel::disc, 0.01}};

TEST(Exchange, ScenesAreCutSomewhereAndHaveGrainsOutside) {
  for (const auto& [seed, kernel, least] : kCases) {
    const Scene scene(seed, kernel, least);
    EXPECT_GT(scene.porosity.clipped, 0.01);
    EXPECT_LT(std::ranges::min(scene.porosity.kept), 0.9);
    EXPECT_EQ(scene.on.immersed[5], 0);
  }
}

TEST(Exchange, DragOnTheGrainsIsWhatTheFluidLoses) {
  for (const auto& [seed, kernel, least] : kCases) {
    Scene scene(seed, kernel, least);
    const Sum on_grains = sum_of(scene.forces().drag);
    Sum by_vertex;
    for (std::size_t v = 0; v < scene.volume.size(); ++v)
      by_vertex.add(scene.volume[v] * scene.flow.drag[v] * (scene.u(v) - scene.flow.carried[v]));
    EXPECT_LT(largest(on_grains.value - by_vertex.value), kRounding * on_grains.size);

    // The same in the equations that are solved, stabilisation and all: what they sum up to besides drag is known of a
    // fluid in which no grain drags.
    const Sum with = lost_by_fluid(scene.flow);
    std::ranges::fill(scene.flow.drag, 0.0);
    const Sum without = lost_by_fluid(scene.flow);
    EXPECT_LT(largest(on_grains.value - (with.value - without.value)), kRounding * with.size);
    EXPECT_GT(largest(on_grains.value), 1e-3 * with.size);
  }
}

TEST(Exchange, PressureOnTheGrainsIsWhatTheFluidDoesNotBear) {
  for (const auto& [seed, kernel, least] : kCases) {
    Scene scene(seed, kernel, least);
    const Sum on_grains = sum_of(scene.forces().pressure);
    // -(1 - phi) grad p, by triangles.
    Sum field;
    for (const auto& t : scene.flow.mesh.triangle) {
      const Vec2 a = scene.flow.mesh.position[t[0]], b = scene.flow.mesh.position[t[1]],
                 c = scene.flow.mesh.position[t[2]];
      const double area = mesh::doubled_area(a, b, c) / 2, p = scene.flow.u(t[0], kPressure),
                   dp = scene.flow.u(t[1], kPressure) - p, dq = scene.flow.u(t[2], kPressure) - p,
                   // grad p solves (b - a).grad p = dp, (c - a).grad p = dq.
          gx = (dp * (c - a).y - dq * (b - a).y) / (2 * area), gy = (dq * (b - a).x - dp * (c - a).x) / (2 * area);
      double solid = 0;
      for (const std::int32_t v : t) solid += (1 - scene.flow.porosity[v]) / 3;
      field.add((-area * solid) * Vec2{gx, gy});
    }
    EXPECT_LT(largest(on_grains.value - field.value), kRounding * on_grains.size);

    // With the equations that are solved: fluid and grains together bear the boundary's pressure and nothing else. The
    // fluid's have -p grad phi, that is phi grad p but for its boundary's phi p n.
    for (std::size_t k = 0; k < scene.flow.unknown.size(); ++k)
      if (k % 3 != kPressure) scene.flow.unknown[k] = 0;
    std::ranges::fill(scene.flow.drag, 0.0);
    const Sum fluid = lost_by_fluid(scene.flow);
    Sum boundary;
    for (const auto& e : scene.flow.mesh.boundary) {
      const Vec2 along = scene.flow.mesh.position[e.to] - scene.flow.mesh.position[e.from];
      const double p = scene.flow.u(e.from, kPressure), q = scene.flow.u(e.to, kPressure),
                   s = 1 - scene.flow.porosity[e.from], r = 1 - scene.flow.porosity[e.to];
      boundary.add((2 * p * s + 2 * q * r + p * r + q * s) / 6 * Vec2{along.y, -along.x});
    }
    EXPECT_LT(largest(fluid.value - boundary.value - on_grains.value), kRounding * (fluid.size + boundary.size));
    EXPECT_GT(largest(on_grains.value), 1e-3 * fluid.size);
  }
}

TEST(Exchange, GrainsFeelWhatTheSumsOverAllVerticesSay) {
  for (const auto& [seed, kernel, least] : kCases) {
    const Scene scene(seed, kernel, least);
    const Forces forces = scene.forces();
    for (std::size_t i = 0; i < scene.discs.size(); ++i) {
      const std::vector<double> row = scene.row(i);
      double all = 0;
      for (const double v : row) all += v;
      Vec2 v_f;
      Sum pressure;
      for (std::size_t j = 0; j < row.size() && all > 0; ++j) {
        v_f = v_f + (row[j] / all / scene.flow.porosity[j]) * scene.u(j);
        if (row[j] == 0) continue;
        // g_j: each triangle around j has a third of its area.
        Vec2 g;
        for (const auto& t : scene.flow.mesh.triangle) {
          if (std::ranges::count(t, static_cast<std::int32_t>(j)) == 0) continue;
          for (int k = 0; k < 3; ++k) {
            // |T| grad N_k is half the opposite edge, turned.
            const Vec2 opposite = scene.flow.mesh.position[t[(k + 2) % 3]] - scene.flow.mesh.position[t[(k + 1) % 3]];
            g = g + scene.flow.u(t[k], kPressure) / 6 * base::perpendicular(opposite);
          }
        }
        pressure.add((-row[j] * scene.porosity.kept[j] / scene.volume[j]) * g);
      }
      const Vec2 drag = all > 0 ? scene.grains.drag[i] * (v_f - scene.grains.velocity[i]) : Vec2{};
      EXPECT_LE(largest(forces.drag[i] - drag), kRounding * scene.grains.drag[i]) << i;
      EXPECT_LE(largest(forces.pressure[i] - pressure.value), 1e-12 * pressure.size) << i;
    }
  }
}

TEST(Exchange, DragCoefficientsAreTheLawsAtTheGrains) {
  for (const auto& [seed, kernel, least] : kCases)
    for (const DragSpec& law : {DragSpec{}, DragSpec{DragClosure::di_felice, DragPorosity::plane}}) {
      const Scene scene(seed, kernel, least);
      const std::vector<double> gamma = drag_coefficients(law, scene.flow.fluid, surroundings(scene.flow, scene.on),
                                                          scene.on.immersed, scene.discs, scene.grains.velocity);
      for (std::size_t i = 0; i < scene.discs.size(); ++i) {
        const std::vector<double> row = scene.row(i);
        double all = 0, phi = 0;
        Vec2 v_f;
        for (std::size_t j = 0; j < row.size(); ++j) {
          all += row[j];
          phi += row[j] * scene.flow.porosity[j];
          v_f = v_f + (row[j] / scene.flow.porosity[j]) * scene.u(j);
        }
        if (all == 0) {
          EXPECT_EQ(gamma[i], 0);
          continue;
        }
        phi /= all;
        const double area = std::numbers::pi * scene.discs[i].radius * scene.discs[i].radius,
                     whole = drag_coefficient(law, scene.flow.fluid, 2 * scene.discs[i].radius, phi,
                                              phi * norm((1 / all) * v_f - scene.grains.velocity[i]));
        EXPECT_NEAR(gamma[i], all / area * whole, 1e-12 * whole) << i;
      }
    }
}

TEST(Exchange, WhatIsFoundOnTheWayIsWhatIsFoundByItself) {
  for (const auto& [seed, kernel, least] : kCases) {
    const Scene scene(seed, kernel, least);
    const Surroundings around = surroundings(scene.flow, scene.on), on_the_way = scene.forces().around;
    EXPECT_EQ(on_the_way.porosity, around.porosity);
    EXPECT_EQ(on_the_way.velocity, around.velocity);
    std::vector<double> solid;
    for (const Load& at : load(scene.on, scene.grains, kStep, scene.volume.size())) solid.push_back(at.solid);
    EXPECT_EQ(solid, solid_volume(scene.on, scene.volume.size()));
  }
}

// Where so little of a grain is in the fluid that the porosity is 1 to the last digit.
TEST(Exchange, GrainsThatBarelyDipInAreDraggedByLittle) {
  Scene scene(5);
  scene.discs.clear();
  for (int i = 0; i < 500; ++i) {
    const double r = uniform(0.011, 0.019, 9, 0, i);
    scene.discs.push_back({uniform(0.1, 0.9, 9, 1, i), 1 + r - std::pow(10, -uniform(12.8, 15, 9, 2, i)), r, 0});
  }
  scene.velocities.assign(scene.discs.size(), {0.1, -0.2});
  Location location(scene.flow.mesh);
  scene.on = deposit(scene.flow.mesh, location, scene.discs);
  scene.porosity = porosity(solid_volume(scene.on, scene.volume.size()), scene.volume, kLeast);
  scene.flow.porosity = scene.porosity.phi;
  const std::vector<double> gamma = drag_coefficients({}, scene.flow.fluid, surroundings(scene.flow, scene.on),
                                                      scene.on.immersed, scene.discs, scene.velocities);
  int wet = 0;
  for (std::size_t i = 0; i < gamma.size(); ++i) {
    EXPECT_GE(gamma[i], 0) << i;
    EXPECT_LT(gamma[i], 1e-3) << i;
    wet += gamma[i] > 0;
  }
  EXPECT_GT(wet, 100);
}

// Grains of one density that are immersed wholly answer as a continuum of that density: a force per volume f on them
// makes them carry dt f/rho_p.
TEST(Exchange, TheAnswerIsThatOfGrainsOfTheirDensity) {
  Scene scene(7);
  std::erase_if(scene.discs, [](const Disc& d) { return std::min({d.x, d.y, 1 - d.x, 1 - d.y}) <= d.radius; });
  Location location(scene.flow.mesh);
  scene.on = deposit(scene.flow.mesh, location, scene.discs);
  scene.masses.clear();
  for (const Disc& d : scene.discs) scene.masses.push_back(kGrainDensity * std::numbers::pi * d.radius * d.radius);
  scene.porosity = porosity(solid_volume(scene.on, scene.volume.size()), scene.volume, kLeast);
  scene.flow.porosity = scene.porosity.phi;
  scene.drags.resize(scene.discs.size());
  scene.velocities.resize(scene.discs.size());
  scene.grains = {scene.masses, scene.drags, scene.velocities};
  put_grains(scene.flow, load(scene.on, scene.grains, kStep, scene.volume.size()), scene.volume, scene.porosity.kept);
  ASSERT_GT(scene.porosity.clipped, 0);
  for (std::size_t v = 0; v < scene.volume.size(); ++v) {
    EXPECT_NEAR(scene.flow.mobility[v], kStep / kGrainDensity * (1 - scene.flow.porosity[v]),
                1e-12 * kStep / kGrainDensity);
    EXPECT_NEAR(scene.flow.response[v], kStep / kGrainDensity * scene.flow.drag[v],
                1e-12 * kStep / kGrainDensity * scene.flow.drag[v]);
  }
}

// sum_j m_j dphi_j/dt + phi_j D m_j = D sum_j m_j phi_j, of which the fluid's equations of mass are the left side: what
// they sum up to is the growth of the fluid's volume and what leaves through the (moving) boundary.
TEST(Exchange, NoVolumeOfTheMixtureIsLostOnAMeshThatMovesUpAndDown) {
  for (const fluid::TimeOrder order : {fluid::TimeOrder::first, fluid::TimeOrder::second}) {
    Scene scene(11);
    fluid::Flow& flow = scene.flow;
    const std::vector<Vec2> start = flow.mesh.position;
    fluid::Past past;
    past.dt = kStep;
    std::vector<double> fluid_volume;
    // Levels n - 1, n, n + 1: vertices and grains jump about, as far as the mesh stays valid.
    for (int level = 0; level < 3; ++level) {
      for (std::size_t v = 0; v < start.size(); ++v)
        flow.mesh.position[v].y = start[v].y * (1 + 0.02 * level) + uniform(-0.01, 0.01, 13, level, v);
      mesh::check(flow.mesh);
      for (std::size_t i = 0; i < scene.discs.size(); ++i) scene.discs[i].y += uniform(-0.01, 0.01, 14, level, i);
      Location location(flow.mesh);
      scene.on = deposit(flow.mesh, location, scene.discs);
      scene.volume = vertex_volume(flow.mesh);
      scene.porosity = porosity(solid_volume(scene.on, scene.volume.size()), scene.volume, kLeast);
      flow.porosity = scene.porosity.phi;
      fluid_volume.insert(fluid_volume.begin(), 0);
      for (std::size_t v = 0; v < start.size(); ++v) fluid_volume[0] += scene.volume[v] * flow.porosity[v];
      if (level < 2) remember(past, flow, kStep);
    }
    if (order == fluid::TimeOrder::first) past.level.pop_back();
    set_rates(flow, past, order);
    set_porosity_rate(flow, past, order, {scene.volume, vertex_volume(flow.mesh.triangle, past.level[0].position)});
    put_grains(flow, load(scene.on, scene.grains, kStep, scene.volume.size()), scene.volume, scene.porosity.kept);

    const double a = fluid_volume[0], b = fluid_volume[1], c = fluid_volume[2],
                 growth = (order == fluid::TimeOrder::first ? a - b : (3 * a - 4 * b + c) / 2) / kStep;
    std::vector<double> residual(flow.unknown.size());
    fluid::residual_of(flow, fluid::TimeScheme{}, flow.unknown, residual);
    double mass = 0, size = 0, out = 0;
    for (std::size_t v = 0; v < start.size(); ++v) mass += residual[3 * v + 2], size += std::abs(residual[3 * v + 2]);
    for (const auto& e : flow.mesh.boundary) {
      const Vec2 along = flow.mesh.position[e.to] - flow.mesh.position[e.from], n{along.y, -along.x};
      const Vec2 w = flow.mesh_velocity[e.from], x = flow.mesh_velocity[e.to];
      const double phi = flow.porosity[e.from], psi = flow.porosity[e.to];
      // u is linear along the edge, phi w a product of two that are.
      out +=
          dot(0.5 * (scene.u(e.from) + scene.u(e.to)), n) - dot((2 * phi + psi) / 6 * w + (2 * psi + phi) / 6 * x, n);
    }
    EXPECT_LT(std::abs(mass - growth - out), 1e-12 * size);
    EXPECT_GT(std::abs(growth), 1e-3 * size);
  }
}

}  // namespace
}  // namespace seapile::coupling
