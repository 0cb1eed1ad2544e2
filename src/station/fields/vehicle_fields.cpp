#include "station/fields/vehicle_fields.hpp"

#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

namespace lapwing::station::internal {

using vehicle::VehicleState;

namespace {

constexpr std::array<std::string_view, 8> families{"copter", "plane", "vtol",  "rover",
                                                   "boat",   "sub",   "robot", "unknown"};
constexpr std::array<std::string_view, 3> connections{"ok", "lost", "conflict"};
constexpr Words family_words{.type = "Family", .words = families, .otherwise = "unknown"};
constexpr Words connection_words{.type = "Link", .words = connections};

constexpr Type position_type{"Position"};
constexpr Type battery_type{"Battery"};
constexpr auto latitude = degrees(7).within(-90, 90);  // 1e-7 degrees is what autopilots send, about a centimetre

/// True, or not told at all.
std::optional<bool> told_if(bool is_true) {
  return is_true ? std::optional(true) : std::nullopt;
}

std::optional<std::string_view> unless_empty(std::string_view text) {
  return text.empty() ? std::nullopt : std::optional(text);
}

/// What is lost of nothing is not known.
struct LinkShown {
  vehicle::LinkQuality link = {};
  bool is_heard = true;
};

}  // namespace

// ---- the objects among the fields; each line {key, member, unit with rounding and range, what it says}

static void members(FieldTable& m, geo::Wgs84 const& place) {
  m.number("lat_deg", place.lat_deg(), latitude);
  m.number("lon_deg", place.lon_deg(), degrees(7));
  m.number("alt_m", place.alt_m, metres(2), "Above mean sea level.");
}

static void members(FieldTable& m, geo::Ned const& velocity) {
  m.number("north", velocity.north, metres_a_second(2));
  m.number("east", velocity.east, metres_a_second(2));
  m.number("down", velocity.down, metres_a_second(2));
}

static void members(FieldTable& m, vehicle::SitePose const& pose) {
  m.text("site", pose.site);
  m.text("floor", unless_empty(pose.floor));
  m.number("x_m", pose.position.x(), metres(3), "East of the site's anchor.");
  m.number("y_m", pose.position.y(), metres(3), "North of it.");
  m.number("z_m", pose.position.z(), metres(3), "Above it.");
  m.number("yaw_rad", pose.yaw_rad, radians(3), "Counterclockwise from the x axis.");
}

static void members(FieldTable& m, vehicle::Attitude const& attitude) {
  m.number("roll", attitude.roll_rad, radians(3));
  m.number("pitch", attitude.pitch_rad, radians(3));
  m.number("yaw", attitude.yaw_rad, radians(3));
}

static void members(FieldTable& m, vehicle::Battery const& battery) {
  auto const tens = seconds(-1);  // it is no more exact than that, and every change is sent
  bool const is_estimate = battery.time_left_is_estimate;
  auto const& flight = battery.in_flight;
  auto const error = is_estimate ? std::optional(battery.time_left_error) : std::nullopt;
  m.number("id", battery.id == 0 ? std::nullopt : std::optional(battery.id), count, "Not for the first one.");
  m.number("remaining", battery.remaining, share(3));
  m.number("voltage_v", battery.voltage_v, volts(2));
  m.number("current_a", battery.current_a, amperes(2));
  m.number("consumed_ah", battery.consumed_ah, ampere_hours(3));
  m.number("time_left_s", battery.time_left, tens, "At what the vehicle does now.");
  m.flag("time_left_is_estimate", told_if(is_estimate), "Ours: the vehicle does not say.");
  m.number("time_left_error_s", error, tens, "Of an estimate, to either side.");
  m.number("in_flight_s", flight ? std::optional(flight->time) : std::nullopt, tens,
           "What is left would last so long in flight, by this flight or the last one.");
  m.number("in_flight_error_s", flight ? std::optional(flight->error) : std::nullopt, tens);
}

static void members(FieldTable& m, vehicle::Gps const& gps) {
  m.text("fix", vehicle::gps_fix_name(gps.fix), "\"no fix\", \"3D\", \"RTK fixed\" ...");
  m.number("satellites", gps.satellites, count.within(0, 1000));
  m.number("hdop", gps.hdop, ratio(2).within(0, 1e6));
}

static void members(FieldTable& m, vehicle::Estimator const& estimator) {
  m.number("velocity", estimator.velocity, ratio(2));
  m.number("position_horizontal", estimator.position_horizontal, ratio(2));
  m.number("position_vertical", estimator.position_vertical, ratio(2));
  m.number("compass", estimator.compass, ratio(2));
}

static void members(FieldTable& m, vehicle::RemoteControl const& remote) {
  auto const shown = std::clamp<std::ptrdiff_t>(remote.channels, 0, std::ssize(remote.pulses_us));
  std::vector const pulses(remote.pulses_us.begin(), remote.pulses_us.begin() + shown);
  m.flag("lost", remote.is_lost);
  m.number("channels", remote.channels, count);
  m.number("rssi", remote.rssi, share(2));
  m.numbers("pulses_us", pulses, Unit{"us", 0, 0, 65535}, "Null: not used.");
}

static void members(FieldTable& m, vehicle::Radio const& radio) {
  m.number("rssi", radio.rssi, ratio(0), "In the radio's own units, 0 to 254, as the next three.");
  m.number("remote_rssi", radio.remote_rssi, ratio(0));
  m.number("noise", radio.noise, ratio(0));
  m.number("remote_noise", radio.remote_noise, ratio(0));
  m.number("buffer_free", radio.transmit_buffer_free, share(2));
  m.number("receive_errors", radio.receive_errors, count);
}

static void members(FieldTable& m, vehicle::Hud const& hud) {
  m.number("airspeed_m_s", hud.airspeed_m_s, metres_a_second(1));
  m.number("climb_m_s", hud.climb_m_s, metres_a_second(1));
  m.number("throttle", hud.throttle, share(2).within(-1, 2));
}

static void members(FieldTable& m, vehicle::Wind const& wind) {
  m.number("from_rad", wind.from_rad, radians(2));
  m.number("speed_m_s", wind.speed_m_s, metres_a_second(1).within(0, 1000));
}

static void members(FieldTable& m, vehicle::Fence const& fence) {
  m.flag("breached", fence.is_breached);
  m.number("breaches", fence.breaches, count);
  m.text("type", unless_empty(fence.type));
}

static void members(FieldTable& m, vehicle::Health const& health) {
  m.flag("position_ok", health.position_ok);
  m.flag("prearm_ok", health.prearm_ok);
}

static void members(FieldTable& m, vehicle::MissionProgress const& mission) {
  m.number("current", mission.current_seq, count);
  m.number("total", mission.total, count);
  m.flag("complete", mission.complete);
  m.text("state", unless_empty(mission.state));
}

static void members(FieldTable& m, vehicle::Gimbal const& gimbal) {
  m.number("roll_rad", gimbal.roll_rad, radians(3));
  m.number("pitch_rad", gimbal.pitch_rad, radians(3), "Negative is down.");
  m.number("yaw_rad", gimbal.yaw_rad, radians(3));
  m.flag("yaw_is_from_north", gimbal.yaw_is_from_north, "Otherwise from the vehicle's nose.");
}

static void members(FieldTable& m, vehicle::Component const& component) {
  m.number("id", component.id, count);
  m.text("kind", component.kind);
  m.text("state", unless_empty(component.state));
  m.text("model", unless_empty(component.model));
}

static void members(FieldTable& m, vehicle::Pictures const& pictures) {
  m.number("taken", pictures.taken, count);
  m.number("lost", pictures.lost, count, "Taken, but nobody told where.");
}

static void members(FieldTable& m, vehicle::CarrierReport const& carrier) {
  m.number("asked_speed_m_s", carrier.asked_speed_m_s, metres_a_second(2));
  m.number("asked_yaw_rad", carrier.asked_yaw_rad, radians(3));
  m.flag("completed", carrier.has_completed, "It goes as it was asked to.");
  m.flag("avoids_obstacle", carrier.avoids_obstacle);
  m.flag("killed", carrier.is_killed, "It stands until an operator lets it go again.");
}

static void members(FieldTable& m, LinkShown const& shown) {
  auto const& link = shown.link;
  auto const loss = shown.is_heard && link.is_alive ? std::optional(link.loss) : std::nullopt;
  // Rounded so that what hardly changes is not sent again and again.
  m.text("name", link.name);
  m.number("loss", loss, share(2), "Missing while nothing is heard on it.");
  m.number("messages_per_s", link.messages_per_s, a_second(0).within(0, 1e6));
  m.number("bytes_per_s", link.bytes_per_s, a_second(-1));
  m.number("round_trip_s", link.round_trip, seconds(2), "By TIMESYNC; missing until it was measured.");
  m.flag("alive", link.is_alive, "Not silent for longer than is usual for it.");
  m.flag("used", link.is_used, "Commands go over it.");
}

static void members(FieldTable& m, vehicle::StatusText const& text) {
  auto const component = text.component == 1 ? std::nullopt : std::optional(text.component);
  m.number("severity", text.severity, count.within(0, 7), "As syslog: 0 emergency to 7 debug.");
  m.text("text", text.text);
  m.number("component", component, count, "Who said it; missing for the autopilot.");
}

static void members(FieldTable& m, vehicle::ControlState const& control) {
  bool const is_asked_for = !control.asked_for_by.empty();
  auto const granted = is_asked_for ? std::optional(control.granted_at.time_since_epoch()) : std::nullopt;
  m.text("commander", control.commander, "An operator, `script`, or nobody: empty.");
  m.text("asked_for_by", unless_empty(control.asked_for_by), "Who asks him for it.");
  m.number("granted_at_s", granted, seconds(3), "By the clock of the message's `time_s`.");
}

// ---- the table; each line {key, member, unit with rounding and range, what it says, which message tells it}. What is
// `Aged` in the state has an age.

namespace {

void identity(FieldTable& t, VehicleState const& state) {
  t.number("system_id", state.system_id, count, "MAVLink's; 0 for what has none.");
  t.text("name", state.name, "\"copter 1\".");
  t.word("family", vehicle::to_string(state.family), family_words);
  t.text("autopilot", vehicle::to_string(state.autopilot), "`ardupilot`, `px4` or `other`.");
  t.text("mode", state.mode, "The autopilot's own name.", "HEARTBEAT");
  t.list(
      "texts",
      told_if_any(state.recent_texts, state.recent_texts.empty() ? base::TimePoint{} : state.recent_texts.back().heard),
      Unique::no, {"Said"}, "Newest last.", "STATUSTEXT");
  t.object("control", state.control, {"Control", "Who commands a vehicle, and who wants to."});
  t.text("foreign_change", state.foreign_change, "The last thing that happened to it without this station.");
}

void links(FieldTable& t, vehicle::Links const& links) {
  bool const is_heard = !links.is_silent && links.connection != vehicle::Connection::lost;
  std::vector<LinkShown> shown;
  for (auto const& link : links.all) shown.push_back({link, is_heard});
  t.word("connection", vehicle::to_string(links.connection), connection_words);
  t.text("link", links.used, "Over which it is commanded.");
  t.list("links", Told{.value = shown.empty() ? nullptr : &shown, .is_optional = true}, Unique::by_name,
         {"LinkQuality", "One of the links on which a vehicle is heard, over the last 10 s."});
  t.flag("heartbeat", told_at(true, links.heartbeat_heard), "True: its age is what counts.", "HEARTBEAT");
  // Only then: it would be news with every message.
  t.flag("silent", told_at(links.is_silent, links.is_silent ? std::optional(links.heard) : std::nullopt),
         "Nothing has come from it for some seconds; its age is that of the silence.");
  t.object("remote_control", links.remote_control, {"RemoteControl"}, "`null` among `pulses_us`: not used.",
           "RC_CHANNELS, SYS_STATUS");
  t.object("radio", links.radio, {"Radio", "The telemetry radio's own view of its link."}, {}, "RADIO_STATUS");
}

void motion(FieldTable& t, vehicle::Motion const& motion) {
  t.flag("landed", motion.landed, {}, "EXTENDED_SYS_STATE");
  t.object("position", motion.position, position_type, {}, "GLOBAL_POSITION_INT");
  t.object("site_pose", motion.site_pose, {"SitePose", "Where it is in the frame of a site, and where it looks."},
           "Of what moves in a site's frame: robots indoors.");
  t.number("relative_alt_m", motion.relative_alt_m, metres(2), "Above home.", "GLOBAL_POSITION_INT");
  t.object("velocity_m_s", motion.velocity_m_s, {"Velocity"}, {}, "GLOBAL_POSITION_INT");
  t.object("attitude_rad", motion.attitude, {"Attitude"}, {}, "ATTITUDE");
  t.number("heading_rad", motion.heading_rad, radians(3), "Clockwise from true north.", "GLOBAL_POSITION_INT");
  t.object("hud", motion.hud, {"Hud"}, {}, "VFR_HUD");
  t.object("wind", motion.wind, {"Wind"}, {}, "WIND, WIND_COV");
  t.object("home", motion.home, position_type, {}, "HOME_POSITION");
  t.number("track_m", motion.track_m, metres(1).within(0, 1e9), "Travelled since it was discovered.");
}

void positioning(FieldTable& t, vehicle::Positioning const& positioning) {
  t.object("gps", positioning.gps, {"Gps"}, {}, "GPS_RAW_INT");
  t.object("estimator", positioning.estimator, {"Estimator"},
           "0.5 deserves a look, above 1 the sensor is not believed.", "EKF_STATUS_REPORT, ESTIMATOR_STATUS");
}

void power(FieldTable& t, vehicle::Power const& power) {
  auto heard = base::TimePoint::max();
  std::vector<vehicle::Battery> further;
  for (auto const& battery : power.further_batteries) {
    further.push_back(*battery.value);
    heard = std::min(heard, battery.heard);
  }
  t.object("battery", power.battery, battery_type, {}, "BATTERY_STATUS 0, else SYS_STATUS");
  t.list("further_batteries", told_if_any(further, heard), Unique::no, battery_type, "As old as the oldest.",
         "BATTERY_STATUS 1, 2 ...");
}

void arming(FieldTable& t, vehicle::Arming const& arming) {
  std::vector<std::string_view> reasons;
  for (auto const& reason : arming.reasons) reasons.emplace_back(reason.text);
  t.flag("armed", arming.armed, {}, "HEARTBEAT");
  t.object("health", arming.health, {"Health"}, {}, "EKF_STATUS_REPORT, ESTIMATOR_STATUS, SYS_STATUS");
  t.texts("unhealthy", arming.unhealthy, Unique::by_value, "Sensors that are there, enabled and sick.", "SYS_STATUS");
  // An empty list, too: a reason that is gone must go.
  t.texts(
      "arming_reasons", told_at(reasons, reasons.empty() ? std::nullopt : std::optional(arming.reasons.back().heard)),
      Unique::by_value,
      "Why it will not arm, in its own words; gone when the checks pass, when it arms, or when they are not repeated "
      "for 75 s.",
      "STATUSTEXT");
}

void mission(FieldTable& t, vehicle::MissionState const& mission) {
  t.object("mission", mission.progress, {"MissionProgress"}, {}, "MISSION_CURRENT");
  t.number("waypoint_distance_m", mission.waypoint_distance_m, metres(0).within(0, 1e8), "To where it is bound for.",
           "NAV_CONTROLLER_OUTPUT");
  t.object("fence", mission.fence, {"Fence"}, {}, "FENCE_STATUS");
}

void payload(FieldTable& t, FieldVisitor& visitor, vehicle::Payload const& payload) {
  t.texts("payload", payload.names, Unique::by_value, "Equipment by the names that scripts ask for.");
  t.object("gimbal", payload.gimbal, {"Gimbal"}, {}, "GIMBAL_DEVICE_ATTITUDE_STATUS, MOUNT_STATUS");
  auto const& components = payload.components;
  t.list("components", Told{.value = components.empty() ? nullptr : &components, .is_optional = true}, Unique::by_id,
         {"Component", "What else is aboard; its age is that of the key component_ID."},
         "Cameras, gimbals, companion computers; the age of each is `component_ID` in `age_s`.",
         "HEARTBEAT of other components");
  for (auto const& component : components) {
    auto const key = fmt::format("component_{}", component.id);
    Member const member{.key = key, .has_age = true, .heard = component.heard};
    if (visitor.wants(member)) visitor.flag(member, true);
  }
  t.object("pictures", payload.pictures, {"PictureCount"}, "`lost`: taken, but nobody told where.",
           "CAMERA_IMAGE_CAPTURED, CAMERA_FEEDBACK, CAMERA_TRIGGER");
}

}  // namespace

void vehicle_fields(FieldVisitor& visitor, VehicleState const& state) {
  FieldTable t(visitor);
  identity(t, state);
  links(t, state.links);
  motion(t, state.motion);
  positioning(t, state.positioning);
  power(t, state.power);
  arming(t, state.arming);
  mission(t, state.mission);
  payload(t, visitor, state.payload);
  t.object("carrier", state.carrier.report, {"Carrier", "What a robot's carrier was asked, and whether it does so."},
           "Of robots.");
}

}  // namespace lapwing::station::internal
