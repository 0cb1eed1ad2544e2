// Where the vehicle is and how it moves.
#include "mavlink/codec/internal/codec_parts.hpp"
#include "mavlink/wire/intake.hpp"
#include "mavlink/wire/wire.hpp"

#include <ardupilotmega/mavlink_msg_camera_feedback.hpp>
#include <ardupilotmega/mavlink_msg_wind.hpp>
#include <common/mavlink_msg_attitude.hpp>
#include <common/mavlink_msg_gps_global_origin.hpp>
#include <common/mavlink_msg_gps_raw_int.hpp>
#include <common/mavlink_msg_home_position.hpp>
#include <common/mavlink_msg_local_position_ned.hpp>
#include <common/mavlink_msg_nav_controller_output.hpp>
#include <common/mavlink_msg_position_target_global_int.hpp>
#include <common/mavlink_msg_set_position_target_global_int.hpp>
#include <common/mavlink_msg_vfr_hud.hpp>
#include <standard/mavlink_msg_global_position_int.hpp>

namespace lapwing::mavlink::internal {

using namespace ::mavlink::standard::msg;
using namespace ::mavlink::common::msg;
using ::mavlink::ardupilotmega::msg::CAMERA_FEEDBACK;
using ::mavlink::ardupilotmega::msg::WIND;

namespace {

auto constexpr unknown16 = std::numeric_limits<std::uint16_t>::max();
auto constexpr unknown8 = std::numeric_limits<std::uint8_t>::max();
auto constexpr unknown_signed16 = std::numeric_limits<std::int16_t>::max();
auto constexpr centidegree = degree * centi;

/// 0 is how those say it who do not know; the receivers' own word is the greatest number.
std::optional<double> accuracy_m(std::uint32_t wire) {
  if (wire == 0 || wire == std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return wire * milli;
}

GpsRaw read(GPS_RAW_INT const& w, Intake& in) {
  GpsRaw m{.time = microseconds(w.time_usec),
           .fix = GpsFix{w.fix_type},
           .position = in.place({"lat", "lon", "alt"}, w.lat, w.lon, w.alt),
           .hdop = in("eph", limit::dilution, unless(unknown16, w.eph, centi)),
           .vdop = in("epv", limit::dilution, unless(unknown16, w.epv, centi)),
           .ground_speed_m_s = in("vel", limit::speed_m_s, unless(unknown16, w.vel, centi)),
           .course_rad = in("cog", limit::bearing_rad, unless(unknown16, w.cog, centidegree)),
           .satellites = std::nullopt,
           .horizontal_accuracy_m = in("h_acc", limit::accuracy_m, accuracy_m(w.h_acc)),
           .vertical_accuracy_m = in("v_acc", limit::accuracy_m, accuracy_m(w.v_acc))};
  if (w.satellites_visible != unknown8) m.satellites = w.satellites_visible;
  return m;
}

Attitude read(ATTITUDE const& w, Intake& in) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .roll_rad = in("roll", limit::angle_rad, w.roll),
          .pitch_rad = in("pitch", limit::angle_rad, w.pitch),
          .yaw_rad = in("yaw", limit::angle_rad, w.yaw),
          .roll_rate_rad_s = in("rollspeed", limit::turn_rate_rad_s, w.rollspeed),
          .pitch_rate_rad_s = in("pitchspeed", limit::turn_rate_rad_s, w.pitchspeed),
          .yaw_rate_rad_s = in("yawspeed", limit::turn_rate_rad_s, w.yawspeed)};
}

std::optional<geo::Ned> velocity(GLOBAL_POSITION_INT const& w, Intake& in) {
  if (w.vx == unknown_signed16 || w.vy == unknown_signed16 || w.vz == unknown_signed16) return std::nullopt;
  return in.vector({"vx", "vy", "vz"}, limit::velocity_m_s, w.vx * centi, w.vy * centi, w.vz * centi);
}

GlobalPosition read(GLOBAL_POSITION_INT const& w, Intake& in) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .position = in.place({"lat", "lon", "alt"}, w.lat, w.lon, w.alt),
          .relative_alt_m = in("relative_alt", limit::altitude_m, unless(unknown32, w.relative_alt, milli)),
          .velocity_m_s = velocity(w, in),
          .heading_rad = in("hdg", limit::bearing_rad, unless(unknown16, w.hdg, centidegree))};
}

LocalPosition read(LOCAL_POSITION_NED const& w, Intake& in) {
  return {.since_boot = since_boot(w.time_boot_ms),
          .position_m = in.vector({"x", "y", "z"}, limit::offset_m, w.x, w.y, w.z),
          .velocity_m_s = in.vector({"vx", "vy", "vz"}, limit::velocity_m_s, w.vx, w.vy, w.vz)};
}

