#include "station/messages/client_request.hpp"
#include "base/testing/cpu_time.hpp"

#include <chrono>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::station {
namespace {

using nlohmann::json;
using vehicle::Action;
using vehicle::StopAction;

TEST(ClientRequest, ReadRequests) {
  auto const start = parse_client_request(R"({"type":"start_script","id":"a","name":"n","source":"text"})");
  ASSERT_TRUE(start);
  EXPECT_EQ(start->id, "a");
  EXPECT_EQ(std::get<StartScript>(start->what).name, "n");
  EXPECT_EQ(std::get<StartScript>(start->what).source, "text");
  EXPECT_TRUE(std::holds_alternative<StopScript>(parse_client_request(R"({"type":"stop_script"})")->what));
  EXPECT_TRUE(std::holds_alternative<Ping>(parse_client_request(R"({"type":"ping","more":[1,2]})")->what));
}

TEST(ClientRequest, SayWhatIsWrongWithARequest) {
  auto const message_of = [](std::string_view text) {
    auto const request = parse_client_request(text);
    return request ? std::string("accepted") : request.error().message;
  };
  EXPECT_EQ(message_of("rubbish"), "This is no JSON object.");
  EXPECT_EQ(message_of("[]"), "This is no JSON object.");
  EXPECT_EQ(message_of(std::string(100'000, '[')), "This is no JSON object.");
  EXPECT_EQ(message_of(R"({"a":)" + std::string(100'000, '[')), "This is no JSON object.");
  EXPECT_EQ(message_of("{\"type\":\"\xff\"}"), "This is no JSON object.");
  EXPECT_EQ(message_of(R"({})"), "There is no request of type \"\".");
  EXPECT_EQ(message_of(R"({"type":"fly"})"), "There is no request of type \"fly\".");
  EXPECT_EQ(message_of(R"({"type":3})"), "\"type\" must be text.");
  EXPECT_EQ(message_of(R"({"type":"ping","id":5})"), "\"id\" must be text.");
  EXPECT_EQ(message_of(R"({"type":"start_script"})"), "\"source\", the script's text, is missing.");
  EXPECT_EQ(message_of(R"({"type":"start_script","source":null})"), "\"source\" must be text.");
  EXPECT_EQ(message_of(R"({"type":"start_script","source":"","name":[]})"), "\"name\" must be text.");
}

TEST(ClientRequest, ReadSubscriptions) {
  auto const request =
      parse_client_request(R"({"type":"subscribe","id":"a","feeds":["log","map"],"run":"4f","revisions":{"log":12}})");
  ASSERT_TRUE(request);
  auto const& subscribe = std::get<Subscribe>(request->what);
  EXPECT_EQ(subscribe.feeds, (std::vector<std::string>{"log", "map"}));
  EXPECT_EQ(subscribe.run, "4f");
  EXPECT_EQ(subscribe.revisions, (std::map<std::string, std::uint64_t>{{"log", 12}}));
  EXPECT_TRUE(std::get<Subscribe>(parse_client_request(R"({"type":"subscribe","feeds":[]})")->what).feeds.empty());
  auto const message_of = [](std::string_view members) {
    auto const wrong = parse_client_request(fmt::format(R"({{"type":"subscribe"{}}})", members));
    return wrong ? std::string("accepted") : wrong.error().message;
  };
  std::string const no_feeds = "\"feeds\" must be a list of feeds' names.";
  for (auto const* members : {"", R"(,"feeds":"log")", R"(,"feeds":{"log":1})", R"(,"feeds":[1])"})
    EXPECT_EQ(message_of(members), no_feeds) << members;
  EXPECT_EQ(message_of(fmt::format(R"(,"feeds":["{}"])", std::string(101, 'x'))), no_feeds);
  std::string const no_revisions = "\"revisions\" must give a number for each feed that it names.";
  for (auto const* revisions : {"12", "[12]", R"({"log":-1})", R"({"log":1.5})", R"({"log":"1"})"})
    EXPECT_EQ(message_of(fmt::format(R"(,"feeds":[],"revisions":{})", revisions)), no_revisions) << revisions;
  EXPECT_EQ(message_of(R"(,"feeds":[],"run":1)"), "\"run\" must be text.");
}

TEST(ClientRequest, ReadTheBodyThatStartsAScript) {
  EXPECT_EQ(std::get<StartScript>(*parse_request_body("start_script", R"({"source":"x"})")).name, "script");
  EXPECT_FALSE(parse_request_body("start_script", ""));
  EXPECT_FALSE(parse_request_body("start_script", R"({"name":"x"})"));
}

std::string complaint(std::string_view type, std::string_view text) {
  auto const request = parse_request_body(type, text);
  return request ? "" : request.error().message;
}

TEST(ClientRequest, ReadACommandWithWhatItNeeds) {
  auto const request = parse_request_body("command", R"({"vehicles":["1","2"],"action":"go_to","height_m":30,
    "lat_deg":52.5,"lon_deg":13.25,"take_over":true,"operator":"anna"})");
  ASSERT_TRUE(request) << request.error().message;
  auto const& control = std::get<ControlRequest>(*request);
  EXPECT_EQ(control.by, "anna");
  auto const& asked = std::get<CommandVehicles>(control.what);
  EXPECT_EQ(asked.command.action, Action::go_to);
  EXPECT_EQ(asked.command.height_m, 30.0);
  EXPECT_NEAR(asked.command.place->lat_deg(), 52.5, 1e-9);
  EXPECT_EQ(asked.vehicles.size(), 2u);
  EXPECT_TRUE(asked.takes_over);
}

TEST(ClientRequest, ReadWhatMayBeImplausibleAndWhy) {
  auto const request = parse_request_body(
      "command", R"({"vehicles":["1"],"action":"go_to","lat_deg":1,"lon_deg":2,"allow":{"too_far":"area B"}})");
  ASSERT_TRUE(request) << request.error().message;
  std::map<std::string, std::string> const expected{{"too_far", "area B"}};
  EXPECT_EQ(std::get<CommandVehicles>(std::get<ControlRequest>(*request).what).command.allow, expected);
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"allow":["too_far"]})"),
            R"("allow" must name rules with the reasons.)");
  EXPECT_EQ(complaint("command", R"({"action":"arm","vehicles":["1"],"allow":{"too_far":1}})"),
            R"("allow": the reason of "too_far" must be a text.)");
}

TEST(ClientRequest, ReadEveryAction) {
  for (std::string_view const word : {"arm", "disarm", "take_off", "land", "rtl", "hold", "go_to", "set_mode",
                                      "start_mission", "pause_mission", "resume_mission"}) {
    auto const text = json{{"vehicles", {"1"}}, {"action", word}}.dump();
    auto const request = parse_request_body("command", text);
    ASSERT_TRUE(request) << word;
    EXPECT_EQ(vehicle::to_string(std::get<CommandVehicles>(std::get<ControlRequest>(*request).what).command.action),
              word);
  }
}

TEST(ClientRequest, SayWhatIsWrongWithACommand) {
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

TEST(ClientRequest, ReadStopsAndHandovers) {
  auto const stop = parse_request_body("emergency_stop", R"({"action":"terminate"})");
  EXPECT_EQ(std::get<StopAll>(std::get<ControlRequest>(*stop).what).action, StopAction::terminate);
  auto const plain = parse_request_body("emergency_stop", "{}");
  EXPECT_FALSE(std::get<StopAll>(std::get<ControlRequest>(*plain).what).action);
  auto const keep = parse_request_body("keep_control", R"({"vehicle":"3"})");
  auto const& change = std::get<ChangeCommander>(std::get<ControlRequest>(*keep).what);
  EXPECT_EQ(change.vehicle.text, "3");
  EXPECT_EQ(change.what, ChangeCommander::What::keep);
}

TEST(ClientRequest, ReadWhatIsAcknowledgedByWhom) {
  auto const read = parse_request_body("acknowledge_alarms", R"({"numbers":[3,5],"operator":"desk"})");
  ASSERT_TRUE(read);
  auto const& asked = std::get<AcknowledgeAlarms>(*read);
  EXPECT_EQ(asked.numbers, (std::vector<std::uint64_t>{3, 5}));
  EXPECT_EQ(asked.by, "desk");
  EXPECT_FALSE(parse_request_body("acknowledge_alarms", R"({})"));
  EXPECT_FALSE(parse_request_body("acknowledge_alarms", R"({"numbers":[]})"));
  EXPECT_FALSE(parse_request_body("acknowledge_alarms", R"({"numbers":[-1]})"));
  EXPECT_FALSE(parse_request_body("acknowledge_alarms", R"({"numbers":["all"]})"));
  EXPECT_FALSE(parse_request_body("acknowledge_alarms", R"([1])"));
}

/// A browser's message may be a megabyte, and the loop that reads it keeps vehicles in the air.
TEST(ClientRequest, OfVeryManyMembersIsReadWithoutDelay) {
  std::string text = R"({"type":"ping")";
  for (int i = 0; text.size() < 1'000'000; ++i) text += fmt::format(R"(,"{}":0)", i);
  auto const begin = base::cpu_time();
  EXPECT_TRUE(parse_client_request(text + "}"));
  EXPECT_LT(base::cpu_time() - begin, std::chrono::seconds(4));
}

}  // namespace
}  // namespace lapwing::station
