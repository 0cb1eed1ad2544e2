#include "station/operator/control_routes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/fake_control.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;

struct ControlRoutes : ::testing::Test {
  ControlRoutes() { add_control_routes(router, &control, log); }
  HttpResponse post(std::string path, std::string body) {
    return std::get<HttpResponse>(router.answer({.method = "POST", .path = std::move(path), .body = std::move(body)}));
  }
  HttpResponse get(std::string path) {
    return std::get<HttpResponse>(router.answer({.method = "GET", .path = std::move(path)}));
  }

  base::Logger log;
  testing::FakeControl control;
  Router router;
};

TEST_F(ControlRoutes, GiveACommandAndShowIt) {
  auto const given = post("/api/v1/commands", R"({"vehicles":["1","2"],"action":"rtl"})");
  EXPECT_EQ(given.status, 202);
  EXPECT_EQ(json::parse(given.body)["number"], 1);
  EXPECT_EQ(json::parse(given.body)["by"], "HTTP");
  control.records.back().outcomes[1].state = vehicle::CommandState::accepted;
  auto const shown = json::parse(get("/api/v1/commands").body)["commands"][0];
  EXPECT_EQ(shown["vehicles"][1], json({{"vehicle", "2"}, {"state", "accepted"}}));
}

TEST_F(ControlRoutes, StopEverythingAndReleaseIt) {
  auto const stopped = post("/api/v1/emergency-stop", R"({"action":"land","operator":"anna"})");
  EXPECT_EQ(stopped.status, 202);
  EXPECT_EQ(json::parse(stopped.body)["latched"], true);
  EXPECT_EQ(json::parse(get("/api/v1/emergency-stop").body)["by"], "anna");
  EXPECT_EQ(post("/api/v1/emergency-stop/release", "{}").status, 202);
  EXPECT_EQ(json::parse(get("/api/v1/emergency-stop").body)["latched"], false);
}

TEST_F(ControlRoutes, RefuseWithAReason) {
  EXPECT_EQ(post("/api/v1/commands", "{}").status, 400);
  EXPECT_EQ(post("/api/v1/commands", "nonsense").status, 400);
  control.refusal = base::Error{base::ErrorKind::refused, "ben asks for it already", ""};
  auto const refused = post("/api/v1/control/request", R"({"vehicle":"1"})");
  EXPECT_EQ(refused.status, 409);
  EXPECT_EQ(json::parse(refused.body)["detail"], "ben asks for it already");
  control.refusal = base::Error{base::ErrorKind::not_found, "there is no vehicle 9", ""};
  EXPECT_EQ(post("/api/v1/control/yield", R"({"vehicle":"9"})").status, 404);
}

TEST_F(ControlRoutes, ShowNothingToCommandOfARecording) {
  router = {};
  add_control_routes(router, nullptr, log);
  EXPECT_EQ(post("/api/v1/emergency-stop", "{}").status, 409);
  auto const shown = get("/api/v1/commands");
  EXPECT_EQ(json::parse(shown.body)["commands"], json::array());
}

}  // namespace
}  // namespace lapwing::station
