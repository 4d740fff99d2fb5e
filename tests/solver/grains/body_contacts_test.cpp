#include "solver/grains/body_contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

constexpr std::int32_t kTip = 0, kSleeve = 1;

/// A pile's outline: tip of height h (0: flat) under a sleeve of half-width 1, from the top left round to the top
/// right.
RigidBody body_with_tip(double h) {
  RigidBody body;
  body.outline = {{{-1, 10}, {-1, h}, kSleeve}};
  if (h > 0) {
    body.outline.push_back({{-1, h}, {0, 0}, kTip});
    body.outline.push_back({{0, 0}, {1, h}, kTip});
  } else {
    body.outline.push_back({{-1, 0}, {1, 0}, kTip});
  }
  body.outline.push_back({{1, h}, {1, 10}, kSleeve});
  return body;
}

/// Distance to the outline by sampling every edge, 2 ulp apart at the ends.
double distance_by_sampling(const RigidBody& body, base::Vec2 p) {
  double nearest = 1e9;
  for (const base::Segment& edge : body.outline)
    for (int k = 0; k <= 20'000; ++k)
      nearest = std::min(nearest, norm(edge.from + (k / 20'000.0) * (edge.to - edge.from) - (p - body.position)));
  return nearest;
}

bool inside(const RigidBody& body, base::Vec2 centre) {
  const base::Vec2 p = centre - body.position;
  return std::all_of(body.outline.begin(), body.outline.end(), [&](const base::Segment& edge) {
    const base::Vec2 along = edge.to - edge.from, to_p = p - edge.from;
    return along.x * to_p.y - along.y * to_p.x > 0;
  });
}

// Samples stand at most 10/20000 m apart: the distance is missed by less than (2.5e-4)^2 / (2 d), and never by more
// than half the spacing.
TEST(NearestPlace, IsTheNearestOfTheOutline) {
  for (const double h : {0.0, 0.5, 1.7, 5.0}) {
    RigidBody body = body_with_tip(h);
    body.position = {0.3, -2};
    for (std::uint64_t k = 0; k < 200; ++k) {
      const base::Vec2 p = body.position + base::Vec2{base::uniform(-2.5, 2.5, 1, 0, k), base::uniform(-2, 8, 1, 1, k)};
      const NearestPlace place = nearest_place(body, p);
      EXPECT_EQ(place.distance < 0, inside(body, p));
      EXPECT_NEAR(std::abs(place.distance), distance_by_sampling(body, p), 2.5e-4);
      EXPECT_NEAR(std::hypot(place.nx, place.ny), 1, 1e-14);
      // Walking the distance along the normal leads to the outline.
      const base::Vec2 foot = p + place.distance * base::Vec2{place.nx, place.ny};
      EXPECT_NEAR(std::abs(nearest_place(body, foot).distance), 0, 1e-13);
    }
  }
}

TEST(NearestPlace, NormalsPointIntoTheBodyFromBothSidesOfItsOutline) {
  const RigidBody body = body_with_tip(0);
  for (const double depth : {-1e-3, 1e-3}) {
    const NearestPlace left = nearest_place(body, {-1 + depth, 5}), face = nearest_place(body, {0.2, depth});
    EXPECT_NEAR(left.distance, -depth, 1e-15);
    EXPECT_EQ(left.nx, 1);
    EXPECT_EQ(left.feature, kSleeve);
    EXPECT_NEAR(face.distance, -depth, 1e-15);
    EXPECT_EQ(face.ny, 1);
    EXPECT_EQ(face.feature, kTip);
  }
}

TEST(NearestPlace, ACornerBetweenTipAndSleeveBelongsToTheTip) {
  for (const double h : {0.0, 1.7}) {
    const RigidBody body = body_with_tip(h);
    for (const double side : {-1.0, 1.0}) {
      // Straight out from the corner, between the normals of both edges.
      const base::Vec2 out = h > 0 ? base::Vec2{side * 0.9, -0.2} : base::Vec2{side, -1};
      const NearestPlace place = nearest_place(body, base::Vec2{side, h} + 0.1 * out);
      EXPECT_NEAR(place.distance, 0.1 * norm(out), 1e-14);
      EXPECT_EQ(place.feature, kTip);
      EXPECT_NEAR(place.nx, -out.x / norm(out), 1e-13);
    }
  }
}

TEST(NearestPlace, ACentreOnTheOutlineHasANormal) {
  for (const double h : {0.0, 1.7}) {
    const RigidBody body = body_with_tip(h);
    for (const base::Vec2 p : {base::Vec2{0, 0}, base::Vec2{-1, h}, base::Vec2{1, h}, base::Vec2{1, 4}}) {
      const NearestPlace place = nearest_place(body, p);
      EXPECT_EQ(place.distance, 0);
      EXPECT_NEAR(std::hypot(place.nx, place.ny), 1, 1e-14) << p.x << ", " << p.y;
    }
  }
}

// A cone of 180 degrees is a flat tip: h = 1/tan(pi/2) is 6e-17.
TEST(NearestPlace, ABluntConeIsAFlatTip) {
  const RigidBody blunt = body_with_tip(1 / std::tan(std::numbers::pi / 2)), flat = body_with_tip(0);
  for (std::uint64_t k = 0; k < 200; ++k) {
    const base::Vec2 p{base::uniform(-2, 2, 2, 0, k), base::uniform(-1, 2, 2, 1, k)};
    const NearestPlace a = nearest_place(blunt, p), b = nearest_place(flat, p);
    EXPECT_NEAR(a.distance, b.distance, 1e-15);
    EXPECT_NEAR(a.nx, b.nx, 1e-13);
    EXPECT_EQ(a.feature, b.feature);
  }
}

TEST(BodyContacts, AreListedOncePerGrainByRisingGrainAndKeepTheirImpulses) {
  RigidBody body = body_with_tip(1.7);
  std::vector<Disc> discs;
  for (std::uint64_t k = 0; k < 200; ++k)
    discs.push_back({base::uniform(-2, 2, 3, 0, k), base::uniform(-1, 4, 3, 1, k), 0.1, 0});
  Grains grains = support::grains_from(discs);
  const auto near = [&](std::size_t i) {
    return nearest_place(body, {grains.disc[i].x, grains.disc[i].y}).distance - 0.1 < 0.05;
  };
  list_body_contacts(body, grains, 0.05);
  for (BodyContact& c : body.contact) c.pn = c.grain + 1, c.pt = -c.grain;
  const std::vector<BodyContact> old = body.contact;

  body.position = {0.3, -0.5};
  body.listed_travel = 0.6;
  list_body_contacts(body, grains, 0.05);
  EXPECT_EQ(body.listed_travel, 0);
  std::size_t next = 0, kept = 0;
  for (std::size_t i = 0; i < grains.count(); ++i) {
    if (!near(i)) continue;
    ASSERT_LT(next, body.contact.size());
    const BodyContact& c = body.contact[next++];
    EXPECT_EQ(c.grain, static_cast<std::int32_t>(i));
    const bool known = std::any_of(old.begin(), old.end(), [&](const BodyContact& o) { return o.grain == c.grain; });
    kept += known;
    EXPECT_EQ(c.pn, known ? c.grain + 1 : 0);
    EXPECT_EQ(c.pt, known ? -c.grain : 0);
  }
  EXPECT_EQ(next, body.contact.size());
  EXPECT_GT(kept, 0u);
  EXPECT_LT(kept, next);
}

/// A frictionless grain that moves along a fixed body without gravity.
ContactScene<double> slider(const RigidBody& body, base::Vec2 place, base::Vec2 velocity) {
  ContactScene<double> scene({{place.x, place.y, 0.1, 0}});
  scene.box = {-support::kFar, support::kFar, -support::kFar};
  scene.law.gravity = 0;
  scene.body = body;
  scene.set_velocity(0, velocity);
  return scene;
}

// Passing a corner of a convex body, a grain can only lose touch: its velocity keeps every bit.
TEST(BodyContacts, AGrainSlidesPastTheCornerOfConeAndSleeveWithoutASnag) {
  const double h = std::sqrt(3.0);  // 60 degrees
  // Up along the cone and beyond the corner, touching; down along the sleeve and beyond.
  const base::Vec2 along{0.5, std::sqrt(3.0) / 2}, out{std::sqrt(3.0) / 2, -0.5};
  auto up = slider(body_with_tip(h), 0.5 * base::Vec2{1, h} + 0.1 * out, along);
  auto down = slider(body_with_tip(h), {1.1, h + 0.3}, {0, -1});
  double up_error = 0, down_error = 0;
  for (int k = 0; k < 4000; ++k) {
    up.step();
    down.step();
    up_error = std::max(up_error, norm(up.velocity(0) - along));
    down_error = std::max(down_error, norm(down.velocity(0) - base::Vec2{0, -1}));
  }
  EXPECT_GT(up.disc(0).y, h + 0.5);
  EXPECT_LT(down.disc(0).y, h - 0.5);
  // Rounding of the first place leaves an overlap of some 1e-16 m, which is pushed apart at up to 1e3 per second.
  EXPECT_LT(up_error, 1e-12);
  EXPECT_LT(down_error, 1e-12);
}

// The seam of two collinear edges is no obstacle either.
TEST(BodyContacts, AGrainSlidesAcrossASeamWithoutASnag) {
  RigidBody body;
  body.outline = {
      {{-1, 10}, {-1, 4}, kSleeve}, {{-1, 4}, {-1, 0}, kSleeve}, {{-1, 0}, {1, 0}, kTip}, {{1, 0}, {1, 10}, kSleeve}};
  auto scene = slider(body, {-1.1, 4.5}, {0, -1});
  scene.run(1);
  EXPECT_LT(norm(scene.velocity(0) - base::Vec2{0, -1}), 1e-12);
  EXPECT_NEAR(scene.disc(0).y, 3.5, 1e-12);
}

// A flat face that comes down on one grain is felt by the tip alone, a sleeve that a grain is pressed against by the
// sleeve alone, as the body's share of the action.
TEST(BodyContacts, ForcesBelongToTheFeatureThatIsTouched) {
  auto scene = slider(body_with_tip(0), {0.3, -0.11}, {0, 0});
  scene.box.base = -0.21;
  scene.body_speed = 0.05;
  scene.run(0.1);
  EXPECT_EQ(scene.totals.feature[kTip].y, 0);
  scene.run(0.2);
  EXPECT_GT(scene.totals.feature[kTip].y, 0);
  EXPECT_EQ(scene.totals.feature[kSleeve].x, 0);
  EXPECT_EQ(scene.totals.feature[kSleeve].y, 0);

  auto side = slider(body_with_tip(0), {1.2, 5}, {-0.5, 0});
  side.run(0.5);
  const double momentum = side.grains.mass[0] * (0.5 + side.velocity(0).x);
  EXPECT_GT(momentum, 0);
  EXPECT_NEAR(side.totals.feature[kSleeve].x, -momentum, 1e-12 * momentum);
  EXPECT_EQ(side.totals.feature[kTip].x, 0);
}

}  // namespace
}  // namespace seapile::grains
