// A run that diverges on a disk without room for the state that it died of.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "runner/store/run_folder.h"
#include "runner/study/study.h"
#include "tests/runner/commands/program.h"

namespace seapile::store::fault {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Lets every write to files whose paths begin like this fail while it exists; `reached` is made at the first.
class NoRoom {
 public:
  NoRoom(const fs::path& files, const fs::path& reached) {
    ::setenv("FAULT_ROOT", files.c_str(), 1);
    ::setenv("FAULT_MARK", reached.c_str(), 1);
    ::setenv("FAULT_MODE", "full", 1);
    ::setenv("FAULT_AT", "1", 1);
    ::setenv("ASAN_OPTIONS", "verify_asan_link_order=0", 1);
    ::setenv("LD_PRELOAD", SEAPILE_STORE_SHIM, 1);
  }
  ~NoRoom() {
    for (const char* name : {"LD_PRELOAD", "ASAN_OPTIONS", "FAULT_AT", "FAULT_MODE", "FAULT_MARK", "FAULT_ROOT"})
      ::unsetenv(name);
  }
  NoRoom(const NoRoom&) = delete;
  NoRoom& operator=(const NoRoom&) = delete;
};

bool is_kept(const Manifest& manifest) {
  return std::ranges::any_of(manifest.files, [](const auto& file) { return file.path == "post_mortem.h5"; });
}

TEST(PostMortem, WhatCannotBeKeptIsToldAndCostsTheRunNothingElse) {
  const commands::Workplace place;
  const study::Study study = study::read(place.write("steep.json", R"({"study": "steep", "record": {"interval": 0.05},
    "base": {"basin": {"surface": {"scheme": "galerkin", "initial": {"cosine": {"amplitude": 0.1}}},
      "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"step": 0.05, "duration": 20}}}})"));
  const std::string id = study.cases.at(0).id;
  const commands::Finished whole = place.run({"steep.json", "--store", "whole"});
  const fs::path kept = newest_run(place.folder() / "whole", id);
  ASSERT_TRUE(is_kept(read_manifest(kept)));

  const fs::path reached = place.folder() / "reached";
  const fs::path run = case_folder(place.results(), id) / kept.filename();
  commands::Finished finished;
  {
    const NoRoom fault(run / ".post_mortem", reached);  // what it is called until it is sealed
    finished = place.run({"steep.json"});
  }
  ASSERT_TRUE(fs::exists(reached));
  EXPECT_EQ(finished.exit_code, whole.exit_code);
  EXPECT_THAT(finished.error, HasSubstr("diverged"));
  EXPECT_THAT(commands::content(run / "log.txt"), HasSubstr("the rejected state is not kept: "));
  EXPECT_TRUE(verify(run).empty());
  const Manifest with = read_manifest(kept), without = read_manifest(run);
  EXPECT_FALSE(is_kept(without));
  for (const auto& entry : fs::directory_iterator(run))
    EXPECT_THAT(entry.path().filename().string(), testing::Not(HasSubstr("post_mortem")));
  EXPECT_EQ(without.result.reason, with.result.reason);
  EXPECT_EQ(without.result.state_hash, with.result.state_hash);
}

}  // namespace
}  // namespace seapile::store::fault
