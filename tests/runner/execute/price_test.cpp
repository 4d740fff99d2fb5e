#include "runner/execute/price.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runner/study/study.h"

namespace seapile::execute {
namespace {

scene::SceneSpec drive_at(double speed, double depth = 1) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  scene.pile->depth = depth;
  scene.pile->driving = pile::ConstantDriving{speed};
  return scene;
}

store::PastCost cost_of(const scene::SceneSpec& scene, double cpu_seconds, double memory_mb = 100, double bytes = 1e6) {
  return {"", "drive", cpu_seconds, memory_mb, bytes, store::parameters(study::to_json(scene), "drive")};
}

TEST(Price, OfACaseIsTheMedianOfRunsAlike) {
  const auto scene = drive_at(0.2);
  const PriceList list({cost_of(scene, 10), cost_of(scene, 11, 130), cost_of(scene, 40)});
  const auto price = list.price("drive", scene);
  ASSERT_TRUE(price);
  EXPECT_EQ(price->cpu_seconds, 11);
  EXPECT_EQ(price->memory_mb, 130) << "memory is that of the one that needed most";
  EXPECT_EQ(price->runs, 3U);
  EXPECT_FALSE(price->scaled);
}

TEST(Price, SeedsAndMaterialsDoNotSetCasesApart) {
  auto other = drive_at(0.2);
  other.bed.seed = 7;
  other.bed.grains.friction.grain = 0.3;
  other.pile->tip = pile::FlatTip{};
  const auto price = PriceList({cost_of(drive_at(0.2), 10)}).price("drive", other);
  ASSERT_TRUE(price);
  EXPECT_FALSE(price->scaled);
  EXPECT_EQ(price->cpu_seconds, 10);
}

TEST(Price, ScalesWithDurationAndGrainsFromTheNearestAmount) {
  const PriceList list({cost_of(drive_at(0.2), 10), cost_of(drive_at(0.05), 44)});
  auto slow = drive_at(0.1);  // ten seconds, between five and twenty
  slow.bed.grains.count = slow.bed.grains.count * 3 / 2;
  const auto price = list.price("drive", slow);
  ASSERT_TRUE(price);
  EXPECT_TRUE(price->scaled);
  EXPECT_THAT(price->cpu_seconds, testing::AnyOf(testing::DoubleNear(30, 0.1), testing::DoubleNear(33, 0.1)));
  EXPECT_NEAR(price->memory_mb, 150, 0.1);
}

TEST(Price, IsNotGuessed) {
  const PriceList list({cost_of(drive_at(0.2), 10)});
  auto finer = drive_at(0.2);
  finer.contact.step /= 2;
  EXPECT_FALSE(list.price("drive", finer)) << "computed otherwise";
  auto wet = drive_at(0.2);
  wet.fluid.emplace();
  EXPECT_FALSE(list.price("drive", wet)) << "another kind of work";
  EXPECT_FALSE(list.price("drive", drive_at(0.002))) << "too far away";
  EXPECT_FALSE(list.price("bed", bed_alone(drive_at(0.2))));
  EXPECT_FALSE(PriceList({}).price("drive", drive_at(0.2)));
}

TEST(Estimate, CountsWhatIsToRunAndSaysWhatHasNoPrice) {
  Plan plan;
  plan.tasks.resize(4);  // a bed, and three drives on it
  plan.tasks[0].kind = Kind::bed;
  for (const std::size_t drive : {1, 2, 3}) plan.tasks[drive].bed = 0;
  plan.tasks[3].decision.action = Action::fresh;
  const Estimate whole = estimate(plan, {Price{10, 50, 1e6}, Price{100, 80, 2e6}, std::nullopt, std::nullopt}, 4);
  EXPECT_EQ(whole.to_run, 3U);
  EXPECT_EQ(whole.unpriced, 1U);
  EXPECT_EQ(whole.cpu_seconds, 110);
  EXPECT_EQ(whole.largest_mb, 80);
  EXPECT_EQ(whole.bytes, 3e6);
  EXPECT_EQ(whole.wall_seconds, 110) << "one thread each, and the drive waits for its bed";
}

}  // namespace
}  // namespace seapile::execute
