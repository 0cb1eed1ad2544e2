#include "station/messages/control_messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/fake_control.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using testing::FakeControl;
using vehicle::Action;
using vehicle::CommandState;
using vehicle::StopAction;

ControlRequest control_request(std::string_view type, std::string_view body) {
  return std::get<ControlRequest>(parse_request_body(type, body).value());
}

TEST(ControlMessages, ShowHowFarACommandHasCome) {
  std::deque<vehicle::CommandRecord> const records{
      {.number = 7,
       .command = {.action = Action::take_off, .height_m = 12.0},
       .by = "operator 1",
       .asked = base::UtcTime{},
       .outcomes = {{{"1"}, CommandState::confirmed, "at 12 m", {}},
                    {{"2"}, CommandState::waiting, "", {}},
                    {{"5"}, CommandState::refused, "12 km away [too_far]", {}, "too_far"},
                    {{"3"}, CommandState::under_way, "at 7 of 12 m", 4.96},
                    {{"4"}, CommandState::cut_short, "emergency stop by anna, at 3 of 12 m", {}}}}};
  EXPECT_EQ(json::parse(commands_message(records)),
            json::parse(R"({"type":"commands","commands":[{"number":7,"action":"take_off","height_m":12.0,
              "by":"operator 1","asked":"1970-01-01T00:00:00.000Z","vehicles":[
              {"vehicle":"1","state":"confirmed","reason":"at 12 m"},{"vehicle":"2","state":"waiting"},
              {"vehicle":"5","state":"refused","reason":"12 km away [too_far]","rule":"too_far"},
              {"vehicle":"3","state":"under_way","reason":"at 7 of 12 m","left_m":5.0},
              {"vehicle":"4","state":"cut_short","reason":"emergency stop by anna, at 3 of 12 m"}]}]})"));
}

TEST(ControlMessages, ShowTheEmergencyStop) {
  vehicle::EmergencyStop const stop{.is_latched = true,
                                    .action = StopAction::land,
                                    .by = "anna",
                                    .since = base::UtcTime{},
                                    .vehicles = {{{"1"}, true, false, 2, "in AUTO"}}};
  EXPECT_EQ(json::parse(emergency_message(stop)),
            json::parse(R"({"type":"emergency","latched":true,"action":"land","by":"anna",
              "since":"1970-01-01T00:00:00.000Z","vehicles":[
              {"vehicle":"1","acknowledged":true,"confirmed":false,"tries":2,"detail":"in AUTO"}]})"));
}

TEST(ControlMessages, AreObeyed) {
  FakeControl control;
  auto const command = control_request("command", R"({"vehicles":["1"],"action":"arm"})");
  EXPECT_EQ(obey(&control, command, "operator 2"), 1u);
  EXPECT_EQ(control.records.back().by, "operator 2");
  EXPECT_TRUE(obey(&control, control_request("emergency_stop", R"({"operator":"anna"})"), "HTTP"));
  EXPECT_TRUE(control.stop.is_latched);
  EXPECT_EQ(control.stop.by, "anna");
  EXPECT_TRUE(obey(&control, control_request("release_emergency_stop", "{}"), "HTTP"));
  EXPECT_FALSE(control.stop.is_latched);
  for (auto const* what : {"request", "yield", "keep"})
    EXPECT_TRUE(obey(&control, control_request(std::string(what) + "_control", R"({"vehicle":"1"})"), "x"));
  EXPECT_EQ(control.said, (std::vector<std::string>{"request 1 by x", "yield 1 by x", "keep 1 by x"}));
}

TEST(ControlMessages, AreRefusedWhereNothingCanBeCommanded) {
  auto const done = obey(nullptr, control_request("emergency_stop", "{}"), "HTTP");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "These vehicles cannot be commanded.");
}

}  // namespace
}  // namespace lapwing::station
