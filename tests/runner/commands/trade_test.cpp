// A study of variants through the real program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runner/study/frozen_file.h"
#include "tests/runner/commands/program.h"

namespace seapile::commands {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
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

/// A study of its own, so that the others have no frozen reference.
TEST_F(TradeCommand, AFrozenReferenceStandsForTheRunsAndIsNotChangedByHand) {
  place->write("kept.json", waves(R"(, "frontier": {"reference": "fine", "coarser": "long", "of": ["highest"]})"));
  const std::string measured = place->run({"trade", "kept.json", "--format", "csv"}).out;
  const Finished frozen = place->run({"trade", "kept.json", "--freeze"});
  ASSERT_EQ(frozen.exit_code, 0) << frozen.error;
  EXPECT_THAT(frozen.out, HasSubstr("frozen/waves.csv"));
  const fs::path file = place->folder() / "frozen" / "waves.csv";
  const std::string text = content(file);
  EXPECT_THAT(text, HasSubstr("# own error: highest "));
  EXPECT_THAT(text, HasSubstr("by what separates it from \"long\""));

  const Finished again = place->run({"trade", "kept.json", "--format", "csv"});
  EXPECT_EQ(again.out, measured);
  EXPECT_THAT(again.error, HasSubstr("reference: frozen, 1 runs"));
  EXPECT_THAT(again.error, Not(HasSubstr("another state")));
  EXPECT_THAT(again.error, Not(HasSubstr("frozen with other")));
  const Finished elsewhere = place->run({"trade", "kept.json", "--store", "empty"});
  EXPECT_EQ(elsewhere.exit_code, 4) << "the other variants were never run";
  EXPECT_THAT(elsewhere.out, Not(HasSubstr("fine: 1 of 1 runs have no result")));
  EXPECT_THAT(elsewhere.out, HasSubstr("long: 1 of 1 runs have no result"));

  for (const char* changed : {"--set=basin.viscosity=7", "--fidelity=draft"}) {
    const Finished smaller = place->run({"trade", "kept.json", "--freeze", changed});
    EXPECT_EQ(smaller.exit_code, 2) << changed;
    EXPECT_THAT(smaller.error, HasSubstr("--freeze: keeps the reference of the study as it is written")) << changed;
    EXPECT_EQ(content(file), text) << changed;
  }

  study::Frozen old = *study::read_frozen(file);
  old.made_with.back() = '0';
  place->write("frozen/waves.csv", study::frozen_text("waves", old));
  EXPECT_THAT(place->run({"trade", "kept.json"}).error, HasSubstr("1 of the reference's runs were frozen with other"));

  study::Frozen moved = *study::read_frozen(file);
  moved.runs[0].state_hash = "0123456789abcdef";
  place->write("frozen/waves.csv", study::frozen_text("waves", moved));
  EXPECT_THAT(place->run({"trade", "kept.json"}).error,
              HasSubstr("1 of the reference's runs here end in another state"));

  place->write("frozen/waves.csv", text + "\n");
  const Finished changed = place->run({"trade", "kept.json"});
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_THAT(changed.error, HasSubstr("was changed since it was frozen"));
  fs::remove(file);
}

}  // namespace
}  // namespace seapile::commands
