// What becomes of runs whose mesher goes wrong, at the first mesh and at a later one.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>
#include <string>

#include "solver/mesh/generate.h"
#include "solver/simulation/basin.h"
#include "solver/simulation/jet.h"
#include "solver/simulation/run.h"
#include "tests/support/scenes.h"

namespace seapile::simulation {
namespace {

using testing::HasSubstr;

constexpr const char* kCrash = "Gmsh ended by signal 6, and with another seed again";

/// While it exists, the mesher goes wrong in this way (tests/solver/mesh/broken_mesher.cpp).
class Broken {
 public:
  explicit Broken(const char* how) { ::setenv("SEAPILE_BROKEN", how, 1); }
  ~Broken() { ::unsetenv("SEAPILE_BROKEN"); }
  Broken(const Broken&) = delete;
  Broken& operator=(const Broken&) = delete;
};

std::string refusal() {
  const std::vector<mesh::Corner> square = {{{0, 0}, 0}, {{1, 0}, 1}, {{1, 1}, 2}, {{0, 1}, 3}};
  try {
    mesh::generate(square, [](base::Vec2) { return 0.3; });
  } catch (const mesh::NoMesh& error) {
    return error.what();
  }
  return "";
}

TEST(BrokenMesher, WithoutAFaultItMeshes) { EXPECT_EQ(refusal(), ""); }

TEST(BrokenMesher, AMeshWithoutElementsIsNone) {
  const Broken broken("is empty");
  EXPECT_EQ(refusal(), "mesh: Gmsh made no elements, and with another seed again");
}

TEST(BrokenMesher, AMeshWithAnInvertedTriangleIsNone) {
  const Broken broken("is inverted");
  EXPECT_THAT(refusal(), HasSubstr("Gmsh made no valid mesh (mesh: triangle 0 does not turn counterclockwise)"));
}

TEST(BrokenMesher, AJetWithoutAMeshHasDiverged) {
  const Broken broken("crashes");
  fluid::JetSpec jet;
  EXPECT_EQ(run_jet(jet, {}, {}, {}).outcome, Outcome::diverged);
  EXPECT_THAT(run_jet(jet, {}, {}, {}).reason, HasSubstr(kCrash));
  jet.method = fluid::TransientMethod{};
  EXPECT_EQ(run_jet(jet, {}, {}, {}).outcome, Outcome::diverged);
  EXPECT_THAT(run_jet(jet, {}, {}, {}).reason, HasSubstr(kCrash));
}

/// A pile that goes down into water through one remesh at least.
basin::BasinSpec water() {
  basin::BasinSpec spec;
  spec.width = 5;
  spec.depth = 2.4;
  spec.pile = basin::BasinPileSpec{};
  spec.mesh.pattern = basin::UnstructuredMesh{0.4, 0.3, 0.15};
  spec.mesh.remesh = basin::RemeshSpec{};
  spec.mesh.remesh->share = 0.02;
  spec.time.step = 0.05;
  spec.time.duration = 5;
  return spec;
}

TEST(BrokenMesher, ABasinWithoutAMeshHasDiverged) {
  const Broken broken("crashes");
  const RunResult result = run_basin(water(), {}, {}, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, HasSubstr(kCrash));
}

TEST(BrokenMesher, ABasinThatGetsNoNewMeshHasDivergedAtItsLastGoodState) {
  std::optional<Broken> broken;
  BasinHooks hooks;
  hooks.record = [&](const FlowRecord&) { broken.emplace("crashes"); };  // the first, which the start is
  std::vector<Array> last;
  hooks.checkpoint = [&](const std::vector<Array>& state) { last = state; };
  const RunResult result = run_basin(water(), {}, {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, HasSubstr(std::string("no new mesh could be made: mesh: ") + kCrash));
  EXPECT_FALSE(last.empty());
}

TEST(BrokenMesher, ASaturatedBedWithoutAMeshHasDiverged) {
  const scene::SceneSpec scene = support::small_saturated_drive();
  const Bed& bed = support::settled(scene.bed);
  const Broken broken("crashes");
  const RunResult result = run(scene, support::small_record(), bed, {}, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, HasSubstr(kCrash));
}

TEST(BrokenMesher, ASaturatedBedThatGetsNoNewMeshHasDivergedAtItsLastGoodState) {
  const scene::SceneSpec scene = support::small_saturated_drive();
  std::optional<Broken> broken;
  RunHooks hooks;
  hooks.record = [&](const Record&) { broken.emplace("crashes"); };
  std::vector<Array> last;
  hooks.checkpoint = [&](const std::vector<Array>& state) { last = state; };
  const RunResult result = run(scene, support::small_record(), support::settled(scene.bed), {}, {}, {}, hooks);
  EXPECT_EQ(result.outcome, Outcome::diverged);
  EXPECT_THAT(result.reason, HasSubstr(std::string("no new mesh could be made: mesh: ") + kCrash));
  EXPECT_FALSE(last.empty());
}

}  // namespace
}  // namespace seapile::simulation
