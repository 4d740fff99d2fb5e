// What a study says of the model, and what it makes of a case's name.
#include <gmock/gmock.h>

#include <set>

#include "runner/study/study.h"
#include "tests/runner/study/scratch.h"

namespace seapile::study {
namespace {

using scene::Choice;
using testing::HasSubstr;
using testing::Not;

std::string text_of(const scene::SceneSpec& scene) { return canonical_text(scene, "bed"); }

std::vector<scene::SceneSpec> scenes() {
  scene::SceneSpec drive, wet, basin, jet;
  drive.pile.emplace();
  wet.pile.emplace();
  wet.fluid.emplace();
  basin.basin.emplace();
  jet.jet.emplace();
  return {drive, wet, basin, jet};
}

TEST(ModelText, WhatIsAsNeededIsNoPartOfACase) {
  for (const scene::SceneSpec& scene : scenes()) {
    EXPECT_THAT(text_of(scene), Not(HasSubstr("model")));
    EXPECT_THAT(to_json(scene), Not(HasSubstr("model")));
  }
}

TEST(ModelText, WhatIsForcedIsAnotherCase) {
  for (scene::SceneSpec scene : scenes()) {
    if (!scene.fluid && !is_water(scene)) continue;
    std::set<std::string> texts = {text_of(scene)};
    for (const Choice choice : {Choice::yes, Choice::no}) {
      scene.model.convection = choice;
      texts.insert(text_of(scene));
      EXPECT_THAT(text_of(scene), HasSubstr(choice == Choice::no ? R"("model":{"convection":"no"})"
                                                                 : R"("model":{"convection":"yes"})"));
      EXPECT_EQ(scene_from_json(to_json(scene)), scene);
    }
    EXPECT_EQ(texts.size(), 3u);
  }
}

TEST(ModelText, WhatASceneHasNoChoiceAboutIsNoPartOfIt) {
  for (scene::SceneSpec scene : scenes()) {
    const std::string text = text_of(scene);
    const bool grains = !is_water(scene), dry = grains && !scene.fluid;
    if (grains) {
      scene.model.rotation = scene::Rotation::no;
      EXPECT_THAT(text_of(scene), HasSubstr(R"("model":{"rotation":"no"})"));
      scene.model = {};
    } else {
      scene.model.rotation = scene::Rotation::no;
    }
    if (dry) scene.model.convection = Choice::no;
    if (scene.jet) scene.model.remeshing = Choice::no;
    EXPECT_EQ(text_of(scene), text);
  }
}

using ModelStudy = Scratch;

TEST_F(ModelStudy, ForcesAPartInTheBaseOrAlongAnAxis) {
  const Study one = study(R"("base": {"basin": {}, "model": {"convection": "no"}})");
  EXPECT_EQ(one.cases.at(0).scene.model.convection, Choice::no);
  const Study three = study(R"("base": {"basin": {}}, "axes": {"model.convection": ["as_needed", "yes", "no"]})");
  EXPECT_EQ(three.cases.size(), 3u);
  EXPECT_EQ(three.cases[0].id, study(R"("base": {"basin": {}})").cases[0].id);
}

TEST_F(ModelStudy, AnAxisOverAPartThatTheSceneHasNotIsRefused) {
  try {
    study(R"("base": {"pile": {}}, "axes": {"model.convection": ["yes", "no"]})");
    FAIL();
  } catch (const BadInput& error) {
    EXPECT_THAT(std::string(error.what()), HasSubstr("model.convection is not used where the scene has no such part"));
  }
}

TEST_F(ModelStudy, SoIsAChoiceThatNoCaseHas) {
  for (const char* base :
       {R"({"basin": {}, "model": {"rotation": "no"}})", R"({"pile": {}, "model": {"remeshing": "no"}})"}) {
    try {
      study(R"("base": )" + std::string(base));
      FAIL() << base;
    } catch (const BadInput& error) {
      EXPECT_THAT(std::string(error.what()), HasSubstr("no case of this study has such a part")) << base;
    }
  }
  EXPECT_EQ(study(R"("base": {"pile": {}, "model": {"convection": "no"}}, "axes": {"fluid": [null, {}]})").cases.size(),
            2u);
}

}  // namespace
}  // namespace seapile::study
