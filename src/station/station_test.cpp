#include "station/station.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/http/openapi.hpp"
#include "station/testing/fake_alarms.hpp"
#include "station/testing/fake_control.hpp"
#include "station/testing/fake_parameters.hpp"
#include "station/testing/fake_script.hpp"
#include "station/testing/http_client.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using testing::Answer;
using testing::ask;
using testing::run_until;
using testing::WebSocketClient;

struct StationTest : ::testing::Test {
  void open(Station::Options options = {}) {
    options.http.port = 0;
    options.period = period;
    options.program_version = "1.2.3";
    auto opened = Station::open(loop, registry, control, hub, std::move(options));
    ASSERT_TRUE(opened) << opened.error().message;
    station = std::move(*opened);
  }
  Answer get(std::string target) { return ask(loop, station->port(), {.target = std::move(target)}); }
  Answer post(std::string target, std::string body) {
    return ask(loop, station->port(),
               {.method = "POST",
                .target = std::move(target),
                .headers = {{"Content-Type", "application/json"}},
                .body = std::move(body)});
  }
  std::unique_ptr<WebSocketClient> watch() {
    return WebSocketClient::open(loop, station->port(), {.target = "/api/v1/ws"});
  }
  /// The next message of that type, skipping others; null when none comes.
  static json next(WebSocketClient& client, std::string_view type) {
    while (auto const text = client.receive()) {
      auto message = json::parse(*text);
      if (message["type"] == type) return message;
    }
    return {};
  }
  void move_vehicle(double alt_m) {
    registry.edit({"1"}).motion.relative_alt_m.set(alt_m, loop.now());
    registry.touch({"1"});
  }

  std::chrono::milliseconds period{5};
  base::Loop loop;
  vehicle::Registry registry{loop};
  testing::FakeScript control;
  base::LogHub hub;
  std::unique_ptr<Station> station;
};

TEST_F(StationTest, TellsItsStatus) {
  open();
  move_vehicle(1);
  auto const status = json::parse(get("/api/v1/status").body);
  EXPECT_EQ(status["version"], "1.2.3");
  EXPECT_EQ(status["protocol"], 1);
  EXPECT_EQ(status["vehicles"], 1);
  EXPECT_EQ(status["script"]["state"], "idle");
}

TEST_F(StationTest, ListsVehicles) {
  open();
  move_vehicle(12);
  EXPECT_EQ(json::parse(get("/api/v1/vehicles").body)["vehicles"][0]["relative_alt_m"], 12.0);
}

TEST_F(StationTest, StartsAndStopsAScriptOverHttp) {
  open();
  auto const started = post("/api/v1/script", R"({"name":"a.dolphin","source":"text"})");
  EXPECT_EQ(started.status, 202);
  EXPECT_EQ(json::parse(started.body)["state"], "running");
  EXPECT_EQ(json::parse(get("/api/v1/script").body)["source"], "text");
  auto const again = post("/api/v1/script", R"({"source":"text"})");
  EXPECT_EQ(again.status, 409);
  EXPECT_EQ(json::parse(again.body)["hint"], "Stop it first.");
  EXPECT_EQ(post("/api/v1/stop", "{}").status, 202);
  EXPECT_EQ(control.stops, 1);
  EXPECT_EQ(control.current.state, ScriptState::stopping);
}

TEST_F(StationTest, RefusesScriptsThatDoNotCheckWithDiagnostics) {
  open();
  auto const answer = post("/api/v1/script", R"({"name":"a","source":""})");
  EXPECT_EQ(answer.status, 422);
  EXPECT_EQ(json::parse(answer.body)["diagnostics"][0]["message"], "nothing here");
  EXPECT_EQ(post("/api/v1/script", "no json").status, 400);
}

TEST_F(StationTest, TakesNoFormPosts) {
  open();
  auto const answer = ask(loop, station->port(), {.method = "POST", .target = "/api/v1/stop", .body = "x=1"});
  EXPECT_EQ(answer.status, 415);
  EXPECT_EQ(control.stops, 0);
}

