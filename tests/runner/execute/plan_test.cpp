#include "runner/execute/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runner/execute/campaign.h"
#include "tests/runner/execute/fake_study.h"

namespace seapile::execute {
namespace {

using fake::FakeDisk;
using fake::kNumerics;
using simulation::Outcome;
using testing::ElementsAre;
using testing::HasSubstr;

struct PlanTest : testing::Test {
  FakeDisk disk;
  Equivalences equivalences;
  study::Study study = fake::make_study({{"flat", "bed"}, {"cone", "bed"}});

  Plan plan(const std::vector<simulation::NumericsVersion>& numerics = kNumerics) {
    return make_plan(
        study, [&](const scene::SceneSpec&) { return numerics; }, disk.look(), equivalences);
  }
  void complete_all() {
    disk.complete_bed("bed");
    disk.complete_drive("flat");
    disk.complete_drive("cone");
  }
};

std::vector<std::string> ids(const Plan& plan) {
  std::vector<std::string> ids;
  for (const Task& task : plan.tasks) ids.push_back(task.id);
  return ids;
}

// Otherwise a dry and a saturated study on the same bed would each make the other's bed out of date.
TEST_F(PlanTest, ABedIsNotAskedForTheNumericsOfTheFluidAboveIt) {
  complete_all();
  study.cases[0].scene.fluid.emplace();
  const Plan all = make_plan(study,
                             [](const scene::SceneSpec& scene) {
                               auto numerics = kNumerics;
                               if (scene.fluid) numerics.push_back({"coupling", 1});
                               return numerics;
                             },
                             disk.look(), {});
  EXPECT_EQ(fake::task(all, "cone").decision.action, Action::fresh);
  EXPECT_EQ(fake::task(all, "bed").decision.action, Action::fresh);
  EXPECT_THAT(fake::task(all, "flat").decision.reason, HasSubstr("coupling none -> 1"));
}

TEST(LabelLine, MembersOfAPartStandAtTheirPaths) {
  EXPECT_EQ(label_line({{"pile.tip", "conical(apex_angle=0.5 rad)"}, {"fluid", "null"}}),
            "pile.tip=conical(apex_angle=0.5 rad), no fluid");
  EXPECT_EQ(label_line({{"fluid", "density=1300 kg/m3"}}), "fluid.density=1300 kg/m3");
  EXPECT_EQ(label_line({{"fluid", "default"}}), "fluid");
}

TEST_F(PlanTest, OnAnEmptyDiskEveryCaseIsRunAndBedsComeFirstAndOnce) {
  study = fake::make_study({{"a", "x"}, {"b", "x"}, {"c", "y"}, {"d", "x"}});
  const Plan all = plan();
  EXPECT_THAT(ids(all), ElementsAre("x", "y", "a", "b", "c", "d"));
  for (const Task& task : all.tasks) {
    EXPECT_EQ(task.decision.action, Action::run);
    EXPECT_EQ(task.decision.reason, "never run");
  }
  EXPECT_EQ(fake::task(all, "c").bed, 1u);
  EXPECT_EQ(fake::task(all, "d").bed, 0u);
}

TEST_F(PlanTest, ABedThatIsACaseOfItsOwnIsNotPlannedTwice) {
  study = fake::make_study({{"bed", "bed"}, {"flat", "bed"}});
  EXPECT_THAT(ids(plan()), ElementsAre("bed", "flat"));
}

TEST_F(PlanTest, WhatIsCompletedWithTodaysNumericsIsFresh) {
  complete_all();
  for (const Task& task : plan().tasks) {
    EXPECT_EQ(task.decision.action, Action::fresh) << task.id;
    EXPECT_THAT(task.decision.reason, HasSubstr("grains 1, pile 1"));
    EXPECT_EQ(task.decision.run, "0001");
  }
}

TEST_F(PlanTest, MovedNumericsRunEverythingAgainAndSaySo) {
  complete_all();
  const Plan moved = plan({{"grains", 2}, {"pile", 1}});
  for (const Task& task : moved.tasks) EXPECT_EQ(task.decision.action, Action::run) << task.id;
  EXPECT_EQ(fake::task(moved, "flat").decision.reason, "numerics of grains 1 -> 2");
  EXPECT_EQ(plan({{"grains", 1}, {"pile", 1}, {"mesh", 1}}).tasks[0].decision.reason, "numerics of mesh none -> 1");
  EXPECT_EQ(plan({{"grains", 1}}).tasks[0].decision.reason, "numerics of pile 1 -> none");
}

/// A declaration that runs of the kind with kNumerics are as good as those with grains 2.
store::Equivalence declaration(const std::string& kind) {
  store::Equivalence one;
  one.kind = kind;
  one.before = kNumerics;
  one.now = {{"grains", 2}, {"pile", 1}};
  one.case_id = std::string(64, 'a');
  one.run = "0001";
  one.likeness = "tolerance";
  one.largest = 3e-9;
  one.tolerance = 1e-6;
  return one;
}

TEST_F(PlanTest, RunsWhoseMovedNumericsAreDeclaredEquivalentAreFreshAndSayWhy) {
  complete_all();
  equivalences = {declaration("bed"), declaration("drive")};
  for (const Task& task : plan({{"pile", 1}, {"grains", 2}}).tasks) {
    EXPECT_EQ(task.decision.action, Action::fresh) << task.id;
    EXPECT_EQ(task.decision.run, "0001");
    EXPECT_EQ(task.decision.reason,
              "equivalent: grains 1 -> 2, probe of case aaaaaaaaaa within 3e-09 (tolerance 1e-06)");
    EXPECT_FALSE(task.outdated);
  }
}

TEST_F(PlanTest, ADriveKeepsTheRunOfABedThatIsEquivalent) {
  complete_all();
  disk.histories.erase("cone");
  equivalences = {declaration("bed"), declaration("drive")};
  const Plan moved = plan({{"grains", 2}, {"pile", 1}});
  EXPECT_EQ(fake::task(moved, "bed").decision.action, Action::fresh);
  EXPECT_EQ(fake::task(moved, "flat").decision.action, Action::fresh);
  EXPECT_EQ(fake::task(moved, "cone").decision.reason, "never run");
}

TEST_F(PlanTest, ADeclarationOfAnotherKindOrOfOtherListsDoesNotCount) {
  complete_all();
  const auto flat_is = [&](auto change) {
    equivalences = {declaration("drive")};
    change(equivalences[0]);
    return fake::task(plan({{"grains", 2}, {"pile", 1}}), "flat").decision.action;
  };
  using store::Equivalence;
  EXPECT_EQ(flat_is([](Equivalence&) {}), Action::fresh);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.kind = "bed"; }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.before[0].version = 0; }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.before.push_back({"coupling", 1}); }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.before.pop_back(); }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.now[1].version = 2; }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.now.push_back({"coupling", 1}); }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { one.now.pop_back(); }), Action::run);
  EXPECT_EQ(flat_is([](Equivalence& one) { std::swap(one.before, one.now); }), Action::run);
}

