#include "solver/grains/contact_kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/aligned.h"
#include "solver/base/random.h"
#include "tests/solver/grains/scalar_kernels.h"

namespace seapile::grains {
namespace {

/// Everything that kernels read and write, filled at random.
template <class Real>
struct Table {
  base::AlignedVector<ContactBlock<Real>> block;
  std::vector<std::uint8_t> active;
  std::vector<double> wake;
  base::AlignedVector<Disc> disc;
  base::AlignedVector<BodyGroup<Real>> group;
  base::AlignedVector<Before<Real>> before;
  base::AlignedVector<Push<Real>> push;
  base::AlignedVector<Iterate<Real>> iterate;
  SweepSums sweep;
  SolveSums solve;
  BodySums body;
};

constexpr int kBlocks = 12, kClose = 64, kApart = 64, kFillers = 2 * kLanes * kBlocks;
constexpr int kBodies = kClose + kApart + kFillers;

/// Bodies below kClose stand close and move, the next kApart stand apart and rest, the others fill empty lanes. Blocks
/// share bodies with other blocks; lanes of one block never do.
template <class Real>
Table<Real> random_table(std::uint64_t seed) {
  std::uint64_t drawn = 0;
  const auto draw = [&](double min, double max) { return base::uniform(min, max, seed, 0, drawn++); };
  const auto real = [&](double min, double max) { return static_cast<Real>(draw(min, max)); };

  Table<Real> t;
  t.group.resize((kBodies + 3) / 4);
  t.before.resize(t.group.size() * 4);
  t.push.resize(t.group.size() * 4);
  t.disc.resize(t.group.size() * 4);
  for (int body = 0; body < kBodies; ++body) {
    Motion<Real>& m = t.group[body / 4].motion[body % 4];
    if (body < kClose) {
      // Every eighth is a point of a wall: unmoved, of radius 0.
      const bool wall = body % 8 == 7;
      t.disc[body] = {draw(0, 1), draw(0, 1), wall ? 0 : draw(0.1, 0.4), 0};
      if (!wall) m = {real(-1, 1), real(-1, 1), real(-1, 1), real(0.2, 3)};
    } else if (body < kClose + kApart) {
      t.disc[body] = {10.0 * body + draw(0, 1), draw(0, 1), draw(0.1, 0.4), 0};
      m.inverse_mass = real(0.2, 3);
    } else {
      t.disc[body] = {static_cast<double>(body % 2), 0, 0, 0};
    }
    if (m.inverse_mass > 0) {
      t.group[body / 4].drift[body % 4] = {real(-0.01, 0.01), real(-0.01, 0.01), real(-0.01, 0.01), 0};
      t.before[body] = {real(-1, 1), real(-1, 1), real(-1, 1), Real(0.5) / m.inverse_mass};
    }
  }

  t.block.resize(kBlocks);
  t.active.resize(kBlocks);
  t.wake.resize(kBlocks);
  t.iterate.resize(kBlocks);
  std::int32_t filler = kClose + kApart;
  for (int b = 0; b < kBlocks; ++b) {
    const bool apart = b % 4 == 3;
    std::array<std::int32_t, kClose> body;
    for (int k = 0; k < kClose; ++k) body[k] = k + (apart ? kClose : 0);
    for (int k = kClose - 1; k > 0; --k) std::swap(body[k], body[static_cast<int>(draw(0, k + 1))]);
    t.active[b] = draw(0, 1) < 0.8;
    t.wake[b] = draw(0, 1);
    for (int lane = 0; lane < kLanes; ++lane) {
      ContactBlock<Real>& block = t.block[b];
      // The last block holds nothing, the others have holes.
      if (b == kBlocks - 1 || draw(0, 1) < 0.15) {
        block.i[lane] = place_of(filler++);
        block.j[lane] = place_of(filler++);
        block.mass[lane] = block.pn[lane] = block.pt[lane] = block.gap[lane] = block.ny[lane] = 0;
        block.nx[lane] = 1;
        continue;
      }
      block.i[lane] = place_of(body[2 * lane]);
      block.j[lane] = place_of(body[2 * lane + 1]);
      block.nx[lane] = real(-0.7, 0.7);
      block.ny[lane] = real(-0.7, 0.7);
      block.gap[lane] = real(-0.02, 0.02);
      block.mass[lane] = real(0.2, 2);
      block.pn[lane] = draw(0, 1) < 0.3 ? Real(0) : real(0, 0.5);
      block.pt[lane] = real(-0.5, 0.5);
      t.iterate[b].bias[lane] = real(-0.5, 0.5);
      t.iterate[b].old_pn[lane] = real(0, 0.5);
      t.iterate[b].old_pt[lane] = real(-0.5, 0.5);
    }
  }
  for (int body = 0; body < kClose + kApart; ++body) t.push[body] = {real(-20, 20), real(-20, 20)};
  return t;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

template <class Real>
void expect_same_bits(const Table<Real>& a, const Table<Real>& b, const std::string& what) {
  EXPECT_TRUE(same_bits(a.block, b.block)) << what << ": blocks";
  EXPECT_TRUE(a.active == b.active) << what << ": activity";
  EXPECT_TRUE(a.wake == b.wake) << what << ": closings at which to wake";
  EXPECT_TRUE(same_bits(a.group, b.group)) << what << ": bodies";
  EXPECT_TRUE(same_bits(a.before, b.before)) << what << ": velocities before";
  EXPECT_TRUE(same_bits(a.iterate, b.iterate)) << what << ": iterates";
  EXPECT_EQ(a.solve.residual, b.solve.residual) << what;
  EXPECT_EQ(a.solve.touching, b.solve.touching) << what;
  EXPECT_EQ(a.solve.work, b.solve.work) << what;
  EXPECT_EQ(a.sweep.work, b.sweep.work) << what;
  EXPECT_EQ(a.sweep.residual, b.sweep.residual) << what;
  EXPECT_EQ(a.body.work, b.body.work) << what;
  EXPECT_EQ(a.body.lift, b.body.lift) << what;
}

constexpr InstructionSet kSets[] = {InstructionSet::generic, InstructionSet::avx2, InstructionSet::avx512};

/// Runs a kernel of every instruction set that this machine has against the scalar twin, on twenty random tables.
template <class Real, class Fast, class Slow>
void expect_the_bits_of(Slow&& slow, Fast&& fast) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Table<Real> expected = random_table<Real>(seed);
    slow(expected);
    for (const InstructionSet set : kSets) {
      if (!available(set)) continue;
      const ContactKernels<Real>& kernels = contact_kernels<Real>(set);
      Table<Real> found = random_table<Real>(seed);
      fast(kernels, found);
      expect_same_bits(found, expected, std::string(kernels.name) + ", seed " + std::to_string(seed));
    }
  }
}

template <class Real>
constexpr Softness<Real> kSoft = {Real(2e4), Real(750), Real(0.94), Real(0.06), Real(2.2)};

template <class Real>
struct ContactKernel : testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(ContactKernel, Reals);

TYPED_TEST(ContactKernel, RefreshHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  // A quarter of the blocks sleeps on, the others are looked at: some work, some rest.
  constexpr Nearness kNear{1e-3, 5e-4, 0.7, 0.05};
  int slept = 0, rested = 0, worked = 0;
  expect_the_bits_of<Real>(
      [&](Table<Real>& t) {
        const std::vector<double> wake = t.wake;
        scalar::refresh(t.block.data(), t.active.data(), t.wake.data(), 0, kBlocks, t.disc.data(), t.group.data(),
                        t.before.data(), kNear);
        for (int b = 0; b < kBlocks; ++b) (t.active[b] ? worked : t.wake[b] == wake[b] ? slept : rested) += 1;
      },
      [&](const ContactKernels<Real>& k, Table<Real>& t) {
        k.refresh(t.block.data(), t.active.data(), t.wake.data(), 0, kBlocks, t.disc.data(), t.group.data(),
                  t.before.data(), kNear);
      });
  EXPECT_GT(slept, 20);
  EXPECT_GT(rested, 20);
  EXPECT_GT(worked, 20);
}

TYPED_TEST(ContactKernel, SweepHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  expect_the_bits_of<Real>(
      [](Table<Real>& t) {
        scalar::sweep(t.block.data(), t.active.data(), 0, kBlocks, t.group.data(), Real(0.5), kSoft<Real>, &t.sweep);
        scalar::sweep(t.block.data(), t.active.data(), 2, 5, t.group.data(), Real(0), kSoft<Real>, &t.sweep);
      },
      [](const ContactKernels<Real>& k, Table<Real>& t) {
        k.sweep(t.block.data(), t.active.data(), 0, kBlocks, t.group.data(), Real(0.5), kSoft<Real>, &t.sweep);
        k.sweep(t.block.data(), t.active.data(), 2, 5, t.group.data(), Real(0), kSoft<Real>, &t.sweep);
      });
}

TYPED_TEST(ContactKernel, BeginHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  expect_the_bits_of<Real>(
      [](Table<Real>& t) {
        scalar::start<Real>(true, t.group.data(), t.before.data(), nullptr, 1, 12, Real(5e-5), Real(9.81), &t.body);
        scalar::start(true, t.group.data(), t.before.data(), t.push.data(), 12, 30, Real(5e-5), Real(9.81), &t.body);
      },
      [](const ContactKernels<Real>& k, Table<Real>& t) {
        k.begin(t.group.data(), t.before.data(), nullptr, 1, 12, Real(5e-5), Real(9.81), &t.body);
        k.begin(t.group.data(), t.before.data(), t.push.data(), 12, 30, Real(5e-5), Real(9.81), &t.body);
      });
}

TYPED_TEST(ContactKernel, AdvanceHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  expect_the_bits_of<Real>(
      [](Table<Real>& t) {
        scalar::start<Real>(false, t.group.data(), t.before.data(), nullptr, 1, 30, Real(5e-5), Real(9.81), &t.body);
        scalar::start(false, t.group.data(), t.before.data(), t.push.data(), 0, 31, Real(5e-5), Real(9.81), &t.body);
      },
      [](const ContactKernels<Real>& k, Table<Real>& t) {
        k.advance(t.group.data(), t.before.data(), nullptr, 1, 30, Real(5e-5), Real(9.81), &t.body);
        k.advance(t.group.data(), t.before.data(), t.push.data(), 0, 31, Real(5e-5), Real(9.81), &t.body);
      });
}

TYPED_TEST(ContactKernel, SolveHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  const auto call = [](auto&& solve, Table<Real>& t) {
    for (const Real momentum : {Real(0), Real(0.7)})
      solve(t.block.data(), t.iterate.data(), t.active.data(), 0, kBlocks, t.group.data(), Real(0.5), Real(2), momentum,
            &t.solve);
    solve(t.block.data(), t.iterate.data(), t.active.data(), 2, 5, t.group.data(), Real(0), Real(2), Real(0.3),
          &t.solve);
  };
  expect_the_bits_of<Real>(
      [&](Table<Real>& t) {
        // Its arithmetic is that of discs that spin.
        call([](auto* b, auto* i, auto* a, int first, int last, auto* bodies, Real mu, Real, Real momentum,
                SolveSums* sums) { scalar::solve(b, i, a, first, last, bodies, mu, momentum, sums); },
             t);
        EXPECT_GT(t.solve.touching, 50);
      },
      [&](const ContactKernels<Real>& k, Table<Real>& t) { call(k.solve, t); });
}

TYPED_TEST(ContactKernel, AssessHasTheBitsOfItsScalarTwinAndMovesNothing) {
  using Real = TypeParam;
  expect_the_bits_of<Real>(
      [](Table<Real>& t) {
        const Table<Real> start = t;
        scalar::assess(t.block.data(), t.iterate.data(), t.active.data(), 0, kBlocks, t.group.data(), t.before.data(),
                       Real(0.5), &t.solve);
        EXPECT_TRUE(same_bits(start.group, t.group) && same_bits(start.block, t.block));
      },
      [](const ContactKernels<Real>& k, Table<Real>& t) {
        k.assess(t.block.data(), t.iterate.data(), t.active.data(), 0, kBlocks, t.group.data(), t.before.data(),
                 Real(0.5), Real(2), &t.solve);
      });
}

TYPED_TEST(ContactKernel, ExtrapolateHasTheBitsOfItsScalarTwin) {
  using Real = TypeParam;
  expect_the_bits_of<Real>(
      [](Table<Real>& t) { scalar::extrapolate(t.group.data(), 1, 30, Real(0.6)); },
      [](const ContactKernels<Real>& k, Table<Real>& t) { k.extrapolate(t.group.data(), 1, 30, Real(0.6)); });
}

TYPED_TEST(ContactKernel, ASweepLeavesRestingBlocksAndEmptyLanesAlone) {
  using Real = TypeParam;
  for (const InstructionSet set : kSets) {
    if (!available(set)) continue;
    Table<Real> t = random_table<Real>(1);
    t.active[2] = t.active[7] = 0;
    const Table<Real> before = t;
    contact_kernels<Real>(set).sweep(t.block.data(), t.active.data(), 0, kBlocks, t.group.data(), Real(0.5),
                                     kSoft<Real>, &t.sweep);
    int resting = 0;
    for (int b = 0; b < kBlocks; ++b) {
      if (!t.active[b]) {
        ++resting;
        EXPECT_EQ(std::memcmp(&t.block[b], &before.block[b], sizeof t.block[b]), 0);
      }
      for (int lane = 0; lane < kLanes; ++lane) {
        if (t.block[b].mass[lane] > 0) continue;
        EXPECT_EQ(t.block[b].pn[lane], 0);
        EXPECT_EQ(t.block[b].pt[lane], 0);
      }
    }
    EXPECT_GE(resting, 2);
    for (int body = kClose + kApart; body < kBodies; ++body) {
      const Motion<Real>& m = t.group[body / 4].motion[body % 4];
      EXPECT_TRUE(m.vx == 0 && m.vy == 0 && m.u == 0 && m.inverse_mass == 0);
    }
  }
}

TEST(ContactKernels, TheProcessorsOwnSetsAreThere) {
  EXPECT_TRUE(available(fastest()));
  // Of two sets that a processor has, the wider one is taken, but for the Zen 4 that does it in halves.
  EXPECT_EQ(fastest() == InstructionSet::generic, !available(InstructionSet::avx2));
#if defined(__x86_64__)
  const bool in_halves = __builtin_cpu_is("amdfam19h");
  EXPECT_EQ(fastest() == InstructionSet::avx512, available(InstructionSet::avx512) && !in_halves);
#endif
  EXPECT_TRUE(available(InstructionSet::generic));
  EXPECT_STREQ(contact_kernels<float>(InstructionSet::generic).name, "generic");
  for (const auto& [set, name] : {std::pair{InstructionSet::avx2, "avx2"}, {InstructionSet::avx512, "avx512"}}) {
    if (available(set))
      EXPECT_STREQ(contact_kernels<double>(set).name, name);
    else
      EXPECT_THROW(contact_kernels<double>(set), std::invalid_argument);
  }
}

}  // namespace
}  // namespace seapile::grains
