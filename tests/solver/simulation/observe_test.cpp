#include "solver/simulation/observe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "solver/grains/packing.h"
#include "solver/simulation/build.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using std::numbers::pi;
using support::settled;
using support::small_drive;
using support::values;

/// In double, so that balances can be asked for exactly.
Simulation pile_in_bed() {
  scene::SceneSpec scene = small_drive(200, 0.7, pile::ConicalTip{});
  scene.contact.precision = grains::Precision::double_;
  return build(scene, settled(scene.bed), {});
}

base::Vec2 momentum(const Simulation& sim) {
  base::Vec2 sum;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) {
    const auto& m = std::get<grains::ContactSystem<double>>(sim.contacts).motion(static_cast<std::int32_t>(i));
    sum = sum + sim.grains.mass[i] * base::Vec2{m.vx, m.vy};
  }
  return sum;
}

// A record's force times its length is an impulse: together with gravity they are the grains' momentum.
TEST(Record, ForcesAreImpulsesOverTheRecordDividedByItsTime) {
  Simulation sim = pile_in_bed();
  double mass = 0;
  for (const double m : sim.grains.mass) mass += m;
  base::Vec2 impulse;
  double time = 0;
  for (int record = 0; record < 60; ++record) {
    for (int k = 0; k < 3 + record % 5; ++k) gather(sim, step(sim));
    const Record r = take_record(sim);
    EXPECT_NEAR(r.span, (3 + record % 5) * 5e-4, 1e-15);
    impulse.x += r.span * (r.left_wall_force - r.right_wall_force - r.tip_force_x - r.sleeve_force_x);
    impulse.y += r.span * (r.base_force - r.tip_force_y - r.sleeve_force_y);
    time += r.span;
    EXPECT_NEAR(r.time, time, 1e-12);
    const base::Vec2 p = momentum(sim);
    // 10^4 roundings of doubles, against the weight's impulse of some 100 N s/m.
    ASSERT_NEAR(p.x, impulse.x, 1e-10 * mass * 9.81);
    ASSERT_NEAR(p.y, impulse.y - mass * 9.81 * time, 1e-10 * mass * 9.81);
  }
}

TEST(Record, ResistanceIsTheTipsForceOverItsWidthAndTheThesisOverItsHalfWidth) {
  Simulation sim = pile_in_bed();
  bool pressed = false;
  for (int record = 0; record < 40; ++record) {
    for (int k = 0; k < 10; ++k) gather(sim, step(sim));
    const Record r = take_record(sim);
    EXPECT_EQ(r.tip_resistance, r.tip_force_y / 0.1);
    EXPECT_EQ(r.tip_resistance_thesis, r.tip_force_y / 0.05);
    EXPECT_NEAR(r.speed, 0.4, 1e-9);
    EXPECT_NEAR(r.depth, sim.surface - sim.pile->start + r.travel, 1e-12);
    pressed = pressed || r.tip_force_y > 10;
  }
  EXPECT_TRUE(pressed);
}

TEST(Record, EnergiesAreThoseOfTheGrains) {
  Simulation sim = pile_in_bed();
  for (int k = 0; k < 300; ++k) gather(sim, step(sim));
  const Record r = take_record(sim);
  double kinetic = 0, potential = 0;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) {
    const auto& m = std::get<grains::ContactSystem<double>>(sim.contacts).motion(static_cast<std::int32_t>(i));
    // A disc spins with m r^2 / 2, at omega = u / r.
    const double radius = sim.grains.disc[i].radius, omega = m.u / radius;
    kinetic += 0.5 * sim.grains.mass[i] * (m.vx * m.vx + m.vy * m.vy) +
               0.25 * sim.grains.mass[i] * radius * radius * omega * omega;
    potential += sim.grains.mass[i] * 9.81 * sim.grains.disc[i].y;
  }
  EXPECT_NEAR(r.kinetic_energy, kinetic, 1e-12 * kinetic);
  EXPECT_NEAR(r.potential_energy, potential, 1e-12 * potential);
  EXPECT_GT(r.kinetic_energy, 0);
}

