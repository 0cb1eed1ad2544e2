#include "missions/mission_block.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "missions/mission_harness.hpp"
#include "missions/mission_task.hpp"
#include "tasks/testing/script.hpp"

namespace lapwing::missions {
namespace {

using geo::Wgs84;
using vehicle::Autopilot;
using Stage = tasks::testing::BasicStage<MissionHarness>;

/// One command of a mission block: `{"move", {100, 200}}`. Arguments left out are filled in as the language does it.
struct Command {
  std::string name;
  std::vector<tasks::Argument> arguments = {};
};

/// Whole numbers are written as the script would write them.
tasks::Argument n(std::int64_t value) {
  return value;
}

bool fits(tasks::Argument const& argument, tasks::Parameter const& parameter) {
  switch (parameter.type) {
    case tasks::Type::number: return argument.index() == 2 || argument.index() == 3;
    case tasks::Type::integer: return argument.index() == 2;
    case tasks::Type::text: return argument.index() == 4;
    case tasks::Type::position: return argument.index() == 5;
    default: return false;
  }
}

std::optional<std::vector<tasks::Argument>> completed(tasks::Overload const& overload,
                                                      std::vector<tasks::Argument> arguments) {
  auto const& parameters = overload.parameters;
  if (arguments.size() > parameters.size()) return std::nullopt;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (i == arguments.size()) {
      if (!parameters[i].fallback) return std::nullopt;
      arguments.push_back(*parameters[i].fallback);
    }
    if (!fits(arguments[i], parameters[i])) return std::nullopt;
  }
  return arguments;
}

base::Result<> add(tasks::BuilderSpec const& spec, tasks::BuilderSession& session, Command const& command) {
  auto const found = std::ranges::find(spec.commands, command.name, &tasks::CommandSpec::name);
  if (found == spec.commands.end()) return base::fail(base::ErrorKind::not_found, "no command " + command.name);
  for (std::size_t i = 0; i < found->overloads.size(); ++i) {
    auto const arguments = completed(found->overloads[i], command.arguments);
    if (!arguments) continue;
    return session.add(static_cast<std::size_t>(found - spec.commands.begin()), i, *arguments);
  }
  return base::fail(base::ErrorKind::not_found, "no overload of " + command.name);
}

base::Result<plan::Mission> build(std::vector<Command> const& commands) {
  auto const spec = mission_block();
  auto const session = spec.begin();
  for (auto const& command : commands) {
    if (auto added = add(spec, *session, command); !added) return std::unexpected(added.error());
  }
  auto const task = session->finish();
  if (!task) return std::unexpected(task.error());
  return dynamic_cast<MissionTask const&>(**task).mission();
}

/// "16 p=(0 50 0 nan) at 40.00000 -8.00000 100.00"
std::string text(mavlink::MissionItem const& item) {
  auto const& p = item.params;
  auto const place = plan::position_of(item);
  return fmt::format("{} p=({} {} {} {}) at {:.5f} {:.5f} {:.2f}", std::to_underlying(item.command), p[0], p[1], p[2],
                     p[3], place.lat_deg(), place.lon_deg(), place.alt_m);
}

std::vector<std::string> dump(std::vector<Command> const& commands, Autopilot autopilot = Autopilot::ardupilot) {
  auto const mission = build(commands);
  if (!mission) return {mission.error().message};
  std::vector<std::string> lines;
  for (auto const& item : plan::for_autopilot(*mission, autopilot, Wgs84::from_degrees(1, 2, 3)))
    lines.push_back(text(item));
  return lines;
}

using Lines = std::vector<std::string>;
auto const base_position = Wgs84::from_degrees(40.444233, -7.375234, 820);
auto const take_off_position = Wgs84::from_degrees(40.444233, -7.375234, 1200);
auto const p = Wgs84::from_degrees(40, -8, 100);

TEST(Mission, OfListingTwo) {  // case 68
  EXPECT_EQ(dump({{"name", {"Survey Area"}},
                  {"home", {base_position}},
                  {"takeOff", {take_off_position}},
                  {"move", {n(100), n(200), n(100)}},
                  {"moveAndLoiterPos", {n(200), n(100), n(-20), n(50)}}}),
            (Lines{"16 p=(0 0 0 0) at 40.44423 -7.37523 820.00", "22 p=(15 0 0 nan) at 40.44423 -7.37523 1200.00",
                   "16 p=(0 50 0 nan) at 40.44513 -7.37288 1300.00", "17 p=(0 0 50 0) at 40.44693 -7.37170 1280.00"}));
}

TEST(Mission, ReturnHomeAndLand) {  // case 69
  EXPECT_EQ(dump({{"home", {base_position}}, {"returnHomeAndLand"}}),
            (Lines{"16 p=(0 0 0 0) at 40.44423 -7.37523 820.00", "21 p=(0 0 0 nan) at 40.44423 -7.37523 820.00"}));
}

TEST(Mission, SurveyWithDefaults) {  // case 70
  auto const mission = build({{"surveyArea", {p, n(1000), n(150)}}});
  ASSERT_TRUE(mission);
  double constexpr north = 40.0092316;
  double constexpr south = 39.9997749;
  std::vector<std::pair<double, double>> const expected{{40.0, -8.0},        {north, -8.0},       {north, -8.0005856},
                                                        {south, -8.0005856}, {south, -8.0011711}, {north, -8.0011711},
                                                        {north, -8.0017567}, {south, -8.0017567}, {40.0, -8.0}};
  ASSERT_EQ(mission->items.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(plan::position_of(mission->items[i]).lat_deg(), expected[i].first, 1e-6) << i;
    EXPECT_NEAR(plan::position_of(mission->items[i]).lon_deg(), expected[i].second, 1e-6) << i;
    EXPECT_EQ(plan::position_of(mission->items[i]).alt_m, 100.0) << i;
    EXPECT_EQ(mission->items[i].params[1], 25.0F) << i;
  }
}

TEST(Mission, SurveyMayTurnInAnotherRoom) {
  auto const mission = build({{"surveyArea", {p, n(1000), n(150), n(50), "NORTH_WEST", n(0)}}});
  ASSERT_TRUE(mission);
  EXPECT_NEAR(geo::LocalFrame(p).ned_from(plan::position_of(mission->items[1])).north, 1000.0, 0.1);
  EXPECT_EQ(dump({{"surveyArea", {p, n(10), n(10), n(50), "NORTH_WEST", n(-1)}}}),
            (Lines{"the room to turn beyond a survey must be 0 or more, not -1 m"}));
}

TEST(Mission, SurveyOfListingThreeStartsAtTheTakeOff) {  // case 71
  auto const mission = build({{"home", {base_position}},
                              {"takeOff", {take_off_position}},
                              {"surveyArea", {n(3000), n(10000), n(500), "NORTH_EAST"}}});
  ASSERT_TRUE(mission);
  EXPECT_EQ(mission->items.size(), 1u + 43u);
  auto const farthest = plan::position_of(mission->items[42]);
  EXPECT_NEAR(geo::LocalFrame(take_off_position).ned_from(farthest).east, 10000.0, 15.0);
  EXPECT_EQ(farthest.alt_m, 1200.0);
}

TEST(Mission, UnknownSurveyDirectionIsRefusedAndTheTableListsTheFour) {  // case 72
  EXPECT_EQ(dump({{"surveyArea", {p, n(1000), n(1000), n(50), "SOUTH"}}}),
            (Lines{"there is no survey direction 'SOUTH'"}));
  auto const spec = mission_block();
  auto const survey = std::ranges::find(spec.commands, "surveyArea", &tasks::CommandSpec::name);
  EXPECT_EQ(survey->overloads[0].parameters[3].choices,
            (std::vector<std::string_view>{"NORTH_WEST", "NORTH_EAST", "SOUTH_WEST", "SOUTH_EAST"}));
}

TEST(Mission, RelativeCommandsNeedABase) {  // case 74
  Lines const without_base{"relative move without home or earlier position"};
  EXPECT_EQ(dump({{"move", {n(10), n(10), n(10)}}}), without_base);
  EXPECT_EQ(dump({{"moveAndLoiterPos", {n(10), n(10), n(10)}}}), without_base);
  EXPECT_EQ(dump({{"surveyArea", {n(10), n(10)}}}), without_base);
  Lines const without_home{"the mission has no home to start from or return to"};
  for (auto const* name : {"returnHome", "returnHomeAndLoiter", "returnHomeAndLand"}) {
    EXPECT_EQ(dump({{"goPos", {p}}, {name}}), without_home) << name;
  }
  EXPECT_EQ(dump({{"moveFromHome", {n(1), n(1)}}}), without_home);
  EXPECT_EQ(dump({{"moveAndLoiterFromHome", {n(1), n(1), n(1)}}}), without_home);
}

TEST(Mission, SpeedNeverTouchesTheThrottle) {  // case 77
  EXPECT_EQ(dump({{"speed", {n(20)}}, {"speed", {n(20), n(1)}}}, Autopilot::px4),
            (Lines{"178 p=(0 20 -1 0) at 0.00000 0.00000 0.00", "178 p=(1 20 -1 0) at 0.00000 0.00000 0.00"}));
}

TEST(Mission, WithoutHomeGetsTheVehiclesOnArduPilotAndNoneOnPx4) {  // case 78
  Lines const items{"16 p=(0 0 0 0) at 1.00000 2.00000 3.00", "16 p=(0 50 0 nan) at 40.00000 -8.00000 100.00"};
  EXPECT_EQ(dump({{"goPos", {p}}}), items);
  EXPECT_EQ(dump({{"goPos", {p}}}, Autopilot::px4), Lines{items[1]});
  EXPECT_EQ(dump({{"home", {base_position}}, {"goPos", {p}}}, Autopilot::px4), Lines{items[1]});
}

// ---- every command, one by one

struct CommandCase {
  Command command;
  std::string item;  ///< what it adds after `home` and `goPos p`
};

std::ostream& operator<<(std::ostream& out, CommandCase const& one) {
  return out << one.command.name;
}

class EveryCommand : public ::testing::TestWithParam<CommandCase> {};

TEST_P(EveryCommand, BecomesItsItem) {
  auto const home = Wgs84::from_degrees(50, 10, 500);
  EXPECT_EQ(dump({{"home", {home}}, {"goPos", {p}}, GetParam().command}).back(), GetParam().item);
}

/// Editors show it.
TEST_P(EveryCommand, SaysInItsDocWhichItemItBecomes) {
  auto const spec = mission_block();
  auto const found = std::ranges::find(spec.commands, GetParam().command.name, &tasks::CommandSpec::name);
  ASSERT_NE(found, spec.commands.end());
  auto const number = GetParam().item.substr(0, GetParam().item.find(' '));
  EXPECT_NE(found->doc.find(fmt::format("({})", number)), std::string_view::npos) << found->doc;
}

/// 100 m north and 200 m east of `p` and of home, 10 m up.
std::string const from_p = " at 40.00090 -7.99766 110.00";
std::string const from_home = " at 50.00090 10.00279 510.00";
std::string const at_p = " at 40.00000 -8.00000 100.00";
std::string const at_home = " at 50.00000 10.00000 500.00";
std::string const nowhere = " at 0.00000 0.00000 0.00";

INSTANTIATE_TEST_SUITE_P(
    Going, EveryCommand,
    ::testing::Values(CommandCase{{"home", {40.5, n(-8), 7.5}}, "179 p=(0 0 0 0) at 40.50000 -8.00000 7.50"},
                      CommandCase{{"home", {n(40), n(-8)}}, "179 p=(0 0 0 0) at 40.00000 -8.00000 0.00"},
                      CommandCase{{"goPos", {n(40), n(-8)}}, "16 p=(0 50 0 nan) at 40.00000 -8.00000 0.00"},
                      CommandCase{{"goPos", {n(40), n(-8), n(100)}}, "16 p=(0 50 0 nan)" + at_p},
                      CommandCase{{"move", {n(100), n(200), n(10)}}, "16 p=(0 50 0 nan)" + from_p},
                      CommandCase{{"move", {n(0), n(0)}}, "16 p=(0 50 0 nan)" + at_p},
                      CommandCase{{"moveFromHome", {n(100), n(200), n(10)}}, "16 p=(0 50 0 nan)" + from_home},
                      CommandCase{{"moveFromHome", {n(0), n(0)}}, "16 p=(0 50 0 nan)" + at_home},
                      CommandCase{{"takeOff", {p}}, "22 p=(15 0 0 nan)" + at_p},
                      CommandCase{{"takeOff", {p, n(8)}}, "22 p=(8 0 0 nan)" + at_p},
                      CommandCase{{"takeOffWithYaw", {p, n(8)}}, "22 p=(8 0 0 nan)" + at_p},
                      CommandCase{{"takeOffWithYaw", {p, n(8), n(90)}}, "22 p=(8 0 0 90)" + at_p},
                      CommandCase{{"landingPoint", {n(40), n(-8)}}, "21 p=(0 0 0 nan) at 40.00000 -8.00000 0.00"},
                      CommandCase{{"landingPoint", {n(40), n(-8), n(100), n(45), n(2)}}, "21 p=(0 2 0 45)" + at_p},
                      CommandCase{{"landingPoint", {p}}, "21 p=(0 0 0 nan)" + at_p},
                      CommandCase{{"landingPoint", {p, 45.5, n(1)}}, "21 p=(0 1 0 45.5)" + at_p},
                      CommandCase{{"returnHome"}, "16 p=(0 50 0 nan)" + at_home},
                      CommandCase{{"returnHomeAndLoiter"}, "17 p=(0 0 15 0)" + at_home},
                      CommandCase{{"returnHomeAndLoiter", {n(-30)}}, "17 p=(0 0 -30 0)" + at_home},
                      CommandCase{{"returnHomeAndLand"}, "21 p=(0 0 0 nan)" + at_home},
                      CommandCase{{"returnHomeAndLand", {n(90), n(1)}}, "21 p=(0 1 0 90)" + at_home},
                      CommandCase{{"surveyArea", {n(100), n(100)}}, "16 p=(0 25 0 nan)" + at_p}));

INSTANTIATE_TEST_SUITE_P(
    Loitering, EveryCommand,
    ::testing::Values(
        CommandCase{{"moveAndLoiterPos", {n(100), n(200), n(10)}}, "17 p=(0 0 15 0)" + from_p},
        CommandCase{{"moveAndLoiterTurns", {n(100), n(200), n(10)}}, "18 p=(10 0 15 0)" + from_p},
        CommandCase{{"moveAndLoiterTurns", {n(100), n(200), n(10), n(3), n(40)}}, "18 p=(3 0 40 0)" + from_p},
        CommandCase{{"moveAndLoiterTime", {n(100), n(200), n(10), n(60)}}, "19 p=(60 0 15 0)" + from_p},
        CommandCase{{"moveAndLoiterTime", {n(100), n(200), n(10), n(60), n(40)}}, "19 p=(60 0 40 0)" + from_p},
        CommandCase{{"moveAndLoiterFromHome", {n(100), n(200), n(10), n(40)}}, "17 p=(0 0 40 0)" + from_home},
        CommandCase{{"moveAndLoiterTurnsFromHome", {n(100), n(200), n(10), n(3)}}, "18 p=(3 0 15 0)" + from_home},
        CommandCase{{"moveAndLoiterTimeFromHome", {n(100), n(200), n(10), n(60)}}, "19 p=(60 0 15 0)" + from_home},
        CommandCase{{"loiterPos", {p}}, "17 p=(0 0 15 0)" + at_p},
        CommandCase{{"loiterPos", {p, n(40)}}, "17 p=(0 0 40 0)" + at_p},
        CommandCase{{"loiterPos", {n(40), n(-8), n(100)}}, "17 p=(0 0 15 0)" + at_p},
        CommandCase{{"loiterPos", {n(40), n(-8), n(100), n(40)}}, "17 p=(0 0 40 0)" + at_p},
        CommandCase{{"loiterTurns", {n(40), n(-8), n(100)}}, "18 p=(10 0 15 0)" + at_p},
        CommandCase{{"loiterTurns", {n(40), n(-8), n(100), n(3), n(40)}}, "18 p=(3 0 40 0)" + at_p},
        CommandCase{{"loiterTime", {n(40), n(-8), n(100), n(60)}}, "19 p=(60 0 15 0)" + at_p},
        CommandCase{{"loiterTime", {p, n(60), n(40)}}, "19 p=(60 0 40 0)" + at_p}));

INSTANTIATE_TEST_SUITE_P(
    OnTheWay, EveryCommand,
    ::testing::Values(CommandCase{{"altitude", {n(150)}}, "30 p=(1 0 0 0) at 0.00000 0.00000 150.00"},
                      CommandCase{{"altitude", {n(50)}}, "30 p=(2 0 0 0) at 0.00000 0.00000 50.00"},
                      CommandCase{{"altitude", {n(100)}}, "30 p=(0 0 0 0) at 0.00000 0.00000 100.00"},
                      CommandCase{{"delay", {n(30)}}, "93 p=(30 -1 -1 -1)" + nowhere},
                      CommandCase{{"capturePhoto"}, "2000 p=(0 0 1 1)" + nowhere},
                      CommandCase{{"captureSeveralPhotos", {n(5)}}, "2000 p=(0 2 5 0)" + nowhere},
                      CommandCase{{"captureSeveralPhotos", {n(5), n(3)}}, "2000 p=(0 3 5 0)" + nowhere},
                      CommandCase{{"captureUntilStop"}, "2000 p=(0 2 0 0)" + nowhere},
                      CommandCase{{"captureUntilStop", {n(4)}}, "2000 p=(0 4 0 0)" + nowhere},
                      CommandCase{{"stopCapturing"}, "2001 p=(0 0 0 0)" + nowhere},
                      CommandCase{{"jumpToItem", {n(1)}}, "177 p=(1 1 0 0)" + nowhere},
                      CommandCase{{"jumpToItem", {n(2), n(-1)}}, "177 p=(2 -1 0 0)" + nowhere}));

TEST(Mission, TableHasEveryCommandOnceWithItsDocumentation) {
  auto const spec = mission_block();
  std::vector<std::string_view> names;
  for (auto const& command : spec.commands) {
    names.push_back(command.name);
    EXPECT_FALSE(command.doc.empty()) << command.name;
    for (auto const& overload : command.overloads) {
      for (auto const& parameter : overload.parameters) EXPECT_FALSE(parameter.doc.empty()) << command.name;
    }
  }
  std::ranges::sort(names);
  EXPECT_EQ(std::ranges::adjacent_find(names), names.end());
  EXPECT_EQ(names.size(), 29u);
}

// ---- errors

struct WrongCase {
  Command command;
  std::string message;
};
class WrongCommand : public ::testing::TestWithParam<WrongCase> {};

TEST_P(WrongCommand, IsRefusedWithItsReason) {
  EXPECT_EQ(dump({{"home", {p}}, GetParam().command}), Lines{GetParam().message});
}

double const nan_value = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    All, WrongCommand,
    ::testing::Values(
        WrongCase{{"goPos", {n(91), n(0)}}, "latitude 91 is beyond 90 degrees"},
        WrongCase{{"loiterPos", {n(0), n(181), n(0)}}, "longitude 181 is beyond 180 degrees"},
        WrongCase{{"home", {n(-95), n(0)}}, "latitude -95 is beyond 90 degrees"},
        WrongCase{{"move", {nan_value, n(0)}}, "a position has a coordinate that is no number"},
        WrongCase{{"takeOff", {p, nan_value}}, "the pitch of a take-off must be a number"},
        WrongCase{{"takeOffWithYaw", {p, nan_value, n(0)}}, "the pitch of a take-off must be a number"},
        WrongCase{{"loiterTurns", {p, n(-1)}}, "the number of turns must be 0 or more, not -1"},
        WrongCase{{"loiterTime", {p, n(-1)}}, "the loiter time must be 0 or more, not -1"},
        WrongCase{{"takeOff", {p, n(-5)}}, "the pitch of a take-off must be 0 or more, not -5"},
        WrongCase{{"takeOff", {p, n(95)}}, "the pitch of a take-off must be at most 90, not 95"},
        WrongCase{{"goPos", {n(40), n(-8), n(83000)}}, "an altitude of 83000 m is beyond 83 km"},
        WrongCase{{"altitude", {n(-90000)}}, "an altitude of -90000 m is beyond 83 km"},
        WrongCase{{"move", {n(2e6), n(0)}}, "2000000 m north and 0 m east are too far away for a relative move"},
        WrongCase{{"loiterTurns", {p, n(256)}}, "the number of turns must be at most 255, not 256"},
        WrongCase{{"loiterTurns", {p, n(1), n(-3000)}}, "the radius must be at most 2550, not 3000"},
        WrongCase{{"loiterPos", {p, n(70000)}}, "the radius must be at most 65535, not 70000"},
        WrongCase{{"loiterTime", {p, n(70000)}}, "the loiter time must be at most 65535, not 70000"},
        WrongCase{{"captureSeveralPhotos", {n(70000)}}, "the number of photos must be at most 65535, not 70000"},
        WrongCase{{"jumpToItem", {n(1), n(40000)}}, "the number of jumps must be at most 32767, not 40000"},
        WrongCase{{"surveyArea", {n(2e6), n(10)}}, "a survey of 2000000 m by 10 m is larger than 1000 km"},
        WrongCase{{"landingPoint", {p, n(0), n(3)}}, "there is no precision land mode 3"},
        WrongCase{{"speed", {n(0)}}, "a speed must be above 0, not 0 m/s"},
        WrongCase{{"speed", {n(5), n(4)}}, "there is no speed type 4"},
        WrongCase{{"altitude", {nan_value}}, "an altitude must be a number"},
        WrongCase{{"delay", {n(-1)}}, "a delay must be 0 or more, not -1"},
        WrongCase{{"captureSeveralPhotos", {n(0)}}, "the number of photos must be 1 or more"},
        WrongCase{{"captureUntilStop", {n(0)}}, "the time between photos must be above 0, not 0 s"},
        WrongCase{{"jumpToItem", {n(0)}}, "cannot jump to item 0"},
        WrongCase{{"jumpToItem", {n(1), n(-2)}}, "cannot jump -2 times"},
        WrongCase{{"jumpToItem", {n(3)}}, "jumpToItem 3: the mission has items 1 to 1"},
        WrongCase{{"surveyArea", {n(0), n(10)}}, "a survey area needs a length and a width above 0, not 0 m by 10 m"},
        WrongCase{{"surveyArea", {n(10), n(10), n(0)}}, "legs of a survey need a spacing above 0, not 0 m"}));

