// A result does not depend on the units it is computed in.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "solver/simulation/build.h"
#include "solver/simulation/state.h"
#include "solver/simulation/step.h"
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

}  // namespace
}  // namespace seapile::simulation