// Distances add up: what is small twice need not be small together.
TEST_F(PlanTest, ChainsOfDeclarationsAreNotJoined) {
  complete_all();
  equivalences = {declaration("drive"), declaration("drive")};
  equivalences[1].before[0].version = 2;
  equivalences[1].now[0].version = 3;
  EXPECT_EQ(fake::task(plan({{"grains", 3}, {"pile", 1}}), "flat").decision.reason, "numerics of grains 1 -> 3");
}

TEST_F(PlanTest, NoDeclarationMakesADivergedDamagedOrOtherwiseRecordedRunFresh) {
  equivalences = {declaration("bed"), declaration("drive")};
  const auto flat_is = [&](auto change) {
    complete_all();
    change(*disk.histories["flat"].past);
    return fake::task(plan({{"grains", 2}, {"pile", 1}}), "flat").decision.action;
  };
  EXPECT_EQ(flat_is([](PastRun& run) { run.outcome = Outcome::diverged; }), Action::run);
  EXPECT_EQ(flat_is([](PastRun& run) { run.damage = "lost"; }), Action::run);
  EXPECT_EQ(flat_is([](PastRun& run) { run.record->travel = 1; }), Action::run);
  EXPECT_EQ(flat_is([](PastRun& run) { run.bed_run = "0007"; }), Action::run);
}

