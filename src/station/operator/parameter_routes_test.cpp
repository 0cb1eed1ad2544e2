#include "station/operator/parameter_routes.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/fake_parameters.hpp"

namespace lapwing::station {
namespace {

using namespace std::chrono_literals;
using nlohmann::json;

struct ParameterRoutes : ::testing::Test {
  ParameterRoutes() { add_parameter_routes(router, &parameters); }
  HttpResponse ask(HttpRequest request) {
    auto reply = router.answer(request);
    request = {};  // the work outlives it
    if (auto* const response = std::get_if<HttpResponse>(&reply)) return std::move(*response);
    return loop.run_until_done(std::get<base::Task<HttpResponse>>(std::move(reply)));
  }
  HttpResponse get(std::string path, std::string query) {
    return ask({.method = "GET", .path = "/api/v1/parameters" + path, .query = std::move(query)});
  }
  HttpResponse put(std::string query, std::string body) {
    return ask(
        {.method = "PUT", .path = "/api/v1/parameters/value", .query = std::move(query), .body = std::move(body)});
  }

  base::Loop loop{{.unpaced = true}};
  testing::FakeParameters parameters{loop, 2s};
  Router router;
};

TEST_F(ParameterRoutes, ListThoseOfAVehicle) {
  auto const answer = get("", "vehicle=2");
  EXPECT_EQ(answer.status, 200);
  auto const list = json::parse(answer.body);
  EXPECT_EQ(list["vehicle"], "2");
  EXPECT_EQ(list["confirmed"], "vehicle");
  EXPECT_EQ(list["parameters"].size(), 19u);
  EXPECT_EQ(list["parameters"][0], json({{"name", "RTL_ALT"}, {"value", 1500}, {"type", "int32"}}));
  EXPECT_EQ(list["parameters"][2].dump(), R"({"name":"COMPASS_DEC","type":"real32","value":0.1})") << "as the float is";
}

TEST_F(ParameterRoutes, TellHowFarAListHasCome) {
  EXPECT_EQ(json::parse(get("/progress", "vehicle=2").body), json({{"vehicle", "2"}, {"fetching", false}}));
  auto list = std::get<base::Task<HttpResponse>>(
      router.answer({.method = "GET", .path = "/api/v1/parameters", .query = "vehicle=2"}));
  list.start();
  EXPECT_EQ(json::parse(get("/progress", "vehicle=2").body),
            json({{"vehicle", "2"}, {"fetching", true}, {"done", 0}, {"total", 19}}));
}

TEST_F(ParameterRoutes, GiveOldOnesOnlyWhenTheyWillDo) {
  EXPECT_EQ(json::parse(get("", "vehicle=2&cached=true").body)["confirmed"], "no");
  EXPECT_EQ(get("", "vehicle=2&cached=perhaps").status, 400);
}

TEST_F(ParameterRoutes, GiveAFile) {
  auto const file = get("/file", "vehicle=2");
  EXPECT_EQ(file.content_type, "text/plain; charset=utf-8");
  EXPECT_EQ(file.headers.at(0).value, "attachment; filename=\"vehicle-2.params\"");
  EXPECT_EQ(file.body, "2\t1\tRTL_ALT\t1500\t6\n");
}

TEST_F(ParameterRoutes, ReadAndSetOne) {
  EXPECT_EQ(json::parse(get("/value", "vehicle=2&name=WPNAV_SPEED").body)["value"], 1000);
  auto const set = put("vehicle=2&name=WPNAV_SPEED", R"({"value":801.5,"operator":"anna"})");
  EXPECT_EQ(set.status, 200);
  EXPECT_EQ(json::parse(set.body),
            json({{"vehicle", "2"}, {"name", "WPNAV_SPEED"}, {"value", 801.5}, {"type", "real32"}, {"before", 1000}}));
  EXPECT_EQ(parameters.changed_by, "anna");
  EXPECT_EQ(json::parse(get("/value", "vehicle=2&name=WPNAV_SPEED").body)["value"], 801.5);
  EXPECT_EQ(put("vehicle=2&name=RTL_ALT", R"({"value":2000})").status, 200);
  EXPECT_EQ(parameters.changed_by, "HTTP");
}

TEST_F(ParameterRoutes, RefuseWhatIsNoValue) {
  for (auto const* body : {R"({"value":NaN})", R"({"value":1e999})", R"({"value":"7"})", R"({"value":null})", "{}", "7",
                           R"({"value":true})", R"({"value":7,"operator":"script"})", ""}) {
    EXPECT_EQ(put("vehicle=2&name=RTL_ALT", body).status, 400) << body;
  }
  EXPECT_EQ(parameters.changed_by, "");
  auto const fraction = put("vehicle=2&name=RTL_ALT", R"({"value":0.5})");
  EXPECT_EQ(fraction.status, 400);
  EXPECT_EQ(json::parse(fraction.body)["detail"], "RTL_ALT cannot be 0.5: it is an integer");
}

TEST_F(ParameterRoutes, RefuseARequestThatDoesNotSayWhatFor) {
  EXPECT_EQ(get("", "").status, 400);
  EXPECT_EQ(get("/value", "vehicle=2").status, 400);
  EXPECT_EQ(put("name=RTL_ALT", R"({"value":1})").status, 400);
}

TEST_F(ParameterRoutes, TellWhatTheVehicleSaid) {
  EXPECT_EQ(get("", "vehicle=9").status, 404);
  EXPECT_EQ(get("/file", "vehicle=9").status, 404);
  auto const unknown = get("/value", "vehicle=2&name=NO_SUCH");
  EXPECT_EQ(unknown.status, 504);
  EXPECT_EQ(json::parse(unknown.body)["hint"], "check the name");
  auto const clamped = put("vehicle=2&name=WPNAV_SPEED", R"({"value":5000})");
  EXPECT_EQ(clamped.status, 409);
  EXPECT_EQ(json::parse(clamped.body)["detail"], "vehicle 2 stored WPNAV_SPEED = 2000, not 5000");
  parameters.refusals["2"] = {base::ErrorKind::lost, "copter 2 is not heard", "ask again when it is back"};
  EXPECT_EQ(put("vehicle=2&name=RTL_ALT", R"({"value":1})").status, 409);
}

TEST_F(ParameterRoutes, AreNotThereForARecording) {
  router = {};
  add_parameter_routes(router, nullptr);
  EXPECT_EQ(get("", "vehicle=2").status, 409);
  EXPECT_EQ(put("vehicle=2&name=RTL_ALT", R"({"value":1})").status, 409);
}

}  // namespace
}  // namespace lapwing::station