TEST_F(StationTest, KeepsALimitedLog) {
  open({.log_history = 2});
  base::Logger const log(hub, "test");
  for (auto const* line : {"one", "two", "three"}) log.info(line);
  auto const lines = json::parse(get("/api/v1/log").body)["lines"];
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[0]["text"], "two");
  EXPECT_EQ(json::parse(get("/api/v1/log?after=2").body)["lines"].size(), 1U);
  EXPECT_EQ(get("/api/v1/log?after=x").status, 400);
}

TEST_F(StationTest, GivesAViewerTheWholeState) {
  open();
  move_vehicle(5);
  base::Logger(hub, "test").info("before");
  control.current.name = "a.dolphin";
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  std::string types;
  for (int i = 0; i < 6; ++i) types += json::parse(*viewer->receive())["type"].get<std::string>() + " ";
  EXPECT_EQ(types, "hello vehicles plan script tasks log ");
}

TEST_F(StationTest, SendsViewersTheNews) {
  open();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  EXPECT_EQ(next(*viewer, "vehicles")["full"], true);
  move_vehicle(7);
  auto const news = next(*viewer, "vehicles");
  EXPECT_EQ(news["full"], false);
  EXPECT_EQ(news["vehicles"][0]["relative_alt_m"], 7.0);
  control.trees = {{1, "mission", "m", 3, tasks::TaskState::running, {}, "", {}}};
  while (next(*viewer, "tasks")["trees"].empty()) {
  }
  base::Logger(hub, "test").warn("later");
  EXPECT_EQ(next(*viewer, "log")["lines"][0]["text"], "later");
}

TEST_F(StationTest, ShowsNewVehiclesAtOnce) {
  period = std::chrono::hours(1);
  open();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  EXPECT_EQ(next(*viewer, "vehicles")["full"], true);
  move_vehicle(7);
  registry.touch_membership({"1"});
  auto const news = next(*viewer, "vehicles");
  ASSERT_TRUE(news.contains("vehicles"));
  EXPECT_EQ(news["vehicles"][0]["id"], "1");
}

TEST_F(StationTest, ObeysViewers) {
  open();
  auto const viewer = watch();
  ASSERT_TRUE(viewer);
  viewer->send(R"({"type":"ping","id":"p"})");
  EXPECT_EQ(next(*viewer, "pong")["id"], "p");
  viewer->send(R"({"type":"start_script","id":"s","source":"text"})");
  EXPECT_EQ(next(*viewer, "reply"), json({{"type", "reply"}, {"id", "s"}, {"ok", true}}));
  viewer->send(R"({"type":"start_script","id":"t","source":"text"})");
  EXPECT_EQ(next(*viewer, "reply")["error"]["message"], "A script runs already.");
  viewer->send(R"({"type":"stop_script","id":"u"})");
  EXPECT_EQ(next(*viewer, "reply")["ok"], true);
  EXPECT_EQ(control.stops, 1);
  EXPECT_EQ(control.stopped_by, "a viewer");
  viewer->send("rubbish");
  EXPECT_EQ(next(*viewer, "reply")["ok"], false);
}

TEST_F(StationTest, LetsViewersCommandVehicles) {
  testing::FakeControl vehicles;
  open({.control = &vehicles});
  auto viewer = watch();
  ASSERT_TRUE(viewer);
  EXPECT_EQ(next(*viewer, "hello")["operator"], "operator 1");
  EXPECT_EQ(next(*viewer, "emergency")["latched"], false);
  viewer->send(R"({"type":"command","id":"a","vehicles":["1"],"action":"land","operator":"somebody else"})");
  EXPECT_EQ(next(*viewer, "reply")["ok"], true);
  EXPECT_EQ(vehicles.records.back().by, "operator 1");
  EXPECT_EQ(next(*viewer, "commands")["commands"][0]["action"], "land");
  viewer->send(R"({"type":"emergency_stop","id":"b"})");
  while (next(*viewer, "emergency")["latched"] != true) {
  }
  viewer->send(R"({"type":"command","id":"c","vehicles":["1"],"action":"jump"})");
  EXPECT_EQ(next(*viewer, "reply")["ok"], false);
  auto const second = watch();
  EXPECT_EQ(next(*second, "hello")["operator"], "operator 2");
  viewer.reset();
  EXPECT_TRUE(run_until(loop, [&] { return !vehicles.said.empty(); }));
  EXPECT_EQ(vehicles.said, std::vector<std::string>{"forget operator 1"});
}

