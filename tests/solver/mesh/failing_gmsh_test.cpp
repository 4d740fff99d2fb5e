// Gmsh that crashes or hangs, by sizes that do.
#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <functional>
#include <string>
#include <vector>

#include "solver/base/crew.h"
#include "solver/mesh/basin_mesh.h"
#include "solver/mesh/generate.h"
#include "tests/solver/mesh/children.h"

namespace seapile::mesh {
namespace {

using FailingGmsh = WithChildren;

const std::vector<Corner> kSquare = {{{0, 0}, 0}, {{1, 0}, 1}, {{1, 1}, 2}, {{0, 1}, 3}};

double even(base::Vec2) { return 0.2; }

/// Why there is no mesh; empty when there is one.
template <class Error = NoMesh>
std::string refusal(const std::function<double(base::Vec2)>& size, double patience) {
  try {
    generate(kSquare, size, {.patience = patience});
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST_F(FailingGmsh, AHangIsKilledAndNotTriedAgain) {
  Children children;
  const std::string why = refusal<NoAnswer>(
      [&](base::Vec2) -> double {
        children.number();
        hang();
      },
      kShort);
  EXPECT_EQ(why, "mesh: Gmsh did not answer within 0.2 s");
  EXPECT_EQ(children.count(), 1) << "the clock would choose the mesh";
}

TEST_F(FailingGmsh, ACrashIsTriedTwiceAndTheParentLives) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
    Children children;
    const std::string why = refusal(
        [&](base::Vec2) {
          children.number();
          ::raise(signal);
          return 0.2;
        },
        kForever);
    EXPECT_EQ(why, "mesh: Gmsh ended by signal " + std::to_string(signal) + ", and with another seed again");
    EXPECT_EQ(children.count(), 2);
  }
}

TEST_F(FailingGmsh, TwoDifferentFailuresAreBothTold) {
  Children children;
  const std::string why = refusal(
      [&](base::Vec2) {
        ::raise(children.number() == 1 ? SIGSEGV : SIGABRT);
        return 0.2;
      },
      kForever);
  EXPECT_EQ(why, "mesh: Gmsh ended by signal 11, and with another seed: Gmsh ended by signal 6");
}

TEST_F(FailingGmsh, WhatFailsOnceHasTheMeshOfTheNextSeed) {
  Children children;
  const TriangleMesh second = generate(kSquare,
                                       [&](base::Vec2) {
                                         if (children.number() == 1) ::raise(SIGSEGV);
                                         return 0.2;
                                       },
                                       {.patience = kForever});
  EXPECT_EQ(children.count(), 2);
  const TriangleMesh asked = generate(kSquare, even, {.seed = 2});
  EXPECT_EQ(second.position, asked.position);
  EXPECT_EQ(second.triangle, asked.triangle);
  EXPECT_NE(second.position, generate(kSquare, even).position) << "the seed does nothing";
}

TEST_F(FailingGmsh, AMeshIsMadeByOneChild) {
  Children children;
  generate(kSquare, [&](base::Vec2) { return 0.2 + 0 * children.number(); });
  EXPECT_EQ(children.count(), 1);
}

// Its threads are not in the child, and wait for their next job meanwhile.
TEST_F(FailingGmsh, AMeshIsMadeBesideACrew) {
  const TriangleMesh alone = generate(kSquare, even);
  base::Crew crew(3);
  std::atomic<int> work = 0;
  for (int i = 0; i < 3; ++i) {
    crew.run([&](int, int) { ++work; });
    EXPECT_EQ(generate(kSquare, even).position, alone.position);
  }
  EXPECT_GE(work, 3);
}

// Of the many ways to mesh it each would be waited for.
TEST_F(FailingGmsh, ABasinWhoseMeshHangsIsNotTriedInOtherWays) {
  Children children;
  const BasinOutline outline{1, {{0, 0.5}, {0.25, 0.5}, {0.5, 0.5}}, {}};
  const auto size = [&](base::Vec2) -> double {
    children.number();
    hang();
  };
  EXPECT_THROW(basin_mesh(outline, size, 0, kShort), NoAnswer);
  EXPECT_EQ(children.count(), 1);
}

TEST_F(FailingGmsh, AnEndWithoutAnAnswerIsNoMesh) {
  for (const int code : {0, 1}) {
    const std::string why = refusal([&](base::Vec2) -> double { ::_exit(code); }, kForever);
    EXPECT_EQ(why, std::string("mesh: ") + (code == 0 ? "Gmsh's answer is not whole" : "Gmsh ended with code 1") +
                       ", and with another seed again");
  }
}

}  // namespace
}  // namespace seapile::mesh
