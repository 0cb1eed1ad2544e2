// The smaller feeds that every station has: what they tell a newcomer, who has all, and who missed something.
#include <array>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/feeds/alarms_feed.hpp"
#include "station/feeds/control_feed.hpp"
#include "station/feeds/log_feed.hpp"
#include "station/feeds/plans_feed.hpp"
#include "station/feeds/script_feed.hpp"
#include "station/feeds/tasks_feed.hpp"
#include "station/testing/fake_alarms.hpp"
#include "station/testing/fake_control.hpp"
#include "station/testing/fake_script.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

std::vector<json> since(Feed const& feed, std::uint64_t revision, base::TimePoint now = {}) {
  std::vector<json> messages;
  for (auto const& frame : feed.since(revision, now, 0).frames) messages.push_back(json::parse(frame.content));
  return messages;
}

TEST(PlansFeed, SendsPlansWhenTheyChange) {
  base::Loop loop{{.unpaced = true}};
  vehicle::Registry registry{loop};
  PlansFeed feed(registry);
  registry.touch({"1"});
  auto const empty = feed.refresh({});
  EXPECT_EQ(since(feed, 0).at(0)["path"], json::array()) << "a newcomer may hold an old one";
  registry.edit({"2"}).mission.planned_path = {geo::Wgs84::from_degrees(1, 2, 3)};
  registry.touch({"2"});
  auto const planned = feed.refresh({});
  EXPECT_GT(planned, empty);
  ASSERT_EQ(since(feed, empty).size(), 1U);
  EXPECT_EQ(
      since(feed, empty)[0],
      json({{"type", "plan"}, {"vehicle", "2"}, {"path", {{{"lat_deg", 1.0}, {"lon_deg", 2.0}, {"alt_m", 3.0}}}}}));
  EXPECT_EQ(since(feed, 0).size(), 2U);
  registry.touch({"2"});
  EXPECT_EQ(feed.refresh({}), planned) << "something else changed";
  registry.edit({"2"}).mission.planned_path.clear();
  registry.touch({"2"});
  (void)feed.refresh({});
  EXPECT_EQ(since(feed, planned).at(0)["path"], json::array());
}

TEST(ScriptFeed, SendsTheScriptAndItsTasksWhenTheyChange) {
  testing::FakeScript script;
  ScriptFeed feed(script);
  TasksFeed trees(script);
  auto const first = feed.refresh({});
  auto const no_trees = trees.refresh({});
  EXPECT_GT(first, 0U);
  EXPECT_EQ(feed.refresh({}), first);
  script.current.message = "waits";
  EXPECT_GT(feed.refresh({}), first);
  EXPECT_EQ(since(feed, first).at(0)["message"], "waits");
  EXPECT_EQ(trees.refresh({}), no_trees);
  script.trees = {{1, "mission", "m", 3, tasks::TaskState::running, {}, "", {}}};
  EXPECT_GT(trees.refresh({}), no_trees);
  EXPECT_EQ(since(trees, 0).at(0)["trees"].size(), 1U);
}

TEST(LogFeed, SendsTheLinesThatAViewerLacks) {
  base::LogHub hub;
  auto const history = keep_log(hub, 3);
  LogFeed feed(history);
  base::Logger const log(hub, "test");
  EXPECT_EQ(feed.refresh({}), 1U);
  EXPECT_TRUE(since(feed, 0).at(0)["lines"].empty()) << "a newcomer is told that there is nothing yet";
  EXPECT_TRUE(since(feed, 1).empty());
  for (auto const* line : {"one", "two"}) log.info(line);
  EXPECT_TRUE(since(feed, 1).empty()) << "it has not looked yet";
  auto const two = feed.refresh({});
  EXPECT_EQ(since(feed, 1).at(0)["lines"].size(), 2U);
  for (auto const* line : {"three", "four", "five", "six"}) log.info(line);
  (void)feed.refresh({});
  auto const left = since(feed, two).at(0)["lines"];
  ASSERT_EQ(left.size(), 3U);
  EXPECT_EQ(left[0]["text"], "four") << "three lines are kept";
}

TEST(ControlFeed, SendsTheStopAndTheCommandsEachWhenItChanges) {
  testing::FakeControl control;
  ControlFeed feed(control);
  auto const first = feed.refresh({});
  ASSERT_EQ(since(feed, 0).size(), 2U);
  EXPECT_EQ(since(feed, 0)[0]["type"], "emergency");
  EXPECT_EQ(since(feed, 0)[1]["type"], "commands");
  control.emergency_stop({}, "anna");
  auto const stopped = feed.refresh({});
  ASSERT_EQ(since(feed, first).size(), 1U);
  EXPECT_EQ(since(feed, first)[0]["latched"], true);
  std::array const vehicles{vehicle::VehicleId{"1"}};
  (void)control.command({.action = vehicle::Action::land}, vehicles, "anna", false);
  auto const landing = feed.refresh({});
  ASSERT_EQ(since(feed, stopped).size(), 1U);
  EXPECT_EQ(since(feed, stopped)[0]["type"], "commands");
  EXPECT_EQ(feed.since(first, {}, 0).frames.back().revision, landing);
  EXPECT_EQ(since(feed, first).size(), 2U) << "who missed both is told of both";
  EXPECT_TRUE(since(feed, landing).empty());
}

TEST(AlarmsFeed, SendsTheAlarmsWithTheirAgesAsTheyAreThen) {
  testing::FakeAlarms alarms;
  AlarmsFeed feed(&alarms);
  auto const none = feed.refresh({});
  alarms.raise(vehicle::AlarmKind::silent, "1", base::TimePoint(1s));
  EXPECT_GT(feed.refresh({}), none);
  EXPECT_EQ(since(feed, none, base::TimePoint(5s)).at(0)["alarms"].at(0)["age_s"], 4.0);
  AlarmsFeed nobody(nullptr);
  EXPECT_EQ(nobody.refresh({}), nobody.refresh({}));
  EXPECT_TRUE(since(nobody, 0).at(0)["alarms"].empty());
}

}  // namespace
}  // namespace lapwing::station
