// An old command centre at a robot in the small office: what it is told, and what it may have the robot do.
#include "robot/old_parts/text_port.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "link/byte_link.hpp"
#include "robot/seed_text/payload.hpp"
#include "robot/testing/platform_bench.hpp"
#include "robot/watch/codes.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;
using seed_text::Line;

/// A command centre that speaks nothing but text, as the far end of a stream.
struct OldCentre {
  void hear(link::Bytes bytes) {
    reader.feed(bytes, [this](std::string_view line) { lines.push_back(seed_text::read(line).value()); });
  }
  [[nodiscard]] std::vector<Line> from(Module module) const {
    std::vector<Line> found;
    std::ranges::copy_if(lines, std::back_inserter(found), [&](auto const& line) { return line.from == module; });
    return found;
  }
  [[nodiscard]] std::vector<std::string> points() const {
    std::vector<std::string> messages;
    for (auto const& line : from(Module::points_of_interest)) messages.push_back(line.message);
    return messages;
  }

  seed_text::LineReader reader;
  std::vector<Line> lines;
};

/// As TCP that waits for others is: they come and go.
struct ManyStreams final : link::ByteLink {
  [[nodiscard]] std::string name() const override { return "streams"; }
  [[nodiscard]] std::string peer_name(link::Peer peer) const override { return std::to_string(peer.key); }
  void start(Receive to) override { receive = std::move(to); }
  bool send(link::Peer peer, link::Bytes bytes, link::Urgency) override {
    if (!ends.contains(peer)) return false;
    ends[peer]->hear(bytes);
    return true;
  }
  [[nodiscard]] std::vector<link::Peer> standing_peers() const override {
    std::vector<link::Peer> peers;
    for (auto const& [peer, end] : ends) peers.push_back(peer);
    return peers;
  }
  [[nodiscard]] link::LinkState state() const override { return link::LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return {}; }
  [[nodiscard]] link::LinkCounters counters() const override { return {}; }

  Receive receive;
  std::map<link::Peer, OldCentre*> ends;
};

struct TextPortTest : ::testing::Test, testing::PlatformBench {
  void SetUp() override {
    hub.add_sink([this](base::LogRecord const& record) {
      if (record.level >= base::LogLevel::warn) warnings.push_back(record.text);
    });
    ASSERT_TRUE(run_until([this] { return robot->here().has_value(); }, 5s));
    streams->ends[{1}] = &centre;
    run_for(300ms);
  }
  void say(std::string const& line) const {
    auto const text = line + "\n";
    std::vector<std::uint8_t> const bytes(text.begin(), text.end());
    streams->receive({1}, bytes);
  }
  [[nodiscard]] seed_text::LogEntry last_log_of(Module module) const {
    return std::get<seed_text::LogEntry>(seed_text::read_payload(centre.from(module).back()).value());
  }
  void put_point(std::string const& id, std::string const& text, std::string const& writer = "robot1") {
    map::PointOfInterest const point{.position = {1.5, -0.5}, .kind = "name tag", .name = text, .text = text};
    ASSERT_TRUE(live_map.put(
        {.id = id, .site = "office", .account = {.writer = writer, .at = loop.utc_now()}, .content = point}));
  }

  std::vector<std::string> warnings;
  OldCentre centre;
  ManyStreams* streams = new ManyStreams;  // the port's
  TextPort port{{loop, *robot, control, authority, live_map}, std::unique_ptr<link::ByteLink>(streams), log};
};

TEST_F(TextPortTest, TellsTenTimesASecondHowEachModuleIsAndWhereTheRobotIs) {
  centre.lines.clear();
  run_for(1s);
  for (auto const module :
       {Module::sensors, Module::carrier, Module::mapping, Module::planner, Module::communication}) {
    auto lines = centre.from(module);
    std::erase_if(lines, [](auto const& line) { return line.to != Module::command_centre; });
    EXPECT_NEAR(static_cast<double>(lines.size()), 10, 1) << name_of(module).name;
    EXPECT_EQ(last_log_of(Module::carrier).state, ModuleState::ready);
  }
  auto poses = centre.from(Module::mapping);
  std::erase_if(poses, [](auto const& line) { return line.to != Module::visualizer; });
  ASSERT_FALSE(poses.empty());
  auto const pose = std::get<seed_text::Pose>(seed_text::read_payload(poses.back()).value());
  EXPECT_NEAR(pose.x_m, body->truth().x, 0.1);
  EXPECT_NEAR(pose.y_m, body->truth().y, 0.1);
  EXPECT_LT(poses.front().stamp, poses.back().stamp);
  EXPECT_LT(poses.back().stamp, 10s) << "counted from the start";
}

TEST(TextPort, SpeaksForItselfAloneBeforeTheRobotIsHeard) {
  testing::PlatformBench bench;
  bench.body->is_numb = true;
  OldCentre centre;
  auto streams = std::make_unique<ManyStreams>();
  streams->ends[{1}] = &centre;
  TextPort const port({bench.loop, *bench.robot, bench.control, bench.authority, bench.live_map}, std::move(streams),
                      bench.log);
  bench.run_for(1s);
  EXPECT_FALSE(centre.from(Module::communication).empty());
  EXPECT_TRUE(centre.from(Module::sensors).empty());
}

TEST_F(TextPortTest, AModuleThatIsSilentIsSilentHereToo) {
  body->is_numb = true;
  run_for(1s);
  centre.lines.clear();
  run_for(1s);
  EXPECT_TRUE(centre.from(Module::sensors).empty());
  EXPECT_FALSE(centre.from(Module::planner).empty());
}

