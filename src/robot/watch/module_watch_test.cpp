#include "robot/watch/module_watch.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "robot/watch/codes.hpp"
#include "robot/watch/process_use.hpp"
#include "robot/watch/self_report.hpp"

namespace lapwing::robot {
namespace {

using namespace std::chrono_literals;

base::TimePoint at(base::Duration time) {
  return base::TimePoint(time);
}

ModuleReport ready(std::uint16_t code = 0) {
  return {.state = ModuleState::ready, .error_code = code, .memory_bytes = 1'000'000, .cpu_share = 0.1};
}

void all_report(ModuleWatch& watch, base::TimePoint now) {
  for (auto const module : WatchSettings{}.required) watch.report(module, ready(), now);
}

TEST(ModuleWatch, LetsNothingMoveBeforeEveryModuleIsReady) {
  ModuleWatch watch;
  EXPECT_EQ(watch.clearance(at(1s)).reason, "sensors (SIM) has not started");
  all_report(watch, at(1s));
  EXPECT_TRUE(watch.clearance(at(1s)).may_move);
  watch.report(Module::planner, {.state = ModuleState::starting}, at(1s));
  auto const clearance = watch.clearance(at(1s));
  EXPECT_FALSE(clearance.may_move);
  EXPECT_EQ(clearance.who, Module::planner);
  EXPECT_EQ(clearance.reason, "planner (PLN) is not ready yet");
}

TEST(ModuleWatch, NamesTheModuleThatFallsSilentAndLetsGoOnWhenItIsBack) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  for (auto const module : {Module::sensors, Module::carrier, Module::planner})
    watch.report(module, ready(), at(1300ms));
  EXPECT_TRUE(watch.clearance(at(1300ms)).may_move);
  auto const silent = watch.clearance(at(1301ms));
  EXPECT_FALSE(silent.may_move);
  EXPECT_EQ(silent.who, Module::mapping);
  EXPECT_EQ(silent.reason, "mapping (MMU) has been silent for 0.3 s");
  watch.report(Module::mapping, ready(), at(1400ms));
  EXPECT_TRUE(watch.clearance(at(1400ms)).may_move);
}

TEST(ModuleWatch, ACriticalErrorStopsAndALesserOneDoesNot) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  watch.report(Module::mapping, ready(code::mapping_slow), at(1s));
  EXPECT_TRUE(watch.clearance(at(1s)).may_move);
  watch.report(Module::mapping, ready(code::pose_lost), at(1s));
  auto const lost = watch.clearance(at(1s));
  EXPECT_FALSE(lost.may_move);
  EXPECT_EQ(lost.reason, "mapping (MMU) reports error 302: The place on the map is not known any more.");
  EXPECT_FALSE(lost.what_to_do.empty());
  watch.report(Module::mapping, ready(4711), at(1s));
  EXPECT_EQ(watch.clearance(at(1s)).reason, "mapping (MMU) reports error 4711: none that this program knows");
  watch.report(Module::mapping, {.state = ModuleState::failed}, at(1s));
  EXPECT_EQ(watch.clearance(at(1s)).reason, "mapping (MMU) has failed");
  watch.report(Module::mapping, ready(), at(1100ms));
  EXPECT_EQ(watch.clearance(at(1100ms)).reason, "mapping (MMU) had failed a moment ago");
}

TEST(ModuleWatch, WaitsForAMomentWithoutACriticalErrorBeforeItLetsGoOn) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  watch.report(Module::carrier, ready(code::left_wheel_dead), at(1s));
  all_report(watch, at(1100ms));
  EXPECT_EQ(watch.clearance(at(1100ms)).reason,
            "carrier (CAR) reported a moment ago error 203: The left wheel is driven and gives no pulses.");
  all_report(watch, at(2900ms));
  EXPECT_FALSE(watch.clearance(at(2900ms)).may_move);
  all_report(watch, at(3s));
  EXPECT_TRUE(watch.clearance(at(3s)).may_move);
}

TEST(ModuleWatch, NamesWhoSaysWhatIsWrongBeforeWhoIsSilent) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  watch.report(Module::carrier, ready(code::board_away), at(1500ms));
  auto const clearance = watch.clearance(at(1500ms));
  EXPECT_EQ(clearance.who, Module::carrier) << clearance.reason;
}

TEST(ModuleWatch, AnOutageOfTheOperatorsPartsStopsNothing) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  for (auto const module : {Module::visualizer, Module::command_centre, Module::communication})
    watch.report(module, ready(), at(0s));
  EXPECT_TRUE(watch.clearance(at(1s)).may_move);
}

TEST(ModuleWatch, AfterAKillOnlyAnOperatorRestartsItAndOnlyWhenAllAreWell) {
  ModuleWatch watch;
  all_report(watch, at(1s));
  watch.kill();
  all_report(watch, at(1100ms));
  EXPECT_EQ(watch.clearance(at(1100ms)).reason, "the robot was killed");
  auto const early = watch.restart(at(2s));
  ASSERT_FALSE(early);
  EXPECT_EQ(early.error().message, "the robot cannot be restarted yet: sensors (SIM) has been silent for 0.9 s");
  EXPECT_TRUE(watch.is_killed());
  all_report(watch, at(3s));
  EXPECT_TRUE(watch.restart(at(3s)));
  EXPECT_TRUE(watch.clearance(at(3s)).may_move);
}

