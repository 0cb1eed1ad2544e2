// Drones and robots in one script: a session with simulated MAVLink vehicles and the test platform's vehicles beside
// them, in one registry, under one authority, with one emergency stop.

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/session/console.hpp"
#include "host/session/session.hpp"
#include "sim/model/vehicle_spec.hpp"
#include "tasks/failed_run.hpp"
#include "tasks/harness_platform.hpp"
#include "vehicle/testing/recording_control.hpp"

namespace lapwing::host {
namespace {

using namespace std::chrono_literals;
using vehicle::VehicleId;
using Words = std::vector<std::string>;

/// A run that tells when it is stopped.
class NotedRun final : public tasks::TaskRun {
 public:
  NotedRun(std::unique_ptr<tasks::TaskRun> run, std::string what, Words& said)
      : run_(std::move(run)), what_(std::move(what)), said_(said) {}
  [[nodiscard]] tasks::RunState state() const override { return run_->state(); }
  [[nodiscard]] std::string error() const override { return run_->error(); }
  [[nodiscard]] std::string progress() const override { return run_->progress(); }
  void stop() override {
    said_.push_back("stop " + what_);
    run_->stop();
  }

 private:
  std::unique_ptr<tasks::TaskRun> run_;
  std::string what_;
  Words& said_;
};

/// The vehicles a1, a2 (UAV), u1, u2 (UUV) of the test platform, which fly no missions, shown as other vehicles are.
class Robots final : public tasks::HarnessPlatform {
 public:
  Robots(base::Loop& loop, vehicle::Registry& registry, vehicle::Authority& authority)
      : HarnessPlatform(loop), loop_(loop), authority_(authority) {
    for (auto const& info : vehicles()) {
      auto& state = registry.edit(info.id);
      state.name = "robot " + info.id.text;
      state.links.heard = state.links.heartbeat_heard = loop.now();
      state.motion.position.set(*info.position, loop.now());
      registry.touch_membership(info.id);
    }
  }
  [[nodiscard]] std::unique_ptr<tasks::TaskRun> start(std::shared_ptr<tasks::PlatformTask const> task,
                                                      VehicleId const& id) override {
    auto const what = fmt::format("{} on {}", task->name(), id.text);
    if (auto claimed = authority_.claim(id, vehicle::script_commander); !claimed)
      return std::make_unique<tasks::FailedRun>(claimed.error().message);
    said.push_back("start " + what);
    return std::make_unique<NotedRun>(HarnessPlatform::start(std::move(task), id), what, said);
  }
  [[nodiscard]] base::Task<void> settle() override {
    co_await loop_.sleep(2s);
    for (auto const& info : vehicles()) (void)authority_.yield(info.id, vehicle::script_commander);
    said.emplace_back("settled");
  }

  Words said;

 private:
  base::Loop& loop_;
  vehicle::Authority& authority_;
};

struct TwoPlatforms : ::testing::Test {
  TwoPlatforms() {
    session.hub.add_sink([this](base::LogRecord const& record) {
      if (record.source == "task" && record.text.starts_with("START")) started.push_back(record.text);
      if (record.source == "platforms" || record.source == script_source) said.push_back(record.text);
    });
    robots = std::make_unique<Robots>(session.loop, session.ground.registry, session.ground.authority);
    joined = session.join("robots", {*robots, &robot_control}).has_value();
  }
  void SetUp() override {
    ASSERT_TRUE(joined);
    sim::WorldOptions world;
    world.vehicles = *sim::parse_vehicles("copter:1");
    ASSERT_TRUE(session.simulate(std::move(world)));
  }
  /// Runs the script to its end and gives the outcome's word.
  std::string run(std::string const& script) {
    auto const is_started = session.host.start("test.dolphin", script);
    EXPECT_TRUE(is_started) << session.host.rendered_diagnostics();
    if (!is_started) return "does not check";
    session.run_to_end(20min);
    return outcome_word(*session.host.outcome());
  }
  /// The same, with something done once all of it is under way.
  std::string run(std::string const& script, std::function<void()> const& what) {
    base::Scope scope(session.loop);
    scope.spawn(meanwhile(what));
    return run(script);
  }
  base::Task<> meanwhile(std::function<void()> what) {
    while (!is_flying() || robots->said.empty()) co_await session.loop.sleep(500ms);
    what();
  }
  [[nodiscard]] bool is_flying() const {
    auto const* copter = session.ground.registry.find({"1"});
    return copter && copter->motion.relative_alt_m.value.value_or(0.0) > 5.0;
  }
  [[nodiscard]] vehicle::VehicleState const& copter() const { return *session.ground.registry.find({"1"}); }
  [[nodiscard]] bool has_said(std::string_view part) const {
    return std::ranges::any_of(said, [&](auto const& line) { return line.contains(part); });
  }