TEST_F(StationTest, TellsEveryViewerOfAnAlarmAndWhoAcknowledgedIt) {
  testing::FakeControl vehicles;
  testing::FakeAlarms alarms;
  open({.control = &vehicles, .alarms = &alarms});
  auto const first = watch();
  auto const second = watch();
  EXPECT_TRUE(next(*first, "alarms")["alarms"].empty());
  EXPECT_TRUE(next(*second, "alarms")["alarms"].empty());
  alarms.raise(vehicle::AlarmKind::silent, "1", loop.now());
  EXPECT_EQ(next(*first, "alarms")["alarms"].at(0)["number"], 1);
  EXPECT_EQ(next(*second, "alarms")["alarms"].at(0)["number"], 1);
  second->send(R"({"type":"acknowledge_alarms","id":"a","numbers":[1],"operator":"somebody else"})");
  EXPECT_EQ(next(*first, "alarms")["alarms"].at(0)["acknowledged_by"], "operator 2");
  EXPECT_EQ(next(*second, "reply")["ok"], true);
  second->send(R"({"type":"acknowledge_alarms","id":"b","numbers":"all"})");
  EXPECT_EQ(next(*second, "reply")["ok"], false);
  auto const late = watch();
  EXPECT_EQ(next(*late, "alarms")["alarms"].size(), 1U) << "who comes later is told what stands";
}

TEST_F(StationTest, TellsOfAlarmsAndTakesAcknowledgementsOverHttp) {
  testing::FakeAlarms alarms;
  open({.alarms = &alarms});
  alarms.raise(vehicle::AlarmKind::fence, "2", loop.now());
  EXPECT_EQ(json::parse(get("/api/v1/alarms").body)["alarms"].at(0)["kind"], "fence");
  auto const answer = post("/api/v1/alarms/acknowledge", R"({"numbers":[1],"operator":"desk"})");
  EXPECT_EQ(answer.status, 200);
  EXPECT_EQ(json::parse(answer.body)["alarms"].at(0)["acknowledged_by"], "desk");
  EXPECT_EQ(post("/api/v1/alarms/acknowledge", R"({"numbers":[]})").status, 400);
}

TEST_F(StationTest, NoticesViewersThatGo) {
  open();
  auto viewer = watch();
  ASSERT_TRUE(viewer);
  EXPECT_EQ(station->viewers(), 1U);
  viewer.reset();
  EXPECT_TRUE(run_until(loop, [&] { return station->viewers() == 0; }));
}

TEST_F(StationTest, MayEndBeforeTheLog) {
  open();
  station.reset();
  base::Logger(hub, "test").info("nobody listens");
}

TEST_F(StationTest, OffersTheScriptsOfItsFolder) {
  Station::Options options;
  options.scripts = LAPWING_SOURCE_DIR "/examples";
  open(std::move(options));
  auto const names = json::parse(get("/api/v1/scripts").body)["scripts"];
  EXPECT_TRUE(std::ranges::any_of(names, [](auto const& script) { return script["name"] == "survey.dolphin"; }));
  auto const text = json::parse(get("/api/v1/scripts/text?name=survey.dolphin").body);
  EXPECT_EQ(text["name"], "survey.dolphin");
  EXPECT_NE(text["source"].get<std::string>().find("mission {"), std::string::npos);
  EXPECT_EQ(get("/api/v1/scripts/text").status, 400);
  EXPECT_EQ(get("/api/v1/scripts/text?name=..%2FREADME.md").status, 400);
  EXPECT_EQ(get("/api/v1/scripts/text?name=absent.dolphin").status, 404);
}

TEST_F(StationTest, OffersNoScriptsWithoutAFolder) {
  open();
  EXPECT_EQ(json::parse(get("/api/v1/scripts").body), (json{{"scripts", json::array()}}));
}

TEST_F(StationTest, NamesItsMapTiles) {
  Station::Options options;
  std::string const tiles = "https://tiles.example/{z}/{x}/{y}.png";
  options.site.tiles = tiles;
  open(std::move(options));
  EXPECT_EQ(json::parse(get("/api/v1/status").body)["site"]["tiles"], tiles);
}

