#include "robot/carrier/carrier_client.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::robot {

namespace {

using namespace std::chrono_literals;
using base::ErrorKind;
using firmware::CommandNumber;
using firmware::Flag;

/// How often it looks what is due. A kill that was lost is said again as soon.
base::Duration constexpr tick = 20ms;
base::Duration constexpr release_period = 200ms;
std::size_t constexpr most_ends = 16;

/// Why a board has dropped a command that it had.
base::Result<> why_dropped(firmware::Readings const& readings) {
  if (readings.has(Flag::killed))
    return base::fail(ErrorKind::refused, "the robot was killed", "release it when it is safe to move");
  if (readings.has(Flag::left_wheel_dead) || readings.has(Flag::right_wheel_dead))
    return base::fail(ErrorKind::refused,
                      fmt::format("the robot stopped: its {} wheel is driven and gives no pulses",
                                  readings.has(Flag::left_wheel_dead) ? "left" : "right"),
                      "look whether the wheel is blocked, and at the encoder's plug");
  if (readings.has(Flag::imu_silent))
    return base::fail(ErrorKind::refused, "the robot stopped: its inertial unit is silent, so that it has no heading",
                      "look at the unit's plug, then start the board anew");
  if (readings.has(Flag::watchdog))
    return base::fail(ErrorKind::lost, "the robot stopped by itself: it heard nobody for half a second",
                      "look at the line, and whether this program was held up");
  return base::fail(ErrorKind::cancelled, "the robot dropped the command");
}

base::Result<> replaced() {
  return base::fail(ErrorKind::cancelled, "another command took its place");
}

}  // namespace

CarrierClient::CarrierClient(base::Loop& loop, link::ByteLink& link, CarrierSettings const& settings)
    : loop_(loop), link_(link), settings_(settings), changed_(loop), scope_(loop) {
  status_.why_away = "nothing was heard yet";
}

void CarrierClient::start(CarrierListener listener) {
  listener_ = std::move(listener);
  link_.start([this](link::Peer peer, link::Bytes bytes) { hear(peer, bytes); });
  scope_.spawn(keep_talking());
}

CarrierClient::Status CarrierClient::status() const {
  auto status = status_;
  status.frames = reader_.counters();
  status.scans_lost = scans_.lost();
  return status;
}

// ---- to the board ----

base::Task<> CarrierClient::keep_talking() {
  for (;;) {
    talk();
    co_await loop_.sleep(tick);
  }
}

void CarrierClient::talk() {
  if (status_.is_here && loop_.now() - status_.heard > settings_.silence) lose(why_silent());
  if (status_.is_kill_wanted && !status_.is_killed) send(firmware::Kill{}, link::Urgency::urgent);
  if (is_hello_awaited_ && is_due(hailed_, settings_.hail_period)) send(firmware::Hail{}, link::Urgency::prompt);
  if (!status_.is_here) return;
  if (is_release_wanted_ && is_due(released_, release_period)) send(firmware::Release{}, link::Urgency::prompt);
  if (is_due(alive_, settings_.alive_period)) send(firmware::Alive{}, link::Urgency::perishable);
  repeat_lost();
}

bool CarrierClient::is_due(std::optional<base::TimePoint>& last, base::Duration period) const {
  if (last && loop_.now() - *last < period) return false;
  last = loop_.now();
  return true;
}

bool CarrierClient::send(firmware::FromHost const& record, link::Urgency urgency) {
  auto const standing = link_.standing_peers();
  auto const peer = peer_ ? peer_ : standing.empty() ? std::nullopt : std::optional(standing.front());
  if (!peer) return false;
  auto const frame = firmware::write(record, sequence_);
  if (!link_.send(*peer, frame.view(), urgency)) return false;
  ++sequence_;
  return true;
}

