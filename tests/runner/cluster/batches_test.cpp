// Cases as arrays of a batch system: each once, never too many in one array, and nothing before what it waits for.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "runner/cluster/batches.h"

namespace seapile::cluster {
namespace {

using execute::Kind;
using testing::ElementsAre;
using testing::IsEmpty;

execute::Task task(Kind kind, std::optional<std::size_t> bed = {}) {
  execute::Task task;
  task.kind = kind;
  task.bed = bed;
  return task;
}

/// `beds` beds, then `drives` drives of them in turn, then `flows` flows.
execute::Plan plan_of(std::size_t beds, std::size_t drives, std::size_t flows) {
  execute::Plan plan;
  for (std::size_t i = 0; i < beds; ++i) plan.tasks.push_back(task(Kind::bed));
  for (std::size_t i = 0; i < drives; ++i) plan.tasks.push_back(task(Kind::drive, i % beds));
  for (std::size_t i = 0; i < flows; ++i) plan.tasks.push_back(task(Kind::flow));
  return plan;
}

std::size_t alone(Kind) { return 1; }

TEST(Batches, EveryWantedCaseIsInOneTaskOnce) {
  for (const std::size_t most : {1U, 2U, 5U, 1000U}) {
    for (const std::size_t together : {1U, 3U, 50U}) {
      const execute::Plan plan = plan_of(7, 23, 11);
      std::vector<bool> wanted(plan.tasks.size(), true);
      wanted[2] = wanted[20] = wanted[40] = false;
      std::map<std::size_t, int> times;
      std::size_t line = 0;
      for (const Array& array : make_arrays(plan, wanted, most, [&](Kind) { return together; })) {
        EXPECT_EQ(array.first, line);
        EXPECT_LE(array.tasks.size(), most);
        line += array.tasks.size();
        for (const auto& cases : array.tasks) {
          EXPECT_LE(cases.size(), together);
          EXPECT_FALSE(cases.empty());
          for (const std::size_t i : cases) {
            ++times[i];
            EXPECT_EQ(plan.tasks[i].kind, array.kind);
          }
        }
      }
      for (std::size_t i = 0; i < plan.tasks.size(); ++i) EXPECT_EQ(times[i], wanted[i] ? 1 : 0) << i;
    }
  }
}

TEST(Batches, ADriveWaitsForTheArrayOfItsBedAndForNoLaterOne) {
  const execute::Plan plan = plan_of(9, 40, 0);
  const auto arrays = make_arrays(plan, std::vector<bool>(plan.tasks.size(), true), 4, alone);
  std::map<std::size_t, std::size_t> array_of;
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    for (const auto& cases : arrays[a].tasks) {
      for (const std::size_t i : cases) array_of[i] = a;
    }
  }
  for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
    if (plan.tasks[i].kind != Kind::drive) continue;
    EXPECT_TRUE(arrays[array_of[i]].after.contains(array_of[*plan.tasks[i].bed])) << i;
  }
  for (std::size_t a = 0; a < arrays.size(); ++a) {
    for (const std::size_t before : arrays[a].after) EXPECT_LT(before, a);
  }
}

TEST(Batches, ADriveWhoseBedIsThereWaitsForNothing) {
  execute::Plan plan = plan_of(2, 2, 0);
  const auto arrays = make_arrays(plan, {true, false, true, true}, 10, alone);
  ASSERT_EQ(arrays.size(), 3U);
  EXPECT_THAT(arrays[1].tasks, ElementsAre(ElementsAre(3U)));
  EXPECT_THAT(arrays[1].after, IsEmpty());
  EXPECT_THAT(arrays[2].tasks, ElementsAre(ElementsAre(2U)));
  EXPECT_THAT(arrays[2].after, ElementsAre(0U));
}

TEST(Batches, ShortCasesShareATaskUntilItTakesAsLongAsWanted) {
  EXPECT_EQ(cases_per_task(0, 30, 7200), 1U);  // nothing known of their pace
  EXPECT_EQ(cases_per_task(10, 30, 7200), 3U);
  EXPECT_EQ(cases_per_task(11, 30, 7200), 3U);
  EXPECT_EQ(cases_per_task(40, 30, 7200), 1U);
  EXPECT_EQ(cases_per_task(1, 600, 600), 300U);  // twice as long still fits the limit
  EXPECT_EQ(cases_per_task(500, 600, 600), 1U);  // a case that hardly fits is alone
  EXPECT_EQ(cases_per_task(1e-9, 600, 7200), 10'000U);
}

}  // namespace
}  // namespace seapile::cluster
