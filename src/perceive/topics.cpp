#include "perceive/topics.hpp"

#include <cmath>

#include "base/wall_clock.hpp"
#include "bus/messages/mavros_names.hpp"
#include "bus/messages/stamps.hpp"
#include "bus/messages/survey_names.hpp"

namespace lapwing::perceive {

namespace flight = bus::mavros::names;
namespace survey = bus::survey::names;
using bus::Profile;

namespace {

constexpr auto world_frame = "map";
/// As the operation states are written down (docs/reference/operation-states.md).
constexpr std::string_view exploring = "AutonomousExplore";
constexpr std::uint16_t change_speed = 178;  // MAV_CMD_DO_CHANGE_SPEED
constexpr float ground_speed = 1.0F;         // SPEED_TYPE

/// Nothing for what is no rotation.
std::optional<video::BodyPlace> place_of(bus::Pose const& pose) {
  auto const& q = pose.orientation;
  Eigen::Quaterniond const rotation(q.w, q.x, q.y, q.z);
  constexpr double least = 0.5;  // of a rotation it is one; messages round
  if (!rotation.coeffs().allFinite() || rotation.norm() < least) return std::nullopt;
  return video::BodyPlace({pose.position.x, pose.position.y, pose.position.z}, rotation);
}

}  // namespace

base::Result<std::unique_ptr<Topics>> Topics::open(base::Loop& loop, bus::Bus& bus) {
  std::unique_ptr<Topics> topics(new Topics(loop));
  if (auto const opened = topics->open_ends(bus); !opened) return std::unexpected(opened.error());
  return topics;
}

base::Result<> Topics::open_ends(bus::Bus& bus) {
  bus::Ends ends(bus);
  ends.say(setpoint_, survey::planner_setpoint, Profile::standard);
  ends.say(map_, survey::occupancy_map, Profile::standard);
  ends.say(sees_lot_, survey::lot_detected, Profile::standard);
  ends.say(in_lot_, survey::place_in_lot, Profile::standard);
  ends.say(slots_, survey::parking_slots, Profile::latched);
  ends.say(report_, survey::survey_report, Profile::standard);
  ends.say(vision_, survey::vision_health, Profile::standard);
  ends.say(mapper_, survey::mapper_health, Profile::standard);
  ends.say(planner_, survey::planner_health, Profile::standard);
  ends.ask<bus::mavros::CommandLong>(commands_, flight::command, [](auto, auto const&) {});
  // Best effort hears writers of both kinds: MAVROS writes its sensors' topics so.
  ends.hear<bus::PoseStamped>(topics_, flight::local_pose, Profile::sensor_data,
                              [this](bus::PoseStamped const& pose) { take(pose); });
  ends.hear<bus::mavros::HomePosition>(topics_, flight::home, Profile::latched,
                                       [this](bus::mavros::HomePosition const& home) { take(home); });
  ends.hear<bus::Float64MultiArray>(topics_, survey::hover_heights, Profile::latched,
                                    [this](bus::Float64MultiArray const& heights) { take(heights); });
  ends.hear<bus::String>(topics_, survey::current_state, Profile::latched,
                         [this](bus::String const& state) { heard_.explores = state.data == exploring; });
  ends.hear<bus::Float64>(topics_, survey::flying_time_left, Profile::standard,
                          [this](bus::Float64 const& seconds) { take(seconds); });
  ends.hear<bus::PoseStamped>(topics_, survey::wanted_pose, Profile::standard, [this](bus::PoseStamped const& wanted) {
    map::SitePoint const place(wanted.pose.position.x, wanted.pose.position.y);
    if (place.is_finite()) heard_.wanted = place;
  });
  return ends.result();
}

void Topics::take(bus::PoseStamped const& pose) {
  auto const place = place_of(pose.pose);
  if (!place) return;
  heard_.track.add(bus::utc_of(pose.header.stamp), *place);
  heard_.pose_at = loop_.now();
}

void Topics::take(bus::mavros::HomePosition const& home) {
  auto const& at = home.position;
  geo::Point3<geo::SiteFrame> const in_frame(at.x, at.y, at.z);
  auto const place = geo::Wgs84::from_degrees(home.geo.latitude, home.geo.longitude, home.geo.altitude);
  bool const is_place =
      std::abs(home.geo.latitude) <= 90.0 && std::isfinite(home.geo.longitude) && std::isfinite(home.geo.altitude);
  if (!is_place || !in_frame.is_finite()) return;
  heard_.ground = SurveyGround{.anchor = anchor_of(place, in_frame), .home = in_frame};
}

void Topics::take(bus::Float64MultiArray const& heights) {
  if (heights.data.size() != 3) return;
  HoverHeights const told{heights.data[0], heights.data[1], heights.data[2]};
  if (0.0 < told.lowest_m && told.lowest_m < told.desired_m && told.desired_m < told.highest_m) heard_.heights = told;
}

/// Who tells it no more may be gone: the time goes on.
void Topics::take(bus::Float64 const& seconds) {
  constexpr double longest_s = 1e6;
  if (seconds.data >= 0.0 && seconds.data < longest_s) heard_.home_by = loop_.now() + base::from_seconds(seconds.data);
}

void Topics::say_goal(explore::SurveyGoal const& goal) {
  bus::PoseStamped pose{.header = bus::header_at(base::wall_now(), world_frame)};
  pose.pose.position = {goal.place.x(), goal.place.y(), goal.place.z()};
  pose.pose.orientation = {.z = std::sin(goal.yaw_rad / 2), .w = std::cos(goal.yaw_rad / 2)};
  setpoint_->publish(pose);
}

void Topics::say_map(explore::LotOccupancy const& map, base::UtcTime at) {
  bus::OccupancyGrid grid{.header = bus::header_at(at, world_frame)};
  grid.info = {.map_load_time = grid.header.stamp,
               .resolution = static_cast<float>(map.resolution_m),
               .width = static_cast<std::uint32_t>(map.width),
               .height = static_cast<std::uint32_t>(map.height),
               .origin = {.position = {map.origin.x(), map.origin.y(), 0.0}}};
  grid.data = map.cells;
  map_->publish(grid);
}

void Topics::say_health(std::optional<bus::DiagnosticStatus> const& vision, bus::DiagnosticStatus const& mapper,
                        bus::DiagnosticStatus const& planner) {
  if (vision) vision_->publish(*vision);
  mapper_->publish(mapper);
  planner_->publish(planner);
}

void Topics::ask_for_speed(double speed_m_s) {
  commands_->call({.command = change_speed, .param1 = ground_speed, .param2 = static_cast<float>(speed_m_s)});
}

}  // namespace lapwing::perceive