void CarrierClient::repeat_lost() {
  if (!running_ || running_->is_taken || loop_.now() - running_->said < settings_.repeat_after) return;
  if (running_->repeats >= settings_.most_repeats)
    return end(base::fail(ErrorKind::timed_out,
                          fmt::format("the robot did not take the command, said {} times", running_->repeats + 1),
                          "see its log: a board says there why it refuses"));
  ++running_->repeats;
  ++status_.repeats;
  running_->said = loop_.now();
  send(running_->frame, link::Urgency::prompt);
}

// ---- orders ----

base::Result<> CarrierClient::may_move() const {
  if (!status_.is_here)
    return base::fail(ErrorKind::lost, fmt::format("the robot's board is away: {}", status_.why_away));
  if (status_.is_kill_wanted || status_.is_killed)
    return base::fail(ErrorKind::refused, "the robot is killed", "release it when it is safe to move");
  return {};
}

base::Result<CommandNumber> CarrierClient::give(Order order) {
  if (auto const may = may_move(); !may) return std::unexpected(may.error());
  if (running_) end(replaced());
  // From 1 again after the last one: zero means none.
  last_number_ = static_cast<CommandNumber>(last_number_ == 0xFFFF ? 1 : last_number_ + 1);
  auto frame = std::visit(
      [this](auto& what) -> firmware::FromHost {
        what.number = last_number_;
        return what;
      },
      order);
  running_ = Running{.number = last_number_, .frame = frame, .said = loop_.now()};
  send(frame, link::Urgency::prompt);
  return last_number_;
}

base::Result<> CarrierClient::begin(Order order) {
  auto const number = give(order);
  if (!number) return std::unexpected(number.error());
  return {};
}

base::Task<base::Result<>> CarrierClient::carry_out(Order order, base::Duration timeout) {
  auto const number = give(order);
  if (!number) co_return std::unexpected(number.error());
  auto const deadline = loop_.now() + timeout;
  for (;;) {
    if (auto const ended = end_of(*number)) co_return *ended;
    if (loop_.now() >= deadline)
      co_return base::fail(
          ErrorKind::timed_out,
          fmt::format("the robot has not completed the command within {:.1f} s", base::to_seconds(timeout)),
          status_.readings && status_.readings->has(Flag::too_near) ? "something stands in its way" : "");
    co_await changed_.wait_until(deadline);
  }
}

std::optional<base::Result<>> CarrierClient::end_of(CommandNumber number) const {
  auto const found = std::ranges::find(ends_, number, &End::number);
  if (found == ends_.end()) return std::nullopt;
  return found->result;
}

void CarrierClient::end(base::Result<> result) {
  if (!running_) return;
  ends_.push_front({.number = running_->number, .result = std::move(result)});
  if (ends_.size() > most_ends) ends_.pop_back();
  running_.reset();
  changed_.notify_all();
}

base::Task<base::Result<firmware::Description>> CarrierClient::description(base::Duration timeout) {
  auto const deadline = loop_.now() + timeout;
  while (!status_.is_here) {
    if (loop_.now() >= deadline)
      co_return base::fail(ErrorKind::timed_out, fmt::format("no robot's board answers on {}", link_.name()),
                           why_silent());
    co_await changed_.wait_until(deadline);
  }
  co_return status_.hello->description;
}

// ---- kill ----

void CarrierClient::kill() {
  if (!status_.is_kill_wanted) {
    killed_at_ = loop_.now();
    status_.kill_took.reset();
    // What the board says of a kill must be newer than this one.
    status_.is_killed = false;
  }
  status_.is_kill_wanted = true;
  is_release_wanted_ = false;
  send(firmware::Kill{}, link::Urgency::urgent);
  end(base::fail(ErrorKind::refused, "the robot was killed", "release it when it is safe to move"));
  changed_.notify_all();
}

void CarrierClient::release() {
  status_.is_kill_wanted = false;
  is_release_wanted_ = true;
  released_.reset();
  talk();
}

void CarrierClient::follow_kill(firmware::Readings const& readings) {
  bool const is_still = readings.left_output_permille == 0 && readings.right_output_permille == 0;
  status_.is_killed = readings.has(Flag::killed);
  if (!status_.is_killed) is_release_wanted_ = false;
  if (status_.is_kill_wanted && status_.is_killed && is_still && !status_.kill_took)
    status_.kill_took = loop_.now() - killed_at_;
}

