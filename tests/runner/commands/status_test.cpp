// `runner status`: what is done, running, failed or missing, by looking alone.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

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

TEST(Status, TellsARunningCaseWithItsShareAndAnInterruptedOneOnceItsRunnerIsGone) {
  const Workplace place;
  // Long enough to be looked at; it is ended below.
  place.write("long.json", small_study("long", R"("fidelity": "reference",)"));
  const pid_t runner = place.start({"long.json", "--checkpoint", "0", "--jobs", "1"});
  Counts seen;
  for (int i = 0; i < 3000 && !seen.contains("running"); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    seen = states(place, "long.json");
    if (seen["completed"] == 3) break;
  }
  EXPECT_EQ(seen["running"], 1);
  EXPECT_THAT(place.run({"status", "long.json"}).out, HasSubstr("running"));
  ::kill(runner, SIGTERM);
  EXPECT_EQ(wait_for(runner), 75);
  Counts after = states(place, "long.json");
  EXPECT_EQ(after["running"], 0);
  EXPECT_LT(after["completed"], 3);
  EXPECT_EQ(place.run({"status", "long.json", "--watch"}).exit_code, 75);
}

/// The folder of the case with this short id.
fs::path folder_of(const Workplace& place, const std::string& id) {
  for (const auto& entry : fs::directory_iterator(place.results() / "cases")) {
    if (entry.path().filename().string().starts_with(id)) return entry.path();
  }
  return {};
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