// Work and dissipation count from the start, forces from the record before.
TEST(Record, WorkAndDissipationGoOnFromRecordToRecord) {
  Simulation sim = pile_in_bed();
  double work = 0, dissipation = 0, by_hand = 0;
  for (int record = 0; record < 30; ++record) {
    for (int k = 0; k < 20; ++k) gather(sim, step(sim));
    const Record r = take_record(sim);
    by_hand += 0.4 * r.span * (r.tip_force_y + r.sleeve_force_y);
    EXPECT_NEAR(r.pile_work, by_hand, 1e-9 * std::max(1.0, by_hand));
    EXPECT_GE(r.pile_work, work);
    EXPECT_GT(r.dissipation, dissipation - 1e-3);
    work = r.pile_work;
    dissipation = r.dissipation;
  }
  EXPECT_GT(work, 0.1);
  EXPECT_GT(dissipation, 0.1);
}

TEST(Record, OverlapsAreOrderedAndContactsAreCounted) {
  Simulation sim = pile_in_bed();
  for (int k = 0; k < 300; ++k) gather(sim, step(sim));
  const Record r = take_record(sim);
  EXPECT_LE(0, r.overlap_mean);
  EXPECT_LE(r.overlap_mean, r.overlap_p999);
  EXPECT_LE(r.overlap_p999, r.overlap_max);
  // Two to four contacts per grain of which each is shared by two.
  EXPECT_GT(r.contacts, 200);
  EXPECT_LT(r.contacts, 600);
  EXPECT_GT(r.residual, 0);
}

/// The frame of a window over the last `steps` steps.
Frame frame_after(Simulation& sim, int before, int steps) {
  for (int k = 0; k < before; ++k) step(sim);
  ForceWindow window(0.123);
  for (int k = 0; k < steps; ++k) {
    step(sim, true);
    window.add(sim);
  }
  return window.frame(sim, 0.05, 0.6);
}

TEST(Frame, ShowsEveryGrainByRisingIdWithItsPlaceAndDisplacement) {
  Simulation sim = pile_in_bed();
  const Frame frame = frame_after(sim, 300, 20);
  EXPECT_EQ(frame.asked, 0.123);
  EXPECT_NEAR(frame.time, 320 * 5e-4, 1e-15);
  EXPECT_EQ(frame.depth, sim.surface - sim.pile->body.position.y);
  const auto& id = values<std::int64_t>(frame.grains, "grains/id");
  const auto& position = values<double>(frame.grains, "grains/position");
  const auto& displacement = values<double>(frame.grains, "grains/displacement");
  const scene::SceneSpec scene = small_drive(200, 0.7, pile::ConicalTip{});
  const auto& start = values<double>(settled(scene.bed).grains, "grains/position");
  ASSERT_EQ(id.size(), 200u);
  double farthest = 0;
  for (std::size_t k = 0; k < id.size(); ++k) {
    EXPECT_EQ(id[k], static_cast<std::int64_t>(k));
    EXPECT_NEAR(position[2 * k] - displacement[2 * k], start[2 * k], 1e-15);
    EXPECT_NEAR(position[2 * k + 1] - displacement[2 * k + 1], start[2 * k + 1], 1e-15);
    farthest = std::max(farthest, std::abs(displacement[2 * k]));
  }
  EXPECT_GT(farthest, 1e-3);
  EXPECT_EQ(values<double>(frame.grains, "grains/velocity").size(), 400u);
  EXPECT_EQ(values<double>(frame.grains, "grains/spin").size(), 200u);
  EXPECT_EQ(values<double>(frame.grains, "grains/radius").size(), 200u);
}

