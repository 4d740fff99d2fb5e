#include "runner/study/nearest.h"

#include <gtest/gtest.h>

namespace seapile::study {
namespace {

TEST(EditDistance, CountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("radius", "radius"), 0u);
  EXPECT_EQ(edit_distance("raduis", "radius"), 1u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);
  EXPECT_EQ(edit_distance("depth", "dept"), 1u);
}

TEST(EditDistance, IsTheSameBothWays) {
  EXPECT_EQ(edit_distance("viscosty", "viscosity"), edit_distance("viscosity", "viscosty"));
  EXPECT_EQ(edit_distance("abcd", "badc"), edit_distance("badc", "abcd"));
}

TEST(Nearest, IsTheCandidateWithTheFewestEdits) {
  const std::vector<std::string> keys = {"radius", "friction", "tip", "driving", "depth", "duration"};
  EXPECT_EQ(nearest("raduis", keys), "radius");
  EXPECT_EQ(nearest("Depth", keys), "depth");
  EXPECT_EQ(nearest("dration", keys), "duration");
  EXPECT_EQ(nearest("tpi", keys), "tip");
}

TEST(Nearest, IsNothingWhenNothingIsNear) {
  const std::vector<std::string> keys = {"radius", "tip"};
  EXPECT_EQ(nearest("viscosity", keys), "");
  EXPECT_EQ(nearest("x", keys), "");
  EXPECT_EQ(nearest("", keys), "");
  EXPECT_EQ(nearest("radius", {}), "");
  EXPECT_EQ(nearest(std::string(1'000'000, 'r'), keys), "");
}

}  // namespace
}  // namespace seapile::study
