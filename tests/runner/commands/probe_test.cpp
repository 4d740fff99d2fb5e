// `runner probe`: after a change of the numerics, what was computed before is declared as good as new where a
// measurement says so, and stays stale where it does not.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "runner/execute/campaign.h"
#include "runner/store/durable.h"
#include "runner/store/manifest.h"
#include "runner/store/run_folder.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using store::Manifest;
using testing::AllOf;
using testing::HasSubstr;
using testing::SizeIs;

/// A study that was run once; every test has a copy of its results.
struct Probe : testing::Test {
  static void SetUpTestSuite() {
    ran = new Workplace;
    ran->run_study("small", small_study("small"));
  }
  static void TearDownTestSuite() { delete ran; }
  void SetUp() override {
    place.write("small.json", small_study("small"));
    fs::copy(ran->results(), place.results(), fs::copy_options::recursive);
  }

  /// The run folders of a kind.
  std::vector<fs::path> runs(const std::string& kind) const {
    std::vector<fs::path> found;
    for (const fs::path& folder : store::entries(place.results() / "cases")) {
      for (const std::string& run : store::complete_runs(folder)) {
        if (store::read_manifest(folder / run).header.kind == kind) found.push_back(folder / run);
      }
    }
    return found;
  }

  /// Changes what the manifest of a run says, and seals it anew.
  static void rewrite(const fs::path& run, const std::function<void(Manifest&)>& change) {
    Manifest manifest = store::read_manifest(run);
    change(manifest);
    std::ofstream(run / "manifest.json") << store::manifest_text(manifest);
  }
  /// As if the version of the grains had been raised since all runs were made.
  void age() const {
    for (const char* kind : {"bed", "drive"}) {
      for (const fs::path& run : runs(kind)) rewrite(run, [](Manifest& one) { --one.header.numerics.at(0).version; });
    }
  }

  std::vector<json> rows(const std::vector<std::string>& words, int code = 0) const {
    std::vector<std::string> all = words;
    all.insert(all.end(), {"--format", "json"});
    const Finished finished = place.run(all);
    EXPECT_EQ(finished.exit_code, code) << finished.error;
    return json::parse(finished.out).at("rows");
  }
  /// Actions of the plan, by kind.
  std::map<std::string, std::set<std::string>> planned() const {
    std::map<std::string, std::set<std::string>> actions;
    for (const json& row : rows({"plan", "small.json"})) actions[row.at("kind")].insert(row.at("action"));
    return actions;
  }
  /// Asks workers for every case, drives with and without the run of their bed: each decides by itself.
  void let_workers_run() const {
    const study::Study study = study::read(place.folder() / "small.json", {});
    execute::CampaignOptions options;
    options.root = place.results();
    const execute::Campaign campaign(study, options);
    for (const execute::Task& task : campaign.plan().tasks) {
      execute::Request request = execute::request_of(study, task, options);
      EXPECT_EQ(place.run({"exec", "-"}, to_json(request)).exit_code, 0);
      request.bed_run.clear();
      EXPECT_EQ(place.run({"exec", "-"}, to_json(request)).exit_code, 0);
    }
  }
  std::vector<fs::path> declarations() const { return store::entries(place.results() / "equivalents"); }
  /// Whether anything of a probe is left beside the results.
  bool is_tidy() const {
    for (const fs::path& entry : store::entries(place.results())) {
      if (entry.filename().string().starts_with("probe.")) return false;
    }
    return true;
  }

  using Actions = std::map<std::string, std::set<std::string>>;
  static Workplace* ran;
  const Workplace place;
};
Workplace* Probe::ran;

