// A study of water, alone or around grains, through the real program.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include "runner/execute/exit_codes.h"
#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"

namespace seapile::execute {

/// With one case, in water.json.
struct WaterJob : testing::Test {
  commands::Workplace place;

  std::filesystem::path run_in(const std::filesystem::path& store) const {
    const study::Study study = study::read(place.folder() / "water.json");
    return store::newest_run(store, study.cases.at(0).id);
  }
  store::Manifest result() const { return store::read_manifest(run_in(place.results())); }

  bool has_checkpoint() const {
    std::error_code changing;
    for (std::filesystem::recursive_directory_iterator entry(place.results(), changing), end; entry != end && !changing;
         entry.increment(changing))
      if (entry->path().filename() == "a.h5") return true;
    return false;
  }

  /// Runs it in one go, and again with a kill after the first checkpoint.
  void expect_the_same_bits_when_killed(const std::string& study) {
    place.write("water.json", study);
    ASSERT_EQ(place.run({"water.json", "--store", "whole"}).exit_code, kDone);
    const store::Manifest expected = store::read_manifest(run_in(place.folder() / "whole"));

    const pid_t runner = place.start({"water.json", "--checkpoint", "0"});
    while (!has_checkpoint() && ::kill(runner, 0) == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    ::kill(runner, SIGKILL);
    commands::wait_for(runner);
    const commands::Finished again = place.run({"water.json"});
    ASSERT_EQ(again.exit_code, kDone) << again.error;
    EXPECT_THAT(again.error, testing::HasSubstr("was interrupted after a checkpoint"));
    const store::Manifest continued = result();
    EXPECT_EQ(continued.provenance.attempts, 2);
    EXPECT_EQ(continued.result.state_hash, expected.result.state_hash);
    EXPECT_EQ(continued.flow_records, expected.flow_records);
    ASSERT_EQ(continued.files.size(), expected.files.size());
    for (std::size_t i = 0; i < expected.files.size(); ++i) {
      EXPECT_EQ(continued.files[i].sha256, expected.files[i].sha256) << expected.files[i].path;
    }
    ASSERT_EQ(continued.result.metrics.size(), expected.result.metrics.size());
    for (std::size_t i = 0; i < expected.result.metrics.size(); ++i) {
      const simulation::Metric &a = continued.result.metrics[i], &b = expected.result.metrics[i];
      EXPECT_EQ(a.name, b.name);
      EXPECT_TRUE(a.value == b.value || (a.value != a.value && b.value != b.value)) << a.name;
    }
  }
};

}  // namespace seapile::execute
