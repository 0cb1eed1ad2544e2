#include "station/messages/health_messages.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/feeds/health_feed.hpp"
#include "station/testing/fake_modules.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;

TEST(HealthMessages, TellOfEachModuleWhatItSays) {
  testing::FakeModules const modules;
  auto const message = json::parse(health_message(modules.modules({})));
  EXPECT_EQ(message["type"], "health");
  auto const& robot = message["vehicles"].at(0);
  EXPECT_EQ(robot["id"], "robot1");
  EXPECT_EQ(robot["may_move"], false);
  EXPECT_EQ(robot["who"], "MMU");
  EXPECT_EQ(robot["needs_restart"], false);
  EXPECT_EQ(robot["modules"][0], json::parse(R"({"module": "SIM", "name": "sensors", "required": true,
      "state": "ready", "memory_bytes": 50000000, "cpu_share": 0.25, "rate_hz": 10.0, "age_s": 0.04})"));
  EXPECT_EQ(robot["modules"][1]["error"], json::parse(R"({"code": 302, "severity": "critical",
      "meaning": "The place is lost.", "what_to_do": "Carry it back."})"));
  EXPECT_EQ(robot["modules"][2],
            json::parse(R"({"module": "PLN", "name": "planner", "required": true, "state": "unheard"})"));
}

TEST(HealthFeed, TellsAtOnceWhatHappensAndOtherwiseOnceASecond) {
  testing::FakeModules modules;
  HealthFeed feed(modules);
  base::TimePoint const begun(10s);
  auto const first = feed.refresh(begun);
  EXPECT_GT(first, 0u);
  modules.list[0].modules[0].since_heard = 90ms;
  modules.list[0].modules[0].reports_per_s = 9.0;
  EXPECT_EQ(feed.refresh(begun + 200ms), first) << "an age that grows is no news";
  modules.list[0].modules[0].state = vehicle::ModuleState::silent;
  EXPECT_EQ(feed.refresh(begun + 400ms), first + 1);
  EXPECT_EQ(feed.refresh(begun + 600ms), first + 1);
  EXPECT_EQ(feed.refresh(begun + 1400ms), first + 2);
  auto const news = feed.since(first, begun + 1400ms, 1 << 16);
  EXPECT_TRUE(news.is_whole);
  EXPECT_EQ(news.frames.back().revision, first + 2);
  EXPECT_EQ(json::parse(news.frames.back().content)["vehicles"][0]["modules"][0]["age_s"], 0.09);
}

}  // namespace
}  // namespace lapwing::station