// ---- from the board ----

void CarrierClient::hear(link::Peer peer, link::Bytes bytes) {
  for (auto const byte : bytes) {
    if (!reader_.push(byte)) continue;
    auto const record = firmware::read_from_board(reader_.packet());
    if (!record) continue;
    peer_ = peer;
    status_.heard = loop_.now();
    take(*record);
  }
}

void CarrierClient::take(firmware::FromBoard const& record) {
  std::visit([this](auto const& what) { take(what); }, record);
}

void CarrierClient::take(firmware::Hello const& hello) {
  bool const has_started_anew = status_.readings && hello.time < status_.readings->time;
  if (has_started_anew)
    end(base::fail(ErrorKind::lost, "the robot's board started anew", "see to its supply, and drive again"));
  bool const was_here = status_.is_here && !is_hello_awaited_;
  status_.hello = hello;
  status_.is_here = true;
  status_.why_away.clear();
  is_hello_awaited_ = false;
  if (has_started_anew) {
    status_.readings.reset();
    // A board forgets a kill with its supply; what is wanted is said again.
    status_.is_killed = false;
  }
  if ((!was_here || has_started_anew) && listener_.here) listener_.here(hello, has_started_anew);
  changed_.notify_all();
}

void CarrierClient::take(firmware::Readings const& readings) {
  // Before the description nobody knows what a pulse is.
  if (is_hello_awaited_) return;
  // Its Hello was lost.
  if (status_.readings && readings.time < status_.readings->time) return lose("the board started anew");
  status_.readings = readings;
  follow_kill(readings);
  follow(readings);
  if (listener_.readings) listener_.readings(readings);
  changed_.notify_all();
}

void CarrierClient::follow(firmware::Readings const& readings) {
  if (!running_) return;
  if (readings.completed == running_->number) return end({});
  if (readings.command == running_->number) {
    running_->is_taken = true;
    return;
  }
  if (running_->is_taken || readings.has(Flag::killed)) end(why_dropped(readings));
}

void CarrierClient::take(firmware::LaserPiece const& piece) {
  if (is_hello_awaited_) return;
  auto const scan = scans_.feed(piece);
  if (scan && listener_.scan) listener_.scan(*scan);
}

void CarrierClient::take(firmware::Completed const& completed) {
  if (running_ && running_->number == completed.number) end({});
}

void CarrierClient::take(firmware::Log const& log) {
  if (log.code == firmware::LogCode::refused && running_ && log.value == running_->number)
    end(status_.is_killed || status_.is_kill_wanted
            ? base::fail(ErrorKind::refused, "the robot was killed", "release it when it is safe to move")
            : base::fail(ErrorKind::refused, "the robot refused the command: it does not know its heading",
                         "its inertial unit is silent: look at the unit's plug"));
  if (listener_.log) listener_.log(log);
}

void CarrierClient::lose(std::string why) {
  status_.is_here = false;
  status_.is_killed = false;
  status_.why_away = why;
  is_hello_awaited_ = true;
  peer_.reset();
  end(base::fail(ErrorKind::lost, fmt::format("the robot's board is away: {}", why),
                 "it stops by itself; see to the line"));
  if (listener_.away) listener_.away(why);
  changed_.notify_all();
}

std::string CarrierClient::why_silent() const {
  if (auto const error = link_.last_error(); !error.empty()) return error;
  auto const& counters = reader_.counters();
  if (counters.other_version > 0)
    return fmt::format("the board speaks version {} of the protocol, this program {}: bring both to one",
                       reader_.other_version(), firmware::protocol_version);
  if (counters.damaged > counters.frames)
    return fmt::format("what comes on {} is no robot's board, or the baud rate is another", link_.name());
  return fmt::format("{} is silent: is the board supplied and its program running?", link_.name());
}

}  // namespace lapwing::robot
