#include "solver/grains/share.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

namespace seapile::grains {
namespace {

// What each thread does, and when: `turn` counts the work of all.
struct Done {
  int turn = -1, thread = -1, times = 0;
};

TEST(Share, EveryRegionIsDoneOnceAfterAllThatItHolds) {
  for (const std::size_t count : {1U, 513U, 6000U, 11'596U, 100'000U})
    for (const int threads : {1, 2, 3, 4, 7}) {
      SCOPED_TRACE(std::to_string(count) + " grains, " + std::to_string(threads) + " threads");
      const Regions regions(count);
      std::vector<Done> done(regions.count()), each(regions.count());
      std::vector<int> tile_of(regions.tiles(), -1);
      std::atomic<int> turn = 0;
      base::Crew crew(threads);
      base::Profile profile;
      const std::size_t part = profile.index("work"), waiting = profile.index("waiting");
      crew.run([&](int me, int all) {
        Worker worker(regions, &crew, me, all, profile, waiting);
        for (std::int32_t tile = worker.first_tile; tile < worker.last_tile; ++tile) tile_of[tile] = me;
        worker.climb(part, [&](std::int32_t r) { done[r] = {turn++, me, done[r].times + 1}; });
        worker.meet(part);
        worker.each([&](std::int32_t r) { each[r] = {0, me, each[r].times + 1}; });
      });
      for (std::int32_t r = 0; r < regions.count(); ++r) {
        EXPECT_EQ(done[r].times, 1);
        EXPECT_EQ(each[r].times, 1);
        EXPECT_EQ(each[r].thread, done[r].thread);
        for (std::int32_t q = regions.first_inside(r); q < r; ++q) EXPECT_LT(done[q].turn, done[r].turn);
        if (regions[r].is_tile()) {
          EXPECT_EQ(tile_of[regions[r].first_tile], done[r].thread);
        }
      }
      EXPECT_EQ(done[regions.count() - 1].thread, 0) << "the first thread goes on with what needs the whole bed";
    }
}

}  // namespace
}  // namespace seapile::grains