TEST_F(Probe, WhatMovedNothingIsFreshAndNothingIsComputed) {
  age();
  for (const json& row : rows({"plan", "small.json"}))
    EXPECT_THAT(row.at("reason").get<std::string>(), HasSubstr("numerics of grains"));
  const auto before = everything(place.results() / "cases");
  fs::create_directories(place.results() / "probe.a1b2c3" / "cases");  // as of a probe that was killed
  std::ofstream(place.results() / "probe.a1b2c3" / "lock");
  fs::create_directories(place.results() / "probe.mine");  // a user's
  const auto groups = rows({"probe", "small.json"});
  ASSERT_THAT(groups, SizeIs(2));
  for (const json& group : groups) {
    EXPECT_EQ(group.at("verdict"), "equivalent");
    EXPECT_EQ(group.at("distance"), 0);
    EXPECT_EQ(group.at("cases"), group.at("kind") == "bed" ? 1 : 2);
  }
  EXPECT_THAT(declarations(), SizeIs(2));
  EXPECT_TRUE(fs::remove(place.results() / "probe.mine"));
  EXPECT_TRUE(is_tidy());

  for (const json& row : rows({"plan", "small.json"})) {
    EXPECT_EQ(row.at("action"), "fresh");
    EXPECT_THAT(row.at("reason").get<std::string>(),
                AllOf(HasSubstr("equivalent: grains"), HasSubstr("identical to the last bit")));
  }
  const Finished run = place.run({"small.json"});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_THAT(run.error, HasSubstr("nothing to run"));
  for (const json& row : rows({"status", "small.json"})) EXPECT_EQ(row.at("state"), "completed");
  EXPECT_THAT(place.run({"submit", "small.json", "--dry-run"}).error, HasSubstr("every case is fresh"));
  let_workers_run();
  EXPECT_EQ(everything(place.results() / "cases"), before);

  const auto declared = everything(place.results() / "equivalents");
  EXPECT_EQ(place.run({"probe", "small.json"}).exit_code, 4) << "nothing is stale any more";
  EXPECT_EQ(place.run({"gc"}).exit_code, 0);
  EXPECT_EQ(everything(place.results() / "equivalents"), declared);
}

TEST_F(Probe, WhatMovedFurtherThanTheToleranceStaysStaleAndIsNamed) {
  age();
  for (const fs::path& run : runs("drive")) {
    rewrite(run, [](Manifest& one) {
      for (simulation::Metric& metric : one.result.metrics)
        if (metric.name == "tip_resistance_mean") metric.value *= 1.001;
    });
  }
  for (const json& group : rows({"probe", "small.json"}, 3)) {
    EXPECT_EQ(group.at("verdict"), group.at("kind") == "bed" ? "equivalent" : "stale");
    if (group.at("kind") == "bed") continue;
    EXPECT_EQ(group.at("of"), "tip_resistance_mean");
    EXPECT_NEAR(group.at("distance"), 1e-3, 1e-5);
    EXPECT_THAT(group.at("reason").get<std::string>(), HasSubstr("tip_resistance_mean differs by 0.000999"));
  }
  EXPECT_EQ(planned(), (Actions{{"bed", {"fresh"}}, {"drive", {"run"}}}));
  EXPECT_EQ(place.run({"probe", "small.json", "--tolerance", "0.01"}).exit_code, 0);
  for (const json& row : rows({"plan", "small.json"})) {
    if (row.at("kind") == "bed") continue;
    EXPECT_THAT(row.at("reason").get<std::string>(), HasSubstr("within 0.001 (tolerance 0.01)"));
  }
}

TEST_F(Probe, NoToleranceMakesUpForWhatIsMissing) {
  age();
  for (const fs::path& run : runs("drive"))
    rewrite(run, [](Manifest& one) { one.result.metrics.at(2).name = "of_another_name"; });
  for (const json& group : rows({"probe", "small.json", "--tolerance", "1e3"}, 3)) {
    if (group.at("kind") == "bed") continue;
    EXPECT_EQ(group.at("verdict"), "stale");
    EXPECT_THAT(group.at("reason").get<std::string>(), HasSubstr("is a number in one alone"));
  }
  EXPECT_EQ(planned().at("drive"), std::set<std::string>{"run"});
}

TEST_F(Probe, EveryListOfVersionsIsAGroupOfItsOwn) {
  age();
  rewrite(runs("drive").at(0), [](Manifest& one) { --one.header.numerics.at(1).version; });
  const auto groups = rows({"probe", "small.json"});
  ASSERT_THAT(groups, SizeIs(3));
  for (const json& group : groups) EXPECT_EQ(group.at("cases"), 1);
  EXPECT_THAT(declarations(), SizeIs(3));
  EXPECT_EQ(planned(), (Actions{{"bed", {"fresh"}}, {"drive", {"fresh"}}}));
}

TEST_F(Probe, ADamagedDeclarationCountsForNothingAndIsNamedInOneLine) {
  age();
  ASSERT_EQ(place.run({"probe", "small.json"}).exit_code, 0);
  const fs::path file = declarations().at(1);
  ASSERT_THAT(file.filename().string(), HasSubstr("drive"));
  const std::string whole = content(file);
  std::string text = whole;
  std::ofstream(file) << text.replace(text.find("identical"), 9, "identicaL");
  EXPECT_EQ(planned(), (Actions{{"bed", {"fresh"}}, {"drive", {"run"}}}));
  const Finished plan = place.run({"plan", "small.json"});
  EXPECT_EQ(plan.exit_code, 0);
  EXPECT_THAT(plan.error, HasSubstr(file.filename().string()));
  EXPECT_EQ(std::ranges::count(plan.error, '\n'), 1);
  // Measured once more, it is whole again.
  EXPECT_EQ(place.run({"probe", "small.json"}).exit_code, 0);
  EXPECT_THAT(declarations(), SizeIs(2));
  EXPECT_EQ(planned(), (Actions{{"bed", {"fresh"}}, {"drive", {"fresh"}}}));
}

