#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/async/notifier.hpp"
#include "fleet/battery/battery_time.hpp"
#include "fleet/network/message_rates.hpp"
#include "fleet/network/telemetry_rate.hpp"
#include "fleet/plausibility/fence_memory.hpp"
#include "fleet/state/mode_list.hpp"
#include "fleet/state/pictures.hpp"
#include "fleet/state/questions.hpp"
#include "fleet/state/status_text.hpp"
#include "mavlink/connection/connection.hpp"
#include "mavlink/wire/system_name.hpp"
#include "vehicle/vehicle_state.hpp"

namespace lapwing::fleet {

/// What a vehicle has told about its mission since somebody last cleared this.
struct MissionTrace {
  std::optional<int> current_seq;  ///< the highest
  std::optional<int> reached_seq;  ///< the highest
  bool was_active = false;         ///< the mission was called anything but complete
  bool reports_complete = false;   ///< the last word
  std::optional<base::TimePoint> on_ground_since;
  base::TimePoint on_ground_heard{};

  [[nodiscard]] std::optional<base::Duration> on_ground_for() const {
    if (!on_ground_since) return std::nullopt;
    return on_ground_heard - *on_ground_since;
  }
};

/// One vehicle as the fleet needs it to fly missions, beyond what `vehicle::VehicleState` shows to everybody.
///
/// Written by its `Network`; mission runs read it and wait on `changed`, which tells of every message from the vehicle
/// and of its loss. Thread-bound; lives as long as its fleet, so references to it may be kept.
struct MavlinkVehicle {
  MavlinkVehicle(mavlink::Connection& heard_on, vehicle::VehicleState& shown)
      : connection(heard_on), state(shown), discovered(heard_on.loop().now()), changed(heard_on.loop()) {}

  mavlink::Connection& connection;  ///< of its network
  vehicle::VehicleState& state;     ///< the registry's
  base::TimePoint discovered;       ///< when it was first heard
  std::string network;              ///< its name; empty: the one without
  mavlink::Address address{};
  mavlink::MavAutopilot mav_autopilot{};
  std::string type;  ///< "UAV"
  base::Duration connection_timeout{};
  mavlink::PeerRef from{};  ///< where the last heartbeat came from
  int boots = 1;            ///< grows with every restart that was noticed

  std::uint32_t custom_mode = 0;
  base::TimePoint mode_changed{};  ///< when a heartbeat first showed it
  bool is_armed = false;
  base::TimePoint armed_changed{};    ///< when a heartbeat first showed it
  bool mission_mode_pending = false;  ///< we commanded the mission mode, and no heartbeat has shown what came of it
  /// An upload was given up in the middle: perhaps a part of one plan and a part of another. Until it has taken a whole
  /// one, or was cleared.
  bool holds_parts = false;
  MissionTrace trace;
  std::optional<std::uint32_t> asked_mode;  ///< the last that this station commanded
  base::TimePoint mode_asked{};
  std::optional<std::uint64_t> capabilities;  ///< MAV_PROTOCOL_CAPABILITY, once the vehicle has told
  unsigned armings = 0;                       ///< how often this station has set out to arm it
  int loans = 0;  ///< changes of parameters under way by who commands it for their sake alone
  std::optional<base::TimePoint> arming_begun;  ///< by the operator's present command
  /// An arming was given up unanswered: if the vehicle carries it out before this, it is taken back.
  std::optional<base::TimePoint> may_arm_late_until;

  // What telemetry keeps between messages.
  std::optional<base::Duration> since_boot;  ///< the vehicle's clock, to notice that it began anew
  mavlink::PeerRef clock_from{};             ///< where that was heard
  std::optional<mavlink::GpsFix> fix;
  std::optional<geo::Wgs84> track_end;  ///< up to where `track_m` has been counted
  base::TimePoint track_end_heard{};
  std::optional<geo::Wgs84> path_end;  ///< up to where `path_m` has been counted
  double path_m = 0.0;                 ///< like `track_m`, height differences included
  bool has_reported_battery = false;   ///< be it that it does not know
  std::optional<base::TimePoint> battery_status_heard;
  std::map<std::uint8_t, BatteryTime> battery_times;  ///< by battery
  std::optional<bool> prearm_ok;                      ///< by the last SYS_STATUS
  std::uint32_t sick_sensors = 0;                     ///< bits of mavlink::sensor_flag
  StatusTexts texts;
  FenceMemory fence;                           ///< of its own
  std::optional<base::TimePoint> home_untold;  ///< when its home was last asked for in vain

  // What it carries, and what it is asked once.
  PictureTrace pictures;
  std::optional<base::TimePoint> gimbal_status_heard;
  ModeList modes;
  bool mode_is_unnamed = false;  ///< no table of ours names the present one
  bool has_asked_for_modes = false;
  std::deque<Question> questions;
  bool is_questioning = false;

  std::optional<MessageRates> rates;
  bool is_asking = false;    ///< message intervals are being asked for
  int intervals_untold = 0;  ///< times in a row that it refused to tell an interval
  TelemetryRate telemetry_rate;

  base::Notifier changed;

  [[nodiscard]] vehicle::VehicleId const& id() const { return state.id; }
  [[nodiscard]] mavlink::SystemName name() const { return {network, address.system}; }
  /// What is not known is tried.
  [[nodiscard]] bool takes_command_int() const {
    constexpr std::uint64_t command_int = 8;  // MAV_PROTOCOL_CAPABILITY_COMMAND_INT
    return !capabilities || (*capabilities & command_int) != 0;
  }
  [[nodiscard]] bool is_connected() const { return state.connection == vehicle::Connection::ok; }
};

}  // namespace lapwing::fleet
