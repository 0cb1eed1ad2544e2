#include "tasks/event_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/text/json.hpp"

namespace lapwing::tasks {
namespace {

TEST(EventJson, SaysWhatHappenedInTheOrderOfTheLine) {
  TaskEvent event{.time = base::TimePoint(std::chrono::milliseconds(100)),
                  .kind = TaskEvent::Kind::start,
                  .task = "A",
                  .vehicle = vehicle::VehicleId{"a1"},
                  .detail = {}};
  EXPECT_EQ(base::to_plain_line(to_json(event)), R"({"t":0.1,"event":"START","task":"A","vehicle":"a1"})");
  event.time = base::TimePoint(std::chrono::seconds(2));
  event.kind = TaskEvent::Kind::error;
  event.detail = "he said \"no\\\"\n";
  event.vehicle.reset();
  EXPECT_EQ(base::to_plain_line(to_json(event)), R"({"t":2,"event":"ERROR","task":"A","detail":"he said \"no\\\"\n"})");
}

}  // namespace
}  // namespace lapwing::tasks
