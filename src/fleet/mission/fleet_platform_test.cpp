#include "fleet/mission/fleet_platform.hpp"

#include <gtest/gtest.h>

#include "fleet/testing/world.hpp"

namespace lapwing::fleet {
namespace {

using namespace std::chrono_literals;
using vehicle::VehicleId;

TEST(FleetPlatform, BringsTheMissionBlock) {
  TestWorld world;
  ASSERT_EQ(world.platform->vocabulary().builders.size(), 1u);
  EXPECT_EQ(world.platform->vocabulary().builders[0].name, "mission");
}

TEST(FleetPlatform, FindsNamedPlansInItsLibrary) {
  TestWorld world({}, {.run = {}, .plan_library = {{"survey1", mission_ending_with(mavlink::MavCmd::nav_land)}}});
  auto const found = world.platform->named_task("survey1");
  ASSERT_TRUE(found);
  EXPECT_EQ((*found)->name(), "survey");
  auto const missing = world.platform->named_task("survey2");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, base::ErrorKind::not_found);
  EXPECT_NE(missing.error().message.find("survey2"), std::string::npos);
}

TEST(FleetPlatform, SendsRawMessagesToTheVehicle) {
  TestWorld world;
  auto& copter = world.add();
  world.run_for(5s);
  std::vector<tasks::NamedValue> fields{{"command", std::string("MAV_CMD_NAV_LAND")}, {"param1", std::int64_t{3}}};
  auto const sent = world.send_message("1", "COMMAND_LONG", fields);
  EXPECT_TRUE(sent) << sent.error().message;
  world.run_for(1s);
  EXPECT_EQ(copter.commands_heard(mavlink::MavCmd::nav_land), 1);
}

TEST(FleetPlatform, RefusesRawMessagesThatThereAreNot) {
  TestWorld world;
  world.add();
  world.run_for(5s);
  EXPECT_EQ(world.send_message("1", "COMMAND_LNG").error().hint, "did you mean COMMAND_LONG?");
  std::vector<tasks::NamedValue> const place{{"command", geo::Wgs84{}}};
  EXPECT_EQ(world.send_message("1", "COMMAND_LONG", place).error().message,
            "COMMAND_LONG: command takes a number or a text");
  EXPECT_EQ(world.send_message("9", "COMMAND_LONG").error().kind, base::ErrorKind::lost);
}

TEST(FleetPlatform, ListsVehiclesBySystemIdWithWhatPickNeeds) {
  TestWorld world({.payload = {{{.system_id = 10}, {"Sidescan"}}}});
  world.add({.address = {10, 1}});
  world.add({.address = {9, 1}, .type = mavlink::MavType::ground_rover});
  world.run_for(10s);
  auto const vehicles = world.platform->vehicles();
  ASSERT_EQ(vehicles.size(), 2u);
  EXPECT_EQ(vehicles[0].id.text, "9");
  EXPECT_EQ(vehicles[0].type, "UGV");
  EXPECT_EQ(vehicles[1].id.text, "10");
  EXPECT_EQ(vehicles[1].payload, std::vector<std::string>{"Sidescan"});
  EXPECT_EQ(vehicles[1].connection_timeout, 20s);
  EXPECT_TRUE(vehicles[1].connected);
  ASSERT_TRUE(vehicles[1].position);
  EXPECT_LT(geo::surface_distance_m(*vehicles[1].position, TestAutopilot::home), 1.0);
  EXPECT_NEAR(vehicles[1].battery.value_or(0.0), 0.8, 0.01);
}

TEST(FleetPlatform, TellsWhenAVehicleComesToCount) {
  TestWorld world;
  world.add();
  auto counts = world.platform->vehicles_changed().wait_for([&] { return !world.platform->vehicles().empty(); }, 10s);
  EXPECT_TRUE(world.loop.run_until_done(std::move(counts)));
  EXPECT_LE(world.loop.now() - world.fleet->find(VehicleId{"1"})->discovered, 1300ms);
}

TEST(FleetPlatform, KnowsNothingOfAVehicleThatWasNeverHeard) {
  TestWorld world;
  EXPECT_FALSE(world.platform->find(VehicleId{"1"}));
  EXPECT_TRUE(world.platform->missions(VehicleId{"1"}).empty());
  world.platform->set_connection_timeout(VehicleId{"1"}, 5s);
  EXPECT_TRUE(world.platform->vehicles().empty());
}

TEST(FleetPlatform, ReadsTheWordsOfTheStopOption) {
  EXPECT_EQ(on_stop_from("rtl"), OnStop::rtl);
  EXPECT_EQ(on_stop_from("land"), OnStop::land);
  EXPECT_EQ(on_stop_from("loiter"), OnStop::loiter);
  EXPECT_FALSE(on_stop_from("explode"));
}

}  // namespace
}  // namespace lapwing::fleet
