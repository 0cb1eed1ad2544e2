#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <utility>

#include "base/async/notifier.hpp"
#include "mavlink/codec/enums.hpp"

namespace lapwing::mavlink {

struct Command;

/// The commands of one kind to one vehicle: whose turn it is, and which tries may still be answered.
class CommandLine {
 public:
  explicit CommandLine(base::Loop& loop) : freed(loop) {}
  [[nodiscard]] bool is_taken() const { return owner_ != 0; }
  /// Tries of late that may still be answered.
  [[nodiscard]] std::size_t unanswered() const { return unanswered_.size(); }

  base::Notifier freed;

 private:
  friend class CommandTurn;
  friend class CommandLedger;
  struct Unanswered {
    std::uint64_t fingerprint;  ///< of the command's parameters
    base::TimePoint sent;
  };
  void forget_old(base::TimePoint now);
  std::uint64_t owner_ = 0;
  std::uint64_t last_owner_ = 0;
  std::deque<Unanswered> unanswered_;
  std::optional<base::TimePoint> last_sent_;
  std::optional<base::TimePoint> last_passed_on_;
};

/// Holds the line while it lives, unless a later turn overtakes it.
class CommandTurn {
 public:
  explicit CommandTurn(CommandLine& line) : line_(line), number_(++line.last_owner_) { line.owner_ = number_; }
  CommandTurn(CommandTurn const&) = delete;
  CommandTurn& operator=(CommandTurn const&) = delete;
  ~CommandTurn();

  [[nodiscard]] bool is_ours() const { return line_.owner_ == number_; }
  void note_sent(Command const& command, base::TimePoint now);
  /// An acknowledgement has come. Whether it can only be meant for `command`: autopilots answer in order, so the oldest
  /// try that still waits for an answer has got this one.
  [[nodiscard]] bool note_answer(Command const& command, base::TimePoint now);

 private:
  CommandLine& line_;
  std::uint64_t number_;
};

/// Every line of one connection. Thread-bound.
class CommandLedger {
 public:
  explicit CommandLedger(base::Loop& loop) : loop_(loop) {}
  [[nodiscard]] CommandLine& line(std::uint8_t system_id, MavCmd command) {
    return lines_.try_emplace({system_id, command}, loop_).first->second;
  }
  /// When a try went out to the vehicle, whoever here has sent it.
  [[nodiscard]] std::optional<base::TimePoint> last_sent(std::uint8_t system_id, MavCmd command) {
    return line(system_id, command).last_sent_;
  }
  /// A command of somebody else, who may speak under our own id.
  void note_passed_on(std::uint8_t system_id, MavCmd command, base::TimePoint now) {
    line(system_id, command).last_passed_on_ = now;
  }
  /// What acknowledges the command now may be meant for him.
  [[nodiscard]] bool was_just_passed_on(std::uint8_t system_id, MavCmd command, base::TimePoint now);

 private:
  base::Loop& loop_;
  std::map<std::pair<std::uint8_t, MavCmd>, CommandLine> lines_;  // nodes do not move
};

}  // namespace lapwing::mavlink
