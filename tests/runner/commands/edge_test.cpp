// A study that looks for an edge, through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "runner/store/manifest.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kWaves = R"({"study": "edge", "question": "How long may a step be?",
  "base": {"basin": {"surface": {"initial": {"cosine": {}}},
    "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"duration": 2}}},
  "axes": {"basin.surface.scheme": ["galerkin", "conservative"]},
  "edge": {"path": "basin.time.step", "good": "2 ms", "bad": "0.2 s", "within": 0.5,
    "invariants": [{"metric": "highest", "at_most": 6e-4}]},
  "record": {"interval": 0.1}})";

std::ptrdiff_t runs_in(const Workplace& place) {
  std::ptrdiff_t runs = 0;
  for (const auto& one : fs::directory_iterator(place.results() / "cases"))
    runs += std::distance(fs::directory_iterator(one), {});
  return runs;
}

TEST(EdgeStudy, EndsBetweenWhatHoldsAndWhatDoesNotAndTriesNothingTwice) {
  const Workplace place;
  place.write("edge.json", kWaves);
  const Finished first = place.run({"edge.json"});
  ASSERT_EQ(first.exit_code, 0) << first.error;
  EXPECT_THAT(first.out, HasSubstr("galerkin"));
  EXPECT_THAT(first.out, HasSubstr("found"));
  EXPECT_THAT(first.out, HasSubstr("always holds")) << "the surface that is found with the flow";
  EXPECT_THAT(first.error, HasSubstr("convection      built")) << "which parts are built, and why";
  const auto runs = runs_in(place);

  const Finished second = place.run({"edge.json"});
  EXPECT_EQ(second.exit_code, 0) << second.error;
  EXPECT_EQ(second.out, first.out);
  EXPECT_EQ(runs_in(place), runs) << "what diverged is a result";
  // All that was tried belongs to the study.
  EXPECT_THAT(place.run({"query", "edge"}).out, HasSubstr("galerkin"));
  ASSERT_EQ(place.run({"report", "edge.json", "-o", "edge.html"}).exit_code, 0);
  const std::string report = content(place.folder() / "edge.html");
  EXPECT_THAT(report, HasSubstr("\"found\""));
  EXPECT_THAT(report, Not(HasSubstr("\"searching\"")));

  // Numerics that moved ask for all of it again, unless a probe has declared them equivalent.
  for (const auto& one : fs::directory_iterator(place.results() / "cases")) {
    store::Manifest manifest = store::read_manifest(one.path() / "0001");
    --manifest.header.numerics.at(0).version;
    std::ofstream(one.path() / "0001" / "manifest.json") << store::manifest_text(manifest);
  }
  EXPECT_THAT(place.run({"edge.json", "--dry-run"}).error, HasSubstr("numerics of mesh"));
  EXPECT_EQ(place.run({"probe", "edge.json"}).exit_code, 0);
  EXPECT_EQ(place.run({"edge.json"}).out, first.out);
  EXPECT_EQ(runs_in(place), runs);
}

TEST(EdgeStudy, SaysWhenAnInvariantIsOfNoMetric) {
  const Workplace place;
  std::string typo = kWaves;
  typo.replace(typo.find("\"highest\""), 9, "\"higest\"");
  place.write("edge.json", typo);
  const Finished finished = place.run({"edge.json"});
  EXPECT_EQ(finished.exit_code, 2);
  EXPECT_THAT(finished.error, HasSubstr("did you mean \"highest\"?"));
}

}  // namespace
}  // namespace seapile::commands