TEST(Frame, ContactsActOnBothAndAreThoseOfTheWindow) {
  Simulation sim = pile_in_bed();
  // Force on the base over the window, from the impulses of the walls.
  for (int k = 0; k < 300; ++k) step(sim);
  sim.totals.base = sim.totals.left = {};
  for (grains::Impulse& f : sim.totals.feature) f = {};
  const Frame frame = frame_after(sim, 0, 20);
  const auto& who = values<std::int64_t>(frame.contacts, "contacts/grain");
  const auto& normal = values<double>(frame.contacts, "contacts/normal");
  const auto& force = values<double>(frame.contacts, "contacts/force");
  const auto& place = values<double>(frame.contacts, "contacts/position");
  double base = 0, left = 0, pile = 0;
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  for (std::size_t k = 0; 2 * k < who.size(); ++k) {
    EXPECT_TRUE(pairs.insert({who[2 * k], who[2 * k + 1]}).second);
    EXPECT_NEAR(std::hypot(normal[2 * k], normal[2 * k + 1]), 1, 1e-6);
    EXPECT_GT(force[2 * k], 0);
    EXPECT_LE(std::abs(force[2 * k + 1]), 0.5 * force[2 * k] * (1 + 1e-12));
    if (who[2 * k + 1] == -3) {
      base += force[2 * k];
      EXPECT_NEAR(place[2 * k + 1], 0, 1e-4);
    }
    if (who[2 * k + 1] == -1) {
      left += force[2 * k];
      EXPECT_NEAR(place[2 * k], -0.35, 1e-4);
    }
    if (who[2 * k + 1] <= -4) pile += force[2 * k] * normal[2 * k + 1] + force[2 * k + 1] * normal[2 * k];
  }
  const double time = 20 * 5e-4;
  EXPECT_NEAR(base, -sim.totals.base.y / time, 1e-9 * base);
  EXPECT_NEAR(left, -sim.totals.left.x / time, 1e-9 * base);
  // A contact of the pile shows its last normal, which turns little within 10 ms.
  EXPECT_NEAR(pile, (sim.totals.feature[0].y + sim.totals.feature[1].y) / time, 0.05 * std::abs(pile));
  EXPECT_GT(pile, 1);
}

TEST(Frame, TheGridCoversTheBoxAndHoldsTheAreaOfTheGrains) {
  Simulation sim = pile_in_bed();
  const Frame frame = frame_after(sim, 100, 1);
  EXPECT_EQ(frame.grid.x0, -0.35);
  EXPECT_EQ(frame.grid.y0, 0);
  EXPECT_EQ(frame.grid.nx, 14);
  EXPECT_EQ(frame.grid.ny, 12);
  double solid = 0, area = 0;
  for (const double porosity : values<double>(frame.cells, "cells/porosity")) solid += (1 - porosity) * 0.05 * 0.05;
  for (const double r : values<double>(frame.grains, "grains/radius")) area += pi * r * r;
  // What overlaps the walls, at most 1e-4 of a radius, sticks out of the grid.
  EXPECT_NEAR(solid, area, 1e-6 * area);
  EXPECT_EQ(values<double>(frame.cells, "cells/stress").size(), 3u * 14 * 12);
  EXPECT_EQ(values<double>(frame.cells, "cells/principal_stress").size(), 2u * 14 * 12);
  EXPECT_EQ(values<double>(frame.cells, "cells/principal_direction").size(), 14u * 12);
}

