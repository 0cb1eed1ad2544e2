#include "station/messages/alarm_messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/fake_alarms.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

TEST(AlarmMessages, TellEachAlarmWithItsAge) {
  testing::FakeAlarms alarms;
  alarms.raise(vehicle::AlarmKind::silent, "7", base::TimePoint(10s));
  alarms.list.back().severity = vehicle::Severity::critical;
  auto const message = json::parse(alarms_message(&alarms, base::TimePoint(14500ms)));
  EXPECT_EQ(message["type"], "alarms");
  EXPECT_EQ(message["battery"], json({{"low", 0.3}, {"critical", 0.15}}));
  auto const& alarm = message["alarms"].at(0);
  EXPECT_EQ(alarm["number"], 1);
  EXPECT_EQ(alarm["kind"], "silent");
  EXPECT_EQ(alarm["severity"], "critical");
  EXPECT_EQ(alarm["vehicle"], "7");
  EXPECT_EQ(alarm["text"], "vehicle 7 silent");
  EXPECT_EQ(alarm["age_s"], 4.5);
  EXPECT_FALSE(alarm.contains("acknowledged_by"));
}

TEST(AlarmMessages, TellOfNoneWhereThereAreNone) {
  EXPECT_TRUE(json::parse(alarms_message(nullptr, base::TimePoint{}))["alarms"].empty());
}

}  // namespace
}  // namespace lapwing::station
