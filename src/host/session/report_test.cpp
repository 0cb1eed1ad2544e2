#include "host/session/report.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lapwing::host {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

base::UtcTime utc(std::chrono::milliseconds since_epoch) {
  return base::UtcTime(std::chrono::duration_cast<base::UtcTime::duration>(since_epoch));
}

RunReport example() {
  RunReport report;
  report.script = "a.dolphin";
  report.outcome = "error";
  report.started = utc(1'000ms);
  report.ended = utc(61'500ms);
  report.vehicles = {{.id = "1",
                      .system_id = 1,
                      .type = "copter",
                      .track_m = 12.5,
                      .pictures = 3,
                      .missions = {{"North", 9, 0.25, "done", ""}}}};
  tasks::TaskView child;
  child.kind = "mission";
  child.line = 3;
  child.vehicle = vehicle::VehicleId{"1"};
  tasks::TaskView root;
  root.kind = "sequence";
  root.state = tasks::TaskState::failed;
  root.children = {child};
  report.tasks = {root};
  report.errors = {{"a.dolphin", 9, "no such thing"}};
  return report;
}

TEST(Report, HasEveryKeyOfTheContract) {
  auto const report = json::parse(to_json(example()));
  EXPECT_EQ(report["script"], "a.dolphin");
  EXPECT_EQ(report["outcome"], "error");
  EXPECT_EQ(report["started"], "1970-01-01T00:00:01.000Z");
  EXPECT_EQ(report["ended"], "1970-01-01T00:01:01.500Z");
  auto const& vehicle = report["vehicles"][0];
  EXPECT_EQ(vehicle["id"], "1");
  EXPECT_EQ(vehicle["system_id"], 1);
  EXPECT_EQ(vehicle["type"], "copter");
  EXPECT_EQ(vehicle["track_m"], 12.5);
  EXPECT_EQ(vehicle["pictures"], 3);
  EXPECT_EQ(vehicle["missions"][0]["name"], "North");
  EXPECT_EQ(vehicle["missions"][0]["items"], 9);
  EXPECT_EQ(vehicle["missions"][0]["upload_s"], 0.25);
  EXPECT_EQ(vehicle["missions"][0]["outcome"], "done");
  EXPECT_EQ(report["errors"][0], (json{{"file", "a.dolphin"}, {"line", 9}, {"message", "no such thing"}}));
}

TEST(Report, TellsWhatRobotsHaveMappedAndOfThemAlone) {
  auto told = example();
  EXPECT_FALSE(json::parse(to_json(told))["vehicles"][0].contains("robot"));
  RobotReport robot{.coverage = 0.5, .free_m2 = 120.5, .closures = 2};
  robot.signs = {"220", "221 office"};
  robot.drives = {{"Office", "failed", "it is lost"}};
  told.vehicles.front().robot = robot;
  auto const report = json::parse(to_json(told));
  EXPECT_EQ(report["vehicles"][0]["robot"], json::parse(R"({"coverage": 0.5, "free_m2": 120.5, "closures": 2,
    "doors": 2, "signs": ["220", "221 office"],
    "drives": [{"name": "Office", "outcome": "failed", "error": "it is lost"}]})"));
  told.vehicles.front().robot->drives.front().remark = "2 places are left unseen";
  EXPECT_EQ(json::parse(to_json(told))["vehicles"][0]["robot"]["drives"][0]["remark"], "2 places are left unseen");
  told.vehicles.front().robot->collisions = 3;
  EXPECT_EQ(json::parse(to_json(told))["vehicles"][0]["robot"]["collisions"], 3);
}

TEST(Report, NestsTasks) {
  auto const report = json::parse(to_json(example()));
  auto const& root = report["tasks"][0];
  EXPECT_EQ(root["state"], "failed");
  EXPECT_TRUE(root["vehicle"].is_null());
  EXPECT_EQ(root["children"][0]["vehicle"], "1");
  EXPECT_EQ(root["children"][0]["line"], 3);
  EXPECT_TRUE(root["children"][0]["children"].empty());
}

TEST(Report, OfNothingHasEmptyLists) {
  auto const report = json::parse(to_json(RunReport{}));
  for (auto const* key : {"vehicles", "tasks", "errors"})
    EXPECT_TRUE(report[key].is_array() && report[key].empty()) << key;
}

TEST(Report, SurvivesTextThatIsNoUtf8) {
  auto report = example();
  report.errors[0].message = "bad \xff byte";
  EXPECT_EQ(json::parse(to_json(report))["errors"][0]["message"], "bad \xEF\xBF\xBD byte");
}

TEST(RunReport, TellsWhatWasSeenOfACarParkAndHowTrueThatIs) {
  auto report = example();
  EXPECT_FALSE(json::parse(to_json(report)).contains("car_park"));
  report.car_park = {
      .pictures = 7,
      .coverage = 0.75,
      .free = 3,
      .taken = 4,
      .unknown = 1,
      .score = LotScore{.true_slots = 10, .found = 8, .told = 7, .right = 6, .invented = 1, .off_m = 0.25}};
  EXPECT_EQ(json::parse(to_json(report))["car_park"],
            json::parse(R"({"pictures": 7, "coverage": 0.75, "free": 3, "taken": 4,
      "unknown": 1, "score": {"true_slots": 10, "found": 8, "told": 7, "right": 6, "invented": 1, "off_m": 0.25}})"));
}

}  // namespace
}  // namespace lapwing::host
