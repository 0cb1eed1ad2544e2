#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/time.hpp"
#include "geo/position.hpp"
#include "mavlink/codec/enums.hpp"
#include "mavlink/codec/payload_messages.hpp"

/// MAVLink messages as values in SI units and radians. What the wire marks as unknown is `nullopt` here, and so is what
/// cannot be (limits.hpp): nobody behind this room has to ask whether a latitude is one. Angles are
/// clockwise from true north where they are headings; altitudes named `alt_m` are above mean sea level. `target` is who
/// is meant; `Connection::send` fills it in. Wire units and sentinels are known to fields_*.hpp alone.
namespace lapwing::mavlink {

using base::Duration;

// ---- identity and time

struct Heartbeat {
  MavType type = MavType::generic;
  MavAutopilot autopilot = MavAutopilot::generic;
  std::uint8_t base_mode = 0;     ///< bits of mode_flag
  std::uint32_t custom_mode = 0;  ///< the autopilot's own number: modes.hpp
  MavState system_status = MavState::uninit;
  std::uint8_t mavlink_version = 3;
  [[nodiscard]] bool armed() const { return (base_mode & mode_flag::safety_armed) != 0; }
};

struct SystemTime {
  std::optional<std::chrono::microseconds> utc{};  ///< since 1970
  Duration since_boot{};                           ///< whole milliseconds
};

struct Ping {
  Address target{};
  std::chrono::microseconds time{};
  std::uint32_t seq = 0;
};

/// A request has tc1 = 0; the answer carries the answering clock in tc1 and the request's ts1.
struct Timesync {
  Duration tc1{};
  Duration ts1{};
};

struct AutopilotVersion {
  std::uint64_t capabilities = 0;
  std::uint32_t flight_sw_version = 0;  ///< 0xMMmmpptt: major, minor, patch, release type
  std::uint32_t board_version = 0;
  std::uint16_t vendor_id = 0;
  std::uint16_t product_id = 0;
  std::uint64_t uid = 0;
  std::array<std::uint8_t, 8> flight_custom_version{};
  std::array<std::uint8_t, 18> uid2{};  ///< the longer number of the hardware; zeros when not told
};

// ---- health

struct SysStatus {
  std::uint32_t sensors_present = 0;  ///< bits of sensor_flag
  std::uint32_t sensors_enabled = 0;
  std::uint32_t sensors_health = 0;
  std::optional<double> load{};  ///< 0..1 of the main loop
  std::optional<double> battery_voltage_v{};
  std::optional<double> battery_current_a{};
  std::optional<double> battery_remaining{};  ///< 0..1
  std::optional<double> drop_rate_comm{};     ///< 0..1
  std::uint16_t errors_comm = 0;
};

struct BatteryStatus {
  std::uint8_t id = 0;
  std::optional<double> voltage_v{};  ///< of the whole pack (sum of the cells that are reported)
  std::optional<double> current_a{};
  std::optional<double> consumed_ah{};
  std::optional<double> energy_consumed_j{};
  std::optional<double> remaining{};      ///< 0..1
  std::optional<double> temperature_c{};  ///< degrees Celsius
  std::optional<std::chrono::seconds> time_remaining{};
  std::uint8_t charge_state = 0;
};

struct EkfStatusReport {
  std::uint16_t flags = 0;  ///< bits of ekf_flag
  std::optional<double> velocity_variance{};
  std::optional<double> position_horizontal_variance{};
  std::optional<double> position_vertical_variance{};
  std::optional<double> compass_variance{};
  std::optional<double> terrain_alt_variance{};
};

/// What PX4 sends instead of EkfStatusReport; the flags have the same meaning.
struct EstimatorStatus {
  std::uint16_t flags = 0;
  std::optional<double> velocity_ratio{};
  std::optional<double> position_horizontal_ratio{};
  std::optional<double> position_vertical_ratio{};
  std::optional<double> position_horizontal_accuracy_m{};
  std::optional<double> position_vertical_accuracy_m{};
};

struct ExtendedSysState {
  MavVtolState vtol_state = MavVtolState::undefined;
  MavLandedState landed_state = MavLandedState::undefined;
};

/// One piece of a text of up to 50 characters. Pieces of a longer text share `id` (not 0) and count `chunk_seq` up from
/// 0; the last piece is the one shorter than 50.
struct StatusText {
  MavSeverity severity = MavSeverity::info;
  std::string text{};
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
};

struct FenceStatus {
  bool breached = false;
  std::uint16_t breach_count = 0;
  std::uint8_t breach_type = 0;
  Duration breach_time{};  ///< since boot
};

struct RadioStatus {
  std::optional<std::uint8_t> rssi{};
  std::optional<std::uint8_t> remote_rssi{};
  std::optional<double> transmit_buffer_free{};  ///< 0..1
  std::optional<std::uint8_t> noise{};
  std::optional<std::uint8_t> remote_noise{};
  std::uint16_t receive_errors = 0;
  std::uint16_t corrected = 0;
};

// ---- motion

struct GpsRaw {
  std::chrono::microseconds time{};
  GpsFix fix = GpsFix::no_gps;
  std::optional<geo::Wgs84> position{};
  std::optional<double> hdop{};
  std::optional<double> vdop{};
  std::optional<double> ground_speed_m_s{};
  std::optional<double> course_rad{};
  std::optional<int> satellites{};
  std::optional<double> horizontal_accuracy_m{};
  std::optional<double> vertical_accuracy_m{};
};

struct Attitude {
  Duration since_boot{};
  std::optional<double> roll_rad{};
  std::optional<double> pitch_rad{};
  std::optional<double> yaw_rad{};
  std::optional<double> roll_rate_rad_s{};
  std::optional<double> pitch_rate_rad_s{};
  std::optional<double> yaw_rate_rad_s{};
};

struct GlobalPosition {
  Duration since_boot{};
  std::optional<geo::Wgs84> position{};
  std::optional<double> relative_alt_m{};  ///< above home
  std::optional<geo::Ned> velocity_m_s{};
  std::optional<double> heading_rad{};
};

/// Relative to the estimator's origin (GpsGlobalOrigin), in metres.
struct LocalPosition {
  Duration since_boot{};
  std::optional<geo::Ned> position_m{};
  std::optional<geo::Ned> velocity_m_s{};
};

struct VfrHud {
  std::optional<double> airspeed_m_s{};
  std::optional<double> ground_speed_m_s{};
  std::optional<double> heading_rad{};
  std::optional<double> throttle{};  ///< 0..1
  std::optional<double> alt_m{};
  std::optional<double> climb_m_s{};
};

struct NavControllerOutput {
  std::optional<double> nav_roll_rad{};
  std::optional<double> nav_pitch_rad{};
  std::optional<double> nav_bearing_rad{};
  std::optional<double> target_bearing_rad{};
  double waypoint_distance_m = 0.0;
  std::optional<double> alt_error_m{};
  std::optional<double> airspeed_error_m_s{};
  std::optional<double> cross_track_error_m{};
};

struct Wind {
  std::optional<double> from_rad{};  ///< the direction it blows from
  std::optional<double> speed_m_s{};
  std::optional<double> down_m_s{};
};

struct HomePosition {
  std::optional<geo::Wgs84> position{};
  std::optional<geo::Ned> local_m{};  ///< relative to the estimator's origin
};

struct GpsGlobalOrigin {
  std::optional<geo::Wgs84> position{};
};

/// Where the estimator's origin shall be, for who has no satellites to find it by.
struct SetGpsGlobalOrigin {
  std::uint8_t target_system = 0;
  std::optional<geo::Wgs84> position{};
};

/// What one range sensor measures.
struct DistanceSensor {
  Duration since_boot{};
  std::optional<double> least_m{};  ///< that it can measure
  std::optional<double> most_m{};
  std::optional<double> distance_m{};
  std::uint8_t id = 0;
  std::uint8_t orientation = 0;  ///< MAV_SENSOR_ORIENTATION: 0 to 7 are yaws of 45 degrees each, clockwise from ahead
};

/// The nearest obstacle in each of up to 72 directions, clockwise.
struct ObstacleDistance {
  std::chrono::microseconds time{};
  std::vector<float> distances_m{};        ///< not a number: not measured; beyond `most_m`: nothing is there
  std::optional<double> step_rad{};        ///< from one direction to the next, to whole degrees; nothing: see below
  std::optional<double> exact_step_rad{};  ///< used instead where it is not zero
  std::optional<double> least_m{};         ///< that can be measured
  std::optional<double> most_m{};
  std::optional<double> first_bearing_rad{};  ///< of the first one
  MavFrame frame = MavFrame::global;          ///< body_frd: from ahead; global: from north
};

struct CameraFeedback {
  std::chrono::microseconds time{};
  std::uint8_t camera = 0;
  std::uint16_t image = 0;
  std::optional<geo::Wgs84> position{};
  std::optional<double> relative_alt_m{};
  std::optional<double> roll_rad{};
  std::optional<double> pitch_rad{};
  std::optional<double> yaw_rad{};
  std::uint16_t completed_captures = 0;
};

/// As PX4 sends it: where the air moves to.
struct WindCov {
  std::chrono::microseconds time{};
  std::optional<double> north_m_s{};
  std::optional<double> east_m_s{};
  std::optional<double> down_m_s{};
};

/// The wire's coordinates of a setpoint; the set bits of `ignore` say which fields do not count
/// (POSITION_TARGET_TYPEMASK). As it was told: a setpoint, like a command or a mission item, says what somebody wants,
/// not what is, and must be recognised as one whatever it asks for.
struct GlobalSetpoint {
  MavFrame frame = MavFrame::global_relative_alt_int;
  std::uint16_t ignore = 0;
  double lat_rad = 0.0;
  double lon_rad = 0.0;
  double alt_m = 0.0;  ///< in the frame's datum
  geo::Ned velocity_m_s{};
  geo::Ned acceleration_m_s2{};
  double yaw_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
};

struct SetPositionTargetGlobalInt {
  Address target{};
  Duration since_boot{};
  GlobalSetpoint setpoint{};
};

/// The same in metres, along the axes of a local frame or of the body.
struct SetPositionTargetLocalNed {
  Address target{};
  Duration since_boot{};
  MavFrame frame = MavFrame::local_ned;
  std::uint16_t ignore = 0;
  geo::Ned position_m{};
  geo::Ned velocity_m_s{};
  geo::Ned acceleration_m_s2{};
  double yaw_rad = 0.0;
  double yaw_rate_rad_s = 0.0;
};

struct PositionTargetGlobalInt {
  Duration since_boot{};
  GlobalSetpoint setpoint{};
};

// ---- commands

/// Parameters are in the units that the standard gives for the command (degrees, metres, seconds), not SI: their
/// meaning is the command's. NaN means "leave as it is" where the command allows it.
struct CommandLong {
  Address target{};
  MavCmd command{};
  std::uint8_t confirmation = 0;
  std::array<float, 7> params{};
};

/// Where a COMMAND_INT or a mission item points. `lat_rad`/`lon_rad` count when `has_place(command)` and the frame is
/// global; otherwise x and y count: metres in a local frame, else parameters 5 and 6 as they are.
struct ItemPlace {
  double lat_rad = 0.0;
  double lon_rad = 0.0;
  double x = 0.0;
  double y = 0.0;
  double z_m = 0.0;  ///< altitude in the frame's datum, or parameter 7 as it is
};

struct CommandInt {
  Address target{};
  MavFrame frame = MavFrame::global;
  MavCmd command{};
  std::array<float, 4> params{};  ///< 1..4, as in CommandLong
  ItemPlace place{};
};

struct CommandAck {
  Address target{};
  MavCmd command{};
  MavResult result = MavResult::accepted;
  std::optional<double> progress{};  ///< 0..1, with in_progress
  std::int32_t result_param2 = 0;
};

/// Deprecated by MAV_CMD_DO_SET_MODE, still accepted by ArduPilot, never acknowledged.
struct SetMode {
  std::uint8_t target_system = 0;
  std::uint8_t base_mode = 0;
  std::uint32_t custom_mode = 0;
};

struct RequestDataStream {
  Address target{};
  std::uint8_t stream = 0;  ///< MAV_DATA_STREAM; 0 is all
  std::uint16_t rate_hz = 0;
  bool start = true;
};

struct MessageInterval {
  MessageId message{};
  std::optional<std::chrono::microseconds> interval{};  ///< nullopt: not sent
};

// ---- parameters

struct ParamRequestRead {
  Address target{};
  std::string name{};  ///< up to 16 characters; used when `index` is -1
  std::int16_t index = -1;
};

struct ParamRequestList {
  Address target{};
};

struct ParamSet {
  Address target{};
  std::string name{};
  float value = 0.0F;  ///< by the vehicle's encoding: param.hpp
  MavParamType type = MavParamType::real32;
};

struct ParamValue {
  std::string name{};
  float value = 0.0F;
  MavParamType type = MavParamType::real32;
  std::uint16_t count = 0;
  std::uint16_t index = 65535;  ///< 65535: not part of a list
};

/// The vehicle cannot read or set a parameter, and says so.
struct ParamError {
  Address target{};
  std::string name{};
  std::int16_t index = -1;
  MavParamError error = MavParamError::no_error;
};

// ---- signing

/// Gives a vehicle the key with which it signs and checks from then on; zeros switch signing off. Whoever hears it has
/// the key: never recorded, never passed on.
struct SetupSigning {
  Address target{};
  std::array<std::uint8_t, 32> key{};
  std::uint64_t initial_timestamp = 0;  ///< units of 10 us since 2015 (signing.hpp)
};

// ---- missions, fences, rally points

/// Whether the item travels as MISSION_ITEM_INT or as the deprecated MISSION_ITEM, whose floats hold a position to
/// about a metre.
enum class ItemForm { integer, floating };

struct MissionItem {
  Address target{};
  std::uint16_t seq = 0;
  MavFrame frame = MavFrame::global;
  MavCmd command{};
  std::array<float, 4> params{};  ///< 1..4 in the command's own units; NaN means "leave it to the vehicle"
  ItemPlace place{};
  std::uint8_t current = 0;
  bool autocontinue = true;
  MissionType type = MissionType::mission;
  ItemForm form = ItemForm::integer;
};

struct MissionCount {
  Address target{};
  std::uint16_t count = 0;
  MissionType type = MissionType::mission;
  std::uint32_t opaque_id = 0;  ///< the vehicle's name for what it holds, changed with every change; 0: it gives none
};

struct MissionRequest {
  Address target{};
  std::uint16_t seq = 0;
  MissionType type = MissionType::mission;
};

struct MissionRequestInt {
  Address target{};
  std::uint16_t seq = 0;
  MissionType type = MissionType::mission;
};

struct MissionRequestList {
  Address target{};
  MissionType type = MissionType::mission;
};

struct MissionRequestPartialList {
  Address target{};
  std::int16_t start = 0;
  std::int16_t end = -1;
  MissionType type = MissionType::mission;
};

struct MissionWritePartialList {
  Address target{};
  std::int16_t start = 0;
  std::int16_t end = -1;
  MissionType type = MissionType::mission;
};

struct MissionAck {
  Address target{};
  MavMissionResult result = MavMissionResult::accepted;
  MissionType type = MissionType::mission;
  std::uint32_t opaque_id = 0;  ///< of what was just uploaded: MissionCount::opaque_id
};

struct MissionClearAll {
  Address target{};
  MissionType type = MissionType::mission;
};

struct MissionSetCurrent {
  Address target{};
  std::uint16_t seq = 0;
};

struct MissionCurrent {
  std::uint16_t seq = 0;
  std::optional<std::uint16_t> total{};  ///< without the home item
  MissionState state = MissionState::unknown;
  std::uint8_t mission_mode = 0;  ///< 1 while the vehicle flies its mission, 2 while it does not, 0 unknown
  std::uint32_t mission_id = 0;   ///< MissionCount::opaque_id of the three plans; 0 unknown
  std::uint32_t fence_id = 0;
  std::uint32_t rally_id = 0;
};

/// ArduPilot reports its mission runner's index here, not always the waypoint's: never wait for an exact number.
struct MissionItemReached {
  std::uint16_t seq = 0;
};

// ---- all of them

using Message =
    std::variant<Heartbeat, SystemTime, Ping, Timesync, AutopilotVersion, SysStatus, BatteryStatus, EkfStatusReport,
                 EstimatorStatus, ExtendedSysState, StatusText, FenceStatus, RadioStatus, GpsRaw, Attitude,
                 GlobalPosition, LocalPosition, VfrHud, NavControllerOutput, Wind, HomePosition, GpsGlobalOrigin,
                 CameraFeedback, SetPositionTargetGlobalInt, PositionTargetGlobalInt, CommandLong, CommandInt,
                 CommandAck, SetMode, RequestDataStream, MessageInterval, ParamRequestRead, ParamRequestList, ParamSet,
                 ParamValue, ParamError, SetupSigning, MissionItem, MissionCount, MissionRequest, MissionRequestInt,
                 MissionRequestList, MissionRequestPartialList, MissionWritePartialList, MissionAck, MissionClearAll,
                 MissionSetCurrent, MissionCurrent, MissionItemReached, WindCov, RcChannels, CameraTrigger,
                 CameraImageCaptured, CameraInformation, GimbalManagerInformation, GimbalDeviceAttitudeStatus,
                 MountStatus, AvailableModes, CurrentMode, AvailableModesMonitor, SetGpsGlobalOrigin, DistanceSensor,
                 ObstacleDistance, SetPositionTargetLocalNed>;

/// Who is meant, or nothing for a message that has no target.
[[nodiscard]] std::optional<Address> target_of(Message const& message);
/// Writes `target` into a message that has one.
void set_target(Message& message, Address target);

}  // namespace lapwing::mavlink