VfrHud read(VFR_HUD const& w, Intake& in) {
  return {.airspeed_m_s = in("airspeed", limit::speed_m_s, w.airspeed),
          .ground_speed_m_s = in("groundspeed", limit::speed_m_s, w.groundspeed),
          .heading_rad = in("heading", limit::angle_rad, unless(unknown_signed16, w.heading, degree)),
          .throttle = in("throttle", limit::fraction, unless(unknown16, w.throttle, centi)),
          .alt_m = in("alt", limit::altitude_m, w.alt),
          .climb_m_s = in("climb", limit::velocity_m_s, w.climb)};
}

NavControllerOutput read(NAV_CONTROLLER_OUTPUT const& w, Intake& in) {
  return {
      .nav_roll_rad = in("nav_roll", limit::angle_rad, static_cast<double>(w.nav_roll) * degree),
      .nav_pitch_rad = in("nav_pitch", limit::angle_rad, static_cast<double>(w.nav_pitch) * degree),
      .nav_bearing_rad = in("nav_bearing", limit::angle_rad, unless(unknown_signed16, w.nav_bearing, degree)),
      .target_bearing_rad = in("target_bearing", limit::angle_rad, unless(unknown_signed16, w.target_bearing, degree)),
      .waypoint_distance_m = static_cast<double>(w.wp_dist),
      .alt_error_m = in("alt_error", limit::offset_m, w.alt_error),
      .airspeed_error_m_s = in("aspd_error", limit::airspeed_error, w.aspd_error),
      .cross_track_error_m = in("xtrack_error", limit::offset_m, w.xtrack_error)};
}

Wind read(WIND const& w, Intake& in) {
  return {.from_rad = in("direction", limit::angle_rad, static_cast<double>(w.direction) * degree),
          .speed_m_s = in("speed", limit::wind_speed_m_s, w.speed),
          .down_m_s = in("speed_z", limit::wind_m_s, w.speed_z)};
}

HomePosition read(HOME_POSITION const& w, Intake& in) {
  return {.position = in.place({"latitude", "longitude", "altitude"}, w.latitude, w.longitude, w.altitude),
          .local_m = in.vector({"x", "y", "z"}, limit::offset_m, w.x, w.y, w.z)};
}

GpsGlobalOrigin read(GPS_GLOBAL_ORIGIN const& w, Intake& in) {
  return {.position = in.place({"latitude", "longitude", "altitude"}, w.latitude, w.longitude, w.altitude)};
}

CameraFeedback read(CAMERA_FEEDBACK const& w, Intake& in) {
  return {.time = microseconds(w.time_usec),
          .camera = w.cam_idx,
          .image = w.img_idx,
          .position = in.place({"lat", "lng", "alt_msl"}, w.lat, w.lng, static_cast<double>(w.alt_msl)),
          .relative_alt_m = in("alt_rel", limit::altitude_m, w.alt_rel),
          .roll_rad = in("roll", limit::angle_rad, static_cast<double>(w.roll) * degree),
          .pitch_rad = in("pitch", limit::angle_rad, static_cast<double>(w.pitch) * degree),
          .yaw_rad = in("yaw", limit::angle_rad, static_cast<double>(w.yaw) * degree),
          .completed_captures = w.completed_captures};
}

template <class Wire>
GlobalSetpoint setpoint(Wire const& w) {
  return {.frame = MavFrame{w.coordinate_frame},
          .ignore = w.type_mask,
          .lat_rad = radians_e7(w.lat_int),
          .lon_rad = radians_e7(w.lon_int),
          .alt_m = w.alt,
          .velocity_m_s = {w.vx, w.vy, w.vz},
          .acceleration_m_s2 = {w.afx, w.afy, w.afz},
          .yaw_rad = w.yaw,
          .yaw_rate_rad_s = w.yaw_rate};
}

template <class Wire>
void put_setpoint(GlobalSetpoint const& setpoint, Wire& w) {
  w.coordinate_frame = static_cast<std::uint8_t>(setpoint.frame);
  w.type_mask = setpoint.ignore;
  w.lat_int = degrees_e7(setpoint.lat_rad);
  w.lon_int = degrees_e7(setpoint.lon_rad);
  w.alt = narrow(setpoint.alt_m);
  w.vx = narrow(setpoint.velocity_m_s.north);
  w.vy = narrow(setpoint.velocity_m_s.east);
  w.vz = narrow(setpoint.velocity_m_s.down);
  w.afx = narrow(setpoint.acceleration_m_s2.north);
  w.afy = narrow(setpoint.acceleration_m_s2.east);
  w.afz = narrow(setpoint.acceleration_m_s2.down);
  w.yaw = narrow(setpoint.yaw_rad);
  w.yaw_rate = narrow(setpoint.yaw_rate_rad_s);
}

