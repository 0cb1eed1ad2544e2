#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"
#include "sim/autopilot/autopilot.hpp"
#include "sim/body/camera.hpp"
#include "sim/body/gimbal.hpp"
#include "sim/body/servo_outputs.hpp"
#include "sim/mavlink/file_transfer.hpp"
#include "sim/mavlink/mission_store.hpp"
#include "sim/mavlink/payload_node.hpp"
#include "sim/mavlink/reports.hpp"
#include "sim/mavlink/telemetry.hpp"
#include "sim/model/parameter_table.hpp"

namespace lapwing::sim {

/// What a flight controller keeps while it is switched off.
struct Memory {
  ParameterTable parameters;
  MissionStore::Plans plans;
  std::optional<mavlink::SigningKey> signing_key = std::nullopt;
};

/// One power-on of a vehicle: its autopilot with its MAVLink side on one link. A reboot is the end of this and a new
/// one.
///
/// Passive: the owner calls `step` in time, everything else happens on the arrival of messages. Thread-bound to the
/// loop.
class FlightController {
 public:
  struct Setup {
    std::uint8_t system_id = 1;
    Autopilot::Setup autopilot;
    base::TimePoint powered_on;
  };
  FlightController(base::Loop& loop, Setup const& setup, Site const& site, Memory& memory,
                   std::unique_ptr<link::ByteLink> link, base::Logger log);
  FlightController(FlightController const&) = delete;
  FlightController& operator=(FlightController const&) = delete;

  /// Whether its camera and its gimbal speak for themselves (PX4's TRIG_INTERFACE and MNT_MODE_OUT): then they want
  /// links of their own.
  [[nodiscard]] bool has_camera_node() const;
  [[nodiscard]] bool has_gimbal_node() const;
  void connect_camera(std::unique_ptr<link::ByteLink> link);
  void connect_gimbal(std::unique_ptr<link::ByteLink> link);

  /// Moves the vehicle on by `dt` and sends what became due.
  void step(base::Duration dt, geo::Ned wind_m_s);
  /// Sends the messages that are due now; for those that come more often than steps.
  void send_due();
  [[nodiscard]] base::TimePoint next_due_between(base::Duration step) const;
  [[nodiscard]] base::Duration since_power_on() const { return loop_.now() - powered_on_; }

  /// A ground station asked for a reboot, and the answer has been sent.
  [[nodiscard]] bool reboot_requested() const { return reboot_requested_; }

  /// Neither hears nor sends until then; flies on.
  void fall_silent(base::TimePoint until) { silent_until_ = until; }
  /// A person at the remote control changes the mode. False when the vehicle refuses.
  bool pilot_sets_mode(std::uint32_t number);
  [[nodiscard]] Autopilot& autopilot() { return autopilot_; }
  [[nodiscard]] Autopilot const& autopilot() const { return autopilot_; }
  [[nodiscard]] MissionStore& missions() { return missions_; }
  [[nodiscard]] Camera const& camera() const { return camera_; }
  [[nodiscard]] Gimbal const& gimbal() const { return gimbal_; }

 private:
  using Result = mavlink::MavResult;

  void receive(mavlink::Received const& received);
  void dispatch(mavlink::Message const& message, mavlink::Address from);
  void dispatch_parameter(mavlink::Message const& message, mavlink::Address from);
  void on(mavlink::CommandInt const& command, mavlink::Address from);
  void on(mavlink::SetPositionTargetGlobalInt const& target);
  void on(mavlink::SetPositionTargetLocalNed const& target);
  void on(mavlink::ParamRequestRead const& request, mavlink::Address from);
  void on(mavlink::ParamSet const& set);
  void on(mavlink::SetupSigning const& setup);
  /// Sends a stream at the rate of the parameter of that name (SR0_...), if there is one.
  void follow_stream_rate(std::string_view name, int stream);

