#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <variant>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/async/task.hpp"
#include "base/error.hpp"
#include "firmware/frames/codec.hpp"
#include "firmware/wire/frame.hpp"
#include "link/byte_link.hpp"
#include "robot/carrier/scan.hpp"

namespace lapwing::robot {

/// What the carrier can be told. The numbers in it are given by the client.
using Order = std::variant<firmware::Drive, firmware::Turn, firmware::Stop>;

struct CarrierSettings {
  base::Duration alive_period = std::chrono::milliseconds(200);
  base::Duration hail_period = std::chrono::milliseconds(500);
  /// A command that the readings do not show by then was lost on the line.
  base::Duration repeat_after = std::chrono::milliseconds(250);
  int most_repeats = 8;
  /// Five readings: the board is away.
  base::Duration silence = std::chrono::milliseconds(500);
};

/// Whom the client tells what the board says. Each may be empty.
struct CarrierListener {
  std::function<void(firmware::Hello const&, bool has_started_anew)> here;
  std::function<void(std::string const& why)> away;
  std::function<void(firmware::Readings const&)> readings;
  std::function<void(LaserRanges const&)> scan;
  std::function<void(firmware::Log const&)> log;
};

/// The host's end of the line to a robot's board (docs/reference/robot-serial.md).
///
/// Finds the board, says that somebody is there five times a second, gives commands and learns what became of them, and
/// comes back by itself after the line was unplugged. Commands that were lost on the line are said again. A kill goes
/// out before everything that waits, and again until the readings show it, over whatever outage.
///
/// Thread-bound to its loop. The link must outlive it, and `start` of the link is the client's to call.
class CarrierClient {
 public:
  CarrierClient(base::Loop& loop, link::ByteLink& link, CarrierSettings const& settings = {});

  void start(CarrierListener listener);

  /// What the board said of its body. Error (timed_out): it did not say anything; says where to look.
  [[nodiscard]] base::Task<base::Result<firmware::Description>> description(base::Duration timeout);

  /// Until the order is completed. Errors: cancelled (another order came), refused (killed, or the board would not),
  /// lost (the board went away, or started anew), timed_out. What goes on after `timed_out` goes on.
  [[nodiscard]] base::Task<base::Result<>> carry_out(Order order, base::Duration timeout);
  /// The same without waiting: for who steers all the time. Error: refused, lost.
  base::Result<> begin(Order order);

  /// Past everything. Holds until `release`, also for a board that is away now.
  void kill();
  /// The operator's: no planner may.
  void release();

  struct Status {
    bool is_here = false;
    std::string why_away;  ///< for people; empty when it is here
    std::optional<firmware::Hello> hello;
    std::optional<firmware::Readings> readings;
    base::TimePoint heard{};
    bool is_kill_wanted = false;
    bool is_killed = false;                   ///< as the board says
    std::optional<base::Duration> kill_took;  ///< from `kill` to the readings that showed the wheels at zero
    firmware::FrameReader::Counters frames;
    std::uint64_t scans_lost = 0;
    std::uint64_t repeats = 0;
  };
  [[nodiscard]] Status status() const;

 private:
  struct Running {
    firmware::CommandNumber number = 0;
    firmware::FromHost frame;
    base::TimePoint said{};
    int repeats = 0;
    bool is_taken = false;  ///< the readings have shown it
  };
  struct End {
    firmware::CommandNumber number = 0;
    base::Result<> result;
  };

  base::Task<> keep_talking();
  void talk();
  void hear(link::Peer peer, link::Bytes bytes);
  void take(firmware::FromBoard const& record);
  void take(firmware::Hello const& hello);
  void take(firmware::Readings const& readings);
  void take(firmware::LaserPiece const& piece);
  void take(firmware::Completed const& completed);
  void take(firmware::Log const& log);
  void follow(firmware::Readings const& readings);
  void follow_kill(firmware::Readings const& readings);
  void repeat_lost();
  void lose(std::string why);
  void end(base::Result<> result);
  base::Result<firmware::CommandNumber> give(Order order);
  [[nodiscard]] base::Result<> may_move() const;
  [[nodiscard]] std::optional<base::Result<>> end_of(firmware::CommandNumber number) const;
  bool send(firmware::FromHost const& record, link::Urgency urgency);
  [[nodiscard]] bool is_due(std::optional<base::TimePoint>& last, base::Duration period) const;
  [[nodiscard]] std::string why_silent() const;

  base::Loop& loop_;
  link::ByteLink& link_;
  CarrierSettings settings_;
  CarrierListener listener_;
  firmware::FrameReader reader_;
  ScanAssembly scans_;
  std::optional<link::Peer> peer_;
  std::uint8_t sequence_ = 0;

  Status status_;
  firmware::CommandNumber last_number_ = 0;
  std::optional<Running> running_;
  std::deque<End> ends_;  ///< the newest few, for who waits
  std::optional<base::TimePoint> hailed_;
  std::optional<base::TimePoint> alive_;
  std::optional<base::TimePoint> released_;
  base::TimePoint killed_at_{};
  bool is_release_wanted_ = false;
  bool is_hello_awaited_ = true;

  base::Notifier changed_;
  base::Scope scope_;
};

}  // namespace lapwing::robot
