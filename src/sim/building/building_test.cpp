#include "sim/building/building.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "sim/building/plan/building_file.hpp"
#include "sim/building/testing/host_end.hpp"
#include "sim/building/testing/small_building.hpp"

namespace lapwing::sim::building {
namespace {

using testing::HostEnd;
using testing::pass;
using testing::small_building;
using testing::small_plan;

BuildingPlan office() {
  std::ifstream file(LAPWING_SOURCE_DIR "/examples/buildings/office.toml");
  std::string const text{std::istreambuf_iterator<char>(file), {}};
  return building_of("office.toml", text).value();
}

std::vector<std::uint8_t> bytes_of_a_drive(std::uint64_t seed) {
  auto const building = Building::make(office(), {.seed = seed, .robots = 2}).value();
  HostEnd first(building->robot(0));
  HostEnd second(building->robot(1));
  // A board that has not felt its inertial unit yet keeps no heading.
  pass(*building, first, 0.1);
  first.drive(0.2F, 0.3F);
  second.drive(0.1F, 0.0F);
  for (int i = 0; i < 10; ++i) {
    pass(*building, first, 0.3);
    second.say(firmware::Alive{});
    second.listen();
  }
  auto bytes = first.all;
  bytes.insert(bytes.end(), second.all.begin(), second.all.end());
  auto const picture = develop(*building->shoot(0));
  bytes.insert(bytes.end(), picture.rgb.begin(), picture.rgb.end());
  return bytes;
}

TEST(Building, GivesTheSameBytesForTheSameSeed) {
  auto const once = bytes_of_a_drive(7);
  EXPECT_EQ(once, bytes_of_a_drive(7));
  EXPECT_NE(once, bytes_of_a_drive(8));
}

TEST(Building, HasARobotThatSaysWhatItIsAndReadsTenTimesASecond) {
  auto const building = small_building({{2, 2}, 0.5});
  HostEnd host(building->robot(0));
  pass(*building, host, 5.0);
  ASSERT_TRUE(host.hello);
  EXPECT_EQ(host.hello->description.sonar_count, 5);
  EXPECT_EQ(host.hello->description.laser.beams, 360);
  EXPECT_NEAR(host.readings_count, 50, 1);
  EXPECT_NEAR(host.pieces, 4 * 50, 8);
  ASSERT_TRUE(host.readings->imu);
  EXPECT_NEAR(static_cast<double>(host.readings->imu->acceleration_m_s2.z), 9.81, 0.3);
}

TEST(Building, StopsARobotFiveCentimetresBeforeAWallAtEveryLegalSpeed) {
  for (float const speed : {0.05F, 0.12F, 0.16F, 0.3F}) {
    for (double const yaw : {0.0, 0.35, 1.2, -1.9}) {
      auto const building = small_building({{4, 2.5}, yaw}, 3);
      HostEnd host(building->robot(0));
      pass(*building, host, 0.1);
      host.drive(speed, 0.0F);
      double nearest_m = 10.0;
      for (int i = 0; i * 0.5 < 4.2 / static_cast<double>(speed); ++i) {
        pass(*building, host, 0.5);
        auto const& at = building->robot(0).body().pose().position;
        // Walls reach 5 cm into the room.
        nearest_m = std::min({nearest_m, at.x() - 0.05, at.y() - 0.05, 7.95 - at.x(), 4.95 - at.y()});
      }
      EXPECT_TRUE(building->collisions().empty()) << speed << ' ' << yaw;
      EXPECT_LT(nearest_m, 0.6) << speed << ' ' << yaw;
      EXPECT_GT(nearest_m - 0.18, 0.01) << speed << ' ' << yaw;
    }
  }
}

TEST(Building, CountsWhatARobotWithoutFirmwareRunsInto) {
  auto const building = small_building({{4, 2.5}, 0.0});
  auto& robot = building->robot(0);
  robot.set({.kind = Fault::Kind::halted});
  robot.drive_wheels(0.5F, 0.5F);
  for (int i = 0; i < 6'000; ++i) building->step();
  ASSERT_FALSE(building->collisions().empty());
  auto const& collision = building->collisions().front();
  EXPECT_EQ(collision.contact.thing, Thing::wall);
  EXPECT_NEAR(collision.contact.speed_m_s, 0.2, 0.06);
  EXPECT_NEAR(robot.body().pose().position.x(), 7.95 - 0.18, 0.001);
  // Told once, though it pushes on; sliding along it comes to the next wall at most.
  EXPECT_LE(building->collisions().size(), 2U);
}

TEST(Building, StopsBeforeAPersonInTheWay) {
  auto plan = small_plan();
  plan.people.push_back({.start = {{6, 2.5}, 0.0}});
  auto const building = small_building({{2, 2.5}, 0.0}, 1, plan);
  HostEnd host(building->robot(0));
  pass(*building, host, 0.1);
  host.drive(0.3F, 0.0F);
  pass(*building, host, 20.0);
  EXPECT_TRUE(building->collisions().empty());
  EXPECT_LT(building->robot(0).body().pose().position.x(), 6.0 - 0.22 - 0.18);
  EXPECT_GT(building->robot(0).body().pose().position.x(), 5.2);
  EXPECT_TRUE(host.readings->has(firmware::Flag::too_near) || std::abs(building->robot(0).body().speed_m_s()) < 0.02);
}

TEST(Building, BreaksWhatIsAskedFor) {
  auto const building = small_building({{4, 2.5}, 0.0});
  auto& robot = building->robot(0);
  HostEnd host(robot);
  pass(*building, host, 1.0);
  robot.set({.kind = Fault::Kind::sonar_stuck, .which = 0});
  auto const stuck = host.readings->echoes_us[0];
  robot.body().put({{2, 2.5}, 0.0});
  pass(*building, host, 1.0);
  EXPECT_EQ(host.readings->echoes_us[0], stuck);
  robot.mend_all();
  pass(*building, host, 1.0);
  EXPECT_NE(host.readings->echoes_us[0], stuck);

  robot.set({.kind = Fault::Kind::imu_silent});
  robot.set({.kind = Fault::Kind::laser_silent});
  auto const pieces = host.pieces;
  pass(*building, host, 1.0);
  EXPECT_TRUE(host.readings->has(firmware::Flag::imu_silent));
  EXPECT_LE(host.pieces, pieces + 4);
  robot.mend_all();
  pass(*building, host, 0.2);

  robot.set({.kind = Fault::Kind::encoder_dead, .which = 1});
  host.drive(0.2F, 0.0F);
  pass(*building, host, 2.0);
  EXPECT_TRUE(host.readings->has(firmware::Flag::right_wheel_dead));
  robot.mend_all();

  robot.set({.kind = Fault::Kind::unplugged});
  auto const heard = host.all.size();
  pass(*building, host, 1.0);
  EXPECT_EQ(host.all.size(), heard);
  robot.mend_all();
  robot.restart_board();
  pass(*building, host, 1.0);
  EXPECT_LT(host.readings->time, firmware::Time(1'100'000));
}

TEST(Building, StopsByItsWatchdogWhenTheLineIsCut) {
  auto const building = small_building({{1, 2.5}, 0.0});
  auto& robot = building->robot(0);
  HostEnd host(robot);
  pass(*building, host, 0.1);
  host.drive(0.3F, 0.0F);
  pass(*building, host, 2.0);
  EXPECT_NEAR(robot.body().speed_m_s(), 0.3, 0.03);
  robot.set({.kind = Fault::Kind::unplugged});
  for (int i = 0; i < 400; ++i) building->step();
  EXPECT_NEAR(robot.body().speed_m_s(), 0.0, 0.001);
}

TEST(Building, PutsRobotsWhereThereIsRoom) {
  auto const building = Building::make(office(), {.robots = 5}).value();
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(distance_m(building->robot(i).body().pose().position, building->robot(j).body().pose().position), 0.4);
  }
  EXPECT_EQ(building->robot(1).body().pose().position, Place(46, 12));
  for (int i = 0; i < 200; ++i) building->step();
  EXPECT_TRUE(building->collisions().empty());
}

TEST(Building, FindsAStartOnAMapThatNamesNone) {
  map::OccupancyGrid grid(0.05);
  for (int y = 0; y < 100; ++y) {
    for (int x = 0; x < 200; ++x) grid.set({x, y}, map::Evidence::of_probability(0.1));
  }
  auto const building = Building::make(plan_of_map(grid, "m").value(), {.seed = 4}).value();
  auto const& at = building->robot(0).body().pose().position;
  EXPECT_GT(std::min({at.x(), at.y(), 10.0 - at.x(), 5.0 - at.y()}), 0.3);
  HostEnd host(building->robot(0));
  pass(*building, host, 1.0);
  EXPECT_GT(host.pieces, 20);
}

TEST(Building, RefusesWhatCannotBe) {
  auto const error = [](BuildingPlan plan, BuildingOptions options) {
    auto const building = Building::make(std::move(plan), std::move(options));
    return building ? "" : building.error().message;
  };
  EXPECT_EQ(error(small_plan(), {.starts = {{{0.1, 2}, 0.0}}}),
            "robot 1 cannot start at 0.10, 2.00: it would touch something");
  EXPECT_EQ(error(small_plan(), {.starts = {{{-3, 2}, 0.0}}}), "");
  EXPECT_EQ(error(small_plan(), {.robots = 33}), "33 robots cannot be simulated in one building");
  EXPECT_EQ(error({}, {}), "the building has no wall");
  auto plan = small_plan();
  plan.doors[0].latch = {4, 4};
  EXPECT_EQ(error(plan, {}), "the door 221 stands in no wall");
}

}  // namespace
}  // namespace lapwing::sim::building
