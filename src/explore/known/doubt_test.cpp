// Who stood somewhere when a robot looked is no wall for ever: what is doubtful, and when it is looked at again.
#include <gtest/gtest.h>

#include "explore/known/frontiers.hpp"
#include "explore/known/known_map.hpp"
#include "explore/known/road_map.hpp"
#include "explore/simulated/laser.hpp"
#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

struct DoubtTest : ::testing::Test {
  DoubtTest() { known.emplace(world.width(), world.height(), world.cell_m(), KnownMap::Distances{}); }

  void look(std::vector<Disc> const& people, int scans) {
    for (int i = 0; i < scans; ++i) {
      auto seen = scan(world, here, {}, people, random);
      seen.time_s = time_s;
      time_s += 0.5;
      known->add(seen, {});
    }
  }
  std::vector<Frontier> open(Frontiers& frontiers) {
    if (!roads) roads.emplace(*known);
    roads->update(*known, known->take_changes());
    auto const root = roads->node_near(known->cell_at(here.position));
    return frontiers.find(*known, *roads, roads->from(root.value()));
  }

  FloorPlan plan = floor_plan_of(testing::drawn_grid(testing::two_rooms)).value();
  World world = World::around(plan, {2.0, 2.0}, {}).value();
  Pose here{Place(2.0, 2.0) - world.plan_from_world(), 0.0};
  Disc doorway{Place(4.75, 2.0) - world.plan_from_world(), 0.25};
  Disc passer{Place(3.0, 2.8) - world.plan_from_world(), 0.25};
  std::optional<KnownMap> known;
  std::optional<RoadMap> roads;
  Random random{1};
  double time_s = 0.0;
};

TEST_F(DoubtTest, WhoWasSeenForAMomentIsDoubtfulWhereThingsMove) {
  look({doorway}, 3);
  auto const at = known->cell_at(doorway.middle - Shift(0.2, 0.0));
  ASSERT_EQ(known->at(at), Knowledge::wall);
  EXPECT_FALSE(known->is_doubtful(at)) << "nothing has moved yet: walls are walls";
  look({doorway}, 2);
  look({doorway, passer}, 1);
  EXPECT_TRUE(known->has_seen_movement());
  EXPECT_TRUE(known->is_doubtful(at));
}

TEST_F(DoubtTest, WhatIsThereLaterIsAWall) {
  look({}, 5);
  look({passer}, 1);
  auto const wall = known->cell_at(Place(0.45, 2.0) - world.plan_from_world());
  ASSERT_EQ(known->at(wall), Knowledge::wall);
  EXPECT_TRUE(known->is_doubtful(wall));
  time_s += 20.0;
  look({}, 1);
  EXPECT_FALSE(known->is_doubtful(wall));
}

TEST_F(DoubtTest, NoiseIsNoMovement) {
  look({}, 400);
  EXPECT_FALSE(known->has_seen_movement());
}

TEST_F(DoubtTest, WherePeopleStoodIsOpenUntilItWasSeenAgain) {
  Frontiers frontiers(*known);
  look({doorway}, 8);
  look({doorway, passer}, 1);
  time_s += 60.0;
  // All walls but the person have been seen again.
  Pose const away = here;
  here.position = here.position + Shift(0.0, -0.8);
  look({}, 30);
  here = away;
  auto const at = known->cell_at(doorway.middle);
  EXPECT_EQ(known->at(at), Knowledge::free) << "evidence for a wall goes where the floor is seen";
  for (auto const& frontier : open(frontiers)) EXPECT_TRUE(known->is_frontier(frontier.middle));
}

TEST_F(DoubtTest, APieceOfDoubtfulWallIsLookedAtWhenNothingElseIsOpen) {
  Frontiers frontiers(*known);
  look({}, 20);
  look({passer}, 6);
  // Everything but what lies behind was given up.
  for (int i = 0; i < 20; ++i) {
    auto const left = open(frontiers);
    bool is_doubt = false;
    for (auto const& frontier : left) {
      if (known->is_doubtful(frontier.middle)) {
        is_doubt = true;
        EXPECT_LT(distance_m(known->middle(frontier.middle), passer.middle), 0.6);
      } else {
        frontiers.give_up(*known, frontier);
      }
    }
    if (is_doubt) {
      EXPECT_TRUE(Frontiers::is_open(*known, left.front()));
      return;
    }
  }
  FAIL() << "nobody looks again";
}

TEST_F(DoubtTest, WhatRemainsIsLookedAtOnceWhereNothingMoves) {
  Frontiers frontiers(*known);
  look({}, 20);
  ASSERT_FALSE(open(frontiers).empty());
  // The ends of long ones are looked at by themselves.
  int rounds = 0;
  for (auto found = open(frontiers); !found.empty() && rounds < 20; found = open(frontiers), ++rounds) {
    for (auto const& frontier : found) frontiers.give_up(*known, frontier);
  }
  EXPECT_LT(rounds, 8);
}

TEST_F(DoubtTest, WhatHadNoWayIsTriedAgainButNotForEver) {
  Frontiers frontiers(*known);
  look({}, 20);
  int rounds = 0;
  for (double now_s = 0.0; now_s < 3600.0; now_s += 1.0) {
    frontiers.set_moment(now_s);
    auto const found = open(frontiers);
    if (!found.empty()) ++rounds;
    for (auto const& frontier : found) frontiers.put_off(*known, frontier);
  }
  EXPECT_EQ(rounds, FrontierSettings().most_put_off);
  EXPECT_FALSE(frontiers.is_any_put_off(*known));
}

TEST_F(DoubtTest, WhatHadNoWayIsNotTriedAgainAtOnce) {
  Frontiers frontiers(*known);
  look({}, 20);
  auto const found = open(frontiers);
  ASSERT_FALSE(found.empty());
  for (auto const& frontier : found) frontiers.put_off(*known, frontier);
  EXPECT_TRUE(open(frontiers).empty()) << "whoever stands in the way is still there";
  EXPECT_TRUE(frontiers.is_any_put_off(*known)) << "and so it is not the end";
  frontiers.set_moment(FrontierSettings().again_after_s);
  EXPECT_EQ(open(frontiers).size(), found.size());
}

}  // namespace
}  // namespace lapwing::explore
