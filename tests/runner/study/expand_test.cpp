#include <gmock/gmock.h>

#include <set>

#include "runner/study/sha256.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using testing::ElementsAre;
using testing::Pair;

using Expand = Scratch;

std::vector<std::string> labels(const Study& study) {
  std::vector<std::string> texts;
  for (const Case& one : study.cases) {
    std::string text;
    for (const auto& [path, value] : one.labels) text += (text.empty() ? "" : " ") + path + "=" + value;
    texts.push_back(text);
  }
  return texts;
}

TEST_F(Expand, AStudyWithoutAxesIsOneCase) {
  const Study one = study("");
  EXPECT_EQ(one.name, "test");
  ASSERT_EQ(one.cases.size(), 1u);
  EXPECT_EQ(one.cases[0].scene, scene::SceneSpec{});
  EXPECT_TRUE(one.cases[0].labels.empty());
}

TEST_F(Expand, ABedAloneIsItsOwnCase) {
  const Study one = study("");
  EXPECT_EQ(one.cases[0].id, one.cases[0].bed_id);
  EXPECT_EQ(one.cases[0].canonical, one.cases[0].bed_canonical);
}

TEST_F(Expand, AxesMakeAGridInTheOrderWritten) {
  EXPECT_THAT(labels(study(R"("axes": {"pile.tip": ["flat", "conical"], "pile.depth": ["1 m", 0.5]})")),
              ElementsAre("pile.tip=flat pile.depth=1 m", "pile.tip=flat pile.depth=0.5 m",
                          "pile.tip=conical pile.depth=1 m", "pile.tip=conical pile.depth=0.5 m"));
}

TEST_F(Expand, ZippedArraysAdvanceTogetherAfterTheAxes) {
  EXPECT_THAT(
      labels(study(R"("zip": {"pile.radius": [0.1, 0.2], "pile.depth": [0.5, 0.6]}, "axes": {"bed.seed": [1, 2]})")),
      ElementsAre("bed.seed=1 pile.radius=0.1 m pile.depth=0.5 m", "bed.seed=1 pile.radius=0.2 m pile.depth=0.6 m",
                  "bed.seed=2 pile.radius=0.1 m pile.depth=0.5 m", "bed.seed=2 pile.radius=0.2 m pile.depth=0.6 m"));
}

TEST_F(Expand, ReplicatesAreTheFastestAxisOverTheSeed) {
  const Study seeds = study(R"("replicates": {"seeds": 3}, "axes": {"pile.tip": ["flat", "conical"]})");
  EXPECT_EQ(labels(seeds)[1], "pile.tip=flat bed.seed=2");
  EXPECT_EQ(seeds.cases.size(), 6u);
  EXPECT_EQ(seeds.cases[2].scene.bed.seed, 3u);
  const Study listed = study(R"("replicates": {"seed": [1, 2, 3]}, "axes": {"pile.tip": ["flat", "conical"]})");
  EXPECT_EQ(labels(listed), labels(seeds));
}

TEST_F(Expand, CasesOfOneSeedShareTheirBed) {
  const Study four = study(R"("axes": {"pile.tip": ["flat", "conical"]}, "replicates": {"seeds": 2})");
  EXPECT_EQ(four.cases[0].bed_id, four.cases[2].bed_id);
  EXPECT_EQ(four.cases[1].bed_id, four.cases[3].bed_id);
  EXPECT_NE(four.cases[0].bed_id, four.cases[1].bed_id);
  std::set<std::string> ids;
  for (const Case& one : four.cases) ids.insert(one.id);
  EXPECT_EQ(ids.size(), 4u);
}

TEST_F(Expand, AnAxisValueTakesThePlaceOfTheBase) {
  const Study two = study(R"("base": {"pile": {"depth": 1}}, "axes": {"pile.depth": [0.5, 0.6]})");
  EXPECT_EQ(two.cases[0].scene.pile->depth, 0.5);
  EXPECT_EQ(two.cases[1].scene.pile->depth, 0.6);
}