  // Commands, in commands.cpp and commands_px4.cpp.
  Result perform(mavlink::CommandInt const& command, mavlink::Address from);
  Result perform_on_px4(mavlink::CommandInt const& command, mavlink::Address from);
  Result px4_set_mode(mavlink::CommandInt const& command);
  Result px4_take_off(mavlink::CommandInt const& command);
  Result perform_request(mavlink::CommandInt const& command, mavlink::Address from);
  Result set_mode(mavlink::CommandInt const& command);
  Result arm_disarm(mavlink::CommandInt const& command);
  Result battery_reset(mavlink::CommandInt const& command);
  Result reposition(mavlink::CommandInt const& command);
  Result set_home(mavlink::CommandInt const& command);
  Result enable_fence(mavlink::CommandInt const& command);
  Result set_interval(mavlink::CommandInt const& command);
  Result get_interval(mavlink::CommandInt const& command, mavlink::Address from);
  Result request_message(mavlink::CommandInt const& command, mavlink::Address from);
  Result reboot(mavlink::CommandInt const& command);
  mavlink::MavMissionResult go_to_item(mavlink::MissionItem const& item);

  // Cameras and gimbals, in payload.cpp.
  std::optional<Result> perform_payload(mavlink::CommandInt const& command);
  void perform_payload(mavlink::MissionItem const& item);
  void step_payload(base::Duration dt);
  [[nodiscard]] std::optional<mavlink::Message> payload_report(mavlink::MessageId id, float argument) const;
  [[nodiscard]] std::optional<mavlink::Message> camera_report(mavlink::MessageId id, float argument) const;
  [[nodiscard]] std::optional<mavlink::Message> gimbal_report(mavlink::MessageId id) const;
  [[nodiscard]] std::unique_ptr<PayloadNode> make_node(std::uint8_t component, mavlink::MavType type,
                                                       PayloadNode::Ports ports, std::unique_ptr<link::ByteLink> link);
  [[nodiscard]] bool is_for_a_node(mavlink::Address target) const;
  [[nodiscard]] mavlink::CameraImageCaptured captured(Camera::Shot const& shot) const;
  [[nodiscard]] mavlink::CameraFeedback feedback(Camera::Shot const& shot) const;
  [[nodiscard]] int camera_type() const;
  [[nodiscard]] bool has_gimbal() const;

  MissionStore::Ports mission_ports();
  void send(mavlink::Address to, mavlink::Message const& message);
  void send(mavlink::Address to, mavlink::Frame const& frame);
  void broadcast(mavlink::Message const& message);
  void broadcast(mavlink::Frame const& frame);
  void broadcast_report(mavlink::MessageId id);
  void say(mavlink::MavSeverity severity, std::string text);
  void send_parameter(std::size_t index, bool in_a_list, mavlink::Address const* to);
  void send_parameter_list();
  void send_parameter_hash(mavlink::Address to);
  void announce_start();
  void send_boot_noise();
  void drain_outbox();
  void send_regular();
  [[nodiscard]] bool is_px4() const { return autopilot_.kind().is_px4(); }
  [[nodiscard]] bool comes_from_the_ground_station(mavlink::Heartbeat const& heartbeat, mavlink::Address from) const;
  [[nodiscard]] bool silent() const { return loop_.now() < silent_until_; }
  [[nodiscard]] ReportView view() const;
  [[nodiscard]] std::optional<mavlink::Frame> sensors(mavlink::MessageId id) const;
  [[nodiscard]] double utc_day_s() const;

  base::Loop& loop_;
  Site const& site_;
  Memory& memory_;
  base::TimePoint powered_on_;
  Autopilot autopilot_;
  Telemetry telemetry_;
  Camera camera_;
  Gimbal gimbal_;
  ServoOutputs outputs_;
  MissionStore missions_;
  FileTransfer files_;
  mavlink::Connection connection_;
  mavlink::Subscription subscription_;
  base::Logger log_;
  std::unique_ptr<PayloadNode> camera_node_;
  std::unique_ptr<PayloadNode> gimbal_node_;
  base::Duration next_gimbal_status_{};
  geo::Ned wind_m_s_;
  base::Duration announced_ = base::Duration{-1};
  base::Duration next_timesync_{};
  base::Duration next_runtime_{};
  base::TimePoint silent_until_{};
  std::optional<mavlink::Address> list_reader_;
  std::size_t list_next_ = 0;
  std::map<mavlink::PeerRef, mavlink::Address> listeners_;  ///< who spoke last at each far end
  bool ground_spoke_ = false;
  bool reboot_requested_ = false;
};

}  // namespace lapwing::sim
