#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "vehicle/endurance.hpp"
#include "vehicle/equipment.hpp"
#include "vehicle/vehicle_id.hpp"

namespace lapwing::vehicle {

/// A value with the time at which it was heard; never heard is a state of its own, not zero.
template <class T>
struct Aged {
  std::optional<T> value;
  base::TimePoint heard{};

  void set(T now_known, base::TimePoint now) {
    value = std::move(now_known);
    heard = now;
  }
  [[nodiscard]] bool known() const { return value.has_value(); }
  [[nodiscard]] std::optional<base::Duration> age(base::TimePoint now) const {
    if (!value) return std::nullopt;
    return now - heard;
  }
};

/// What moves it: decides icon, capabilities and mode tables.
enum class Family { copter, plane, vtol, rover, boat, sub, unknown };
[[nodiscard]] std::string_view to_string(Family family);

enum class Autopilot { ardupilot, px4, other };
[[nodiscard]] std::string_view to_string(Autopilot autopilot);

/// ok: heard within the time-out · lost: silent for longer · conflict: two vehicles use its system id, commands are
/// refused.
enum class Connection { ok, lost, conflict };
[[nodiscard]] std::string_view to_string(Connection connection);

struct Attitude {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

/// What a battery's own monitor, and the failsafes set in the vehicle, make of its charge.
enum class Charge { unknown, ok, low, critical };

struct Battery {
  double remaining = 0.0;  ///< 0..1
  std::optional<double> voltage_v;
  std::optional<double> current_a;
  int id = 0;
  std::optional<double> consumed_ah = {};
  std::optional<base::Duration> time_left = {};  ///< at what the vehicle does now
  base::Duration time_left_error = {};           ///< to either side; of an estimate only
  bool time_left_is_estimate = false;            ///< ours, not the vehicle's: from what it draws
  /// What is left would last so long in flight, by this flight or the last one; nothing before it has flown.
  std::optional<Endurance> in_flight = {};
  Charge charge = Charge::unknown;
};

struct Gps {
  int fix = 0;  ///< as GPS_FIX_TYPE counts: `gps_fix_name`
  std::optional<int> satellites;
  std::optional<double> hdop;
};
/// "no fix", "3D", "RTK fixed" ...
[[nodiscard]] std::string_view gps_fix_name(int fix);

/// How far the estimator's innovations are from what it trusts: above 1 it does not believe the sensor; above 0.8
/// ArduPilot's failsafe acts by default.
struct Estimator {
  std::optional<double> velocity;
  std::optional<double> position_horizontal;
  std::optional<double> position_vertical;
  std::optional<double> compass;
};

struct RemoteControl {
  bool is_lost = false;  ///< the receiver hears no transmitter
  int channels = 0;
  std::array<std::optional<std::uint16_t>, 18> pulses_us{};
  std::optional<double> rssi;  ///< 0..1
};

/// The telemetry radio's own view of its link, for both ends.
struct Radio {
  std::optional<int> rssi;  ///< in the radio's own units, 0..254
  std::optional<int> remote_rssi;
  std::optional<int> noise;
  std::optional<int> remote_noise;
  std::optional<double> transmit_buffer_free;  ///< 0..1
  int receive_errors = 0;
};

/// What a pilot's head-up display shows beside attitude and position.
struct Hud {
  std::optional<double> airspeed_m_s;
  std::optional<double> climb_m_s;
  std::optional<double> throttle;  ///< 0..1
};

struct Wind {
  double from_rad = 0.0;  ///< clockwise from true north
  double speed_m_s = 0.0;
};

struct Fence {
  bool is_breached = false;
  int breaches = 0;            ///< since boot
  std::string_view type = {};  ///< of the last breach: "maximum altitude"; empty for none
};

/// Where the vehicle stands in the mission it holds.
struct MissionProgress {
  int current_seq = 0;
  int total = 0;
  bool complete = false;
  std::string_view state = {};  ///< "active", "paused" ...; empty when the vehicle does not say
};

struct StatusText {
  int severity = 6;  ///< MAVLink / syslog: 0 emergency .. 7 debug
  std::string text;
  base::TimePoint heard{};
  int component = 1;  ///< who said it; 1 is the autopilot
};

/// The vehicle's own view of its health, as far as arming needs it.
struct Health {
  bool position_ok = false;  ///< the estimator has an absolute position and is not guessing
  bool prearm_ok = false;
};

/// One of the links on which a vehicle is heard, over the last 10 s.
struct LinkQuality {
  std::string name;   ///< URL and far end
  double loss = 0.0;  ///< 0..1
  double messages_per_s = 0.0;
  double bytes_per_s = 0.0;
  std::optional<base::Duration> round_trip;  ///< nothing until it has been measured
  bool is_alive = false;
  bool is_used = false;  ///< commands go over it

