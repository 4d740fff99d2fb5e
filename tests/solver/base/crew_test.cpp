#include "solver/base/crew.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>
#include <vector>

namespace seapile::base {
namespace {

// Without looks every wait asks the system, which is where a wake-up can be lost: the test then never ends. Between two
// meetings each thread writes what the others read, so that one that runs ahead is seen.
TEST(Meeting, NobodyRunsAheadAndNobodySleepsOn) {
  constexpr int kRounds = 20'000;
  for (const int looks : {0, 50, 20'000})
    for (const int threads : {2, 3}) {
      Meeting meeting;
      std::vector<int> written(threads, 0);
      std::vector<int> wrong(threads, 0);
      std::vector<std::thread> team;
      for (int me = 0; me < threads; ++me)
        team.emplace_back([&, me] {
          for (int round = 1; round <= kRounds / (looks == 0 ? 1 : 10); ++round) {
            written[me] = round;
            meeting.wait(threads, looks);
            for (const int other : written) wrong[me] += other != round;
            meeting.wait(threads, looks);
          }
        });
      for (std::thread& one : team) one.join();
      EXPECT_EQ(wrong, std::vector<int>(threads, 0)) << looks << " looks, " << threads << " threads";
    }
}

TEST(Crew, EachThreadDoesItsPartOfEachJob) {
  for (const int threads : {1, 2, 5}) {
    Crew crew(threads, 1000, 1000);  // five threads on two cores would look in vain for long
    for (int job = 0; job < 200; ++job) {
      std::vector<int> done(threads, 0);
      int all = 0;
      crew.run([&](int me, int count) {
        ++done[me];
        if (me == 0) all = count;
      });
      ASSERT_TRUE(all == threads || all == 1);
      for (int me = 0; me < threads; ++me) ASSERT_EQ(done[me], me < all ? 1 : 0);
    }
  }
}

TEST(Crew, WithoutOneTheCallingThreadDoesIt) {
  int calls = 0;
  together(nullptr, [&](int me, int threads) { calls += me == 0 && threads == 1; });
  EXPECT_EQ(calls, 1);
}

// The second thread comes when the first lies down, so the first is let down at every job that it does not do alone.
TEST(Crew, WorksAloneForAWhileWhenTheOthersAreNotLetRun) {
  Crew crew(2, 0);
  std::vector<int> threads;
  for (int job = 0; job < 40; ++job)
    crew.run([&](int me, int all) {
      if (me == 0) threads.push_back(all);
      if (me == 1) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    });
  int together = 0;
  for (const int all : threads) together += all == 2;
  EXPECT_GE(together, 1);
  EXPECT_LT(together, 40) << "no job was done alone";
}

}  // namespace
}  // namespace seapile::base