TEST_F(PlanTest, AnInterruptedRunGoesOnWithTheNumericsItWasBegunWithAlone) {
  disk.complete_bed("bed");
  equivalences = {declaration("bed"), declaration("drive")};
  disk.histories["flat"].interrupted = InterruptedRun{"0001", true, kNumerics, scene::RecordSpec{}, "0001"};
  EXPECT_EQ(fake::task(plan({{"grains", 2}, {"pile", 1}}), "flat").decision.action, Action::run);
}

TEST_F(PlanTest, OnlyWhatIsOtherwiseFreshIsOutdatedByItsNumericsAlone) {
  const std::vector<simulation::NumericsVersion> now = {{"grains", 2}, {"pile", 1}};
  complete_all();
  for (const Task& task : plan(now).tasks) {
    ASSERT_TRUE(task.outdated) << task.id;
    EXPECT_TRUE(store::same_numerics(task.outdated->before, kNumerics));
    EXPECT_TRUE(store::same_numerics(task.outdated->now, now));
  }
  for (const Task& task : plan().tasks) EXPECT_FALSE(task.outdated) << "nothing moved";
  const auto flat_is_outdated = [&](auto change) {
    complete_all();
    change(*disk.histories["flat"].past);
    return fake::task(plan(now), "flat").outdated.has_value();
  };
  EXPECT_FALSE(flat_is_outdated([](PastRun& run) { run.outcome = Outcome::diverged; }));
  EXPECT_FALSE(flat_is_outdated([](PastRun& run) { run.damage = "lost"; }));
  EXPECT_FALSE(flat_is_outdated([](PastRun& run) { run.record->travel = 1; }));
  EXPECT_FALSE(flat_is_outdated([](PastRun& run) { run.bed_run = "0007"; })) << "on another run of its bed";
}

TEST_F(PlanTest, ADivergedRunIsRunAgainWithItsReason) {
  complete_all();
  disk.histories["flat"].past->outcome = Outcome::diverged;
  disk.histories["flat"].past->reason = "a grain left the box";
  const Plan all = plan();
  EXPECT_EQ(fake::task(all, "flat").decision.action, Action::run);
  EXPECT_EQ(fake::task(all, "flat").decision.reason, "last run diverged: a grain left the box");
  EXPECT_EQ(fake::task(all, "cone").decision.action, Action::fresh);
}

TEST_F(PlanTest, ADamagedRunIsNotFresh) {
  complete_all();
  disk.histories["cone"].past->damage = "run 0001 is damaged: series.h5 is missing";
  EXPECT_EQ(fake::task(plan(), "cone").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "cone").decision.reason, "run 0001 is damaged: series.h5 is missing");
}

TEST_F(PlanTest, AMissingFrameIsNamed) {
  complete_all();
  study.record.frames = {0, 0.6, 0.7};
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "flat").decision.reason, "frame at 0.7 m not recorded");
  EXPECT_EQ(fake::task(plan(), "bed").decision.action, Action::fresh);
}

TEST_F(PlanTest, FewerFramesAreCovered) {
  complete_all();
  study.record.frames = {0.6};
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::fresh);
}

TEST_F(PlanTest, AnotherRhythmWindowOrGridIsNotCovered) {
  const scene::RecordSpec have;
  scene::RecordSpec travel = have, window = have, spacing = have;
  travel.travel *= 2;
  window.window *= 2;
  spacing.spacing *= 2;
  EXPECT_EQ(lacking(have, have), "");
  EXPECT_THAT(lacking(have, travel), HasSubstr("travel between records"));
  EXPECT_THAT(lacking(have, window), HasSubstr("window"));
  EXPECT_THAT(lacking(have, spacing), HasSubstr("grid spacing"));
}