  std::unique_ptr<Robots> robots;  // before the session, which they outlive
  vehicle::testing::RecordingControl robot_control{{"a1", "a2", "u1", "u2"}, 1};
  Words started;
  Words said;
  Session session{{.speedup = 0.0, .log_level = base::LogLevel::error, .seed = 1}};
  bool joined = false;
};

/// Flies for half a minute and lands.
constexpr auto hop = R"(
base = location(41.1780, -8.5980, 90)
hop = mission { name 'hop'; home base; takeOff location(41.1780, -8.5980, 105); move 40, 0; returnHomeAndLand() }
)";
/// Flies until it is stopped.
constexpr auto circles = R"(
base = location(41.1780, -8.5980, 90)
circles = mission { name 'circles'; home base; takeOff location(41.1780, -8.5980, 105); moveAndLoiterPos 40, 0, 0 }
)";

TEST_F(TwoPlatforms, AreInOneScript) {
  EXPECT_EQ(run(std::string(hop) + R"(
all = pick { type 'UAV'; count 3; timeout 60 }
message all
execute (hop | task('scan:4')) >> (task('park:2') | hop)
release all
boat = pick { type 'UUV' }
execute boat: task('dive:1')
)"),
            "done");
  EXPECT_TRUE(has_said("{ 1 a1 a2 }"));
  EXPECT_EQ(started, (Words{"START hop vehicle=1", "START scan vehicle=a1", "START park vehicle=a1",
                            "START hop vehicle=1", "START dive vehicle=u1"}))
      << "each by a vehicle that can do it";
  auto const report = session.report();
  ASSERT_EQ(report.vehicles.size(), 5u);
  EXPECT_EQ(report.vehicles.front().missions.size(), 2u);
}

TEST_F(TwoPlatforms, SayWhyTheOthersVehiclesCannot) {
  EXPECT_EQ(run(std::string(hop) + "v = pick { id 'a1' }\nexecute v: hop"), "error");
  EXPECT_EQ(session.host.outcome()->message,
            "TaskError: No vehicles to run task hop! (a1: hop is a task of another platform)");
  EXPECT_EQ(run("v = pick { id '1'; timeout 60 }\nexecute v: task('scan:1')"), "error");
  EXPECT_EQ(session.host.outcome()->message, "TaskError: No vehicles to run task scan! (1: scan is no mission)");
}

TEST_F(TwoPlatforms, StopTogetherWhenTheScriptIsStopped) {
  EXPECT_EQ(run(std::string(circles) +
                    "d = pick { id '1'; timeout 60 }\nr = pick { id 'a1' }\nexecute circles | task('scan:600')",
                [this] { session.host.stop("an interrupt"); }),
            "interrupted");
  EXPECT_EQ(robots->said, (Words{"start scan on a1", "stop scan on a1", "settled"}));
  EXPECT_EQ(copter().mode.value, "BRAKE") << "what a copter holds its place by";
  EXPECT_TRUE(session.platform.unsettled().empty());
}

