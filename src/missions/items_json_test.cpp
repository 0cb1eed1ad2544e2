#include "missions/items_json.hpp"

#include <gtest/gtest.h>

#include "missions/mission_task.hpp"
#include "plan/mission_builder.hpp"

namespace lapwing::missions {
namespace {

TEST(ItemsJson, StartOfAMissionCarriesItsItems) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_EQ(items_json(event, {.home = geo::Wgs84{.alt_m = 820.0}}),
            R"("items":[{"seq":0,"command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":0,"x":0,"y":0,"z":820},)"
            R"({"seq":1,"command":16,"frame":0,"p1":0,"p2":50,"p3":0,"p4":null,"x":0,"y":0,"z":50}])");
  event.kind = tasks::TaskEvent::Kind::done;
  EXPECT_EQ(items_json(event), "");
}

TEST(ItemsJson, WritesDegreesAsTheyWereGiven) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84::from_degrees(40.1, -8.1, 0.0)));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent const event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_NE(items_json(event).find(R"("x":40.1,"y":-8.1,"z":0)"), std::string::npos) << items_json(event);
}

TEST(ItemsJson, StartOfAMissionCarriesWhatTheVehicleGets) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent const event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  auto const px4 = items_json(event, {.autopilot = vehicle::Autopilot::px4});
  EXPECT_NE(px4.find(R"("items":[{"seq":0,"command":16,)"), std::string::npos) << px4;
  EXPECT_EQ(px4.find(R"("seq":1)"), std::string::npos) << px4;
}

}  // namespace
}  // namespace lapwing::missions
