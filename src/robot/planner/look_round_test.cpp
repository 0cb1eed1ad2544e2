// A robot that sees little at a time looks round where it is worth it, once.
#include "robot/planner/look_round.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace lapwing::robot {
namespace {

/// 4 by 4 m around (2, 2), of which what lies within `known_m` of the middle is known to be free.
explore::KnownMap known_within(double known_m) {
  explore::KnownMap map(80, 80, 0.05, {});
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      if (geo::distance_m(map.middle({x, y}), explore::Place(2.0, 2.0)) < known_m)
        map.learn({x, y}, explore::Knowledge::free);
  return map;
}

/// How far it turns from there until it has no reason to any more.
double turned_rad(LookRound& look, double yaw_rad) {
  constexpr double step_rad = 0.05;
  double turned = 0.0;
  while (auto const towards = look.next(geo::wrap_pi(yaw_rad + turned))) {
    turned += std::copysign(step_rad, geo::wrap_pi(*towards - yaw_rad - turned));
    if (turned > 20.0) break;
  }
  return turned;
}

TEST(LookRound, TurnsOnceRoundWhereMuchIsUnknown) {
  LookRound look;
  look.arrive(known_within(0.5), {{2.0, 2.0}, 1.0});
  EXPECT_NEAR(turned_rad(look, 1.0), 2.0 * std::numbers::pi, 0.2);
}

TEST(LookRound, DoesNotTurnWhereAllIsKnown) {
  LookRound look;
  look.arrive(known_within(1.5), {{2.0, 2.0}, 0.0});
  EXPECT_FALSE(look.next(0.0));
}

TEST(LookRound, TakesWhatLiesBehindAWallForNothingToBeSeen) {
  auto map = known_within(0.5);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x)
      if (geo::distance_m(map.middle({x, y}), explore::Place(2.0, 2.0)) >= 0.5)
        map.learn({x, y}, explore::Knowledge::wall);
  LookRound look;
  look.arrive(map, {{2.0, 2.0}, 0.0});
  EXPECT_FALSE(look.next(0.0));
}

TEST(LookRound, DoesNotTurnTwiceAtOnePlace) {
  auto const map = known_within(0.3);
  LookRound look;
  look.arrive(map, {{2.0, 2.0}, 0.0});
  EXPECT_GT(turned_rad(look, 0.0), 6.0);
  look.arrive(map, {{2.2, 2.0}, 0.0});
  EXPECT_FALSE(look.next(0.0)) << "it has been seen from here already";
  look.arrive(map, {{2.6, 2.0}, 0.0});
  EXPECT_TRUE(look.next(0.0));
}

TEST(LookRound, EndsWhenSomethingElseIsToBeDone) {
  LookRound look;
  look.arrive(known_within(0.3), {{2.0, 2.0}, 0.0});
  look.stop();
  EXPECT_FALSE(look.next(0.0));
}

}  // namespace
}  // namespace lapwing::robot