TEST_F(TextPortTest, StartsTheNormalRunAndStopsIt) {
  say("CC_PLN_1000_CONTINUE");
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  EXPECT_EQ(state().control.commander, "the old command centre");
  say("CC_PLN_2000_STOP");
  EXPECT_TRUE(run_until([this] { return robot->stands(); }, 3s));
  EXPECT_FALSE(robot->is_driving());
}

TEST_F(TextPortTest, AKillHoldsUntilItIsToldToGoOnTwice) {
  say("CC_PLN_1000_CONTINUE");
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  say("CC_CAR_2000_Kill");
  ASSERT_TRUE(run_until([this] { return robot->is_killed() && robot->stands(); }, 2s));
  body->carrier_code = code::killed;
  run_for(1s);
  EXPECT_EQ(last_log_of(Module::carrier).error_code, code::killed);
  body->carrier_code = code::none;
  say("CC_PLN_3000_CONTINUE");
  ASSERT_TRUE(run_until([this] { return !robot->needs_restart(); }, 2s));
  run_for(3s);
  EXPECT_TRUE(robot->stands()) << "it is let go, and not sent off";
  auto const before_m = body->driven_m();
  say("CC_PLN_4000_CONTINUE");
  EXPECT_TRUE(run_until([&] { return body->driven_m() > before_m + 0.5; }, 1min));
}

TEST_F(TextPortTest, KillsWhoeverCommandsTheRobotAndStartsNothingThatIsSomebodyElses) {
  auto const run = start({ExploreStep{"tour"}});
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  say("CM_CAR_2000_e-Stop");
  ASSERT_TRUE(run_until([this] { return robot->is_killed() && robot->stands(); }, 2s));
  EXPECT_EQ(run->state(), tasks::RunState::failed);
  std::vector<vehicle::VehicleId> const ids{{"robot1"}};
  ASSERT_TRUE(control.command({.action = vehicle::Action::arm}, ids, "anna", true));
  ASSERT_TRUE(run_until([this] { return !robot->needs_restart(); }, 2s));
  say("CC_PLN_4000_CONTINUE");
  run_for(2s);
  EXPECT_FALSE(robot->is_driving());
  EXPECT_NE(warnings.back().find("is commanded by anna"), std::string::npos) << warnings.back();
}

TEST_F(TextPortTest, TellsPointsOfInterestOnceAndInOrderAlsoToWhoComesLater) {
  put_point("b", "221");
  run_for(300ms);
  put_point("a", "222 \"lab\"");
  put_point("of another", "300", "robot2");
  run_for(300ms);
  put_point("b", "223");
  run_for(500ms);
  std::vector<std::string> const all{"\"Name Tag\", \"221\", 150, -50", "\"Name Tag\", \"222 'lab'\", 150, -50",
                                     "\"Name Tag\", \"223\", 150, -50"};
  EXPECT_EQ(centre.points(), all);
  OldCentre late;
  streams->ends[{2}] = &late;
  run_for(500ms);
  EXPECT_EQ(late.points(), (std::vector{all[1], all[2]}));
  EXPECT_EQ(centre.points(), all);
}

TEST_F(TextPortTest, GivesUpTheCommandOfWhoIsGoneAndTheRobotGoesOn) {
  say("CC_PLN_1000_CONTINUE");
  ASSERT_TRUE(run_until([this] { return body->driven_m() > 1.0; }, 1min));
  EXPECT_TRUE(port.has_listener());
  streams->ends.clear();
  run_for(200ms);
  EXPECT_FALSE(port.has_listener());
  EXPECT_EQ(state().control.commander, "");
  auto const before_m = body->driven_m();
  EXPECT_TRUE(run_until([&] { return body->driven_m() > before_m + 1.0; }, 1min));
}

TEST_F(TextPortTest, ShowsHowOldPartsSayTheyAreAmongTheModules) {
  say("VSL_CM_100_ready:701:4096");
  run_for(100ms);
  auto const all = robot->watch().health(loop.now());
  auto const& visualizer = all[static_cast<std::size_t>(Module::visualizer)];
  EXPECT_TRUE(visualizer.was_heard);
  EXPECT_EQ(visualizer.report.error_code, 701);
  EXPECT_TRUE(robot->watch().clearance(loop.now()).may_move);
}

TEST_F(TextPortTest, WhatIsWrongIsSaidOnceInAWhileAndChangesNothing) {
  warnings.clear();
  for (int i = 0; i < 100; ++i) say("PLN_CAR_5_High");
  say(std::string(5'000, 'x'));
  run_for(5s);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings.front().find("takes nothing of that kind from PLN to CAR"), std::string::npos) << warnings.front();
  EXPECT_TRUE(robot->stands());
  run_for(10s);
  say("nonsense");
  run_for(100ms);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings.back().find("101 lines"), std::string::npos) << warnings.back();
}

TEST_F(TextPortTest, AFloodOfOrdersIsHeldBackAndAKillAmongThemIsNot) {
  for (int i = 0; i < 1'000; ++i) say("CC_PLN_5_STOP");
  for (int i = 0; i < 1'000; ++i) say("CC_CAR_5_Kill");
  ASSERT_TRUE(run_until([this] { return robot->is_killed(); }, 2s));
  auto const kills = std::ranges::count_if(
      control.commands(), [](auto const& record) { return record.command.action == vehicle::Action::disarm; });
  EXPECT_EQ(kills, 1);
  EXPECT_LE(control.commands().back().number, 11U);
}

}  // namespace
}  // namespace lapwing::robot
