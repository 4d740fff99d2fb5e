#include "solver/scene/warnings.h"

#include <gmock/gmock.h>

namespace seapile::scene {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Warnings, AWallNearerThanTheThesisIsTold) {
  SceneSpec scene;
  EXPECT_THAT(warnings(scene), IsEmpty()) << "a bed has no pile to be influenced";
  scene.pile.emplace();
  scene.bed.domain.width = 40 * scene.pile->radius;
  EXPECT_THAT(warnings(scene), IsEmpty());
  scene.bed.domain.width = 39.9 * scene.pile->radius;
  EXPECT_THAT(warnings(scene), ElementsAre(HasSubstr("boundary_influence: the walls are 19.9 radii")));
}

}  // namespace
}  // namespace seapile::scene
