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

std::string complaint(std::string_view type, std::string_view text) {
  auto const request = parse_control_request(type, text);
  return request ? "" : request.error().message;
}

TEST(ControlMessages, ReadACommandWithWhatItNeeds) {
  auto const request = parse_control_request("command", R"({"vehicles":["1","2"],"action":"go_to","height_m":30,
    "lat_deg":52.5,"lon_deg":13.25,"take_over":true,"operator":"anna"})");
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->by, "anna");
  auto const& asked = std::get<CommandVehicles>(request->what);
  EXPECT_EQ(asked.command.action, Action::go_to);
  EXPECT_EQ(asked.command.height_m, 30.0);
  EXPECT_NEAR(asked.command.place->lat_deg(), 52.5, 1e-9);
  EXPECT_EQ(asked.vehicles.size(), 2u);
  EXPECT_TRUE(asked.takes_over);
}

TEST(ControlMessages, ReadWhatMayBeImplausibleAndWhy) {
  auto const request = parse_control_request(
      "command", R"({"vehicles":["1"],"action":"go_to","lat_deg":1,"lon_deg":2,"allow":{"too_far":"area B"}})");
  ASSERT_TRUE(request) << request.error().message;
  std::map<std::string, std::string> const expected{{"too_far", "area B"}};
  EXPECT_EQ(std::get<CommandVehicles>(request->what).command.allow, expected);
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"allow":["too_far"]})"),
            R"("allow" must name rules with the reasons.)");
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"allow":{"too_far":1}})"),
            R"("allow": the reason of "too_far" must be a text.)");
}

TEST(ControlMessages, ReadEveryAction) {
  for (std::string_view const word : {"arm", "disarm", "take_off", "land", "rtl", "hold", "go_to", "set_mode",
                                      "start_mission", "pause_mission", "resume_mission"}) {
    auto const text = json{{"vehicles", {"1"}}, {"action", word}}.dump();
    auto const request = parse_control_request("command", text);
    ASSERT_TRUE(request) << word;
    EXPECT_EQ(vehicle::to_string(std::get<CommandVehicles>(request->what).command.action), word);
  }
}

TEST(ControlMessages, SayWhatIsWrongWithACommand) {
  EXPECT_EQ(complaint("command", R"({"vehicles":["1"]})"), R"(There is no action "".)");
  EXPECT_EQ(complaint("command", R"({"action":"jump","vehicles":["1"]})"), R"(There is no action "jump".)");
  for (auto const* vehicles : {"[]", "[1]", "\"1\"", "null"})
    EXPECT_EQ(complaint("command", std::string(R"({"action":"arm","vehicles":)") + vehicles + "}"),
              R"("vehicles" must be a list of vehicle ids.)");
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"height_m":"high"})"),
            R"("height_m" must be a number.)");
  EXPECT_EQ(complaint("command", R"({"action":"go_to","vehicles":["1"],"lat_deg":95,"lon_deg":1})"),
            R"("lat_deg" and "lon_deg" must be a place on Earth.)");
  EXPECT_EQ(complaint("command", R"({"action":"go_to","vehicles":["1"],"lat_deg":5})"),
            R"("lat_deg" and "lon_deg" must be a place on Earth.)");
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"take_over":1})"),
            R"("take_over" must be true or false.)");
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"operator":"script"})"),
            R"("operator" must be a short name, other than script.)");
  EXPECT_EQ(complaint("emergency_stop", R"({"action":"explode"})"), R"(An emergency stop cannot be "explode".)");
  EXPECT_EQ(complaint("yield_control", "{}"), R"("vehicle", whose command changes, is missing.)");
  EXPECT_EQ(complaint("command", "[]"), "This is no JSON object.");
}

TEST(ControlMessages, ReadStopsAndHandovers) {
  auto const stop = parse_control_request("emergency_stop", R"({"action":"terminate"})");
  EXPECT_EQ(std::get<StopAll>(stop->what).action, StopAction::terminate);
  EXPECT_FALSE(std::get<StopAll>(parse_control_request("emergency_stop", "{}")->what).action);
  auto const keep = parse_control_request("keep_control", R"({"vehicle":"3"})");
  EXPECT_EQ(std::get<ChangeCommander>(keep->what).vehicle.text, "3");
  EXPECT_EQ(std::get<ChangeCommander>(keep->what).what, ChangeCommander::What::keep);
}

TEST(ControlMessages, ShowHowFarACommandHasCome) {
  std::deque<vehicle::CommandRecord> const records{
      {.number = 7,
       .command = {.action = Action::take_off, .height_m = 12.0},
       .by = "operator 1",
       .asked = base::UtcTime{},
       .outcomes = {{{"1"}, CommandState::confirmed, "at 12 m", {}},
                    {{"2"}, CommandState::waiting, "", {}},
                    {{"3"}, CommandState::under_way, "at 7 of 12 m", 4.96},
                    {{"4"}, CommandState::cut_short, "emergency stop by anna, at 3 of 12 m", {}}}}};
  EXPECT_EQ(json::parse(commands_message(records)),
            json::parse(R"({"type":"commands","commands":[{"number":7,"action":"take_off","height_m":12.0,
              "by":"operator 1","asked":"1970-01-01T00:00:00.000Z","vehicles":[
              {"vehicle":"1","state":"confirmed","reason":"at 12 m"},{"vehicle":"2","state":"waiting"},
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
  auto const command = parse_control_request("command", R"({"vehicles":["1"],"action":"arm"})");
  EXPECT_EQ(obey(&control, *command, "operator 2"), 1u);
  EXPECT_EQ(control.records.back().by, "operator 2");
  EXPECT_TRUE(obey(&control, *parse_control_request("emergency_stop", R"({"operator":"anna"})"), "HTTP"));
  EXPECT_TRUE(control.stop.is_latched);
  EXPECT_EQ(control.stop.by, "anna");
  EXPECT_TRUE(obey(&control, *parse_control_request("release_emergency_stop", "{}"), "HTTP"));
  EXPECT_FALSE(control.stop.is_latched);
  for (auto const* what : {"request", "yield", "keep"})
    EXPECT_TRUE(obey(&control, *parse_control_request(std::string(what) + "_control", R"({"vehicle":"1"})"), "x"));
  EXPECT_EQ(control.said, (std::vector<std::string>{"request 1 by x", "yield 1 by x", "keep 1 by x"}));
}

TEST(ControlMessages, AreRefusedWhereNothingCanBeCommanded) {
  auto const done = obey(nullptr, *parse_control_request("emergency_stop", "{}"), "HTTP");
  ASSERT_FALSE(done);
  EXPECT_EQ(done.error().message, "These vehicles cannot be commanded.");
}

}  // namespace
}  // namespace lapwing::station