SetPositionTargetGlobalInt read(SET_POSITION_TARGET_GLOBAL_INT const& w) {
  return {.target = target(w), .since_boot = since_boot(w.time_boot_ms), .setpoint = setpoint(w)};
}

PositionTargetGlobalInt read(POSITION_TARGET_GLOBAL_INT const& w) {
  return {.since_boot = since_boot(w.time_boot_ms), .setpoint = setpoint(w)};
}

}  // namespace

bool is_motion(std::uint32_t message_id) {
  switch (message_id) {
    case GPS_RAW_INT::MSG_ID:
    case ATTITUDE::MSG_ID:
    case GLOBAL_POSITION_INT::MSG_ID:
    case LOCAL_POSITION_NED::MSG_ID:
    case VFR_HUD::MSG_ID:
    case NAV_CONTROLLER_OUTPUT::MSG_ID:
    case WIND::MSG_ID:
    case HOME_POSITION::MSG_ID:
    case GPS_GLOBAL_ORIGIN::MSG_ID:
    case CAMERA_FEEDBACK::MSG_ID:
    case SET_POSITION_TARGET_GLOBAL_INT::MSG_ID:
    case POSITION_TARGET_GLOBAL_INT::MSG_ID: return true;
    default: return false;
  }
}

std::optional<Message> read_motion(Frame const& frame, Intake& in) {
  switch (frame.message_id) {
    case GPS_RAW_INT::MSG_ID: return read(unpack<GPS_RAW_INT>(frame), in);
    case ATTITUDE::MSG_ID: return read(unpack<ATTITUDE>(frame), in);
    case GLOBAL_POSITION_INT::MSG_ID: return read(unpack<GLOBAL_POSITION_INT>(frame), in);
    case LOCAL_POSITION_NED::MSG_ID: return read(unpack<LOCAL_POSITION_NED>(frame), in);
    case VFR_HUD::MSG_ID: return read(unpack<VFR_HUD>(frame), in);
    case NAV_CONTROLLER_OUTPUT::MSG_ID: return read(unpack<NAV_CONTROLLER_OUTPUT>(frame), in);
    case WIND::MSG_ID: return read(unpack<WIND>(frame), in);
    case HOME_POSITION::MSG_ID: return read(unpack<HOME_POSITION>(frame), in);
    case GPS_GLOBAL_ORIGIN::MSG_ID: return read(unpack<GPS_GLOBAL_ORIGIN>(frame), in);
    case CAMERA_FEEDBACK::MSG_ID: return read(unpack<CAMERA_FEEDBACK>(frame), in);
    case SET_POSITION_TARGET_GLOBAL_INT::MSG_ID: return read(unpack<SET_POSITION_TARGET_GLOBAL_INT>(frame));
    case POSITION_TARGET_GLOBAL_INT::MSG_ID: return read(unpack<POSITION_TARGET_GLOBAL_INT>(frame));
    default: return std::nullopt;
  }
}

void write(GpsRaw const& m, Frame& frame) {
  GPS_RAW_INT w{};
  w.time_usec = microsecond_count(m.time);
  w.fix_type = static_cast<std::uint8_t>(m.fix);
  put_place(m.position, w.lat, w.lon, w.alt);
  w.eph = rounded_or(unknown16, m.hdop, centi);
  w.epv = rounded_or(unknown16, m.vdop, centi);
  w.vel = rounded_or(unknown16, m.ground_speed_m_s, centi);
  w.cog = m.course_rad ? heading<std::uint16_t>(*m.course_rad, centidegree) : unknown16;
  w.satellites_visible = m.satellites ? rounded<std::uint8_t>(*m.satellites) : unknown8;
  w.h_acc = rounded_or<std::uint32_t>(0, m.horizontal_accuracy_m, milli);
  w.v_acc = rounded_or<std::uint32_t>(0, m.vertical_accuracy_m, milli);
  pack(w, frame);
}

void write(Attitude const& m, Frame& frame) {
  ATTITUDE w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  w.roll = narrow(m.roll_rad);
  w.pitch = narrow(m.pitch_rad);
  w.yaw = narrow(m.yaw_rad);
  w.rollspeed = narrow(m.roll_rate_rad_s);
  w.pitchspeed = narrow(m.pitch_rate_rad_s);
  w.yawspeed = narrow(m.yaw_rate_rad_s);
  pack(w, frame);
}

