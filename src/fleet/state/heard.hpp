#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "fleet/battery/battery_time.hpp"
#include "fleet/plausibility/fence_memory.hpp"
#include "fleet/state/mode_list.hpp"
#include "fleet/state/pictures.hpp"
#include "fleet/state/status_text.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::fleet {

/// What a vehicle has told about its mission since a run began to look.
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

/// What a vehicle has said, beyond what its state shows to everybody: what telemetry keeps between messages.
struct Heard {
  mavlink::MavAutopilot mav_autopilot{};
  std::string type;                ///< "UAV"
  mavlink::PeerRef from{};         ///< where the last heartbeat came from
  base::TimePoint current_from{};  ///< what was told before is of before a silence, a conflict or a restart
  int boots = 1;                   ///< grows with every restart that was noticed
  unsigned plans_taken = 0;  ///< grows when it says that it has taken a whole plan or was cleared, whoever sent it
  std::optional<std::uint64_t> capabilities;  ///< MAV_PROTOCOL_CAPABILITY, once the vehicle has told

  std::uint32_t custom_mode = 0;
  base::TimePoint mode_changed{};  ///< when a heartbeat first showed it
  bool is_armed = false;
  base::TimePoint armed_changed{};  ///< when a heartbeat first showed it
  MissionTrace trace;
  ModeList modes;
  bool mode_is_unnamed = false;  ///< no table of ours names the present one

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
  FenceMemory fence;  ///< of its own
  PictureTrace pictures;
  std::optional<base::TimePoint> gimbal_status_heard;
};

}  // namespace lapwing::fleet