TEST_F(Probe, DeclarationsAreRowsOfTheCatalogueWhichAReindexingMakesAgain) {
  age();
  ASSERT_EQ(place.run({"probe", "small.json"}).exit_code, 0);
  const auto listed = [&] { return rows({"query", "--sql", "select * from equivalence order by kind"}); };
  const auto before = listed();
  ASSERT_THAT(before, SizeIs(2));
  EXPECT_EQ(before[0].at("kind"), "bed");
  EXPECT_EQ(before[1].at("likeness"), "identical");
  const int now = json::parse(before[1].at("numerics_now").get<std::string>()).at("grains");
  EXPECT_EQ(json::parse(before[1].at("numerics_before").get<std::string>()).at("grains"), now - 1);
  EXPECT_EQ(before[1].at("state_before"), before[1].at("state_now"));
  fs::remove(place.results() / "catalogue.sqlite");
  EXPECT_EQ(place.run({"reindex"}).exit_code, 0);
  EXPECT_EQ(listed(), before);
  EXPECT_EQ(place.run({"verify"}).exit_code, 0);

  const fs::path damaged = place.results() / "equivalents" / "damaged.json";
  std::ofstream(damaged) << "{}";
  for (const char* command : {"reindex", "verify"}) {
    const Finished finished = place.run({command});
    EXPECT_EQ(finished.exit_code, 3) << command;
    EXPECT_THAT(finished.out, HasSubstr("damaged.json")) << command;
  }
  EXPECT_EQ(listed(), before);
  // One that is withdrawn is no longer listed.
  fs::remove(damaged);
  fs::remove(declarations().at(0));
  EXPECT_EQ(place.run({"ingest"}).exit_code, 0);
  EXPECT_EQ(listed(), std::vector<json>{before[1]});
}

TEST_F(Probe, ADriveWhoseBedIsGoneCannotBeProbedAndStaysStale) {
  age();
  fs::remove_all(runs("bed").at(0));
  const auto groups = rows({"probe", "small.json"}, 1);
  ASSERT_THAT(groups, SizeIs(1));
  EXPECT_EQ(groups[0].at("verdict"), "failed");
  EXPECT_THAT(groups[0].at("reason").get<std::string>(), HasSubstr("is gone"));
  EXPECT_THAT(declarations(), SizeIs(0));
  EXPECT_TRUE(is_tidy());
}

TEST_F(Probe, AFailedProbeLeavesItsGroupStaleAndTheOthersDeclared) {
  age();
  const fs::path bed = runs("bed").at(0);
  // Another case of that bed is computed on its bits, which are no longer those that were sealed.
  std::string bytes = content(bed / "bed.h5");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  std::ofstream(bed / "bed.h5", std::ios::binary) << bytes;
  for (const json& group : rows({"probe", "small.json"}, 1)) EXPECT_EQ(group.at("verdict"), "failed") << group;
  EXPECT_THAT(declarations(), SizeIs(0));
  EXPECT_EQ(planned(), (Actions{{"bed", {"run"}}, {"drive", {"run"}}}));
  EXPECT_TRUE(is_tidy());
}

TEST_F(Probe, AStoppedProbeIsSeventyFiveAndLeavesNothingBehind) {
  age();
  const pid_t process = place.start({"probe", "small.json", "-j", "1"});
  while (content(place.folder() / "error").find("started") == std::string::npos && ::kill(process, 0) == 0)
    ::usleep(500);
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for(process), 75) << content(place.folder() / "error");
  EXPECT_TRUE(is_tidy());
  EXPECT_LT(declarations().size(), 2u);
}

TEST_F(Probe, BadInputIsTwoAndNothingToProbeIsFour) {
  EXPECT_EQ(place.run({"probe", "small.json"}).exit_code, 4);
  EXPECT_EQ(place.run({"probe", "missing.json"}).exit_code, 2);
  EXPECT_EQ(place.run({"probe"}).exit_code, 2);
  EXPECT_EQ(place.run({"probe", "small.json", "--tolerance", "-1"}).exit_code, 2);
  EXPECT_EQ(place.run({"probe", "small.json", "--tolerance", "nan"}).exit_code, 2);
  const Finished help = place.run({"probe", "--help"});
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_THAT(help.out, HasSubstr("Examples:"));
}

}  // namespace
}  // namespace seapile::commands
