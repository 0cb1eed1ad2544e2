#include "tasks/event_json.hpp"

#include <gtest/gtest.h>

#include "plan/mission_builder.hpp"
#include "tasks/mission_task.hpp"

namespace lapwing::tasks {
namespace {

TEST(EventJson, WritesOneLineAnEvent) {
  TaskEvent event{.time = base::TimePoint(std::chrono::milliseconds(100)),
                  .kind = TaskEvent::Kind::start,
                  .task = "A",
                  .vehicle = VehicleId{"a1"},
                  .detail = {}};
  EXPECT_EQ(to_json_line(event), R"({"t":0.1,"event":"START","task":"A","vehicle":"a1"})");
  event.kind = TaskEvent::Kind::error;
  event.detail = "he said \"no\\\"\n";
  event.vehicle.reset();
  EXPECT_EQ(to_json_line(event), R"({"t":0.1,"event":"ERROR","task":"A","detail":"he said \"no\\\"\u000a"})");
}

TEST(EventJson, StartOfAMissionCarriesItsItems) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  TaskEvent event{.kind = TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_EQ(to_json_line(event, {.home = geo::Wgs84{.alt_m = 820.0}}),
            R"({"t":0,"event":"START","task":"m","items":[)"
            R"({"seq":0,"command":16,"frame":0,"p1":0,"p2":0,"p3":0,"p4":0,"x":0,"y":0,"z":820},)"
            R"({"seq":1,"command":16,"frame":0,"p1":0,"p2":50,"p3":0,"p4":null,"x":0,"y":0,"z":50}]})");
  event.kind = TaskEvent::Kind::done;
  EXPECT_EQ(to_json_line(event), R"({"t":0,"event":"DONE","task":"m"})");
}

TEST(EventJson, WritesDegreesAsTheyWereGiven) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84::from_degrees(40.1, -8.1, 0.0)));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  TaskEvent const event{.kind = TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  EXPECT_NE(to_json_line(event).find(R"("x":40.1,"y":-8.1,"z":0)"), std::string::npos) << to_json_line(event);
}

TEST(EventJson, StartOfAMissionCarriesWhatTheVehicleGets) {
  plan::MissionBuilder builder;
  ASSERT_TRUE(builder.waypoint(geo::Wgs84{.alt_m = 50.0}));
  auto const task = std::make_shared<MissionTask>(*builder.finish("m"));
  TaskEvent const event{.kind = TaskEvent::Kind::start, .task = "m", .vehicle = {}, .detail = {}, .subject = task};
  auto const px4 = to_json_line(event, {.autopilot = vehicle::Autopilot::px4});
  EXPECT_NE(px4.find(R"("items":[{"seq":0,"command":16,)"), std::string::npos) << px4;
  EXPECT_EQ(px4.find(R"("seq":1)"), std::string::npos) << px4;
}

}  // namespace
}  // namespace lapwing::tasks