  friend bool operator==(LinkQuality const&, LinkQuality const&) = default;
};

/// Who commands the vehicle; names as in vehicle/control.hpp.
struct ControlState {
  std::string commander = {};     ///< empty: nobody
  std::string asked_for_by = {};  ///< who wants it from him; empty: nobody
  base::TimePoint granted_at{};   ///< when that request is granted unless he answers
  friend bool operator==(ControlState const&, ControlState const&) = default;
};

/// Everything known about one vehicle. A value: copy it to keep a moment.
struct VehicleState {
  VehicleId id;
  int system_id = 0;
  std::string name;  ///< "copter 1"
  Family family = Family::unknown;
  Autopilot autopilot = Autopilot::other;
  Connection connection = Connection::ok;
  std::string link;  ///< URL of the link over which it is commanded, with its peer
  std::vector<LinkQuality> links;
  base::TimePoint heartbeat_heard{};
  base::TimePoint heard{};  ///< the last message of its autopilot, whatever it was
  /// Nothing at all has come for some seconds: what stands here is the last that is known. Long before it is lost.
  bool is_silent = false;
  std::string conflict;        ///< which two vehicles use its system id, for people; empty: none
  bool is_in_trouble = false;  ///< by its own heartbeat, which calls its state critical or worse: a failsafe acts

  Aged<std::string> mode;  ///< the autopilot's own name, "AUTO"
  Aged<bool> armed;
  Aged<bool> landed;
  Aged<geo::Wgs84> position;
  Aged<double> relative_alt_m;  ///< above home
  Aged<geo::Ned> velocity_m_s;
  Aged<Attitude> attitude;
  Aged<double> heading_rad;                      ///< clockwise from true north
  Aged<Battery> battery;                         ///< the first one, by which guards go
  std::vector<Aged<Battery>> further_batteries;  ///< by id
  Aged<Gps> gps;
  Aged<Estimator> estimator;
  Aged<Health> health;
  Aged<std::vector<std::string_view>> unhealthy;  ///< sensors that are there, enabled and sick
  std::vector<StatusText> arming_reasons;  ///< why it refused to arm or would, newest last; empty when it would not
  Aged<RemoteControl> remote_control;
  Aged<Radio> radio;
  Aged<Hud> hud;
  Aged<Wind> wind;
  Aged<Fence> fence;
  Aged<geo::Wgs84> home;
  Aged<MissionProgress> mission;
  Aged<double> waypoint_distance_m;  ///< to where it is flying now
  Aged<geo::Wgs84> position_target;  ///< where it is flying now, as it tells; latitude and longitude count
  Aged<Gimbal> gimbal;
  std::vector<Component> components;  ///< besides the autopilot, by id
  Aged<Pictures> pictures;
  std::vector<std::string> payload;      ///< named equipment, "Camera"
  std::vector<geo::Wgs84> planned_path;  ///< positions of the mission it holds, in flight order, for the map
  std::vector<StatusText> recent_texts;  ///< newest last, bounded
  double track_m = 0.0;                  ///< distance travelled since discovery
  ControlState control;
  /// The last thing that happened to it without this station: another station's command, a mode that nobody here asked
  /// for.
  Aged<std::string> foreign_change;
  /// How it came into the mode that it is in, when nobody here asked for that: "AUTO to LOITER". Without a value when
  /// somebody did.
  Aged<std::string> foreign_mode;
};

}  // namespace lapwing::vehicle