TEST_F(TwoPlatforms, AreStoppedByOneEmergencyStop) {
  auto const script = std::string(circles) +
                      "d = pick { id '1'; timeout 60 }\nr = pick { id 'a1' }\nexecute circles | task('scan:600')";
  EXPECT_EQ(run(script, [this] { session.all_control.emergency_stop(std::nullopt, "anna"); }), "halted");
  auto const& emergency = session.all_control.emergency();
  EXPECT_TRUE(emergency.is_latched);
  EXPECT_TRUE(session.control.emergency().is_latched && robot_control.emergency().is_latched);
  EXPECT_EQ(emergency.vehicles.size(), 5u);
  EXPECT_EQ(robots->said, (Words{"start scan on a1", "stop scan on a1", "settled"}));
  EXPECT_NE(copter().mode.value, "AUTO");
  EXPECT_FALSE(session.host.start("test.dolphin", script)) << "no script runs while it is latched";
  EXPECT_EQ(session.ground.authority.claim({"a1"}, "ben").error().message, "emergency stop by anna: release it first");
  session.all_control.release_emergency_stop("anna");
  EXPECT_FALSE(session.control.emergency().is_latched || robot_control.emergency().is_latched);
  EXPECT_TRUE(session.ground.authority.claim({"a1"}, "ben"));
}

TEST_F(TwoPlatforms, AreCommandedAsOne) {
  EXPECT_EQ(run("v = pick { id '1'; timeout 60 }"), "done");
  std::vector<VehicleId> const ids{{"a2"}, {"1"}, {"nobody"}};
  ASSERT_TRUE(session.all_control.command({.action = vehicle::Action::set_mode, .mode = "GUIDED"}, ids, "anna", false));
  session.loop.run_until_done([](Session& here) -> base::Task<> { co_await here.loop.sleep(10s); }(session));
  auto const& outcomes = session.all_control.commands().back().outcomes;
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_EQ(outcomes[0].state, vehicle::CommandState::confirmed);
  EXPECT_EQ(outcomes[1].state, vehicle::CommandState::confirmed) << outcomes[1].reason;
  EXPECT_EQ(outcomes[2].reason, "there is no vehicle nobody");
  EXPECT_EQ(copter().mode.value, "GUIDED");
  EXPECT_EQ(robot_control.commands().back().outcomes.size(), 1u);
}

TEST_F(TwoPlatforms, HaveOneCommanderAVehicle) {
  ASSERT_TRUE(session.ground.authority.claim({"a1"}, "anna"));
  EXPECT_EQ(run("v = pick { id 'a1' }\nexecute v: task('scan:1')"), "error");
  EXPECT_NE(session.host.outcome()->message.find("robot a1 is commanded by anna"), std::string::npos);
  EXPECT_EQ(session.ground.registry.find({"a1"})->control.commander, "anna");
}

TEST_F(TwoPlatforms, GiveNobodyAVehicleWhoseIdBothHave) {
  auto second = robots->vehicles().front();
  second.id = {"1"};
  robots->set_vehicle(std::move(second));
  EXPECT_EQ(run("pause 10\nv = pick { id '1'; timeout 20 }"), "halted");
  auto const conflict = "conflict: MAVLink and robots each have a vehicle 1";
  EXPECT_TRUE(has_said(conflict));
  EXPECT_FALSE(session.platforms.find({"1"})->connected);
  EXPECT_EQ(run("v = pick { id 'a1' }"), "done") << "the others go on";
}

TEST_F(TwoPlatforms, WarnOfAnyVehicleOfTheRegistry) {
  auto& robot = session.ground.registry.edit({"u1"});
  vehicle::Battery nearly_empty;
  nearly_empty.remaining = 0.05;
  robot.power.battery.set(nearly_empty, session.loop.now());
  session.ground.registry.touch({"u1"});
  EXPECT_EQ(run("pause 3"), "done");
  auto const& alarms = session.ground.fleet.alarms().alarms();
  auto const of_robot = std::ranges::find(alarms, VehicleId{"u1"}, &vehicle::Alarm::vehicle);
  ASSERT_NE(of_robot, alarms.end());
  EXPECT_EQ(of_robot->name, "robot u1");
}

TEST_F(TwoPlatforms, RefuseAPlatformThatTakesTheWordsOfAnother) {
  tasks::HarnessPlatform other(
      session.loop,
      {.builders = {{.name = "mission", .commands = {}, .doc = "Other.", .begin = {}}}, .instructions = {}});
  auto const refused = session.join("other", {other});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message,
            "other does not go with the platforms before it: the block word mission has two meanings");
}

}  // namespace
}  // namespace lapwing::host
