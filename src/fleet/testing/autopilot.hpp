#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/async/scope.hpp"
#include "link/byte_link.hpp"
#include "mavlink/codec/codec.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::fleet {

/// Mode numbers of ArduPilot's vehicles that the tests speak of.
namespace copter_mode {
inline constexpr std::uint32_t stabilize = 0;
inline constexpr std::uint32_t automatic = 3;
inline constexpr std::uint32_t guided = 4;
inline constexpr std::uint32_t rtl = 6;
inline constexpr std::uint32_t land = 9;
inline constexpr std::uint32_t brake = 17;
}  // namespace copter_mode
namespace rover_mode {
inline constexpr std::uint32_t manual = 0;
inline constexpr std::uint32_t hold = 4;
inline constexpr std::uint32_t automatic = 10;
}  // namespace rover_mode

namespace plane_mode {
inline constexpr std::uint32_t automatic = 10;
inline constexpr std::uint32_t loiter = 12;
}  // namespace plane_mode

/// A scripted autopilot on the far end of a link, for tests: answers as ArduPilot does, misbehaves when told to. It has
/// hardly any physics: every mission item takes `item_time`, or longer where its place is far, and it moves there
/// evenly; LAND puts it on the ground and disarms it. By hand it climbs at 5 m/s and goes places at 10 m/s.
class TestAutopilot {
 public:
  struct Options {
    mavlink::Address address{1, 1};
    mavlink::MavType type = mavlink::MavType::quadrotor;
    mavlink::MavAutopilot autopilot = mavlink::MavAutopilot::ardupilotmega;
    base::Duration item_time = std::chrono::seconds(3);
    base::Duration position_ok_after{};  ///< boot to estimator
    bool asks_with_request_int = false;  ///< ArduPilot asks with MISSION_REQUEST
    base::Duration request_spacing = std::chrono::milliseconds(5);
    bool tells_place = false;  ///< when asked for that message; not with two of them, which are too much alike then
  };

  TestAutopilot(base::Loop& loop, std::unique_ptr<link::ByteLink> link, Options options);
  TestAutopilot(TestAutopilot const&) = delete;
  TestAutopilot& operator=(TestAutopilot const&) = delete;

  // ---- how it misbehaves ----
  bool is_silent = false;                         ///< neither sends nor hears
  std::optional<std::string> arming_refusal;      ///< refuses with this text
  std::optional<std::uint16_t> refused_item;      ///< answered with MISSION_ACK "unsupported"
  std::optional<std::uint16_t> silent_from_item;  ///< goes silent when this item arrives
  std::set<mavlink::MavCmd> refused_commands;
  std::set<mavlink::MavCmd> ignored_commands;
  std::set<mavlink::MessageId> denied_intervals;
  bool has_home = true;  ///< when asked for it
  std::set<std::uint32_t> refused_modes;
  std::map<mavlink::MavCmd, std::uint32_t> modes_by_command;  ///< of an autopilot without modes that are known
  bool takes_set_current_message = false;                     ///< instead of the command
  bool forgets_items = false;                                 ///< stores every item a hundred metres too high
  std::optional<double> battery = 0.8;
  bool ends_in_rtl = false;  ///< as ArduPlane does after its last item
  bool reports_complete = true;
  bool is_stuck = false;                     ///< carries its item out for ever and moves no more
  bool keeps_armed = false;                  ///< on the ground, too
  std::optional<geo::Wgs84> false_position;  ///< which it tells instead of its own
  std::map<std::string, float> parameters{{"FENCE_ENABLE", 0.0F}, {"FENCE_AUTOENABLE", 0.0F}};
  std::vector<mavlink::MissionItem> fence;
  int times_busy = 0;  ///< so many commands are answered "temporarily rejected"

  bool climbs = true;         ///< when told to take off; else its height stays where it is
  bool moves = true;          ///< when told to go to a place
  bool tells_target = false;  ///< POSITION_TARGET_GLOBAL_INT, every half second while guided to a place

