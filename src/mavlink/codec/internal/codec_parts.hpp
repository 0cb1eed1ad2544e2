#pragma once

#include <optional>

#include "mavlink/codec/messages.hpp"
#include "mavlink/wire/frame.hpp"

/// The codec's parts, one group of messages a file. `read_*` gives nothing for an id of another group; `write` fills in
/// the frame's id and payload.
namespace lapwing::mavlink::internal {

class Intake;

[[nodiscard]] std::optional<Message> read_state(Frame const& frame, Intake& in);
[[nodiscard]] bool is_motion(std::uint32_t message_id);
[[nodiscard]] std::optional<Message> read_motion(Frame const& frame, Intake& in);
[[nodiscard]] std::optional<Message> read_payload(Frame const& frame, Intake& in);
[[nodiscard]] std::optional<Message> read_command(Frame const& frame, Intake& in);
[[nodiscard]] std::optional<Message> read_mission(Frame const& frame);

/// The place of a COMMAND_INT or MISSION_ITEM_INT.
[[nodiscard]] ItemPlace place_from_wire(MavFrame frame, MavCmd command, std::int32_t x, std::int32_t y, float z);
struct WirePlace {
  std::int32_t x;
  std::int32_t y;
  float z;
};
[[nodiscard]] WirePlace place_to_wire(MavFrame frame, MavCmd command, ItemPlace const& place);

void write(Heartbeat const& m, Frame& frame);
void write(SystemTime const& m, Frame& frame);
void write(Ping const& m, Frame& frame);
void write(Timesync const& m, Frame& frame);
void write(AutopilotVersion const& m, Frame& frame);
void write(SysStatus const& m, Frame& frame);
void write(BatteryStatus const& m, Frame& frame);
void write(EkfStatusReport const& m, Frame& frame);
void write(EstimatorStatus const& m, Frame& frame);
void write(ExtendedSysState const& m, Frame& frame);
void write(StatusText const& m, Frame& frame);
void write(FenceStatus const& m, Frame& frame);
void write(RadioStatus const& m, Frame& frame);

void write(GpsRaw const& m, Frame& frame);
void write(Attitude const& m, Frame& frame);
void write(GlobalPosition const& m, Frame& frame);
void write(LocalPosition const& m, Frame& frame);
void write(VfrHud const& m, Frame& frame);
void write(NavControllerOutput const& m, Frame& frame);
void write(Wind const& m, Frame& frame);
void write(HomePosition const& m, Frame& frame);
void write(GpsGlobalOrigin const& m, Frame& frame);
void write(CameraFeedback const& m, Frame& frame);
void write(SetPositionTargetGlobalInt const& m, Frame& frame);
void write(PositionTargetGlobalInt const& m, Frame& frame);

void write(CommandLong const& m, Frame& frame);
void write(CommandInt const& m, Frame& frame);
void write(CommandAck const& m, Frame& frame);
void write(SetMode const& m, Frame& frame);
void write(RequestDataStream const& m, Frame& frame);
void write(MessageInterval const& m, Frame& frame);
void write(ParamRequestRead const& m, Frame& frame);
void write(ParamRequestList const& m, Frame& frame);
void write(ParamSet const& m, Frame& frame);
void write(ParamValue const& m, Frame& frame);
void write(ParamError const& m, Frame& frame);
void write(SetupSigning const& m, Frame& frame);

void write(MissionItem const& m, Frame& frame);
void write(MissionCount const& m, Frame& frame);
void write(MissionRequest const& m, Frame& frame);
void write(MissionRequestInt const& m, Frame& frame);
void write(MissionRequestList const& m, Frame& frame);
void write(MissionRequestPartialList const& m, Frame& frame);
void write(MissionWritePartialList const& m, Frame& frame);
void write(MissionAck const& m, Frame& frame);
void write(MissionClearAll const& m, Frame& frame);
void write(MissionSetCurrent const& m, Frame& frame);
void write(MissionCurrent const& m, Frame& frame);
void write(MissionItemReached const& m, Frame& frame);

void write(WindCov const& m, Frame& frame);
void write(RcChannels const& m, Frame& frame);
void write(CameraTrigger const& m, Frame& frame);
void write(CameraImageCaptured const& m, Frame& frame);
void write(CameraInformation const& m, Frame& frame);
void write(GimbalManagerInformation const& m, Frame& frame);
void write(GimbalDeviceAttitudeStatus const& m, Frame& frame);
void write(MountStatus const& m, Frame& frame);
void write(AvailableModes const& m, Frame& frame);
void write(CurrentMode const& m, Frame& frame);
void write(AvailableModesMonitor const& m, Frame& frame);

}  // namespace lapwing::mavlink::internal