// ---- the task

MissionTask task_of(std::vector<Command> const& commands) {
  return MissionTask(*build(commands));
}

TEST(MissionTask, TakesItsNameFromTheLastNameOrACount) {
  EXPECT_EQ(task_of({{"name", {"a"}}, {"name", {"b"}}}).name(), "b");
  auto const spec = mission_block();
  EXPECT_EQ((*spec.begin()->finish())->name(), "MissionPlan_1");
  EXPECT_EQ((*spec.begin()->finish())->name(), "MissionPlan_2");
}

TEST(MissionTask, WithPhotosNeedsACameraWherePayloadIsKnown) {
  Stage stage;
  auto const photos = task_of({{"capturePhoto"}});
  EXPECT_EQ(photos.unsuited(*stage.platform.find({"a1"})), std::nullopt);
  EXPECT_EQ(photos.unsuited(*stage.platform.find({"u1"})), "no payload Camera");
  EXPECT_EQ(photos.unsuited(*stage.platform.find({"u2"})), std::nullopt);
  EXPECT_EQ(task_of({{"goPos", {p}}}).unsuited(*stage.platform.find({"u1"})), std::nullopt);
}

tasks::VehicleInfo vehicle_of(std::string type) {
  tasks::VehicleInfo info;
  info.id = {"7"};
  info.type = std::move(type);
  return info;
}