TEST_F(Expand, APartStandsBeforeWhatIsInItInWhateverOrder) {
  const std::string parts = R"("pile": [{"friction": 0.1}, {"friction": 0.2}])";
  const std::string members = R"("pile.depth": [0.5, 0.6])";
  for (const std::string& axes : {parts + ", " + members, members + ", " + parts}) {
    const Study four = study("\"axes\": {" + axes + "}");
    ASSERT_EQ(four.cases.size(), 4u);
    for (const Case& one : four.cases) EXPECT_NE(one.scene.pile->depth, 1.2);
    EXPECT_NE(four.cases[0].scene.pile->friction, four.cases[3].scene.pile->friction);
  }
}

TEST_F(Expand, AnAxisInsideAnAlternativeKeepsItsOtherMembers) {
  const Study two = study(R"("base": {"pile": {"driving": {"vibratory": {"speed": 0.1}}}},
                             "axes": {"pile.driving.vibratory.frequency": [10, 20]})");
  EXPECT_EQ(two.cases[1].scene.pile->driving, pile::Driving(pile::VibratoryDriving{0.1, 1e-3, 20}));
}

TEST_F(Expand, ANamedAlternativeOpensForItsMembers) {
  const Study two =
      study(R"("base": {"pile": {"tip": "conical"}}, "axes": {"pile.tip.conical.apex_angle": ["30 deg", "90 deg"]})");
  EXPECT_EQ(labels(two)[0], "pile.tip.conical.apex_angle=30 deg");
}

TEST_F(Expand, LabelsOfPartsAreReadable) {
  EXPECT_THAT(labels(study(R"("axes": {"pile.tip": ["flat", "conical", {"conical": {"apex_angle": 0.5}}]})")),
              ElementsAre("pile.tip=flat", "pile.tip=conical", "pile.tip=conical(apex_angle=0.5 rad)"));
  EXPECT_THAT(labels(study(R"("axes": {"pile": [null, {}, {"depth": "50 cm", "tip": "flat"}]})")),
              ElementsAre("pile=null", "pile=default", "pile=depth=50 cm, tip=flat"));
  EXPECT_THAT(labels(study(R"("base": {"pile": {"depth": 1.2}},
                                    "axes": {"fluid": [{"density": 1300, "time": {"step": 5e-4, "order": 2}}, {"mesh": {}}]})")),
              ElementsAre("fluid=density=1300 kg/m3, time.step=0.0005 s, time.order=2", "fluid=mesh=default"));
}

// Of the same axis: what is null is dry, and what is an object has a fluid with these members.
TEST_F(Expand, DryAndSaturatedCasesStandInOneStudy) {
  const Study fluids =
      study(R"("base": {"pile": {}}, "axes": {"fluid": [null, {"density": 1000}, {"density": 1300}]})");
  EXPECT_THAT(labels(fluids), ElementsAre("fluid=null", "fluid=density=1000 kg/m3", "fluid=density=1300 kg/m3"));
  EXPECT_FALSE(fluids.cases[0].scene.fluid);
  ASSERT_TRUE(fluids.cases[2].scene.fluid);
  EXPECT_EQ(fluids.cases[1].scene.fluid, scene::FluidSpec{});
  EXPECT_EQ(fluids.cases[2].scene.fluid->density, 1300);
  EXPECT_EQ(fluids.cases[0].bed_id, fluids.cases[2].bed_id) << "what is poured on a bed changes no bed";

  const Study campaign = study(R"("base": {"pile": {}}, "axes": {"pile.driving.constant.speed": [0.02, 0.06, 0.2],
                                  "pile.tip": ["flat", "conical"], "fluid": [null, {}]})");
  EXPECT_EQ(campaign.cases.size(), 12u);
  EXPECT_EQ(labels(campaign)[1], "pile.driving.constant.speed=0.02 m/s pile.tip=flat fluid=default");
}

