#include "station/messages/messages.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

TEST(Messages, SayHello) {
  Hello const hello{"1.2.3", {"field", geo::Wgs84::from_degrees(1, 2, 3)}, base::UtcTime{} + 1'700'000'000'123ms};
  EXPECT_EQ(json::parse(hello_message(hello)), json::parse(R"({"type":"hello","protocol":1,"version":"1.2.3",
    "server_time":"2023-11-14T22:13:20.123Z","site":{"name":"field","origin":{"lat_deg":1.0,"lon_deg":2.0,"alt_m":3.0}}})"));
}

TEST(Messages, ListFeedsInTheHello) {
  Hello hello{"1.2.3", {}, {}};
  hello.feeds = {.run = "4f", .feeds = {{"vehicles", 1, true}, {"map", 2, false}}};
  auto const message = json::parse(hello_message(hello));
  EXPECT_EQ(message["run"], "4f");
  EXPECT_EQ(message["feeds"],
            json::parse(R"([{"name":"vehicles","id":1,"usual":true},{"name":"map","id":2,"usual":false}])"));
}

TEST(Messages, DescribeTheScript) {
  base::DiagnosticRecord const record{"a.dolphin", {1, 6}, {1, 7}, "error", "expected a name", "name it", {}, "syntax"};
  ScriptStatus const status{"a.dolphin", "pick { }", ScriptState::failed, "does not check", {record}};
  EXPECT_EQ(json::parse(script_message(status)), json::parse(R"({"type":"script","name":"a.dolphin","state":"failed",
    "message":"does not check","source":"pick { }","diagnostics":[{"severity":"error","file":"a.dolphin","line":1,
    "column":6,"end_line":1,"end_column":7,"code":"syntax","message":"expected a name","hint":"name it"}]})"));
}

TEST(Messages, DescribeTaskTrees) {
  tasks::TaskView const leaf{2,           "mission", "m1", 5, tasks::TaskState::running, vehicle::VehicleId{"1"},
                             "item 3/12", {}};
  tasks::TaskView const root{1, "sequence", "", 4, tasks::TaskState::running, {}, "", {leaf}};
  EXPECT_EQ(json::parse(tasks_message({{root}})),
            json::parse(R"({"type":"tasks","trees":[{"id":1,"kind":"sequence","label":"",
    "line":4,"state":"running","children":[{"id":2,"kind":"mission","label":"m1","line":5,"state":"running","vehicle":"1",
    "detail":"item 3/12"}]}]})"));
}

TEST(Messages, CarryLogLines) {
  LogLine const line{7, {base::LogLevel::warn, base::UtcTime{} + 5ms, "vehicle 1", "low battery"}};
  EXPECT_EQ(json::parse(log_message({{line}})), json::parse(R"({"type":"log","lines":[{"seq":7,
    "time":"1970-01-01T00:00:00.005Z","level":"warn","source":"vehicle 1","text":"low battery"}]})"));
}

TEST(Messages, AnswerRequests) {
  EXPECT_EQ(json::parse(accepted_message("r1")), json({{"type", "reply"}, {"id", "r1"}, {"ok", true}}));
  auto const refused = json::parse(refused_message("r2", {{base::ErrorKind::refused, "one runs", "stop it"}, {}}));
  EXPECT_EQ(refused["ok"], false);
  EXPECT_EQ(refused["error"], json({{"message", "one runs"}, {"hint", "stop it"}}));
}

TEST(Messages, ListDiagnosticsOfAFailedStart) {
  base::DiagnosticRecord const note{"f", {5, 6}, {5, 7}, "note", "first defined here", "", {}, ""};
  StartFailure const failure{{base::ErrorKind::invalid_input, "2 mistakes", ""},
                             {{"f", {1, 2}, {1, 3}, "error", "first", "", {note}, ""},
                              {"f", {3, 4}, {3, 5}, "warning", "second", "", {}, ""}}};
  auto const body = json::parse(start_failure_body(422, "Unprocessable Content", failure));
  EXPECT_EQ(body["status"], 422);
  EXPECT_EQ(body["diagnostics"].size(), 2U);
  EXPECT_EQ(body["diagnostics"][0]["notes"][0]["line"], 5);
  EXPECT_EQ(body["diagnostics"][1]["severity"], "warning");
}

}  // namespace
}  // namespace lapwing::station
