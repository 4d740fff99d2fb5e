// `runner status`: what is done, running, failed or missing, by looking alone.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;

std::map<std::string, int> states(const Workplace& place, const std::string& study) {
  std::map<std::string, int> counts;
  const Finished status = place.run({"status", study, "--format", "json"});
  EXPECT_EQ(status.exit_code, 0) << status.error;
  const json table = json::parse(status.out);
  for (const json& row : table.at("rows")) ++counts[row.at("state").get<std::string>()];
  return counts;
}

using Counts = std::map<std::string, int>;

TEST(Status, FollowsAStudyFromMissingToCompletedAndWritesNothing) {
  const Workplace place;
  place.write("small.json", small_study("small"));
  EXPECT_EQ(states(place, "small.json"), (Counts{{"missing", 3}}));
  EXPECT_FALSE(fs::exists(place.results()));
  EXPECT_EQ(place.run({"status"}).exit_code, 5) << "there is no catalogue";

  ASSERT_EQ(place.run({"small.json"}).exit_code, 0);
  const auto before = everything(place.results());
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 3}}));
  EXPECT_EQ(states(place, "small"), (Counts{{"completed", 2}})) << "by its name, without its bed";
  const Finished overview = place.run({"status", "--format", "csv"});
  EXPECT_THAT(overview.out, HasSubstr("small,2,2,0,0,0,0,0,0"));
  EXPECT_EQ(place.run({"status", "small.json", "--watch"}).exit_code, 0);
  EXPECT_EQ(everything(place.results()), before);

  EXPECT_EQ(place.run({"status", "nobody"}).exit_code, 4);
  EXPECT_EQ(place.run({"status", "missing.json"}).exit_code, 2);
  EXPECT_EQ(place.run({"status", "--watch"}).exit_code, 2);
}

/// The folder of the case with this short id.
fs::path folder_of(const Workplace& place, const std::string& id) {
  for (const auto& entry : fs::directory_iterator(place.results() / "cases")) {
    if (entry.path().filename().string().starts_with(id)) return entry.path();
  }
  return {};
}

TEST(Status, ACaseIsRunningWhileItsClaimIsHeldAndInterruptedAfterwards) {
  const Workplace place;
  const auto ids = place.run_study("small", small_study("small"));
  // A quarter of it was done in half a minute, and somebody is at it: this test.
  const fs::path folder = folder_of(place, ids.back());
  fs::remove(folder / "0001" / "manifest.json");
  std::ofstream(folder / "0001" / "progress.json")
      << R"({"fraction": 0.25, "start_fraction": 0, "elapsed": 30, "threads": 1, "host": "here"})";
  const int claim = ::open((folder / "lock").c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_EQ(::flock(claim, LOCK_EX), 0);
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 2}, {"running", 1}}));
  EXPECT_THAT(place.run({"status", "small"}).out, HasSubstr("25 %, about 1:30 left (1 thread on here)"));

  ::close(claim);
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 2}, {"interrupted", 1}}));
  EXPECT_EQ(place.run({"status", "small", "--watch"}).exit_code, 75);
}

TEST(Status, LookingTakesNoClaim) {
  const Workplace place;
  const auto ids = place.run_study("small", small_study("small"));
  const fs::path folder = folder_of(place, ids.back());
  fs::remove(folder / "0001" / "manifest.json");
  fs::remove(folder / "lock");
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 2}, {"interrupted", 1}}));
  EXPECT_FALSE(fs::exists(folder / "lock"));
}

TEST(Status, AFailureIsToldWithTheLastLinesOfItsLogUntilItIsMadeGood) {
  const Workplace place;
  const auto ids = place.run_study("small", small_study("small"));
  // One run is lost, and a folder stands where its series is to be written.
  const fs::path run = folder_of(place, ids.back()) / "0001";
  fs::remove_all(run);
  fs::create_directories(run / "series.h5" / "in_the_way");
  const Finished failed = place.run({"small.json"});
  EXPECT_EQ(failed.exit_code, 1) << failed.error;
  EXPECT_THAT(failed.error, HasSubstr("| cannot give its name to")) << "the log's last lines stand below the failure";
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 2}, {"failed", 1}}));
  const Finished status = place.run({"status", "small"});
  EXPECT_THAT(status.out, HasSubstr("reading or writing failed"));
  EXPECT_THAT(status.out, HasSubstr("| cannot give its name to"));
  EXPECT_EQ(place.run({"status", "small", "--watch"}).exit_code, 1);

  fs::remove_all(run / "series.h5");
  EXPECT_EQ(place.run({"small.json"}).exit_code, 0);
  EXPECT_EQ(states(place, "small.json"), (Counts{{"completed", 3}}));
  EXPECT_FALSE(fs::exists(run / "failure.json"));
  EXPECT_FALSE(fs::exists(run / "progress.json"));
}

}  // namespace
}  // namespace seapile::commands
