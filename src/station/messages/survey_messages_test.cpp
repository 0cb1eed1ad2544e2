#include "station/messages/survey_messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/feeds/survey_feed.hpp"
#include "station/testing/fake_survey.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;

HttpResponse answer(Router const& router, std::string method, std::string const& target, std::string body = {}) {
  auto request = request_for(std::move(method), target).value();
  request.body = std::move(body);
  return std::get<HttpResponse>(router.answer(request));
}

TEST(SurveyMessages, TellWhatEachDroneSaysAndLeaveOutWhatItDoesNot) {
  testing::FakeSurvey const survey;
  auto const message = json::parse(survey_message(survey.drones()));
  EXPECT_EQ(message["type"], "survey");
  EXPECT_EQ(message["drones"].at(0), json::parse(R"({"name": "hawk", "connected": true,
      "words": [{"at": "2023-11-14T22:13:20.000Z", "text": "it climbs"}],
      "state": "AutonomousExplore", "mode": "GUIDED", "armed": true, "healthy": true,
      "user_error": "No_Lot_Detected", "height_m": 12.35, "battery": 0.812,
      "position": {"lat_deg": 43.2585, "lon_deg": -79.9201}, "slots": {"free": 3, "taken": 4, "unknown": 1}})"));
  EXPECT_EQ(message["drones"].at(1),
            json::parse(R"({"name": "dove", "connected": false, "trouble": "connection refused", "words": []})"));
}

TEST(SurveyFeed, TellsWhatIsNew) {
  testing::FakeSurvey survey;
  SurveyFeed feed(survey);
  auto const first = feed.refresh({});
  EXPECT_EQ(feed.refresh({}), first);
  survey.list[0].state = "Hover";
  EXPECT_GT(feed.refresh({}), first);
}

TEST(SurveyRoutes, HandCommandsToTheDroneThatIsNamed) {
  base::LogHub hub;
  base::Logger const log(hub, "station");
  testing::FakeSurvey survey;
  Router router;
  add_survey_routes(router, &survey, log);
  EXPECT_EQ(json::parse(answer(router, "GET", "/api/v1/survey").body)["drones"].size(), 2U);
  auto const taken = answer(router, "POST", "/api/v1/survey/hawk/commands", R"({"Type":"Arm"})");
  EXPECT_EQ(taken.status, 202);
  EXPECT_EQ(survey.commands, std::vector<std::string>{R"({"Type":"Arm"})"});
  auto const refused = answer(router, "POST", "/api/v1/survey/dove/commands", R"({"Type":"Arm"})");
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(json::parse(refused.body)["detail"], "dove is not connected");
}

TEST(SurveyRoutes, SayWhereThereIsNone) {
  base::LogHub hub;
  base::Logger const log(hub, "station");
  Router router;
  add_survey_routes(router, nullptr, log);
  EXPECT_EQ(answer(router, "GET", "/api/v1/survey").body, R"({"type":"survey","drones":[]})");
  EXPECT_EQ(answer(router, "POST", "/api/v1/survey/hawk/commands").status, 404);
}

}  // namespace
}  // namespace lapwing::station