// With frictionless walls the vertical stress of a bed at rest is the weight above: on average over the lower rows,
// weight over width less what lies below. 15 %: a column of 200 grains is 12 grains high, the averaging disc 5.
TEST(Frame, TheStressOfABedAtRestIsItsWeight) {
  scene::SceneSpec scene = small_drive(200, 0.7, pile::ConicalTip{});
  scene.pile.reset();
  Simulation sim = build(scene, settled(scene.bed), {});
  const Frame frame = frame_after(sim, 200, 20);
  const auto& stress = values<double>(frame.cells, "cells/stress");
  double mean = 0, weight = 0;
  for (int ix = 2; ix < 12; ++ix) mean += stress[3 * (1 * 14 + ix) + 1] / 10;
  for (std::size_t i = 0; i < sim.grains.count(); ++i) {
    const grains::Disc& d = sim.grains.disc[i];
    weight += 1500 * 9.81 * (pi * d.radius * d.radius - grains::disc_area_below(d.radius, 0.075 - d.y));
  }
  EXPECT_NEAR(mean, weight / 0.7, 0.15 * weight / 0.7);
}

/// Records every 5 mm, with a resistance that is a function of depth.
template <class F>
std::vector<Record> records_with(F&& resistance) {
  std::vector<Record> records;
  for (int k = 0; k < 248; ++k) {
    Record r;
    r.depth = -0.0175 + 0.005 * k;
    r.speed = 0.4;
    r.span = 0.0125;
    r.tip_resistance = resistance(r.depth);
    r.tip_force_y = 0.25 * r.tip_resistance;
    r.overlap_max = 1e-3 * k;
    records.push_back(r);
  }
  return records;
}

// Design README: the headline is the mean over 0.2-1.2 m, the fluctuation the standard deviation of what is left of q_c
// when its straight line is taken away, bins are of 0.05 m.
TEST(DriveMetrics, OfAStraightLineAreItsMeanSlopeAndNoFluctuation) {
  const auto metrics = drive_metrics(records_with([](double d) { return 1e4 + 5e4 * d; }), {}, {});
  EXPECT_NEAR(support::metric(metrics, "tip_resistance_mean"), 1e4 + 5e4 * 0.7, 1);
  EXPECT_NEAR(support::metric(metrics, "tip_resistance_slope"), 5e4, 1e-6 * 5e4);
  EXPECT_NEAR(support::metric(metrics, "tip_resistance_fluctuation"), 0, 1e-6);
  EXPECT_NEAR(support::metric(metrics, "tip_resistance_bin_0.60"), 1e4 + 5e4 * 0.625, 1);
  EXPECT_NEAR(support::metric(metrics, "overlap_max"), 0.247, 1e-12);
}

TEST(DriveMetrics, FluctuationIsThatAroundTheLine) {
  int k = 0;
  const auto metrics = drive_metrics(records_with([&](double d) { return 5e4 * d + (k++ % 2 ? 300 : -300); }), {}, {});
  EXPECT_NEAR(support::metric(metrics, "tip_resistance_fluctuation"), 300, 2);
}

// A record counts by the way that the pile made in it, not by its time: a slow stretch weighs no more than a fast one.
TEST(DriveMetrics, RecordsWeighByTheirTravel) {
  std::vector<Record> records = records_with([](double d) { return d < 0.7 ? 1.0 : 3.0; });
  for (Record& r : records)
    if (r.depth >= 0.7) r.speed /= 10, r.span *= 10;
  EXPECT_NEAR(support::metric(drive_metrics(records, {}, {}), "tip_resistance_mean"), 2, 0.02);
}

TEST(DriveMetrics, WhatWasNotReachedIsNotReported) {
  std::vector<Record> records = records_with([](double) { return 1.0; });
  records.resize(20);  // To 0.075 m.
  const auto metrics = drive_metrics(records, {}, {});
  for (const Metric& m : metrics) EXPECT_TRUE(std::isfinite(m.value)) << m.name;
  EXPECT_TRUE(std::isnan(support::metric(metrics, "tip_resistance_mean")));
  EXPECT_TRUE(std::isnan(support::metric(metrics, "tip_resistance_bin_0.30")));
  EXPECT_EQ(support::metric(metrics, "tip_resistance_bin_0.00"), 1);
  EXPECT_TRUE(drive_metrics({}, {}, {}).size() < records_with([](double) { return 1.0; }).size());
}

}  // namespace
}  // namespace seapile::simulation