TEST_F(StationTest, AsksForItsTokenOverHttpAndWebSocket) {
  Station::Options options;
  options.http.token = "0123456789abcdef";
  open(std::move(options));
  EXPECT_EQ(get("/api/v1/status").status, 401);
  EXPECT_EQ(get("/api/v1/scripts").status, 401);
  EXPECT_EQ(post("/api/v1/stop", "{}").status, 401);
  EXPECT_EQ(post("/api/v1/emergency-stop", "{}").status, 401);
  auto const with = [&](std::string token) {
    return ask(loop, station->port(),
               {.target = "/api/v1/status", .headers = {{"Authorization", "Bearer " + std::move(token)}}})
        .status;
  };
  EXPECT_EQ(with("0123456789abcdef"), 200);
  EXPECT_EQ(with("0123456789abcdeF"), 401);
  EXPECT_EQ(with("0123456789abcdef0"), 401);
  EXPECT_EQ(watch(), nullptr);
  auto const client = WebSocketClient::open(loop, station->port(), {.target = "/api/v1/ws?token=0123456789abcdef"});
  ASSERT_TRUE(client);
  EXPECT_EQ(next(*client, "hello")["protocol"], 1);
  EXPECT_EQ(control.stops, 0);
}

TEST_F(StationTest, SetsAParameterOverHttp) {
  testing::FakeParameters parameters(loop, std::chrono::milliseconds(20));
  open({.parameters = &parameters});
  auto const put = [this](std::string body, std::string content_type) {
    return ask(loop, station->port(),
               {.method = "PUT",
                .target = "/api/v1/parameters/value?vehicle=2&name=RTL_ALT",
                .headers = {{"Content-Type", std::move(content_type)}},
                .body = std::move(body)});
  };
  EXPECT_EQ(put(R"({"value":2000})", "text/plain").status, 415) << "another site's page could send that";
  EXPECT_EQ(put(R"({"value":2000,"filler":")" + std::string(2'000'000, 'x') + "\"}", "application/json").status, 413);
  EXPECT_EQ(parameters.changed_by, "");
  EXPECT_EQ(put(R"({"value":2000})", "application/json").status, 200);
  EXPECT_EQ(json::parse(get("/api/v1/parameters?vehicle=2").body)["parameters"][0]["value"], 2000);
}

TEST_F(StationTest, ServesItsDescription) {
  open();
  auto const answer = get("/api/openapi.yaml");
  EXPECT_EQ(answer.header("Content-Type"), "application/yaml");
  EXPECT_TRUE(answer.body.starts_with("openapi: 3.1.0"));
}

TEST_F(StationTest, ShowsTheMetricsThatItIsGiven) {
  open({.metrics = [] { return std::string("lapwing_test 1\n# EOF\n"); }});
  auto const answer = get("/metrics");
  EXPECT_EQ(answer.header("Content-Type"), "application/openmetrics-text; version=1.0.0; charset=utf-8");
  EXPECT_EQ(answer.body, "lapwing_test 1\n# EOF\n");
}

TEST_F(StationTest, HasAnEmptyPageOfMetricsOtherwise) {
  open();
  EXPECT_EQ(get("/metrics").body, "# EOF\n");
}

TEST_F(StationTest, IsDescribedByTheOpenApiFile) {
  open();
  // The file's own shape makes a YAML parser unnecessary: paths are indented by two, methods by four.
  std::set<std::string> described;
  std::istringstream lines{std::string(openapi_description())};
  std::string path;
  bool in_paths = false;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with(' ')) in_paths = line == "paths:";
    if (!in_paths) continue;
    if (line.starts_with("  /")) path = line.substr(2, line.size() - 3);
    for (std::string_view const method : {"get", "post", "put", "delete", "patch"}) {
      if (line == fmt::format("    {}:", method)) described.insert(fmt::format("{} {}", method, path));
    }
  }
  std::set<std::string> served;
  auto const router = station->make_router();
  for (auto const& route : router.routes()) {
    std::string method = route.method;
    std::ranges::transform(method, method.begin(), [](unsigned char c) { return std::tolower(c); });
    served.insert(fmt::format("{} {}", method, route.path));
  }
  EXPECT_EQ(described, served);
}

}  // namespace
}  // namespace lapwing::station
