#include "missions/event_line.hpp"

#include <gtest/gtest.h>

#include "missions/mission_task.hpp"
#include "plan/mission_builder.hpp"

namespace lapwing::missions {
namespace {

TEST(EventLine, StartOfAMissionCarriesItsItems) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_EQ(event_line(event, {.home = geo::Wgs84{.alt_m = 820.0}}),
            R"({"t":0,"event":"START","task":"m","items":[)"
            R"({"seq":0,"command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":0,"x":0,"y":0,"z":820},)"
            R"({"seq":1,"command":16,"frame":0,"p1":0,"p2":50,"p3":0,"p4":null,"x":0,"y":0,"z":50}]})");
  event.kind = tasks::TaskEvent::Kind::done;
  EXPECT_EQ(event_line(event), R"({"t":0,"event":"DONE","task":"m"})");
}

TEST(EventLine, WritesDegreesAsTheyWereGiven) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84::from_degrees(40.1, -8.1, 0.0)));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent const event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_NE(event_line(event).find(R"("x":40.1,"y":-8.1,"z":0)"), std::string::npos) << event_line(event);
}

TEST(EventLine, StartOfAMissionCarriesWhatTheVehicleGets) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  tasks::TaskEvent const event{
      .kind = tasks::TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  auto const px4 = event_line(event, {.autopilot = vehicle::Autopilot::px4});
  EXPECT_NE(px4.find(R"("items":[{"seq":0,"command":16,)"), std::string::npos) << px4;
  EXPECT_EQ(px4.find(R"("seq":1)"), std::string::npos) << px4;
}

}  // namespace
}  // namespace lapwing::missions