  // ---- what tests do to it ----
  void change_mode(std::uint32_t mode);
  void disarm();
  /// What another ground station can do: go on with that item.
  void jump_to(std::uint16_t item);
  /// Back on another link, disarmed, in its first mode, without its message rates.
  void reboot(std::unique_ptr<link::ByteLink> link);
  void say(mavlink::MavSeverity severity, std::string text);
  void send(mavlink::Message const& message) { send_as(options_.address, message); }
  void send_as(mavlink::Address source, mavlink::Message const& message);
  /// Sends `message` every `interval` without having been asked.
  void stream(mavlink::MessageId message, base::Duration interval) { intervals_[message] = {interval, {}}; }

  // ---- what it knows ----
  std::uint32_t mode = 0;
  bool is_armed = false;
  bool is_flying = false;
  std::vector<mavlink::MissionItem> mission;
  std::uint16_t current_item = 0;
  double height_m = 0.0;  ///< above home, as it tells; of itself it changes at a take-off and a landing alone
  geo::Ned velocity_m_s{};
  std::optional<geo::Wgs84> place;      ///< when it is not where its mission has it
  std::optional<geo::Wgs84> goal;       ///< of the last command to go somewhere
  std::vector<mavlink::Message> heard;  ///< from the ground; heartbeats and questions who it is excepted
  [[nodiscard]] int commands_heard(mavlink::MavCmd command) const;
  [[nodiscard]] std::vector<std::uint32_t> modes_commanded() const;
  [[nodiscard]] std::vector<mavlink::MessageId> messages_asked_for() const;
  [[nodiscard]] std::optional<base::Duration> interval(mavlink::MessageId message) const {
    auto const found = intervals_.find(message);
    return found == intervals_.end() ? std::nullopt : std::optional(found->second.interval);
  }
  [[nodiscard]] bool was_upload_cancelled() const { return upload_cancelled_; }
  /// Where it is.
  [[nodiscard]] geo::Wgs84 position() const;

  static constexpr geo::Wgs84 home = geo::Wgs84::from_degrees(40.0, -8.0, 100.0);

 private:
  struct Rate {
    base::Duration interval{};
    base::TimePoint next{};
  };
  struct Upload {
    std::uint16_t count = 0;
    std::uint16_t taken = 0;
    base::TimePoint last_good{};
    base::TimePoint next_request{};
    bool is_asking = false;  ///< an item that it has not asked for yet is not taken
    mavlink::Address partner{};
  };

  void attach(std::unique_ptr<link::ByteLink> link);
  void take(mavlink::Frame const& frame);
  void obey(mavlink::MavCmd command, std::array<float, 7> const& params, mavlink::Address from);
  mavlink::MavResult execute(mavlink::MavCmd command, std::array<float, 7> const& params);
  mavlink::MavResult serve_stream(mavlink::MavCmd command, std::array<float, 7> const& params);
  void move();
  mavlink::MavResult arm();
  void serve_upload(mavlink::Message const& message, mavlink::Address from);
  void serve_download(mavlink::Message const& message, mavlink::Address from);
  void serve_parameter(mavlink::Message const& message);
  void take_item(mavlink::MissionItem item);
  void request_item();
  void beat();
  void send_due_telemetry();
  void send_message(mavlink::MessageId id);
  void advance_mission();
  void begin_item();
  void travel();
  void finish_item();
  base::Task<> live();
  [[nodiscard]] bool is_automatic() const;
  [[nodiscard]] bool is_copter() const { return options_.type == mavlink::MavType::quadrotor; }
  [[nodiscard]] bool has_position() const;

  base::Loop& loop_;
  Options options_;
  std::unique_ptr<link::ByteLink> link_;
  std::optional<link::Peer> ground_;
  mavlink::FrameParser parser_;
  std::uint8_t sequence_ = 0;
  base::TimePoint booted_{};
  base::TimePoint next_beat_{};
  base::TimePoint armed_at_{};
  base::TimePoint item_began_{};
  base::TimePoint item_ends_{};
  base::TimePoint next_target_{};
  std::optional<double> climbs_to_m_;
  geo::Wgs84 leg_from_ = home;
  geo::Wgs84 at_ = home;  ///< but for its height
  bool is_running_mission_ = false;
  bool is_complete_ = false;
  bool upload_cancelled_ = false;
  std::map<mavlink::MessageId, Rate> intervals_;
  std::optional<Upload> upload_;
  base::Scope scope_;
};

}  // namespace lapwing::fleet