TEST_F(PlanTest, ABasinIsFreshWhileItsTimesAreKept) {
  scene::RecordSpec have;
  have.times = {1, 2};
  study = fake::make_study({{"basin", ""}});
  study.cases[0].scene = {};
  study.cases[0].scene.basin.emplace();
  disk.complete_drive("basin", "0001", "");
  disk.histories["basin"].past->record = have;
  study.record = have;
  study.record.travel = 2 * have.travel;
  EXPECT_EQ(plan().tasks.size(), 1u);
  EXPECT_EQ(plan().tasks[0].kind, Kind::flow);
  EXPECT_EQ(plan().tasks[0].decision.action, Action::fresh) << "a basin does not heed the pile's travel";
  study.record.times = {2, 3};
  EXPECT_EQ(plan().tasks[0].decision.reason, "frame at 3 s not recorded");
  study.record = have;
  study.record.interval = 0.5;
  EXPECT_EQ(plan().tasks[0].decision.reason, "interval between records of 0.01 s recorded, 0.5 s asked for");
}

TEST_F(PlanTest, ADriveDoesNotHeedWhatIsRecordedOfABasin) {
  complete_all();
  study.record.interval = 0.5;
  study.record.times = {1};
  for (const Task& task : plan().tasks) EXPECT_EQ(task.decision.action, Action::fresh) << task.decision.reason;
}

InterruptedRun interrupted_run() { return {"0001", true, kNumerics, scene::RecordSpec{}, "0001"}; }

TEST_F(PlanTest, AnInterruptedRunWithACheckpointContinues) {
  disk.complete_bed("bed");
  disk.histories["flat"].interrupted = interrupted_run();
  const Decision decision = fake::task(plan(), "flat").decision;
  EXPECT_EQ(decision.action, Action::resume);
  EXPECT_EQ(decision.run, "0001");
}

TEST_F(PlanTest, WithoutACheckpointTheFolderIsUsedAgain) {
  disk.complete_bed("bed");
  disk.histories["flat"].interrupted = interrupted_run();
  disk.histories["flat"].interrupted->checkpoint = false;
  const Decision decision = fake::task(plan(), "flat").decision;
  EXPECT_EQ(decision.action, Action::run);
  EXPECT_EQ(decision.reason, "interrupted before its first checkpoint");
  EXPECT_EQ(decision.run, "0001");
}

TEST_F(PlanTest, AnInterruptedRunOfOtherNumericsRecordOrBedDoesNotContinue) {
  disk.complete_bed("bed");
  const auto decide_with = [&](auto change) {
    disk.histories["flat"].interrupted = interrupted_run();
    change(*disk.histories["flat"].interrupted);
    return fake::task(plan(), "flat").decision;
  };
  const Decision numerics = decide_with([](InterruptedRun& run) { run.numerics = {{"grains", 0}, {"pile", 1}}; });
  EXPECT_EQ(numerics.action, Action::run);
  EXPECT_EQ(numerics.reason, "interrupted, since then numerics of grains 0 -> 1");
  EXPECT_EQ(numerics.run, "");
  EXPECT_EQ(decide_with([](InterruptedRun& run) { run.record->travel = 1; }).action, Action::run);
  EXPECT_EQ(decide_with([](InterruptedRun& run) { run.bed_run = "0007"; }).action, Action::run);
}

TEST_F(PlanTest, AStaleRunWithANewerInterruptedOneContinuesThatOne) {
  complete_all();
  disk.histories["flat"].past->numerics = {{"grains", 0}, {"pile", 1}};
  disk.histories["flat"].interrupted = interrupted_run();
  disk.histories["flat"].interrupted->run = "0002";
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::resume);
  EXPECT_EQ(fake::task(plan(), "flat").decision.run, "0002");
}

