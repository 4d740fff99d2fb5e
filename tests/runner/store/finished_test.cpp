#include "runner/store/finished.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runner/store/sample_run.h"
#include "tests/runner/store/scratch.h"

namespace seapile::store {
namespace {

using testing::Contains;

class Finished : public testing::Test {
 protected:
  /// One more run of the sample's drive.
  void add_run(const std::string& run, double value,
               simulation::Outcome outcome = simulation::Outcome::completed) const {
    simulation::RunResult result = sample::drive_result();
    result.metrics.front().value = value;
    result.outcome = outcome;
    RunWriter(case_folder(root_, id_) / run, sample::drive_header()).finish(result, sample::provenance(), nullptr);
  }
  Scratch scratch_;
  const std::filesystem::path& root_ = scratch_.path();
  const std::string id_ = sample::drive_header().case_id;
  const std::string metric_ = sample::drive_result().metrics.front().name;
};

TEST_F(Finished, TheNewestRunCounts) {
  EXPECT_EQ(newest_run(root_, id_), std::filesystem::path());
  EXPECT_FALSE(read_finished(root_, id_, false));
  add_run("0001", 1);
  add_run("0002", 2);
  EXPECT_EQ(newest_run(root_, id_), case_folder(root_, id_) / "0002");
  const auto finished = read_finished(root_, id_, false);
  ASSERT_TRUE(finished);
  EXPECT_EQ(finished->manifest.run, "0002");
  EXPECT_EQ(finished->metric(metric_)->value, 2);
  EXPECT_EQ(finished->metric("no_such_metric"), nullptr);
}

TEST_F(Finished, ANewestRunThatDivergedHidesTheOlderOnes) {
  add_run("0001", 1);
  add_run("0002", 2, simulation::Outcome::diverged);
  EXPECT_FALSE(read_finished(root_, id_, false));
}

TEST_F(Finished, TheBedsMetricsHaveItsMarkBeforeTheirNames) {
  sample::write(root_);
  const std::string name = sample::bed_result().metrics.front().name;
  EXPECT_EQ(read_finished(root_, id_, false)->metric("bed:" + name), nullptr);
  const auto finished = read_finished(root_, id_, true);
  ASSERT_NE(finished->metric("bed:" + name), nullptr);
  EXPECT_EQ(finished->metric("bed:" + name)->value, sample::bed_result().metrics.front().value);
  EXPECT_THAT(finished->metric_names(), Contains("bed:" + name));
  EXPECT_THAT(finished->metric_names(), Contains(metric_));
}

TEST_F(Finished, ALostBedLeavesTheDriveItsOwnMetrics) {
  add_run("0001", 1);
  const auto finished = read_finished(root_, id_, true);
  ASSERT_TRUE(finished);
  EXPECT_TRUE(finished->bed_metrics.empty());
  EXPECT_NE(finished->metric(metric_), nullptr);
}

TEST_F(Finished, ADamagedManifestIsAnErrorAndNoMissingResult) {
  add_run("0001", 1);
  write_text(case_folder(root_, id_) / "0001" / "manifest.json", "{}");
  EXPECT_THROW(read_finished(root_, id_, false), StoreError);
}

}  // namespace
}  // namespace seapile::store