TEST_F(Expand, AnAxisInsideTheFluidIsOfTheSaturatedCases) {
  EXPECT_THAT(labels(study(R"("base": {"pile": {}, "fluid": {"depth": "3 m"}},
                              "axes": {"fluid.density": ["1 t/m3", 1300]})")),
              ElementsAre("fluid.density=1 t/m3", "fluid.density=1300 kg/m3"));
  const Study common = study(R"("base": {"pile": {}}, "axes": {"fluid": [null, {}, {"density": 1300}]},
                                "when": [{"if": {"fluid": {}}, "set": {"fluid.depth": "3 m"}}])");
  EXPECT_FALSE(common.cases[0].scene.fluid) << "a condition on the fluid holds where there is one";
  EXPECT_EQ(common.cases[1].scene.fluid->depth, 3);
  EXPECT_EQ(common.cases[2].scene.fluid->depth, 3);
  EXPECT_EQ(common.cases[2].scene.fluid->density, 1300);
}

TEST_F(Expand, ExcludedCasesAreLeftOut) {
  EXPECT_THAT(labels(study(R"("axes": {"pile.tip": ["flat", "conical"], "pile.depth": [0.5, "1 m"]},
                              "exclude": [{"pile.tip": "flat", "pile.depth": "100 cm"}])")),
              ElementsAre("pile.tip=flat pile.depth=0.5 m", "pile.tip=conical pile.depth=0.5 m",
                          "pile.tip=conical pile.depth=1 m"));
}

TEST_F(Expand, AConditionMayNameAnythingTheSceneHolds) {
  const std::string axes = R"("axes": {"pile.tip": ["flat", "conical"], "pile.depth": [0.5, 1]}, "exclude": [)";
  EXPECT_EQ(study(axes + R"({"pile.tip": "conical"}])").cases.size(), 2u);
  EXPECT_EQ(study(axes + R"({"pile.tip": {"conical": {"apex_angle": "60 deg"}}, "pile.depth": 1}])").cases.size(), 3u);
  EXPECT_EQ(study(axes + R"({"pile.tip.conical.apex_angle": "60 deg"}])").cases.size(), 2u);
  EXPECT_EQ(study(axes + R"({"pile.depth": 1, "contact.step": "0.5 ms", "contact.precision": "single"}])").cases.size(),
            2u);
  EXPECT_EQ(study(axes + R"({"pile.depth": 1, "pile.duration": null, "pile": {}}])").cases.size(), 2u);
  EXPECT_EQ(problems(axes + R"({"pile.tip.conical.apex_angle": "61 deg"}])").size(), 1u);
}

TEST_F(Expand, AnExcludedCaseMayBeImpossible) {
  EXPECT_EQ(
      study(R"("axes": {"pile.depth": [0.5, 3], "pile.tip": ["flat", "conical"]}, "exclude": [{"pile.depth": 3}])")
          .cases.size(),
      2u);
  EXPECT_EQ(study(R"("axes": {"pile.tip": ["flat", "conical"], "pile.tip.conical.apex_angle": ["60 deg", 1]},
                      "exclude": [{"pile.tip": "flat"}])")
                .cases.size(),
            2u);
}

TEST_F(Expand, WhenSetsWhereItsConditionHolds) {
  const Study two = study(R"("axes": {"pile.tip": ["flat", "conical"]},
      "when": [{"if": {"pile.tip": "conical"}, "set": {"pile.tip.conical.apex_angle": "45 deg", "pile.depth": 0.5}}])");
  EXPECT_EQ(two.cases[0].scene.pile->depth, 1.2);
  EXPECT_EQ(two.cases[1].scene.pile->depth, 0.5);
  EXPECT_NE(two.cases[1].scene.pile->tip, pile::Tip(pile::ConicalTip{}));
}

TEST_F(Expand, ExcludeSeesWhatWhenHasSet) {
  EXPECT_EQ(study(R"("axes": {"pile.tip": ["flat", "conical"]},
      "when": [{"if": {"pile.tip": "conical"}, "set": {"pile.depth": 0.5}}], "exclude": [{"pile.depth": 0.5}])")
                .cases.size(),
            1u);
}

TEST_F(Expand, FidelityFillsTheFluidOfSaturatedCasesAndMakesNone) {
  const auto cases = [&](const std::string& level) {
    return study(R"("base": {"pile": {}}, "axes": {"fluid": [null, {}]}, "fidelity": ")" + level + R"(")").cases;
  };
  EXPECT_FALSE(cases("thesis")[0].scene.fluid.has_value());
  const scene::FluidSpec thesis = *cases("thesis")[1].scene.fluid;
  EXPECT_EQ(thesis.time.step, 1e-4);
  EXPECT_EQ(thesis.coupling.drag.porosity, coupling::DragPorosity::plane);
  EXPECT_EQ(thesis.coupling.porosity.kernel, coupling::Kernel::hat);
  EXPECT_EQ(cases("draft")[1].scene.fluid->time.step, 8e-3);
  EXPECT_EQ(cases("reference")[1].scene.fluid->time.step, 5e-4);
  EXPECT_EQ(*cases("standard")[1].scene.fluid, scene::FluidSpec{}) << "what is usual";
}

TEST_F(Expand, FidelityFillsTheContactSolverOfTheDrive) {
  const auto contact = [&](const std::string& members) {
    return study("\"base\": {\"pile\": {}}, " + members).cases[0].scene.contact;
  };
  EXPECT_EQ(contact(R"("fidelity": "standard")"), grains::ContactSpec{});
  EXPECT_EQ(contact(R"("fidelity": "draft")").step, 4e-3);
  const grains::ContactSpec reference = contact(R"("fidelity": "reference")");
  EXPECT_EQ(reference.step, 5e-4);
  EXPECT_EQ(reference.substeps, 20);
  EXPECT_EQ(reference.precision, grains::Precision::double_);
  const grains::ContactSpec thesis = contact(R"("fidelity": "thesis")");
  EXPECT_EQ(thesis.step, 1e-4);
  EXPECT_EQ(thesis.method, grains::Method{grains::NonSmoothMethod{}});
  EXPECT_EQ(thesis.precision, grains::Precision::double_);
  EXPECT_EQ(study(R"("base": {"pile": {}}, "fidelity": "reference")").cases[0].bed_id,
            study(R"("base": {"pile": {}})").cases[0].bed_id);
}

TEST_F(Expand, WhatTheStudySaysItselfStandsAboveItsFidelity) {
  const auto base =
      study(R"("base": {"pile": {}, "contact": {"substeps": 7}}, "fidelity": "reference")").cases[0].scene.contact;
  EXPECT_EQ(base.substeps, 7);
  EXPECT_EQ(base.precision, grains::Precision::double_);
  const Study axis = study(R"("axes": {"contact.substeps": [7, 8]}, "base": {"pile": {}}, "fidelity": "draft")");
  EXPECT_EQ(axis.cases[1].scene.contact.substeps, 8);
}

TEST_F(Expand, ABasinIsACaseWithoutABed) {
  const Study two =
      study(R"("axes": {"basin.depth": ["25 cm", 0.5]}, "record": {"interval": "20 ms", "times": [0.5]})");
  ASSERT_EQ(two.cases.size(), 2u);
  EXPECT_EQ(two.cases[0].bed_id, "");
  EXPECT_EQ(two.cases[0].scene.basin, basin::BasinSpec{});
  EXPECT_EQ(two.cases[1].scene.basin->depth, 0.5);
  EXPECT_THAT(two.cases[1].labels, ElementsAre(std::pair<std::string, std::string>("basin.depth", "0.5 m")));
  EXPECT_THAT(two.record.times, ElementsAre(0.5));
  EXPECT_EQ(two.record.interval, 0.02);
}

TEST_F(Expand, FidelityOfABasinIsItsStepOrTheSchemeOfTheThesis) {
  const auto basin = [&](const std::string& members) { return *study(members).cases[0].scene.basin; };
  EXPECT_EQ(basin(R"("base": {"basin": {}}, "fidelity": "standard")"), basin::BasinSpec{});
  basin::BasinSpec draft, fine, thesis;
  draft.time.step = 2e-3;
  fine.time.step = 5e-4;
  thesis.time.order = 1;
  thesis.time.iterated = false;
  thesis.surface->scheme = basin::SurfaceScheme::galerkin;
  EXPECT_EQ(basin(R"("base": {"basin": {}}, "fidelity": "draft")"), draft);
  EXPECT_EQ(basin(R"("base": {"basin": {}}, "fidelity": "reference")"), fine);
  EXPECT_EQ(basin(R"("base": {"basin": {}}, "fidelity": "thesis")"), thesis);
  thesis.surface.reset();
  EXPECT_EQ(basin(R"("base": {"basin": {"surface": null}}, "fidelity": "thesis")"), thesis);
  draft.time.step = 1e-2;
  EXPECT_EQ(basin(R"("base": {"basin": {"time": {"step": 0.01}}}, "fidelity": "draft")"), draft);
}

TEST_F(Expand, ATimeThatOneBasinReachesIsFine) {
  EXPECT_THAT(study(R"("axes": {"basin.time.duration": [1, 3]}, "record": {"times": [2]})").record.times,
              ElementsAre(2));
}

TEST_F(Expand, AnIdDependsOnTheSceneAndNotOnHowItIsSaid) {
  const std::string one = study(R"("base": {"pile": {"depth": 1.2, "tip": "conical"}, "fluid": null})").cases[0].id;
  EXPECT_EQ(study(R"("base": {"pile": {}})").cases[0].id, one);
  EXPECT_EQ(study(R"("base": {"pile": {"tip": {"conical": {"apex_angle": "60 deg"}}, "depth": "120 cm"}})").cases[0].id,
            one);
  EXPECT_EQ(study(R"("axes": {"pile.depth": [1, "1.2 m"]})").cases[1].id, one);
  EXPECT_EQ(study(R"("base": {"pile": {}}, "fidelity": "standard")").cases[0].id, one);
  EXPECT_EQ(
      study(R"("base": {"pile": {}}, "question": "Why?", "record": {"travel": "1 mm", "frames": []})").cases[0].id,
      one);
}

TEST_F(Expand, DefaultFramesAreThoseThatACaseReaches) {
  EXPECT_THAT(study(R"("base": {"pile": {"depth": 0.5}})").record.frames, ElementsAre(0, 0.2));
  EXPECT_THAT(study(R"("axes": {"pile.depth": [0.3, 0.9]})").record.frames, ElementsAre(0, 0.2, 0.6));
  EXPECT_THAT(study(R"("base": {"pile": {"depth": null, "duration": "5 s"}})").record.frames, ElementsAre(0, 0.2));
  EXPECT_THAT(study(R"("base": {"pile": {}})").record.frames, ElementsAre(0, 0.2, 0.6, 1.2));
}

TEST_F(Expand, AFrameThatOneCaseReachesIsFine) {
  EXPECT_THAT(study(R"("axes": {"pile.depth": [0.3, 0.9]}, "record": {"frames": [0.8]})").record.frames,
              ElementsAre(0.8));
}

TEST_F(Expand, TenThousandCasesAreTheMost) {
  EXPECT_EQ(study(R"("replicates": {"seeds": 10000})").cases.size(), 10'000u);
  EXPECT_EQ(problems(R"("replicates": {"seeds": 5001}, "axes": {"pile.tip": ["flat", "conical"]})").size(), 1u);
}

TEST_F(Expand, TheFilesHashIsOfTheBytesThatWereRead) {
  const auto file = write("x.json", R"({"study": "x"} )");
  EXPECT_EQ(read(file).file_sha256, sha256(R"({"study": "x"} )"));
}

Study shipped(const std::string& name) { return read(SEAPILE_SOURCE_DIR "/studies/" + name + ".json"); }

TEST(Studies, TipShapeIsTheTwoTipsDryAndThenSaturatedOnOneBed) {
  const Study tips = shipped("tip_shape");
  EXPECT_EQ(tips.name, "tip_shape");
  EXPECT_FALSE(tips.question.empty());
  ASSERT_EQ(tips.cases.size(), 4u);
  for (std::size_t k = 0; k < tips.cases.size(); ++k) {
    const Case& one = tips.cases[k];
    EXPECT_EQ(one.scene.fluid.has_value(), k >= 2);
    EXPECT_EQ(std::holds_alternative<pile::FlatTip>(one.scene.pile->tip), k % 2 == 1);
    EXPECT_EQ(one.scene.pile->driving, pile::Driving(pile::ConstantDriving{0.06}));
    EXPECT_EQ(one.scene.pile->depth, 1.2);
    EXPECT_EQ(one.bed_id, tips.cases[0].bed_id);
  }
}

TEST(Studies, VelocityIsThreeSpeedsOnTheBedOfTipShape) {
  const Study speeds = shipped("velocity"), tips = shipped("tip_shape");
  ASSERT_EQ(speeds.cases.size(), 6u);
  EXPECT_THAT(speeds.cases[2].labels,
              ElementsAre(Pair("fluid", "null"), Pair("pile.driving.constant.speed", "0.4 m/s")));
  EXPECT_EQ(speeds.cases[0].id, tips.cases[0].id) << "one case belongs to both studies";
  EXPECT_EQ(speeds.cases[3].id, tips.cases[2].id);
  EXPECT_EQ(speeds.cases[2].bed_id, tips.cases[0].bed_id);
}

TEST(Studies, TheCampaignSharesEveryCaseWithTheOthers) {
  std::set<std::string> campaign;
  for (const Case& one : shipped("campaign").cases) campaign.insert(one.id);
  EXPECT_EQ(campaign.size(), 12u);
  for (const char* name : {"tip_shape", "velocity"})
    for (const Case& one : shipped(name).cases) EXPECT_TRUE(campaign.contains(one.id)) << name;
  const Study fluid = shipped("fluid");
  ASSERT_EQ(fluid.cases.size(), 3u);
  EXPECT_TRUE(campaign.contains(fluid.cases[0].id) && campaign.contains(fluid.cases[1].id));
  EXPECT_TRUE(campaign.contains(shipped("surface").cases[0].id)) << "a free surface is what is usual";
}

TEST(Studies, ChapterSixIsTheNineCasesOfItsThreeStudies) {
  const auto ids = [](std::initializer_list<const char*> names) {
    std::set<std::string> found;
    for (const char* name : names)
      for (const Case& one : shipped(name).cases) found.insert(one.id);
    return found;
  };
  const std::set<std::string> nine = ids({"chapter_6"});
  EXPECT_EQ(nine.size(), 9u);
  EXPECT_EQ(nine, ids({"velocity", "tip_shape", "fluid"}));
  for (const Case& one : shipped("chapter_6_fine").cases) {
    EXPECT_EQ(one.scene.contact.step, 1e-4);
    if (one.scene.fluid) {
      EXPECT_EQ(one.scene.fluid->time.step, 1e-4);
    }
  }
}

TEST(Studies, OfChapterSixAreAllAtItsSize) {
  for (const char* name :
       {"tip_shape", "velocity", "fluid", "campaign", "surface", "vibratory", "chapter_6", "chapter_6_fine"})
    for (const Case& one : shipped(name).cases) {
      EXPECT_EQ(one.scene.bed.grains.count, 11596) << name;
      EXPECT_EQ(one.scene.bed.domain.width, 5) << name;
      if (one.scene.fluid) {
        EXPECT_EQ(one.scene.fluid->depth, 4) << name;
      }
    }
  EXPECT_EQ(shipped("domain").cases.size(), 9u);
  EXPECT_EQ(shipped("coupling").cases.size(), 33u);
}

TEST(Studies, DensityComparesSpeedsOnTheSameEightBedsOfEachDensity) {
  const Study density = read(SEAPILE_SOURCE_DIR "/studies/density.json");
  ASSERT_EQ(density.cases.size(), 5u * 2 * 8);
  std::set<std::string> beds;
  for (std::size_t i = 0; i < density.cases.size(); i += 16) {
    for (std::size_t seed = 0; seed < 8; ++seed) {
      const Case &slow = density.cases[i + seed], &fast = density.cases[i + 8 + seed];
      EXPECT_EQ(slow.scene.pile->driving, pile::Driving(pile::ConstantDriving{0.06}));
      EXPECT_EQ(fast.scene.pile->driving, pile::Driving(pile::ConstantDriving{0.4}));
      EXPECT_EQ(slow.bed_id, fast.bed_id);
      beds.insert(slow.bed_id);
    }
  }
  EXPECT_EQ(beds.size(), 40u);
}

}  // namespace
}  // namespace seapile::study
