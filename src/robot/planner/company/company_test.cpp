// Robots that stand in each other's way: who decides, and who does as it is told. Where they go is GivingWay's.
#include "robot/planner/company/company.hpp"

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

using explore::Cell;
using explore::Knowledge;
using explore::Place;

/// A corridor of 10 by 1 m with a bay of 1 m above its middle, at the lower end of the grid.
struct CompanyTest : ::testing::Test {
  CompanyTest() {
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 100; ++x) {
        bool const is_free = (y > 0 && y <= 10 && x > 0 && x < 99) || (y > 10 && y <= 20 && x > 45 && x <= 55);
        map.learn({x, y}, is_free ? Knowledge::free : Knowledge::wall);
      }
    }
    roads.update(map, map.take_changes());
  }
  /// `wants_to_x` where it stands: nowhere.
  static Company::Neighbour robot(std::string id, double x, double wants_to_x, bool explores = true) {
    Company::Neighbour one{.id = std::move(id), .explores = explores, .now = {.at = Place(x, 0.55), .stood_s = 5.0}};
    if (wants_to_x != x) one.now.way = {one.now.at, Place(wants_to_x, 0.55)};
    return one;
  }
  auto decide(Company::Neighbour const& self) {
    auto const decision = company.decide(map, roads, self, 0.18, time_s++);
    decides = decision.is_own;
    return decision.asks;
  }

  explore::KnownMap map{100, 30, 0.1, {.keep_off_m = 0.23, .wary_m = 0.3}};
  explore::RoadMap roads{map};
  Company company;
  double time_s = 0.0;
  bool decides = false;
};

TEST_F(CompanyTest, TheFirstSendsAnotherIntoTheBay) {
  company.take({robot("robot2", 5.5, 1.0)});
  auto const asks = decide(robot("robot1", 4.5, 9.0));
  ASSERT_EQ(asks.size(), 1u);
  auto const& [who, place] = *asks.begin();
  EXPECT_TRUE(decides);
  EXPECT_EQ(who, "robot2");
  EXPECT_GT(place.y(), 1.0);
}

TEST_F(CompanyTest, AnotherDoesAsTheFirstHasToldIt) {
  auto first = robot("robot1", 4.5, 9.0);
  first.asks = {{"robot2", Place(5.0, 1.5)}, {"robot3", Place(5.2, 1.5)}};
  company.take({robot("robot3", 6.5, 1.0), first});
  EXPECT_EQ(decide(robot("robot2", 5.5, 1.0)), first.asks) << "and decides nothing itself";
  EXPECT_FALSE(decides);
}

TEST_F(CompanyTest, WhoExploresDecidesBeforeWhoOnlyDrives) {
  company.take({robot("robot1", 4.5, 9.0, false)});
  EXPECT_EQ(decide(robot("robot2", 5.5, 1.0)).size(), 1u);
}

TEST_F(CompanyTest, NobodyIsAskedWhoIsInNobodysWay) {
  company.take({robot("robot2", 5.5, 5.5)});
  EXPECT_TRUE(decide(robot("robot1", 4.5, 4.5)).empty()) << "neither wants to go on";
  company.take({robot("robot2", 8.5, 1.0)});
  EXPECT_TRUE(decide(robot("robot1", 1.5, 9.0)).empty()) << "they have not met yet";
}

TEST_F(CompanyTest, ForgetsWhatWasDecidedWhenOthersAreThere) {
  company.take({robot("robot2", 5.5, 1.0)});
  ASSERT_FALSE(decide(robot("robot1", 4.5, 9.0)).empty());
  company.take({robot("robot3", 8.5, 1.0)});
  EXPECT_TRUE(decide(robot("robot1", 4.5, 9.0)).empty());
}

}  // namespace
}  // namespace lapwing::robot
