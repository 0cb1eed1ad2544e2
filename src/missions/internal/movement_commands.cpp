#include "missions/internal/mission_commands.hpp"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

namespace lapwing::missions::internal {
namespace {

using tasks::Argument;
using tasks::Dimension;
using tasks::Overload;
using tasks::Parameter;
using tasks::Type;

using base::Result;
using plan::Loiter;
using plan::MissionBuilder;
using plan::Offset;
using Arguments = std::span<Argument const>;

// ---- parameters

Parameter length(std::string_view name, std::string_view doc, std::optional<Argument> fallback = std::nullopt) {
  return {
      .name = name, .type = Type::number, .dimension = Dimension::length, .fallback = std::move(fallback), .doc = doc};
}
Parameter angle(std::string_view name, std::string_view doc, std::optional<Argument> fallback = std::nullopt) {
  return {
      .name = name, .type = Type::number, .dimension = Dimension::angle, .fallback = std::move(fallback), .doc = doc};
}
Parameter place(std::string_view doc) {
  return {.name = "pos", .type = Type::position, .doc = doc};
}
Parameter turn_count() {
  return {.name = "turns", .type = Type::integer, .fallback = Argument{std::int64_t{10}}, .doc = "full circles"};
}
Parameter loiter_time() {
  return {.name = "secs", .type = Type::integer, .dimension = Dimension::time, .doc = "how long to stay"};
}
Parameter radius() {
  return length("r", "radius of the circle; counterclockwise when negative", Argument{15.0});
}
Parameter yaw() {
  return angle("yaw", "heading, clockwise from north; NaN leaves it to the vehicle",
               Argument{MissionBuilder::free_yaw});
}
Parameter precision_mode() {
  return {.name = "mode",
          .type = Type::integer,
          .fallback = Argument{std::int64_t{0}},
          .doc = "PRECISION_LAND_MODE: 0 off, 1 opportunistic, 2 required"};
}

using Parameters = std::vector<Parameter>;
Parameters operator+(Parameters left, Parameters const& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}
Parameters coordinates(std::optional<Argument> height = std::nullopt) {
  return {angle("lat", "north is positive"), angle("lon", "east is positive"),
          length("height", "above mean sea level", std::move(height))};
}
Parameters offset(std::optional<Argument> up = std::nullopt) {
  return {length("north", "northwards"), length("east", "eastwards"), length("up", "upwards", std::move(up))};
}

// ---- arguments

/// Where a command goes, and what remains of its arguments: overload 0 takes latitude, longitude and height, overload 1
/// a position.
std::pair<geo::Wgs84, Arguments> split_place(std::size_t overload, Arguments arguments) {
  if (overload == 1) return {position(arguments[0]), arguments.subspan(1)};
  auto const [lat, lon, height] = std::tuple(number(arguments[0]), number(arguments[1]), number(arguments[2]));
  return {geo::Wgs84::from_degrees(lat, lon, height), arguments.subspan(3)};
}

Offset offset_of(Arguments arguments) {
  return {.north_m = number(arguments[0]), .east_m = number(arguments[1]), .up_m = number(arguments[2])};
}

using From = Result<geo::Wgs84> (MissionBuilder::*)(Offset) const;

template <From from>
Result<> move(MissionBuilder& builder, std::size_t, Arguments arguments) {
  auto const target = (builder.*from)(offset_of(arguments));
  if (!target) return std::unexpected(target.error());
  return builder.waypoint(*target);
}

/// The kind's own arguments, then the radius.
template <Loiter::Kind kind>
Loiter loiter_of(Arguments arguments) {
  if constexpr (kind == Loiter::Kind::unlimited) return {.kind = kind, .radius_m = number(arguments[0])};
  return {.kind = kind, .amount = number(arguments[0]), .radius_m = number(arguments[arguments.size() - 1])};
}

template <From from, Loiter::Kind kind>
Result<> move_and_loiter(MissionBuilder& builder, std::size_t, Arguments arguments) {
  auto const target = (builder.*from)(offset_of(arguments));
  if (!target) return std::unexpected(target.error());
  return builder.loiter(*target, loiter_of<kind>(arguments.subspan(3)));
}

template <Loiter::Kind kind>
Result<> loiter_at(MissionBuilder& builder, std::size_t overload, Arguments arguments) {
  auto const [target, rest] = split_place(overload, arguments);
  return builder.loiter(target, loiter_of<kind>(rest));
}

Result<> home(MissionBuilder& builder, std::size_t overload, Arguments arguments) {
  return builder.home(split_place(overload, arguments).first);
}

Result<> go_to(MissionBuilder& builder, std::size_t overload, Arguments arguments) {
  return builder.waypoint(split_place(overload, arguments).first);
}

/// `pos, pitch[, yaw]`
Result<> take_off(MissionBuilder& builder, std::size_t, Arguments arguments) {
  double const yaw_deg = arguments.size() > 2 ? number(arguments[2]) : MissionBuilder::free_yaw;
  return builder.take_off(position(arguments[0]), number(arguments[1]), yaw_deg);
}

Result<> landing_point(MissionBuilder& builder, std::size_t overload, Arguments arguments) {
  auto const [target, rest] = split_place(overload, arguments);
  return builder.land(target, number(rest[0]), integer(rest[1]));
}

Result<> return_home(MissionBuilder& builder, std::size_t, Arguments) {
  auto const target = builder.from_home({});
  if (!target) return std::unexpected(target.error());
  return builder.waypoint(*target);
}

Result<> return_home_and_loiter(MissionBuilder& builder, std::size_t, Arguments arguments) {
  auto const target = builder.from_home({});
  if (!target) return std::unexpected(target.error());
  return builder.loiter(*target, loiter_of<Loiter::Kind::unlimited>(arguments));
}

Result<> return_home_and_land(MissionBuilder& builder, std::size_t, Arguments arguments) {
  auto const target = builder.from_home({});
  if (!target) return std::unexpected(target.error());
  return builder.land(*target, number(arguments[0]), integer(arguments[1]));
}

// ---- surveys

constexpr std::pair<std::string_view, plan::SurveyDirection> directions[] = {
    {"NORTH_WEST", plan::SurveyDirection::north_west},
    {"NORTH_EAST", plan::SurveyDirection::north_east},
    {"SOUTH_WEST", plan::SurveyDirection::south_west},
    {"SOUTH_EAST", plan::SurveyDirection::south_east},
};

Parameters survey_parameters() {
  Parameter direction{.name = "dir",
                      .type = Type::text,
                      .fallback = Argument{std::string(directions[0].first)},
                      .doc = "where the area lies as seen from its base"};
  for (auto const& [word, value] : directions) direction.choices.push_back(word);
  return {length("len", "north to south"), length("width", "east to west"),
          length("spacing", "between the legs", Argument{50.0}), direction,
          length("overshoot", "room to turn, beyond the area at both ends", Argument{25.0})};
}

Result<plan::SurveyDirection> direction_of(std::string const& word) {
  for (auto const& [name, value] : directions) {
    if (name == word) return value;
  }
  return base::fail(base::ErrorKind::invalid_input, "there is no survey direction '" + word + "'",
                    "NORTH_WEST, NORTH_EAST, SOUTH_WEST or SOUTH_EAST");
}

/// `[pos,] len, width, spacing, dir, overshoot`; without a position it begins at the last one.
Result<> survey_area(MissionBuilder& builder, std::size_t overload, Arguments arguments) {
  auto const base = overload == 1 ? position(arguments[0]) : builder.from_last({});
  if (!base) return std::unexpected(base.error());
  if (overload == 1) arguments = arguments.subspan(1);
  auto const direction = direction_of(text(arguments[3]));
  if (!direction) return std::unexpected(direction.error());
  return builder.survey({.base = *base,
                         .length_m = number(arguments[0]),
                         .width_m = number(arguments[1]),
                         .spacing_m = number(arguments[2]),
                         .direction = *direction,
                         .overshoot_m = number(arguments[4])});
}

std::vector<Overload> by_coordinates_or_position(Parameters const& rest,
                                                 std::optional<Argument> height = std::nullopt) {
  return {{coordinates(std::move(height)) + rest}, {Parameters{place("where")} + rest}};
}

std::vector<MissionCommand> loiter_commands() {
  using enum Loiter::Kind;
  From constexpr last = &MissionBuilder::from_last;
  From constexpr from_home = &MissionBuilder::from_home;
  Parameters const turning{turn_count(), radius()};
  Parameters const timed{loiter_time(), radius()};
  return {
      {{"moveAndLoiterPos",
        {{offset() + Parameters{radius()}}},
        "Goes there from the last position and stays until told otherwise; planes circle. MAV_CMD_NAV_LOITER_UNLIM "
        "(17)."},
       move_and_loiter<last, unlimited>},
      {{"moveAndLoiterTurns",
        {{offset() + turning}},
        "Goes there from the last position and flies circles. MAV_CMD_NAV_LOITER_TURNS (18)."},
       move_and_loiter<last, turns>},
      {{"moveAndLoiterTime",
        {{offset() + timed}},
        "Goes there from the last position and stays for a time; planes circle. MAV_CMD_NAV_LOITER_TIME (19)."},
       move_and_loiter<last, time>},
      {{"moveAndLoiterFromHome",
        {{offset() + Parameters{radius()}}},
        "Goes there from home and stays until told otherwise; planes circle. MAV_CMD_NAV_LOITER_UNLIM (17)."},
       move_and_loiter<from_home, unlimited>},
      {{"moveAndLoiterTurnsFromHome",
        {{offset() + turning}},
        "Goes there from home and flies circles. MAV_CMD_NAV_LOITER_TURNS (18)."},
       move_and_loiter<from_home, turns>},
      {{"moveAndLoiterTimeFromHome",
        {{offset() + timed}},
        "Goes there from home and stays for a time; planes circle. MAV_CMD_NAV_LOITER_TIME (19)."},
       move_and_loiter<from_home, time>},
      {{"loiterPos", by_coordinates_or_position({radius()}),
        "Goes there and stays until told otherwise; planes circle. MAV_CMD_NAV_LOITER_UNLIM (17)."},
       loiter_at<unlimited>},
      {{"loiterTurns", by_coordinates_or_position(turning),
        "Goes there and flies circles. MAV_CMD_NAV_LOITER_TURNS (18)."},
       loiter_at<turns>},
      {{"loiterTime", by_coordinates_or_position(timed),
        "Goes there and stays for a time; planes circle. MAV_CMD_NAV_LOITER_TIME (19)."},
       loiter_at<time>},
  };
}

}  // namespace

std::vector<MissionCommand> movement_commands() {
  Argument const zero{0.0};
  Parameters const ending{yaw(), precision_mode()};
  auto pitch = [](std::optional<Argument> fallback) {
    return angle("pitch", "least climb angle of a plane", std::move(fallback));
  };
  std::vector<std::string_view> const fliers{"UAV"};
  std::vector<std::string_view> const landers{"UAV", "UUV"};
  std::vector<MissionCommand> commands{
      {{"home", by_coordinates_or_position({}, zero),
        "Where the vehicle starts and returns to. MAV_CMD_DO_SET_HOME (179), or item 0 of the mission when it comes "
        "first."},
       home},
      {{"goPos", by_coordinates_or_position({}, zero), "Goes there. MAV_CMD_NAV_WAYPOINT (16)."}, go_to},
      {{"move", {{offset(zero)}}, "Goes there from the last position. MAV_CMD_NAV_WAYPOINT (16)."},
       move<&MissionBuilder::from_last>},
      {{"moveFromHome", {{offset(zero)}}, "Goes there from home. MAV_CMD_NAV_WAYPOINT (16)."},
       move<&MissionBuilder::from_home>},
      {{"takeOff",
        {{{place("where to climb to"), pitch(Argument{15.0})}}},
        "Takes off. MAV_CMD_NAV_TAKEOFF (22).",
        fliers},
       take_off},
      {{"takeOffWithYaw",
        {{{place("where to climb to"), pitch(std::nullopt), yaw()}}},
        "Takes off and turns. MAV_CMD_NAV_TAKEOFF (22).",
        fliers},
       take_off},
      {{"landingPoint", by_coordinates_or_position(ending, zero), "Lands there. MAV_CMD_NAV_LAND (21).", landers},
       landing_point},
      {{"returnHome",
        {{}},
        "Goes back to home, at the height of home, which is mostly the ground. MAV_CMD_NAV_WAYPOINT (16)."},
       return_home},
      {{"returnHomeAndLoiter",
        {{{radius()}}},
        "Goes back to home and stays there, at the height of home, which is mostly the ground. "
        "MAV_CMD_NAV_LOITER_UNLIM "
        "(17)."},
       return_home_and_loiter},
      {{"returnHomeAndLand", {{ending}}, "Goes back to home and lands. MAV_CMD_NAV_LAND (21).", landers},
       return_home_and_land},
      {{"surveyArea",
        {{survey_parameters()}, {Parameters{place("a corner of the area")} + survey_parameters()}},
        "Sweeps a rectangle in parallel legs, from one corner and back to it. MAV_CMD_NAV_WAYPOINT (16)."},
       survey_area},
  };
  std::ranges::move(loiter_commands(), std::back_inserter(commands));
  return commands;
}

}  // namespace lapwing::missions::internal
