#include "tasks/event_json.hpp"

#include <gtest/gtest.h>

namespace lapwing::tasks {
namespace {

TEST(EventJson, WritesOneLineAnEvent) {
  TaskEvent event{.time = base::TimePoint(std::chrono::milliseconds(100)),
                  .kind = TaskEvent::Kind::start,
                  .task = "A",
                  .vehicle = vehicle::VehicleId{"a1"},
                  .detail = {}};
  EXPECT_EQ(to_json_line(event), R"({"t":0.1,"event":"START","task":"A","vehicle":"a1"})");
  event.kind = TaskEvent::Kind::error;
  event.detail = "he said \"no\\\"\n";
  event.vehicle.reset();
  EXPECT_EQ(to_json_line(event), R"({"t":0.1,"event":"ERROR","task":"A","detail":"he said \"no\\\"\u000a"})");
}

TEST(EventJson, EndsWithWhatAPlatformAdds) {
  TaskEvent const event{.kind = TaskEvent::Kind::start, .task = "A", .vehicle = {}, .detail = {}};
  EXPECT_EQ(to_json_line(event, R"("items":[])"), R"({"t":0,"event":"START","task":"A","items":[]})");
}

}  // namespace
}  // namespace lapwing::tasks
