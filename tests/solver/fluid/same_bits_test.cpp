// A flow's bits depend on its case alone: not on a rerun, the instruction set, or a stop and a restart in between; and
// what a step does when it fails.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "solver/fluid/advance.h"
#include "tests/solver/fluid/manufactured.h"

namespace seapile::fluid {
namespace {

using support::Manufactured;

/// A small flow that has everything, on its way. It can be copied at any step, as a checkpoint would: all but the
/// factors, of which the matrix is kept.
struct MovingFlow {
  Manufactured exact;
  mesh::TriangleMesh regular;
  Flow flow;
  Past past;
  FlowSolver solver;
  int step = 0;
  double time = 0;
  std::vector<int> refactored;  ///< steps

  explicit MovingFlow(Geometry geometry, base::InstructionSet instructions = base::InstructionSet::generic)
      : exact{{20, 0.5, geometry}, 0.15, 0.1, 2, 10, 30, 0.3}, regular(support::manufactured_mesh(7)) {
    solver.instructions = instructions;
    flow = at_rest(regular, exact.fluid);
    support::set_time(flow, exact, regular, 0);
    support::set_exact(flow, exact, 0);
  }

  MovingFlow restarted() const {
    MovingFlow copy(exact.fluid.geometry, solver.instructions);
    copy.flow = flow;
    copy.past = past;
    copy.step = step;
    copy.time = time;
    copy.solver.order = solver.order;
    copy.solver.tolerance = solver.tolerance;
    copy.solver.factor_rate = solver.factor_rate;
    copy.solver.last_iterations = solver.last_iterations;
    copy.solver.first_iterations = solver.first_iterations;
    copy.solver.excess_iterations = solver.excess_iterations;
    copy.solver.refactorisations = solver.refactorisations;
    if (!solver.factor.empty()) copy.solver.factor.factorise(solver.factor.matrix());
    return copy;
  }

  void advance_to(int last) {
    base::Profile profile;
    while (step < last) {
      // Long steps, short ones, long ones again: the rate of the scheme changes, so there are several factors.
      const double dt = step / 5 == 1 ? 0.02 : 0.1;
      remember(past, flow, dt);
      time += dt;
      support::set_time(flow, exact, regular, time);
      set_rates(flow, past, solver.order);
      const FlowReport report = advance(flow, past, solver, profile);
      ASSERT_TRUE(report.converged) << report.reason;
      if (report.refactored) refactored.push_back(step);
      ++step;
    }
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

constexpr int kSteps = 13;
constexpr Geometry kGeometries[] = {Geometry::planar, Geometry::axisymmetric};

TEST(SameBits, OnARerun) {
  for (const Geometry geometry : kGeometries) {
    MovingFlow first(geometry), second(geometry);
    first.advance_to(kSteps);
    second.advance_to(kSteps);
    EXPECT_TRUE(same_bits(first.flow.unknown, second.flow.unknown));
  }
}

TEST(SameBits, ForEveryInstructionSet) {
  for (const Geometry geometry : kGeometries) {
    MovingFlow reference(geometry);
    reference.advance_to(kSteps);
    for (const base::InstructionSet set : {base::InstructionSet::avx2, base::InstructionSet::avx512}) {
      if (!available(set)) continue;
      MovingFlow run(geometry, set);
      run.advance_to(kSteps);
      EXPECT_TRUE(same_bits(run.flow.unknown, reference.flow.unknown));
    }
  }
}

// From every step on: right after a new factor, long after one, and where the ordering of the factors is that of an
// earlier matrix.
TEST(SameBits, AfterAStopAndARestart) {
  for (const Geometry geometry : kGeometries) {
    MovingFlow whole(geometry);
    whole.advance_to(kSteps);
    ASSERT_GE(whole.refactored.size(), 5u);
    MovingFlow stopped(geometry);
    for (int stop = 0; stop < kSteps; ++stop) {
      stopped.advance_to(stop);
      MovingFlow run = stopped.restarted();
      run.advance_to(kSteps);
      EXPECT_TRUE(same_bits(run.flow.unknown, whole.flow.unknown)) << "stopped before step " << stop;
      EXPECT_EQ(run.solver.refactorisations, whole.solver.refactorisations);
    }
  }
}

TEST(Advance, KeepsItsFactorWhileTheRateAndTheMeshStay) {
  MovingFlow run(Geometry::planar);
  run.advance_to(1);
  EXPECT_EQ(run.refactored, std::vector<int>{0});
  run.advance_to(2);
  EXPECT_EQ(run.refactored, (std::vector<int>{0, 1}));  // From Euler's rate to that of BDF2.
  run.solver.last_iterations = kManyIterations;
  run.advance_to(3);
  EXPECT_EQ(run.refactored, (std::vector<int>{0, 1}));
  run.solver.last_iterations = kManyIterations + 1;
  run.advance_to(4);
  EXPECT_EQ(run.refactored, (std::vector<int>{0, 1, 3}));
}

TEST(Advance, MakesANewFactorWhenTheOldOneHasCostAsMuch) {
  MovingFlow run(Geometry::planar);
  run.advance_to(2);
  ASSERT_EQ(run.refactored, (std::vector<int>{0, 1}));
  EXPECT_EQ(run.solver.excess_iterations, 0);
  EXPECT_EQ(run.solver.first_iterations, run.solver.last_iterations);
  run.solver.excess_iterations = kFactorWorth - 1;
  run.solver.first_iterations = 0;
  run.advance_to(3);
  EXPECT_EQ(run.refactored, (std::vector<int>{0, 1}));
  ASSERT_GT(run.solver.last_iterations, 0);
  EXPECT_EQ(run.solver.excess_iterations, kFactorWorth - 1 + run.solver.last_iterations);
  run.solver.last_iterations = kManyIterations;  // no reason by itself
  run.advance_to(4);
  EXPECT_EQ(run.refactored, (std::vector<int>{0, 1, 3}));
  EXPECT_EQ(run.solver.excess_iterations, 0);
  EXPECT_EQ(run.solver.first_iterations, run.solver.last_iterations);
}

TEST(Advance, LeavesTheUnknownsWhenItFails) {
  MovingFlow run(Geometry::planar);
  run.advance_to(2);
  base::Profile profile;
  remember(run.past, run.flow, 0.1);
  support::set_time(run.flow, run.exact, run.regular, run.time + 0.1);
  set_rates(run.flow, run.past, run.solver.order);
  const std::vector<double> given = run.flow.unknown;

  run.solver.tolerance = -1;  // Which nothing meets.
  FlowReport report = advance(run.flow, run.past, run.solver, profile);
  EXPECT_FALSE(report.converged);
  EXPECT_NE(report.reason.find("not solved within"), std::string::npos) << report.reason;
  EXPECT_TRUE(same_bits(run.flow.unknown, given));

  // A mesh that has been turned inside out.
  run.solver.tolerance = 1e-8;
  const Flow before = run.flow;
  run.flow.mesh.position[9] = run.flow.mesh.position[60];
  report = advance(run.flow, run.past, run.solver, profile);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
  EXPECT_TRUE(same_bits(run.flow.unknown, given));

  // And goes on from there as if nothing had been, with a new factor.
  run.flow = before;
  report = advance(run.flow, run.past, run.solver, profile);
  EXPECT_TRUE(report.converged) << report.reason;
}

}  // namespace
}  // namespace seapile::fluid
