#include "solver/grains/contact_lists.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include "tests/support/contact_scene.h"

namespace seapile::grains {
namespace {

using support::ContactScene;

/// One disc of radius 1 inside a ring of `count` small ones that touch it: the worst that colouring can meet.
std::vector<Disc> planet(int count, double ratio) {
  std::vector<Disc> discs = {{0, 0, 1, 0}};
  for (int k = 0; k < count; ++k) {
    const double angle = 2 * std::numbers::pi * k / count, reach = 1 + 1 / ratio;
    discs.push_back({reach * std::cos(angle), reach * std::sin(angle), 1 / ratio, 0});
  }
  return discs;
}

/// True for a lane that holds a contact.
bool filled(const ContactBlock<double>& block, int lane) { return block.mass[lane] > 0; }

void expect_no_shared_grain_within_a_colour(const ContactScene<double>& scene) {
  for (const Colour& colour : scene.system.blocks.colour) {
    ASSERT_LE(colour.first, colour.first_wall);
    ASSERT_LE(colour.first_wall, colour.last);
    std::set<std::int32_t> met;
    for (std::int32_t b = colour.first; b < colour.last; ++b)
      for (int lane = 0; lane < kLanes; ++lane)
        for (const std::int32_t place : {scene.system.blocks.block[b].i[lane], scene.system.blocks.block[b].j[lane]})
          EXPECT_TRUE(met.insert(body_at(place)).second) << "body " << body_at(place) << " twice in one colour";
  }
}

/// Every listed pair and wall contact stands in exactly one lane, and every filled lane holds one of them.
void expect_one_lane_per_contact(const ContactScene<double>& scene) {
  const auto& system = scene.system;
  const auto& blocks = system.blocks;
  std::set<std::int32_t> taken;
  ASSERT_EQ(system.pair.size(), system.pair_slot.size());
  for (std::size_t p = 0; p < system.pair.size(); ++p) {
    const std::int32_t slot = system.pair_slot[p];
    EXPECT_TRUE(taken.insert(slot).second);
    const auto& block = blocks.block[slot / kLanes];
    EXPECT_EQ(body_at(block.i[slot % kLanes]), system.pair[p].i);
    EXPECT_EQ(body_at(block.j[slot % kLanes]), system.pair[p].j);
  }
  for (std::size_t w = 0; w < blocks.wall.size(); ++w) {
    const std::int32_t slot = blocks.wall_slot[w];
    EXPECT_TRUE(taken.insert(slot).second);
    const auto& block = blocks.block[slot / kLanes];
    EXPECT_EQ(body_at(block.i[slot % kLanes]), blocks.wall_grain[w]);
    EXPECT_EQ(body_at(block.j[slot % kLanes]), first_point(scene.grains.count()) + static_cast<std::int32_t>(w));
  }
  std::size_t count = 0;
  for (const auto& block : blocks.block)
    for (int lane = 0; lane < kLanes; ++lane) count += filled(block, lane);
  EXPECT_EQ(count, taken.size());
}

ContactScene<double> listed(const std::vector<Disc>& discs, Box box) {
  ContactScene<double> scene(discs);
  scene.box = box;
  list_contacts(scene.system, scene.grains, box);
  return scene;
}

TEST(ContactLists, NoTwoContactsOfAColourShareABody) {
  expect_no_shared_grain_within_a_colour(listed(support::jittered_lattice(300, 17, 0.01, 0.02, 1), {0, 0.7, 0}));
  expect_no_shared_grain_within_a_colour(listed(support::jittered_lattice(1200, 35, 0.01, 0.02, 1), {0, 1.43, 0}));
  expect_no_shared_grain_within_a_colour(listed(planet(200, 100), {-support::kFar, support::kFar, -support::kFar}));
}

// Threads own regions: a region's blocks may touch its grains only, and those of a smaller region must not be in them.
TEST(ContactLists, AContactBelongsToTheSmallestRegionThatHoldsBothItsGrains) {
  constexpr std::int32_t kGrains = 6000;
  const auto scene = listed(support::jittered_lattice(kGrains, 75, 0.01, 0.02, 1), {0, 3.03, 0});
  const auto& blocks = scene.system.blocks;
  const Regions& regions = scene.system.regions;
  ASSERT_EQ(blocks.region_colour.size(), static_cast<std::size_t>(regions.count()) + 1);
  EXPECT_EQ(blocks.region_colour.front(), 0);
  EXPECT_EQ(blocks.region_colour.back(), static_cast<std::int32_t>(blocks.colour.size()));
  std::int32_t next_block = 0;
  std::vector<int> found(regions.count());
  for (std::int32_t region = 0; region < regions.count(); ++region)
    for (std::int32_t k = blocks.region_colour[region]; k < blocks.region_colour[region + 1]; ++k) {
      const Colour& colour = blocks.colour[k];
      EXPECT_EQ(colour.first, next_block);
      next_block = colour.last;
      for (std::int32_t b = colour.first; b < colour.last; ++b)
        for (int lane = 0; lane < kLanes; ++lane) {
          if (!filled(blocks.block[b], lane)) continue;
          const std::int32_t i = body_at(blocks.block[b].i[lane]), j = body_at(blocks.block[b].j[lane]);
          const bool wall = b >= colour.first_wall;
          EXPECT_EQ(wall, j >= kGrains);
          EXPECT_EQ(regions.holding(regions.tile_of(i), regions.tile_of(wall ? i : j)), region);
          ++found[region];
        }
    }
  EXPECT_EQ(next_block, static_cast<std::int32_t>(blocks.block.size()));
  for (std::int32_t region = 0; region < regions.count(); ++region) EXPECT_GT(found[region], 20) << region;
}

TEST(ContactLists, EveryListedContactStandsInExactlyOneLane) {
  expect_one_lane_per_contact(listed(support::jittered_lattice(300, 17, 0.005, 0.02, 2), {0, 0.7, 0}));
  expect_one_lane_per_contact(listed(support::jittered_lattice(1200, 35, 0.01, 0.02, 2), {0, 1.43, 0}));
  expect_one_lane_per_contact(listed(planet(200, 100), {-support::kFar, support::kFar, -support::kFar}));
}

TEST(ContactLists, ThePairsAreThoseOfBruteForceWithinTheSkin) {
  const auto scene = listed(support::jittered_lattice(300, 17, 0.001, 0.02, 3), {0, 0.7, 0});
  EXPECT_GT(scene.system.skin, 0);
  const std::span<const Disc> discs(scene.grains.disc.data(), scene.grains.count());
  EXPECT_TRUE(scene.system.pair == neighbour_pairs_brute_force(discs, scene.system.skin));
}

TEST(ContactLists, AWallHasAContactWithEveryGrainWithinTheSkin) {
  const Box box{0, 0.7, 0};
  const auto scene = listed(support::jittered_lattice(300, 17, 0.01, 0.02, 4), box);
  std::set<std::pair<Wall, std::int32_t>> expected, found;
  for (std::int32_t i = 0; i < 300; ++i) {
    const Disc& d = scene.grains.disc[i];
    if (d.x - d.radius - box.left < scene.system.skin) expected.insert({Wall::left, i});
    if (box.right - d.x - d.radius < scene.system.skin) expected.insert({Wall::right, i});
    if (d.y - d.radius - box.base < scene.system.skin) expected.insert({Wall::base, i});
  }
  for (std::size_t w = 0; w < scene.system.blocks.wall.size(); ++w)
    found.insert({scene.system.blocks.wall[w], scene.system.blocks.wall_grain[w]});
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 20u);
}

// 200 neighbours need at least 200 colours: more than one machine word of them.
TEST(ContactLists, AGrainMayHaveMoreThan64Neighbours) {
  const auto scene = listed(planet(200, 100), {-support::kFar, support::kFar, -support::kFar});
  EXPECT_GE(scene.system.blocks.colour.size(), 200u);
  ASSERT_GE(scene.system.pair.size(), 400u);
}

TEST(ContactLists, AnyNumberOfThreadsMakesTheSameList) {
  const Box box{0, 1.43, 0};
  const auto discs = support::jittered_lattice(2000, 35, 0.01, 0.02, 6);
  const auto one = listed(discs, box);
  for (const int threads : {2, 3, 7}) {
    ContactScene<double> scene(discs);
    scene.box = box;
    base::Crew crew(threads);
    list_contacts(scene.system, scene.grains, box, &crew);
    EXPECT_TRUE(scene.system.pair == one.system.pair);
    EXPECT_TRUE(scene.system.pair_slot == one.system.pair_slot);
    EXPECT_TRUE(scene.system.blocks.wall_slot == one.system.blocks.wall_slot);
    EXPECT_EQ(scene.system.blocks.bodies, one.system.blocks.bodies);
    ASSERT_EQ(scene.system.blocks.block.size(), one.system.blocks.block.size());
    const std::size_t bytes = one.system.blocks.block.size() * sizeof(ContactBlock<double>);
    EXPECT_EQ(std::memcmp(scene.system.blocks.block.data(), one.system.blocks.block.data(), bytes), 0);
  }
}

TEST(ContactLists, ContactsThatStayKeepTheirImpulsesOverARebuild) {
  auto scene = listed(support::jittered_lattice(300, 17, 0.01, 0.02, 5), {0, 0.7, 0});
  auto& blocks = scene.system.blocks;
  // Each contact is marked by an impulse of its own.
  double mark = 0;
  std::map<std::pair<std::int32_t, std::int32_t>, std::pair<double, double>> marked;
  const auto set = [&](std::int32_t i, std::int32_t j, std::int32_t slot) {
    mark += 1;
    blocks.block[slot / kLanes].pn[slot % kLanes] = mark;
    blocks.block[slot / kLanes].pt[slot % kLanes] = -0.25 * mark;
    marked[{i, j}] = {mark, -0.25 * mark};
  };
  const auto wall_name = [](Wall wall) { return -1 - static_cast<std::int32_t>(wall); };
  for (std::size_t p = 0; p < scene.system.pair.size(); ++p)
    set(scene.system.pair[p].i, scene.system.pair[p].j, scene.system.pair_slot[p]);
  for (std::size_t w = 0; w < blocks.wall.size(); ++w)
    set(blocks.wall_grain[w], wall_name(blocks.wall[w]), blocks.wall_slot[w]);

  // The grains move; some contacts end, some begin, most stay.
  for (std::uint64_t i = 0; i < 300; ++i) {
    scene.grains.disc[i].x += base::uniform(-0.004, 0.004, 9, 0, i);
    scene.grains.disc[i].y += base::uniform(-0.004, 0.004, 9, 1, i);
  }
  list_contacts(scene.system, scene.grains, scene.box);

  int stayed = 0, begun = 0;
  const auto check = [&](std::int32_t i, std::int32_t j, std::int32_t slot) {
    const auto known = marked.find({i, j});
    const bool old = known != marked.end();
    (old ? stayed : begun) += 1;
    EXPECT_EQ(blocks.block[slot / kLanes].pn[slot % kLanes], old ? known->second.first : 0.0);
    EXPECT_EQ(blocks.block[slot / kLanes].pt[slot % kLanes], old ? known->second.second : 0.0);
  };
  for (std::size_t p = 0; p < scene.system.pair.size(); ++p)
    check(scene.system.pair[p].i, scene.system.pair[p].j, scene.system.pair_slot[p]);
  for (std::size_t w = 0; w < blocks.wall.size(); ++w)
    check(blocks.wall_grain[w], wall_name(blocks.wall[w]), blocks.wall_slot[w]);
  EXPECT_GT(begun, 0);
  EXPECT_GT(static_cast<int>(marked.size()) - stayed, 0);
  EXPECT_GT(stayed, 200);
}

// An empty lane must change nothing: its bodies are no grains, do not move, and stand apart so that its normal exists.
TEST(ContactLists, EmptyLanesHoldUnmovedBodiesOfTheirOwn) {
  const auto scene = listed(support::jittered_lattice(50, 7, 0.01, 0.02, 6), {0, 0.3, 0});
  std::set<std::int32_t> fillers;
  for (const auto& block : scene.system.blocks.block)
    for (int lane = 0; lane < kLanes; ++lane) {
      if (filled(block, lane)) continue;
      const std::int32_t i = body_at(block.i[lane]), j = body_at(block.j[lane]);
      for (const std::int32_t body : {i, j}) {
        EXPECT_GE(body, first_point(50) + static_cast<std::int32_t>(scene.system.blocks.wall.size()));
        EXPECT_LT(body, scene.system.blocks.bodies);
        EXPECT_EQ(scene.system.motion(body).inverse_mass, 0);
        EXPECT_TRUE(fillers.insert(body).second);
      }
      const Disc &a = scene.grains.disc[i], &b = scene.grains.disc[j];
      EXPECT_GT(std::hypot(b.x - a.x, b.y - a.y), a.radius + b.radius);
    }
  EXPECT_FALSE(fillers.empty());
}

TEST(ContactLists, TheFootOfAGrainStandsOnItsWall) {
  auto scene = listed({{0.02, 0.01, 0.01, 0}, {0.99, 0.5, 0.01, 0}}, {0.01, 1, 0});
  scene.grains.disc[0].x += 0.001;
  place_wall_points(scene.system, scene.grains, scene.box);
  ASSERT_EQ(scene.system.blocks.wall.size(), 3u);
  const Disc* foot = &scene.grains.disc[first_point(2)];
  EXPECT_EQ(foot[0].x, 0.01);
  EXPECT_EQ(foot[0].y, 0.01);
  EXPECT_EQ(foot[1].x, 1);
  EXPECT_EQ(foot[1].y, 0.5);
  EXPECT_EQ(foot[2].x, 0.02 + 0.001);
  EXPECT_EQ(foot[2].y, 0);
  for (int k = 0; k < 3; ++k) EXPECT_EQ(foot[k].radius, 0);
}

}  // namespace
}  // namespace seapile::grains
