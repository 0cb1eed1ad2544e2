// Robots that meet where they cannot pass: who goes first, and where the others go.
#include "explore/lead/giving_way.hpp"

#include <gtest/gtest.h>

#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

/// A corridor one robot wide, 10 m long, with two bays.
std::vector<std::string_view> const corridor = {
    "########################",  //
    "########  ######  ######",  //
    "########  ######  ######",  //
    "#                      #",  //
    "#                      #",  //
    "########################",
};

struct GivingWayTest : ::testing::Test {
  GivingWayTest() : map(120, 30, 0.1, {.keep_off_m = 0.23, .wary_m = 0.3}) {
    auto const grid = testing::drawn_grid(corridor);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 120; ++x) map.learn({x, y}, knowledge_of(grid.at({x, y})));
    }
    roads.emplace(map);
    roads->update(map, map.take_changes());
  }

  GivingWay::Member robot(double x_m, double to_x_m) const {
    GivingWay::Member member{.at = Place(x_m, 1.0), .stood_s = 5.0};
    if (to_x_m != x_m) member.way = {member.at, Place(to_x_m, 1.0)};
    return member;
  }
  std::vector<std::optional<Place>> decide(std::vector<GivingWay::Member> const& members, double time_s = 0.0) {
    std::vector<std::optional<Place>> places;
    for (auto const& cell : giving_way.decide(map, *roads, members, 0.18, time_s))
      places.push_back(cell ? std::optional(map.middle(*cell)) : std::nullopt);
    return places;
  }

  KnownMap map;
  std::optional<RoadMap> roads;
  GivingWay giving_way;
};

TEST_F(GivingWayTest, WhoHasNowhereToGoStepsIntoABay) {
  auto const places = decide({robot(3.5, 11.0), robot(4.3, 4.3)});
  EXPECT_FALSE(places[0]);
  ASSERT_TRUE(places[1]);
  EXPECT_GT(std::abs(places[1]->y() - 1.0) + std::max(0.0, places[1]->x() - 11.0), 0.5) << "off the way";
}

TEST_F(GivingWayTest, ThoseBehindMoveTooWhereOneAloneCannot) {
  auto const places = decide({robot(5.6, 9.5), robot(6.4, 6.4), robot(7.1, 7.1)});
  EXPECT_FALSE(places[0]);
  for (std::size_t i = 1; i < 3; ++i) {
    ASSERT_TRUE(places[i]) << i;
    for (std::size_t j = 1; j < i; ++j) EXPECT_GT(distance_m(*places[i], *places[j]), 0.36);
  }
}

TEST_F(GivingWayTest, TheOneInTheDeadEndComesOutFirst) {
  // Robot 0 wants into the dead end on the left, robot 1 out of it, and only behind robot 0 is there a bay.
  auto const places = decide({robot(2.5, 0.7), robot(1.7, 11.0)});
  ASSERT_TRUE(places[0]);
  ASSERT_TRUE(places[1]);
  EXPECT_GT(places[1]->y(), 1.5) << "into a bay, or the other could not come by";
}

TEST_F(GivingWayTest, NobodyMovesForWhoWaitsForAMomentOnly) {
  auto members = std::vector{robot(3.5, 11.0), robot(4.3, 4.3)};
  members[0].stood_s = 1.0;
  EXPECT_FALSE(decide(members)[1]);
}

TEST_F(GivingWayTest, GoesBackWhenTheOtherHasPassed) {
  auto members = std::vector{robot(3.5, 11.0), robot(4.3, 4.3)};
  auto const bay = decide(members)[1];
  ASSERT_TRUE(bay);
  members[1].at = *bay;
  members[0].stood_s = 0.0;
  EXPECT_TRUE(decide(members, 3.0)[1]);
  members[0] = robot(8.0, 11.0);
  members[0].stood_s = 0.0;
  EXPECT_FALSE(decide(members, 20.0)[1]);
}

TEST_F(GivingWayTest, DoesNotWaitForEverForOneThatDoesNotCome) {
  auto members = std::vector{robot(3.5, 11.0), robot(4.3, 4.3)};
  ASSERT_TRUE(decide(members)[1]);
  members[0].stood_s = 0.0;
  EXPECT_FALSE(decide(members, 600.0)[1]);
}

TEST_F(GivingWayTest, WhereNobodyGetsOnEachBacksOffInTurn) {
  auto members = std::vector{robot(5.6, 11.0), robot(6.05, 0.7)};
  for (auto& member : members) member.stood_s = 2.0 * GivingWay::stalls_s;
  auto const first = decide(members);
  ASSERT_TRUE(first[0]);
  EXPECT_FALSE(first[1]) << "that one goes on";
  EXPECT_GT(distance_m(*first[0], members[0].at), 0.9);
  EXPECT_GT(distance_m(*first[0], members[1].at), distance_m(members[0].at, members[1].at)) << "not past the other";
  auto const next = decide(members, GivingWay::back_off_every_s);
  EXPECT_FALSE(next[0]);
  ASSERT_TRUE(next[1]);
  EXPECT_GT(distance_m(*next[1], members[1].at), 0.9);
}

}  // namespace
}  // namespace lapwing::explore
