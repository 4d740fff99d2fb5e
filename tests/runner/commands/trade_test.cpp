// A study of variants through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// A wave by four steps, of which one is too long for the thesis' surface.
std::string waves(const std::string& more) {
  return R"({"study": "waves", "question": "What does a step cost?",
    "base": {"basin": {"surface": {"initial": {"cosine": {}}},
      "mesh": {"pattern": {"structured": {"columns": 16, "rows": 4}}}, "time": {"duration": 0.4}}},
    "variants": [{"name": "fine", "set": {"basin.time.step": 0.005}}, {"name": "long", "set": {"basin.time.step": 0.02}},
      {"name": "broken", "set": {"basin.time.step": 0.1, "basin.surface.scheme": "differences"}}],
    "record": {"interval": 0.1})" +
         more + "}";
}

struct TradeCommand : testing::Test {
  static void SetUpTestSuite() {
    place = new Workplace;
    place->write("waves.json", waves(R"(, "frontier": {"reference": "fine", "of": ["highest"]})"));
    place->run({"waves.json"});
  }
  static void TearDownTestSuite() { delete place; }
  static Workplace* place;
};
Workplace* TradeCommand::place;

TEST_F(TradeCommand, ShowsCostAndErrorOfEachVariantAndWhatHasNoResult) {
  const Finished table = place->run({"trade", "waves.json"});
  ASSERT_EQ(table.exit_code, 0) << table.error;
  for (const char* word : {"error:highest", "fine", "long", "cpu", "memory"}) EXPECT_THAT(table.out, HasSubstr(word));
  const Finished csv = place->run({"trade", "waves.json", "--format", "csv"});
  EXPECT_THAT(csv.out, StartsWith("variant,runs[-],asked[-],cpu[s],cost[-],memory[MB],steps[-],error:highest.mean[%]"));
}

TEST_F(TradeCommand, DrawsAWorkPrecisionDiagram) {
  const Finished drawn = place->run({"trade", "waves.json", "-o", "waves.svg"});
  ASSERT_EQ(drawn.exit_code, 0) << drawn.error;
  EXPECT_THAT(content(place->folder() / "waves.svg"), HasSubstr("<svg"));
}

TEST_F(TradeCommand, SaysWhatItCannotDo) {
  place->write("plain.json", waves(""));
  EXPECT_EQ(place->run({"trade", "plain.json"}).exit_code, 2);
  EXPECT_THAT(place->run({"trade", "plain.json"}).error, HasSubstr("has neither \"frontier\" nor \"ablate\""));
  EXPECT_THAT(place->run({"trade", "waves.json", "--of", "lowest"}).error, HasSubstr("it compares highest"));
  place->write("typo.json", waves(R"(, "frontier": {"reference": "fine", "of": ["higest"]})"));
  const Finished typo = place->run({"trade", "typo.json"});
  EXPECT_EQ(typo.exit_code, 2);
  EXPECT_THAT(typo.error, HasSubstr("did you mean \"highest\"?"));
  EXPECT_EQ(place->run({"trade", "waves.json", "--set", "basin.viscosity=7"}).exit_code, 4) << "never run";
}

TEST_F(TradeCommand, AnAblationTellsChanges) {
  place->write("without.json", waves(R"(, "ablate": {"whole": "fine", "of": ["highest"]})"));
  const Finished table = place->run({"trade", "without.json"});
  ASSERT_EQ(table.exit_code, 0) << table.error;
  EXPECT_THAT(table.out, HasSubstr("change:highest"));
}

}  // namespace
}  // namespace seapile::commands
