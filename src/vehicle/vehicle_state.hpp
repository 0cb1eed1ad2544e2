#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
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

struct Battery {
  double remaining = 0.0;  ///< 0..1
  std::optional<double> voltage_v;
  std::optional<double> current_a;
};

/// Where the vehicle stands in the mission it holds.
struct MissionProgress {
  int current_seq = 0;
  int total = 0;
  bool complete = false;
};

struct StatusText {
  int severity = 6;  ///< MAVLink / syslog: 0 emergency .. 7 debug
  std::string text;
  base::TimePoint heard{};
};

/// The vehicle's own view of its health, as far as arming needs it.
struct Health {
  bool position_ok = false;  ///< the estimator has an absolute position and is not guessing
  bool prearm_ok = false;
};

/// Everything known about one vehicle. A value: copy it to keep a moment.
struct VehicleState {
  VehicleId id;
  int system_id = 0;
  std::string name;  ///< "copter 1"
  Family family = Family::unknown;
  Autopilot autopilot = Autopilot::other;
  Connection connection = Connection::ok;
  std::string link;  ///< URL of the link it was last heard on, with its peer
  base::TimePoint heartbeat_heard{};

  Aged<std::string> mode;  ///< the autopilot's own name, "AUTO"
  Aged<bool> armed;
  Aged<bool> landed;
  Aged<geo::Wgs84> position;
  Aged<double> relative_alt_m;  ///< above home
  Aged<geo::Ned> velocity_m_s;
  Aged<Attitude> attitude;
  Aged<double> heading_rad;  ///< clockwise from true north
  Aged<Battery> battery;
  Aged<Health> health;
  Aged<geo::Wgs84> home;
  Aged<MissionProgress> mission;
  std::vector<std::string> payload;      ///< named equipment, "Camera"
  std::vector<geo::Wgs84> planned_path;  ///< positions of the mission it holds, in flight order, for the map
  std::vector<StatusText> recent_texts;  ///< newest last, bounded
  double track_m = 0.0;                  ///< distance travelled since discovery
};

}  // namespace lapwing::vehicle