TEST(ModuleWatch, ShowsEachModulesHealth) {
  ModuleWatch watch;
  for (int i = 0; i < 30; ++i) watch.report(Module::mapping, ready(), at(i * 100ms));
  auto const health = watch.health(at(3100ms));
  ASSERT_EQ(health.size(), module_names.size());
  auto const& mapping = health[static_cast<std::size_t>(Module::mapping)];
  EXPECT_TRUE(mapping.was_heard);
  EXPECT_TRUE(mapping.is_required);
  EXPECT_NEAR(mapping.reports_per_s, 9, 1);
  EXPECT_EQ(mapping.since_heard, 200ms);
  EXPECT_EQ(mapping.report.memory_bytes, 1'000'000U);
  EXPECT_FALSE(health[static_cast<std::size_t>(Module::planner)].was_heard);
  EXPECT_TRUE(watch.health(at(4s))[static_cast<std::size_t>(Module::mapping)].is_silent);
  EXPECT_EQ(watch.health(at(9s))[static_cast<std::size_t>(Module::mapping)].reports_per_s, 0);
}

TEST(Codes, EachHasOneNumberInTheHundredOfItsModuleAndSaysWhatToDo) {
  std::set<std::uint16_t> numbers;
  std::uint16_t before = 0;
  for (auto const& entry : code_table()) {
    EXPECT_TRUE(numbers.insert(entry.code).second) << entry.code;
    EXPECT_GT(entry.code, before);
    before = entry.code;
    EXPECT_EQ(entry.code / 100, static_cast<int>(entry.module) + 1) << entry.code;
    EXPECT_TRUE(entry.meaning.ends_with('.')) << entry.code;
    EXPECT_TRUE(entry.what_to_do.ends_with('.')) << entry.code;
    EXPECT_EQ(find_code(entry.code), &entry);
  }
  EXPECT_EQ(find_code(0), nullptr);
}

TEST(Codes, ThePageIsWhatTheTableSays) {
  std::string const path = LAPWING_SOURCE_DIR "/docs/reference/robot-errors.md";
  std::string page;
  {
    std::ifstream file(path);
    page.assign(std::istreambuf_iterator<char>(file), {});
  }
  // What follows is written by hand: which faults were tried, and what the robot does then.
  auto const by_hand = std::min(page.find("\n## What breaks"), page.size());
  if (std::getenv("LAPWING_REFRESH_GOLDEN") != nullptr) std::ofstream(path) << code_page() << page.substr(by_hand);
  EXPECT_EQ(page.substr(0, by_hand), code_page()) << "LAPWING_REFRESH_GOLDEN=1 before this test writes " << path;
}

TEST(SelfReport, TellsTheWorstOfTheCarrier) {
  CarrierClient::Status status;
  EXPECT_EQ(carrier_code(status, {}), code::board_away);
  status.frames.other_version = 3;
  EXPECT_EQ(carrier_code(status, {}), code::board_version);
  status.is_here = true;
  EXPECT_EQ(carrier_code(status, {}), code::none);
  status.readings = firmware::Readings{};
  status.readings->flags = firmware::bit(firmware::Flag::too_near);
  EXPECT_EQ(carrier_code(status, {}), code::too_near);
  status.frames.damaged = 10;
  status.frames.frames = 90;
  EXPECT_EQ(carrier_code(status, {}), code::line_damaged);
  EXPECT_EQ(carrier_code(status, status.frames), code::too_near);
  status.readings->battery_percent = 10;
  EXPECT_EQ(carrier_code(status, status.frames), code::battery_low);
  status.readings->flags |= firmware::bit(firmware::Flag::right_wheel_dead);
  EXPECT_EQ(carrier_code(status, status.frames), code::right_wheel_dead);
}

TEST(SelfReport, TellsTheWorstOfTheSensors) {
  Sensed::Faults faults;
  EXPECT_EQ(sensors_code(faults), code::none);
  faults.sonars = {SensorFault::none, SensorFault::dropouts};
  EXPECT_EQ(sensors_code(faults), code::sonar_dropouts);
  faults.is_slipping = true;
  EXPECT_EQ(sensors_code(faults), code::wheels_slip);
  faults.sonars.push_back(SensorFault::stuck);
  EXPECT_EQ(sensors_code(faults), code::sonar_stuck);
  faults.imu = SensorFault::dropouts;
  EXPECT_EQ(sensors_code(faults), code::imu_silent);
}

TEST(ProcessUse, IsThatOfThisProcess) {
  auto const before = process_use();
  EXPECT_GT(before.memory_bytes, 1'000'000U);
  double sum = 0;
  for (int i = 0; i < 20'000'000; ++i) sum += 1.0 / (1 + i);
  EXPECT_GT(sum, 1);
  auto const after = process_use();
  EXPECT_GT(after.cpu, before.cpu);
  EXPECT_GT(cpu_share(before, after, 1s), 0);
  EXPECT_EQ(cpu_share(before, after, 0s), 0);
}

TEST(ProcessMeter, SaysTheMemoryAtOnceAndTheSameUntilItLooksAgain) {
  ProcessMeter meter;
  auto const first = meter.use();
  EXPECT_GT(first.memory_bytes, 1'000'000U);
  EXPECT_EQ(first.cpu_share, 0);
  EXPECT_EQ(meter.use().memory_bytes, first.memory_bytes);
}

}  // namespace
}  // namespace lapwing::robot
