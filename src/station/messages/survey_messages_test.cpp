#include "station/messages/survey_messages.hpp"

#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/async/loop.hpp"
#include "station/feeds/survey_feed.hpp"
#include "station/testing/fake_survey.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;

/// A quarter of a second after the fake drone's picture.
base::UtcTime const answered{std::chrono::milliseconds(1'700'000'000'250)};

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
      "position": {"lat_deg": 43.2585, "lon_deg": -79.9201}, "coverage": 0.813, "slots": {"free": 3, "taken": 4, "unknown": 1}})"));
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
  add_survey_routes(router, &survey, log, [] { return answered; });
  EXPECT_EQ(json::parse(answer(router, "GET", "/api/v1/survey").body)["drones"].size(), 2U);
  auto const taken = answer(router, "POST", "/api/v1/survey/hawk/commands", R"({"Type":"Arm"})");
  EXPECT_EQ(taken.status, 202);
  EXPECT_EQ(survey.commands, std::vector<std::string>{R"({"Type":"Arm"})"});
  auto const refused = answer(router, "POST", "/api/v1/survey/dove/commands", R"({"Type":"Arm"})");
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(json::parse(refused.body)["detail"], "dove is not connected");
}

TEST(SurveyRoutes, GiveAPictureWithItsDelay) {
  base::LogHub hub;
  base::Logger const log(hub, "station");
  base::Loop loop;
  testing::FakeSurvey survey;
  Router router;
  add_survey_routes(router, &survey, log, [] { return answered; });
  auto const ask = [&](std::string const& target) {
    auto reply = router.answer(request_for("GET", target).value());
    if (auto* const task = std::get_if<base::Task<HttpResponse>>(&reply)) return loop.run_until_done(std::move(*task));
    return std::get<HttpResponse>(std::move(reply));
  };
  auto const picture = ask("/api/v1/survey/hawk/picture?view=raw&after=6");
  EXPECT_EQ(picture.content_type, "image/jpeg");
  EXPECT_EQ(picture.body, "raw");
  std::map<std::string, std::string> headers;
  for (auto const& [name, value] : picture.headers) headers[name] = value;
  EXPECT_EQ(headers["Lapwing-Age-Ms"], "250");
  EXPECT_EQ(headers["Lapwing-Number"], "7");
  EXPECT_EQ(headers["Lapwing-Taken"], "2023-11-14T22:13:20.000Z");
  EXPECT_EQ(ask("/api/v1/survey/hawk/picture").body, "annotated");
  auto const none = ask("/api/v1/survey/dove/picture");
  EXPECT_EQ(none.status, 504);
  EXPECT_EQ(json::parse(none.body)["detail"], "NoImage: no picture for 3 s");
  EXPECT_EQ(ask("/api/v1/survey/hawk/picture?view=infrared").status, 400);
  EXPECT_EQ(ask("/api/v1/survey/hawk/picture?after=-1").status, 400);
}

TEST(SurveyRoutes, HandAViewersOfferToTheDroneAndItsAnswerBack) {
  base::LogHub hub;
  base::Logger const log(hub, "station");
  base::Loop loop;
  testing::FakeSurvey survey;
  Router router;
  add_survey_routes(router, &survey, log, [] { return answered; });
  auto const ask = [&](std::string const& method, std::string const& target, std::string type = "application/sdp") {
    auto request = request_for(method, target).value();
    request.headers = {{"Content-Type", std::move(type)}};
    request.body = "v=0";
    auto reply = router.answer(request);
    if (auto* const task = std::get_if<base::Task<HttpResponse>>(&reply)) return loop.run_until_done(std::move(*task));
    return std::get<HttpResponse>(std::move(reply));
  };
  auto const begun = ask("POST", "/api/v1/survey/hawk/video?view=raw");
  EXPECT_EQ(begun.status, 201);
  EXPECT_EQ(begun.content_type, "application/sdp");
  EXPECT_EQ(begun.body, "raw for v=0");
  std::map<std::string, std::string> headers;
  for (auto const& [name, value] : begun.headers) headers[name] = value;
  EXPECT_EQ(headers["Location"], "/api/v1/survey/hawk/video/5eed");
  EXPECT_EQ(headers["Lapwing-Now-Ms"], "1700000000250");
  EXPECT_EQ(ask("POST", "/api/v1/survey/hawk/video", "application/json").status, 415);
  EXPECT_EQ(ask("POST", "/api/v1/survey/hawk/video?view=infrared").status, 400);
  auto const lost = ask("POST", "/api/v1/survey/dove/video");
  EXPECT_EQ(lost.status, 409);
  EXPECT_EQ(json::parse(lost.body)["detail"], "FailedToSend: nobody answers at dove:3180");
  EXPECT_EQ(ask("DELETE", "/api/v1/survey/hawk/video/5eed").status, 200);
  EXPECT_EQ(survey.ended, std::vector<std::string>{"hawk"});
  EXPECT_EQ(ask("DELETE", "/api/v1/survey/hawk/video/another").status, 409);
}

TEST(SurveyRoutes, SayWhereThereIsNone) {
  base::LogHub hub;
  base::Logger const log(hub, "station");
  Router router;
  add_survey_routes(router, nullptr, log, [] { return answered; });
  EXPECT_EQ(answer(router, "GET", "/api/v1/survey").body, R"({"type":"survey","drones":[]})");
  EXPECT_EQ(answer(router, "POST", "/api/v1/survey/hawk/commands").status, 404);
  EXPECT_EQ(answer(router, "POST", "/api/v1/survey/hawk/video").status, 404);
}

}  // namespace
}  // namespace lapwing::station
