#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::robot::rover {

struct HelmTimes {
  /// It stands so long until it is put into HOLD, and so long until it is disarmed.
  base::Duration hold_after = std::chrono::seconds(3);
  base::Duration disarm_after = std::chrono::seconds(30);
  /// After a refusal it is asked again no sooner.
  base::Duration ask_again_after = std::chrono::seconds(2);
  /// What leaves the kill within that obeys an older command; later its pilot has taken it.
  base::Duration late_commands_end = std::chrono::seconds(10);
};

/// Who may drive a rover: has its autopilot in GUIDED and armed while it is to drive, in HOLD when it stands for a
/// while, and disarmed when it stands for longer. ArduPilot's rovers alone: their modes are known.
///
/// A kill goes out at once, as HOLD and disarming, and again until the autopilot shows both; whatever was under way to
/// arm it ends there. A rover that leaves GUIDED or is disarmed by somebody else, its pilot or a failsafe, is taken
/// for killed as well: nobody arms it again until an operator releases it. Thread-bound.
class RoverHelm {
 public:
  RoverHelm(base::Loop& loop, mavlink::Connection& connection, std::uint8_t system_id, base::Logger log,
            HelmTimes const& times = {});

  /// It is to drive, or to stand. Says so again and again.
  void want(bool is_to_drive);
  void kill();
  void release();
  /// Sends HOLD and disarming once, for who goes.
  void leave();

  /// It obeys setpoints of ours.
  [[nodiscard]] bool may_steer() const { return is_ours_ && !is_killed(); }
  /// It is not to move until it is released.
  [[nodiscard]] bool is_killed() const { return is_kill_wanted_ || is_taken_; }
  /// Its autopilot has shown that it obeys that, or that somebody else has it.
  [[nodiscard]] bool shows_killed() const;
  /// It is to drive, and its autopilot does not let it.
  [[nodiscard]] bool is_refused() const { return is_to_drive_ && !refusal_.empty(); }
  /// A rover of ArduPilot has been heard under the system id.
  [[nodiscard]] bool knows_it() const { return shown_.has_value(); }
  [[nodiscard]] mavlink::Address address() const { return address_; }

 private:
  struct Shown {
    std::uint32_t custom_mode = 0;
    bool is_armed = false;
  };
  void take(mavlink::Received const& received);
  void take(mavlink::Heartbeat const& heartbeat);
  void take(mavlink::StatusText const& text);
  void lose(std::string const& why);
  void send(mavlink::Command const& command);
  void send_stop();
  base::Task<> keep();
  base::Task<> do_next();
  base::Task<> engage();
  base::Task<> rest();
  base::Task<> pursue_kill();
  base::Task<base::Result<>> command(mavlink::Command command, bool is_urgent);
  void refuse(std::string why);
  [[nodiscard]] std::string with_its_reason(std::string what) const;
  [[nodiscard]] bool stands_since(base::Duration time) const { return loop_.now() - stood_up_ >= time; }

  base::Loop& loop_;
  mavlink::Connection& connection_;
  mavlink::Address address_;
  base::Logger log_;
  HelmTimes times_;
  std::uint32_t guided_;
  std::uint32_t hold_;

  std::optional<Shown> shown_;  ///< by its last heartbeat
  bool has_told_of_stranger_ = false;
  bool is_to_drive_ = false;
  base::TimePoint stood_up_{};  ///< when it was told to stand
  bool is_ours_ = false;        ///< in GUIDED and armed by us
  base::TimePoint ours_since_{};
  bool is_resting_ = false;  ///< was ours, and is to be held and disarmed
  base::TimePoint rest_asked_{};
  bool is_taken_ = false;
  bool is_kill_wanted_ = false;
  base::TimePoint kill_asked_{};
  std::optional<base::TimePoint> kill_shown_;  ///< first
  std::string refusal_;                        ///< why it may not drive; empty: it may, or nobody knows
  base::TimePoint ask_again_{};
  std::string objection_;  ///< the last that the autopilot said in words
  base::TimePoint objected_{};
  base::Notifier changed_;
  mavlink::Subscription subscription_;
  std::optional<base::Task<>> doing_;  // behind what it waits for
  base::Scope scope_;
};

}  // namespace lapwing::robot::rover
