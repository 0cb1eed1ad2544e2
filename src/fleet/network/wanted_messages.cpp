// Which messages a vehicle is asked for.
#include <algorithm>
#include <array>

#include "fleet/state/telemetry.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

struct Numbering {
  using Id = mavlink::MessageId;
  template <class Other>
  std::optional<Id> operator()(Other const&) const {
    return std::nullopt;
  }
  std::optional<Id> operator()(mavlink::GlobalPosition const&) const { return Id::global_position_int; }
  std::optional<Id> operator()(mavlink::Attitude const&) const { return Id::attitude; }
  std::optional<Id> operator()(mavlink::SysStatus const&) const { return Id::sys_status; }
  std::optional<Id> operator()(mavlink::GpsRaw const&) const { return Id::gps_raw_int; }
  std::optional<Id> operator()(mavlink::MissionCurrent const&) const { return Id::mission_current; }
  std::optional<Id> operator()(mavlink::ExtendedSysState const&) const { return Id::extended_sys_state; }
  std::optional<Id> operator()(mavlink::HomePosition const&) const { return Id::home_position; }
  std::optional<Id> operator()(mavlink::EkfStatusReport const&) const { return Id::ekf_status_report; }
  std::optional<Id> operator()(mavlink::BatteryStatus const&) const { return Id::battery_status; }
  std::optional<Id> operator()(mavlink::VfrHud const&) const { return Id::vfr_hud; }
  std::optional<Id> operator()(mavlink::NavControllerOutput const&) const { return Id::nav_controller_output; }
  std::optional<Id> operator()(mavlink::RcChannels const&) const { return Id::rc_channels; }
  std::optional<Id> operator()(mavlink::FenceStatus const&) const { return Id::fence_status; }
  std::optional<Id> operator()(mavlink::Wind const&) const { return Id::wind; }
  std::optional<Id> operator()(mavlink::WindCov const&) const { return Id::wind_cov; }
  std::optional<Id> operator()(mavlink::GimbalDeviceAttitudeStatus const&) const {
    return Id::gimbal_device_attitude_status;
  }
  std::optional<Id> operator()(mavlink::EstimatorStatus const&) const { return Id::estimator_status; }
};

using mavlink::MessageId;

/// What mission runs go by: never asked for less often.
constexpr std::array needed{
    WantedMessage{MessageId::sys_status, 1s},      WantedMessage{MessageId::gps_raw_int, 1s},
    WantedMessage{MessageId::mission_current, 1s}, WantedMessage{MessageId::extended_sys_state, 1s},
    WantedMessage{MessageId::home_position, 10s},
};
/// What people look at: a slow link carries less of it.
constexpr std::array shown{
    WantedMessage{MessageId::global_position_int, 200ms, true}, WantedMessage{MessageId::attitude, 250ms, true},
    WantedMessage{MessageId::battery_status, 1s, true},         WantedMessage{MessageId::vfr_hud, 1s, true},
    WantedMessage{MessageId::nav_controller_output, 1s, true},  WantedMessage{MessageId::rc_channels, 2s, true},
    WantedMessage{MessageId::fence_status, 2s, true},
};
constexpr std::array of_ardupilot{WantedMessage{MessageId::ekf_status_report, 1s},
                                  WantedMessage{MessageId::wind, 2s, true}};
constexpr std::array of_px4{WantedMessage{MessageId::estimator_status, 1s},
                            WantedMessage{MessageId::wind_cov, 2s, true}};

template <std::size_t... sizes>
constexpr auto joined(std::array<WantedMessage, sizes> const&... parts) {
  std::array<WantedMessage, (sizes + ...)> all{};
  auto end = all.begin();
  ((end = std::ranges::copy(parts, end).out), ...);
  return all;
}
constexpr auto wanted_of_ardupilot = joined(needed, shown, of_ardupilot);
constexpr auto wanted_of_px4 = joined(needed, shown, of_px4);

}  // namespace

std::optional<mavlink::MessageId> id_of(mavlink::Message const& message) {
  return std::visit(Numbering{}, message);
}

std::span<WantedMessage const> wanted_messages(vehicle::Autopilot autopilot) {
  if (autopilot == vehicle::Autopilot::px4) return wanted_of_px4;
  return wanted_of_ardupilot;
}

}  // namespace lapwing::fleet
