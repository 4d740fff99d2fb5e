// A result does not depend on the units it is computed in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "solver/simulation/build.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
#include "tests/solver/basin/scenes.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

/// How many of the new units an old one is.
struct Units {
  double length = 1, time = 1, density = 1;

  double of(const std::string& unit) const {
    const double mass = density * length * length;  // per metre of depth
    const std::map<std::string, double> known = {{"-", 1},
                                                 {"m", length},
                                                 {"m/s", length / time},
                                                 {"m/s2", length / (time * time)},
                                                 {"kg/m", mass},
                                                 {"Pa", density * length * length / (time * time)},
                                                 {"N s/m", mass * length / time},
                                                 {"J/m", mass * length * length / (time * time)}};
    return known.at(unit);
  }
};

scene::SceneSpec in(const Units& units, scene::SceneSpec scene) {
  const double length = units.length;
  scene.bed.domain.width *= length;
  scene.bed.domain.height *= length;
  scene.bed.domain.gravity *= units.of("m/s2");
  scene.bed.grains.radius.min *= length;
  scene.bed.grains.radius.max *= length;
  scene.bed.grains.density *= units.density;
  scene.pile->radius *= length;
  *scene.pile->depth *= length;
  std::get<pile::ConstantDriving>(scene.pile->driving).speed *= units.of("m/s");
  scene.contact.step *= units.time;
  scene.bed.preparation.contact.step *= units.time;
  if (auto* method = std::get_if<grains::NonSmoothMethod>(&scene.contact.method)) {
    method->tolerance *= units.of("m/s");
    method->correction *= units.of("m/s");
  }
  return scene;
}

Bed in(const Units& units, Bed bed) {
  for (Array& array : bed.grains)
    if (auto* values = std::get_if<std::vector<double>>(&array.values))
      for (double& value : *values) value *= units.of(array.info.unit);
  return bed;
}

/// Arrays of numbers of several units, of which parts are in others as well.
bool is_mixed(const std::string& name) { return name == "totals" || name == "gathering" || name == "pile/motion"; }

void expect_same(const std::vector<Array>& expected, const std::vector<Array>& found, const Units& units) {
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const Array& a = expected[k];
    if (is_mixed(a.info.name)) continue;
    const double scale = units.of(a.info.unit);
    std::visit(
        [&]<class T>(const std::vector<T>& values) {
          const auto& others = std::get<std::vector<T>>(found[k].values);
          ASSERT_EQ(values.size(), others.size()) << a.info.name;
          for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(static_cast<T>(scale * static_cast<double>(values[i])), others[i]) << a.info.name << " " << i;
        },
        a.values);
  }
}

void expect_same(const grains::ContactSpec& contact, const Units& units, int steps) {
  scene::SceneSpec scene = support::small_drive(300, 0.8, pile::ConicalTip{});
  scene.contact = contact;
  const Bed& bed = support::settled(scene.bed);
  Simulation one = build(scene, bed, {}), other = build(in(units, scene), in(units, bed), {});
  for (int k = 0; k < steps; ++k) {
    step(one);
    step(other);
  }
  expect_same(snapshot(one), snapshot(other), units);
}

// Powers of two: no product or quotient is rounded otherwise.
TEST(Units, GrainsHaveTheSameBitsInUnitsThatArePowersOfTwo) {
  for (const Units& units : {Units{1024, 1, 1}, Units{1, 1.0 / 64, 1}, Units{1, 1, 1.0 / 512}})
    expect_same({}, units, 200);
  const Units mixed{0.125, 4, 64};
  grains::ContactSpec contact;
  contact.precision = grains::Precision::double_;
  expect_same(contact, mixed, 200);
  contact.method = grains::NonSmoothMethod{};
  expect_same(contact, mixed, 50);
  contact = {};
  contact.solver = grains::Solver::brute_force;
  expect_same(contact, mixed, 20);
}

