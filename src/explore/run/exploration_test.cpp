// Whole runs on small drawn floors: every one ends by itself, has seen everything, touched nothing and is home again.
#include "explore/run/exploration.hpp"

#include <gtest/gtest.h>

#include "explore/run/picture.hpp"
#include "explore/run/starts.hpp"
#include "explore/testing/drawn_floor.hpp"

namespace lapwing::explore {
namespace {

using Lines = std::vector<std::string_view>;

struct Case {
  char const* name;
  Lines const* floor;
  char const* strategy;
  int robots;
  int people;
};

std::ostream& operator<<(std::ostream& out, Case const& value) {
  return out << value.name << '/' << value.strategy << '/' << value.robots << '/' << value.people;
}

Settings settings_of(Case const& value) {
  Settings settings;
  settings.strategy = value.strategy;
  settings.robots = value.robots;
  settings.people = value.people;
  settings.laser.range_m = 5.0;
  settings.most_time_s = 4.0 * 3600.0;
  settings.seed = 7;
  return settings;
}

Exploration begin(Lines const& floor, Settings const& settings) {
  auto const plan = floor_plan_of(testing::drawn_grid(floor)).value();
  auto const first = random_start(plan, possible_starts(plan, settings), settings.seed).value();
  auto world = std::make_shared<World const>(World::around(plan, first.position, settings).value());
  auto const starts =
      starts_around(*world, {first.position - world->plan_from_world(), first.yaw_rad}, settings).value();
  return Exploration::begin(world, settings, starts).value();
}

RunReport run(Lines const& floor, Settings const& settings) {
  auto exploration = begin(floor, settings);
  while (exploration.step()) {
  }
  return exploration.report();
}

/// Several starts of each: what goes well from one may not from the next.
constexpr std::uint64_t seeds[] = {10, 11, 12};

struct ExplorationTest : ::testing::TestWithParam<Case> {};

TEST_P(ExplorationTest, EndsHomeWithEverythingSeenAndNothingTouched) {
  for (auto const seed : seeds) {
    auto settings = settings_of(GetParam());
    settings.seed = seed;
    auto const report = run(*GetParam().floor, settings);
    EXPECT_EQ(report.ending, Ending::explored) << to_string(report.ending) << ", seed " << seed;
    EXPECT_TRUE(report.is_finished) << "seed " << seed;
    EXPECT_GE(report.coverage, 0.99) << "seed " << seed;
    EXPECT_EQ(report.collisions, 0) << "seed " << seed;
    EXPECT_TRUE(report.travel_to_99_m) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(OneRobot, ExplorationTest,
                         ::testing::Values(Case{"two_rooms", &testing::two_rooms, "nearest", 1, 0},
                                           Case{"island", &testing::island, "nearest", 1, 0},
                                           Case{"dead_ends", &testing::dead_ends, "nearest", 1, 0},
                                           Case{"two_rooms", &testing::two_rooms, "tour", 1, 0},
                                           Case{"island", &testing::island, "tour", 1, 0},
                                           Case{"dead_ends", &testing::dead_ends, "tour", 1, 0},
                                           Case{"two_rooms", &testing::two_rooms, "right-hand", 1, 0},
                                           Case{"island", &testing::island, "right-hand", 1, 0},
                                           Case{"dead_ends", &testing::dead_ends, "right-hand", 1, 0}));
INSTANTIATE_TEST_SUITE_P(WallsThatLeadRound, ExplorationTest,
                         ::testing::Values(Case{"hall", &testing::hall, "right-hand", 1, 0},
                                           Case{"narrow", &testing::narrow, "right-hand", 1, 0},
                                           Case{"hall", &testing::hall, "right-hand", 2, 0},
                                           Case{"dead_ends", &testing::dead_ends, "right-hand", 2, 0}));
INSTANTIATE_TEST_SUITE_P(SeveralRobots, ExplorationTest,
                         ::testing::Values(Case{"dead_ends", &testing::dead_ends, "tour", 2, 0},
                                           Case{"dead_ends", &testing::dead_ends, "tour", 4, 0},
                                           Case{"narrow", &testing::narrow, "tour", 2, 0},
                                           Case{"narrow", &testing::narrow, "tour", 3, 0},
                                           Case{"narrow", &testing::narrow, "tour", 8, 0},
                                           Case{"narrow", &testing::narrow, "nearest", 8, 0}));
INSTANTIATE_TEST_SUITE_P(People, ExplorationTest,
                         ::testing::Values(Case{"island", &testing::island, "tour", 2, 3},
                                           Case{"narrow", &testing::narrow, "tour", 2, 4},
                                           Case{"dead_ends", &testing::dead_ends, "nearest", 1, 6},
                                           Case{"dead_ends", &testing::dead_ends, "right-hand", 1, 4},
                                           Case{"dead_ends", &testing::dead_ends, "tour", 1, 6},
                                           Case{"narrow", &testing::narrow, "nearest", 1, 4},
                                           Case{"narrow", &testing::narrow, "nearest", 2, 4}));

// Robots that push one another back in doorways and corridors.
INSTANTIATE_TEST_SUITE_P(InOneAnothersWay, ExplorationTest,
                         ::testing::Values(Case{"dead_ends", &testing::dead_ends, "nearest", 3, 0},
                                           Case{"narrow", &testing::narrow, "nearest", 4, 0}));

// A known limit: from the first of these starts a part is left unseen.
INSTANTIATE_TEST_SUITE_P(DISABLED_NotFromEveryStart, ExplorationTest,
                         ::testing::Values(Case{"narrow", &testing::narrow, "right-hand", 3, 0}));

TEST(Exploration, TheSameSeedGivesTheSameRun) {
  auto const settings = settings_of({"", nullptr, "tour", 2, 3});
  auto const one = run(testing::dead_ends, settings);
  auto const two = run(testing::dead_ends, settings);
  EXPECT_EQ(one.travel_m, two.travel_m);
  EXPECT_EQ(one.time_s, two.time_s);
  EXPECT_EQ(one.coverage, two.coverage);
}

TEST(Exploration, ARobotComesHomeBeforeItsBatteryIsEmpty) {
  auto settings = settings_of({"", nullptr, "tour", 1, 0});
  settings.energy_m = 15.0;
  auto exploration = begin(testing::dead_ends, settings);
  while (exploration.step()) {
  }
  auto const report = exploration.report();
  EXPECT_EQ(report.ending, Ending::energy);
  EXPECT_FALSE(report.is_finished);
  EXPECT_LE(report.travel_m, settings.energy_m);
  EXPECT_LT(distance_m(exploration.track(0).back(), report.starts[0].position), 0.6);
}

TEST(Exploration, TimeRunsOut) {
  auto settings = settings_of({"", nullptr, "tour", 1, 0});
  settings.most_time_s = 20.0;
  auto const report = run(testing::dead_ends, settings);
  EXPECT_EQ(report.ending, Ending::time);
  EXPECT_FALSE(report.is_finished);
  EXPECT_LT(report.coverage, 0.9);
}

TEST(Exploration, SpeedAndAccelerationKeepToTheLimits) {
  auto const settings = settings_of({"", nullptr, "tour", 1, 0});
  auto exploration = begin(testing::dead_ends, settings);
  double before_m = 0.0;
  double speed_before = 0.0;
  for (int i = 0; i < 3000 && exploration.step(); ++i) {
    double const speed = (exploration.travel_m() - before_m) / Exploration::step_s;
    EXPECT_LE(speed, settings.carrier.speed_m_s + 1e-9);
    EXPECT_LE(speed - speed_before, settings.carrier.acceleration_m_s2 * Exploration::step_s + 1e-3);
    before_m = exploration.travel_m();
    speed_before = speed;
  }
}

TEST(Exploration, ThePictureHasWallsAndAPathARobot) {
  auto exploration = begin(testing::two_rooms, settings_of({"", nullptr, "tour", 2, 0}));
  while (exploration.step()) {
  }
  auto const picture = svg_of(exploration);
  EXPECT_TRUE(picture.starts_with("<svg"));
  std::size_t paths = 0;
  for (std::size_t at = 0; (at = picture.find("<polyline", at)) != std::string::npos; ++at) ++paths;
  EXPECT_EQ(paths, 2U);
}

TEST(Exploration, AStrategyThatThereIsNotIsRefused) {
  auto const made = make_strategy("left-hand");
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().message, "there is no strategy `left-hand`");
}

}  // namespace
}  // namespace lapwing::explore
