#include "runner/store/label_text.h"

#include <gtest/gtest.h>

namespace seapile::store {
namespace {

TEST(LabelText, IsByThePathsOfAStudyOrShort) {
  struct Expected {
    const char *path, *value, *text, *short_text;
  };
  for (const auto& [path, value, text, short_text] :
       {Expected{"pile.tip", "flat", "pile.tip=flat", "tip flat"},
        {"fluid", "density=1300 kg/m3", "fluid.density=1300 kg/m3", "fluid density 1300 kg/m3"},
        {"fluid", "depth=2 m, viscosity=0.1 Pa s", "fluid.depth=2 m, viscosity=0.1 Pa s",
         "fluid depth 2 m, viscosity 0.1 Pa s"},
        {"pile", "tip=conical(apex_angle=0.5 rad)", "pile.tip=conical(apex_angle=0.5 rad)",
         "pile tip conical(apex_angle=0.5 rad)"},
        {"pile.tip", "conical(apex_angle=0.5 rad)", "pile.tip=conical(apex_angle=0.5 rad)",
         "tip conical(apex_angle=0.5 rad)"},
        {"fluid", "time.step=0.1 ms", "fluid.time.step=0.1 ms", "fluid time.step 0.1 ms"},
        {"pile.depth", "1 m", "pile.depth=1 m", "depth 1 m"}}) {
    EXPECT_EQ(label_text(path, value), text);
    EXPECT_EQ(short_label_text(path, value), short_text);
  }
}

TEST(LabelText, SaysWhetherAPartIsThere) {
  EXPECT_EQ(label_text("fluid", "null"), "no fluid");
  EXPECT_EQ(label_text("fluid", "default"), "fluid");
  EXPECT_EQ(short_label_text("fluid", "null"), "no fluid");
  EXPECT_EQ(short_label_text("pile.duration", "null"), "no duration");
}

}  // namespace
}  // namespace seapile::store