TEST_F(PlanTest, ABedThatWasRunAgainMakesItsDrivesStale) {
  complete_all();
  disk.complete_bed("bed", "0002");
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "flat").decision.reason, "bed newly computed (run 0002)");
}

TEST_F(PlanTest, ALostBedIsNobodysConcernWhileItsDrivesAreFresh) {
  complete_all();
  disk.histories.erase("bed");
  EXPECT_THAT(ids(plan()), ElementsAre("flat", "cone"));
  for (const Task& task : plan().tasks) EXPECT_EQ(task.decision.action, Action::fresh);
}

TEST_F(PlanTest, ALostBedIsComputedForANewDriveAndTheOldDriveStaysFresh) {
  complete_all();
  disk.histories.erase("bed");
  disk.histories.erase("cone");
  EXPECT_EQ(fake::task(plan(), "bed").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "cone").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::fresh);  // the bed will be run 0001 again
}

TEST_F(PlanTest, ADamagedBedThatOneDriveNeedsIsNewToAllOfThem) {
  complete_all();
  disk.histories["bed"].past->damage = "run 0001 is damaged: bed.h5 is missing";
  EXPECT_THAT(ids(plan()), ElementsAre("flat", "cone"));  // nobody needs it
  disk.histories.erase("cone");
  EXPECT_EQ(fake::task(plan(), "bed").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "flat").decision.action, Action::run);
  EXPECT_EQ(fake::task(plan(), "flat").decision.reason, "bed newly computed");
}

TEST_F(PlanTest, AfterThePlanIsCarriedOutASecondPlanRunsNothing) {
  // Whatever was on the disk: carrying out what was decided makes everything fresh.
  complete_all();
  disk.histories["bed"].past->damage = "lost";
  disk.histories.erase("cone");
  for (const Task& task : plan().tasks) {
    const Decision& decision = task.decision;
    if (decision.action == Action::fresh) continue;
    const std::string run = disk.histories[task.id].past ? "0002" : "0001";
    if (task.kind == Kind::bed) {
      disk.complete_bed(task.id, run);
    } else {
      disk.complete_drive(task.id, run, disk.histories["bed"].past->run);
    }
  }
  for (const Task& task : plan().tasks) EXPECT_EQ(task.decision.action, Action::fresh) << task.id;
}

TEST_F(PlanTest, ThreadsAreForCasesWithGrainsEnough) {
  study.cases[0].scene.bed.grains.count = 150;
  study.cases[1].scene.bed.grains.count = 4 * kGrainsPerThread;
  EXPECT_EQ(fake::task(plan(), "flat").most_threads, 1);
  EXPECT_EQ(fake::task(plan(), "cone").most_threads, 4);
}

TEST_F(PlanTest, TheDescriptionNamesCasesOrCountsThem) {
  EXPECT_THAT(describe(plan()), ElementsAre(HasSubstr("bed bed: never run"), HasSubstr("case=flat: never run"),
                                            HasSubstr("case=cone: never run")));
  std::vector<std::pair<std::string, std::string>> many;
  for (int i = 0; i < 50; ++i) many.emplace_back(std::to_string(i), "bed");
  study = fake::make_study(many);
  EXPECT_THAT(describe(plan()), ElementsAre(HasSubstr("51 cases: never run")));
}

// What an edge was found with must be today's as well; a run that diverged is none that would be done again.
TEST(Today, VersionsAreAllThoseOfTheScene) {
  scene::SceneSpec scene;
  scene.pile.emplace();
  std::vector<simulation::NumericsVersion> versions = simulation::numerics_versions(scene);
  EXPECT_TRUE(are_of_today(versions, scene));
  std::ranges::reverse(versions);
  EXPECT_TRUE(are_of_today(versions, scene));
  --versions.back().version;
  EXPECT_FALSE(are_of_today(versions, scene));
  versions.pop_back();
  EXPECT_FALSE(are_of_today(versions, scene));
}

}  // namespace
}  // namespace seapile::execute