void write(GlobalPosition const& m, Frame& frame) {
  GLOBAL_POSITION_INT w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  put_place(m.position, w.lat, w.lon, w.alt);
  w.relative_alt = rounded_or(unknown32, m.relative_alt_m, milli);
  w.vx = m.velocity_m_s ? rounded<std::int16_t>(m.velocity_m_s->north / centi) : unknown_signed16;
  w.vy = m.velocity_m_s ? rounded<std::int16_t>(m.velocity_m_s->east / centi) : unknown_signed16;
  w.vz = m.velocity_m_s ? rounded<std::int16_t>(m.velocity_m_s->down / centi) : unknown_signed16;
  w.hdg = m.heading_rad ? heading<std::uint16_t>(*m.heading_rad, centidegree) : unknown16;
  pack(w, frame);
}

void write(LocalPosition const& m, Frame& frame) {
  LOCAL_POSITION_NED w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  put_vector(m.position_m, w.x, w.y, w.z);
  put_vector(m.velocity_m_s, w.vx, w.vy, w.vz);
  pack(w, frame);
}

void write(VfrHud const& m, Frame& frame) {
  VFR_HUD w{};
  w.airspeed = narrow(m.airspeed_m_s);
  w.groundspeed = narrow(m.ground_speed_m_s);
  w.heading = m.heading_rad ? heading<std::int16_t>(*m.heading_rad, degree) : unknown_signed16;
  w.throttle = rounded_or(unknown16, m.throttle, centi);
  w.alt = narrow(m.alt_m);
  w.climb = narrow(m.climb_m_s);
  pack(w, frame);
}

void write(NavControllerOutput const& m, Frame& frame) {
  NAV_CONTROLLER_OUTPUT w{};
  w.nav_roll = narrow(m.nav_roll_rad, degree);
  w.nav_pitch = narrow(m.nav_pitch_rad, degree);
  w.nav_bearing = rounded_or(unknown_signed16, m.nav_bearing_rad, degree);
  w.target_bearing = rounded_or(unknown_signed16, m.target_bearing_rad, degree);
  w.wp_dist = rounded<std::uint16_t>(m.waypoint_distance_m);
  w.alt_error = narrow(m.alt_error_m);
  w.aspd_error = narrow(m.airspeed_error_m_s);
  w.xtrack_error = narrow(m.cross_track_error_m);
  pack(w, frame);
}

void write(Wind const& m, Frame& frame) {
  WIND w{};
  w.direction = narrow(m.from_rad, degree);
  w.speed = narrow(m.speed_m_s);
  w.speed_z = narrow(m.down_m_s);
  pack(w, frame);
}

void write(HomePosition const& m, Frame& frame) {
  HOME_POSITION w{};
  put_place(m.position, w.latitude, w.longitude, w.altitude);
  put_vector(m.local_m, w.x, w.y, w.z);
  w.q.fill(std::numeric_limits<float>::quiet_NaN());  // how the ground lies is not known
  pack(w, frame);
}

void write(GpsGlobalOrigin const& m, Frame& frame) {
  GPS_GLOBAL_ORIGIN w{};
  put_place(m.position, w.latitude, w.longitude, w.altitude);
  pack(w, frame);
}

void write(CameraFeedback const& m, Frame& frame) {
  CAMERA_FEEDBACK w{};
  w.time_usec = microsecond_count(m.time);
  w.cam_idx = m.camera;
  w.img_idx = m.image;
  w.lat = m.position ? degrees_e7(m.position->lat_rad) : unknown32;
  w.lng = m.position ? degrees_e7(m.position->lon_rad) : unknown32;
  w.alt_msl = m.position ? narrow(m.position->alt_m) : not_a_number;
  w.alt_rel = narrow(m.relative_alt_m);
  w.roll = narrow(m.roll_rad, degree);
  w.pitch = narrow(m.pitch_rad, degree);
  w.yaw = narrow(m.yaw_rad, degree);
  w.completed_captures = m.completed_captures;
  pack(w, frame);
}

void write(SetPositionTargetGlobalInt const& m, Frame& frame) {
  SET_POSITION_TARGET_GLOBAL_INT w{};
  put_target(w, m.target);
  w.time_boot_ms = boot_ms(m.since_boot);
  put_setpoint(m.setpoint, w);
  pack(w, frame);
}

void write(PositionTargetGlobalInt const& m, Frame& frame) {
  POSITION_TARGET_GLOBAL_INT w{};
  w.time_boot_ms = boot_ms(m.since_boot);
  put_setpoint(m.setpoint, w);
  pack(w, frame);
}

}  // namespace lapwing::mavlink::internal