basin::BasinSpec in(const Units& units, basin::BasinSpec basin) {
  const double length = units.length, stress = units.of("Pa");
  basin.width *= length;
  basin.depth *= length;
  basin.gravity *= units.of("m/s2");
  basin.density *= units.density;
  basin.viscosity *= stress * units.time;
  basin.surface->tension *= stress * length;
  if (auto* wave = std::get_if<basin::CosineSurface>(&basin.surface->initial)) wave->amplitude *= length;
  if (auto* hump = std::get_if<basin::HumpSurface>(&basin.surface->initial)) {
    hump->amplitude *= length;
    hump->width *= length;
  }
  if (auto* mesh = std::get_if<basin::UnstructuredMesh>(&basin.mesh.pattern)) {
    mesh->size *= length;
    mesh->pile_size *= length;
  }
  if (auto* motion = std::get_if<basin::ZonesMotion>(&basin.mesh.motion)) motion->reach *= length;
  if (basin.pile) {
    basin.pile->radius *= length;
    basin.pile->start *= length;
    auto& driving = std::get<pile::SinusoidalDriving>(basin.pile->driving);
    driving.speed *= units.of("m/s");
    driving.frequency /= units.time;
  }
  basin.time.step *= units.time;
  basin.time.duration *= units.time;
  return basin;
}

/// Largest difference of two fields by the largest value of the first, when `units` says what the second is in.
double difference(const std::vector<double>& one, const std::vector<double>& other, double unit) {
  if (one.size() != other.size()) return INFINITY;
  double most = 0, size = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    most = std::max(most, std::abs(other[i] / unit - one[i]));
    size = std::max(size, std::abs(one[i]));
  }
  return most / size;
}

std::vector<double> component(const basin::Basin& basin, int c) {
  std::vector<double> values;
  for (std::size_t i = c; i < basin.flow.unknown.size(); i += 3) values.push_back(basin.flow.unknown[i]);
  return values;
}

std::vector<double> rise(const basin::Basin& basin) {
  std::vector<double> height = basin.top.height;
  for (double& h : height) h -= basin.spec.depth;
  return height;
}

void expect_similar(const basin::BasinSpec& spec, int steps, double most) {
  const Units millimetres{1e3, 1e3, 1e-9};  // also milliseconds, and grams in a cubic millimetre
  basin::Basin one = basin::support::filled(spec);
  // Gmsh rounds, and may turn an edge for it.
  mesh::TriangleMesh mesh = one.flow.mesh;
  mesh.position = one.domain.reference;
  for (base::Vec2& p : mesh.position) p = millimetres.length * p;
  basin::Basin other = basin::filled(in(millimetres, spec), base::fastest(), std::move(mesh));
  ASSERT_EQ(basin::support::run(one, steps), "");
  ASSERT_EQ(basin::support::run(other, steps), "");
  const double speed = millimetres.of("m/s"), stress = millimetres.of("Pa");
  EXPECT_LT(difference(component(one, fluid::kVelocityX), component(other, fluid::kVelocityX), speed), most);
  EXPECT_LT(difference(component(one, fluid::kVelocityY), component(other, fluid::kVelocityY), speed), most);
  EXPECT_LT(difference(component(one, fluid::kPressure), component(other, fluid::kPressure), stress), most);
  EXPECT_LT(difference(rise(one), rise(other), millimetres.length), most);
}

// A thousand is no power of two: what is left is rounding, and how far the equations are solved.
TEST(Units, WaterHasTheSameWavesInMillimetres) {
  basin::BasinSpec wave = basin::support::wave(48, 24, 0.02);
  wave.time.tolerance = 1e-12;
  expect_similar(wave, 50, 1e-9);
  basin::BasinSpec hump = basin::support::hump();
  hump.surface->tension = 0.07;
  hump.time.tolerance = 1e-12;
  expect_similar(hump, 50, 1e-9);
}

TEST(Units, APileMovesWaterTheSameInMillimetres) {
  basin::BasinSpec spec = basin::support::pile_in_water();
  spec.time.tolerance = 1e-11;
  expect_similar(spec, 50, 1e-9);
}

}  // namespace
}  // namespace seapile::simulation
