#include "solver/grains/contact_step.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace seapile::grains {
namespace {

// Without looks every wait asks the system, which is where a wake-up can be lost: the test then never ends. Between two
// meetings each thread writes what the others read, so that one that runs ahead is seen.
TEST(Meeting, NobodyRunsAheadAndNobodySleepsOn) {
  constexpr int kRounds = 20'000;
  for (const int looks : {0, 50, 20'000})
    for (const int threads : {2, 3}) {
      Meeting meeting(looks);
      std::vector<int> written(threads, 0);
      std::vector<int> wrong(threads, 0);
      std::vector<std::thread> team;
      for (int me = 0; me < threads; ++me)
        team.emplace_back([&, me] {
          for (int round = 1; round <= kRounds / (looks == 0 ? 1 : 10); ++round) {
            written[me] = round;
            meeting.wait(threads);
            for (const int other : written) wrong[me] += other != round;
            meeting.wait(threads);
          }
        });
      for (std::thread& one : team) one.join();
      EXPECT_EQ(wrong, std::vector<int>(threads, 0)) << looks << " looks, " << threads << " threads";
    }
}

}  // namespace
}  // namespace seapile::grains