TEST(MissionTask, IsUnsuitedForVehiclesThatWouldSkipAnItem) {
  auto const task = task_of({{"home", {p}}, {"takeOff", {p}}});
  EXPECT_EQ(task.unsuited(vehicle_of("UAV")), std::nullopt);
  EXPECT_EQ(task.unsuited(vehicle_of("UGV")), "item 1, NAV_TAKEOFF: a rover with ArduPilot would skip it");
  EXPECT_EQ(task.unsuited(vehicle_of("")), std::nullopt);
}

/// The table says the same as the items do when they come to a vehicle.
TEST(MissionTask, AgreesWithTheTableOnVehicleTypes) {
  Command const forms[] = {{"takeOff", {p}},      {"takeOffWithYaw", {p, n(8)}}, {"landingPoint", {p}},
                           {"returnHomeAndLand"}, {"altitude", {n(150)}},        {"goPos", {n(1), n(2)}},
                           {"loiterTurns", {p}},  {"surveyArea", {n(9), n(9)}},  {"capturePhoto"},
                           {"delay", {n(5)}},     {"returnHomeAndLoiter"},       {"speed", {n(5)}}};
  auto const spec = mission_block();
  for (auto const& form : forms) {
    auto const task = task_of({{"home", {p}}, form});
    auto const command = std::ranges::find(spec.commands, form.name, &tasks::CommandSpec::name);
    for (auto const* type : {"UAV", "UGV", "USV", "UUV"})
      EXPECT_EQ(!task.unsuited(vehicle_of(type)), command->suits(type)) << form.name << " " << type;
  }
}

TEST(MissionTask, TakesItsEstimatedTimeOnTheHarness) {
  Stage stage;
  auto const task = std::make_shared<MissionTask>(
      task_of({{"name", {"m"}}, {"home", {p}}, {"move", {n(100), n(0)}}, {"delay", {n(5)}}}));
  EXPECT_TRUE(stage.execute(tasks::performed(task), {"a1"}).is_done());
  EXPECT_EQ(stage.trace, (tasks::testing::Trace{"0.0 START m@a1", "15.0 DONE m@a1"}));
}

TEST(MissionTask, ThatEndsInALoiterRunsUntilItIsStopped) {
  Stage stage;
  auto const task = std::make_shared<MissionTask>(task_of({{"name", {"m"}}, {"loiterPos", {p}}}));
  EXPECT_TRUE(stage.execute(during(tasks::performed(task), tasks::testing::seconds(7200)), {"a1"}).is_done());
  EXPECT_EQ(stage.trace.back(), "7200.0 STOP m@a1");
}

}  // namespace
}  // namespace lapwing::missions
