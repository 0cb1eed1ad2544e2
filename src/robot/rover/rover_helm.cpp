#include "robot/rover/rover_helm.hpp"

#include <utility>

#include <fmt/format.h>

#include "mavlink/exchange/command.hpp"
#include "mavlink/wire/modes.hpp"

namespace lapwing::robot::rover {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_period = 100ms;
constexpr base::Duration ack_wait = 700ms;
/// A stop is sent again rather than waited for; it may be heard twice.
constexpr base::Duration urgent_ack_wait = 300ms;
/// Heartbeats come every second.
constexpr base::Duration heartbeat_wait = 1200ms;
constexpr base::Duration between_rests = 2s;
/// An arming shows in the heartbeats after it; the first may still be of before.
constexpr base::Duration shows_within = 2s;
/// What the autopilot said so lately is its reason.
constexpr base::Duration objection_is_old = 5s;

std::uint32_t mode_of(mavlink::ModeRole role) {
  return *mavlink::mode_for(mavlink::Autopilot::ardupilot, mavlink::Family::rover, role);
}

mavlink::Command enter(std::uint32_t mode) {
  return mavlink::set_mode(mavlink::MavAutopilot::ardupilotmega, mode);
}

std::string name_of(std::uint32_t mode) {
  return mavlink::mode_name(mavlink::Autopilot::ardupilot, mavlink::Family::rover, mode);
}

}  // namespace

RoverHelm::RoverHelm(base::Loop& loop, mavlink::Connection& connection, std::uint8_t system_id, base::Logger log,
                     HelmTimes const& times)
    : loop_(loop),
      connection_(connection),
      address_{system_id, mavlink::autopilot_component},
      log_(std::move(log)),
      times_(times),
      guided_(mode_of(mavlink::ModeRole::guided)),
      hold_(mode_of(mavlink::ModeRole::hold)),
      changed_(loop),
      subscription_(connection.subscribe(system_id, [this](mavlink::Received const& received) { take(received); })),
      scope_(loop) {
  scope_.spawn(keep());
}

// ---- what it shows

void RoverHelm::take(mavlink::Received const& received) {
  if (received.source.component != address_.component) return;
  if (auto const* heartbeat = std::get_if<mavlink::Heartbeat>(&received.message)) take(*heartbeat);
  if (auto const* text = std::get_if<mavlink::StatusText>(&received.message)) take(*text);
}

void RoverHelm::take(mavlink::Heartbeat const& heartbeat) {
  bool const is_rover = mavlink::family_of(heartbeat.type) == mavlink::Family::rover &&
                        mavlink::autopilot_of(heartbeat.autopilot) == mavlink::Autopilot::ardupilot;
  if (!is_rover) {
    if (!std::exchange(has_told_of_stranger_, true))
      log_.error(fmt::format("system {} is no rover of ArduPilot: it is left alone", address_.system));
    return;
  }
  if (!shown_) log_.info(fmt::format("a rover of ArduPilot, system {}", address_.system));
  shown_ = Shown{.custom_mode = heartbeat.custom_mode, .is_armed = heartbeat.armed()};
  bool const obeys = shown_->custom_mode == guided_ && shown_->is_armed;
  if (is_ours_ && !obeys && loop_.now() - ours_since_ > shows_within)
    lose(fmt::format("{}, {}", name_of(shown_->custom_mode), shown_->is_armed ? "armed" : "disarmed"));
  changed_.notify_all();
}

void RoverHelm::take(mavlink::StatusText const& text) {
  if (text.severity > mavlink::MavSeverity::warning) return;
  objection_ = text.text;
  objected_ = loop_.now();
}

std::string RoverHelm::with_its_reason(std::string what) const {
  bool const has_reason = !objection_.empty() && loop_.now() - objected_ < objection_is_old;
  return has_reason ? fmt::format("{}; it says \"{}\"", what, objection_) : what;
}

void RoverHelm::lose(std::string const& why) {
  is_ours_ = false;
  is_taken_ = true;
  log_.warn(with_its_reason("somebody else has taken the rover, or it has stopped itself: " + why) +
            "; it stands until it is restarted");
}

bool RoverHelm::shows_killed() const {
  if (is_taken_) return true;
  return is_kill_wanted_ && shown_ && (shown_->custom_mode == hold_ || !shown_->is_armed);
}

// ---- what is wanted

void RoverHelm::want(bool is_to_drive) {
  if (is_to_drive == is_to_drive_) return;
  is_to_drive_ = is_to_drive;
  if (!is_to_drive) stood_up_ = loop_.now();
  changed_.notify_all();
}

void RoverHelm::kill() {
  if (!is_kill_wanted_) kill_asked_ = loop_.now();
  is_kill_wanted_ = true;
  is_ours_ = is_resting_ = false;
  kill_shown_.reset();
  // Past whatever is under way: it may be an arming.
  doing_.reset();
  send_stop();
  changed_.notify_all();
}

void RoverHelm::release() {
  is_kill_wanted_ = is_taken_ = false;
  doing_.reset();
  changed_.notify_all();
}

void RoverHelm::leave() {
  if (is_ours_ || is_resting_) send_stop();
}

void RoverHelm::send(mavlink::Command const& command) {
  // Who is not heard at all cannot be told either; `pursue_kill` goes on when it is.
  (void)connection_.send(address_, mavlink::CommandLong{.command = command.id, .params = command.params});
}

void RoverHelm::send_stop() {
  send(enter(hold_));
  send(mavlink::disarm());
  send(mavlink::request_message(mavlink::MessageId::heartbeat));
}

// ---- what is done for it

base::Task<> RoverHelm::keep() {
  for (;;) {
    if (shown_ && (!doing_ || doing_->done())) {
      doing_ = do_next();
      doing_->start();
    }
    co_await changed_.wait_until(loop_.now() + look_period);
  }
}

base::Task<> RoverHelm::do_next() {
  if (is_taken_ && !is_kill_wanted_) co_return;
  auto next = is_kill_wanted_ ? pursue_kill() : is_to_drive_ ? engage() : rest();
  co_await std::move(next);
}

base::Task<base::Result<>> RoverHelm::command(mavlink::Command command, bool is_urgent) {
  mavlink::CommandOptions const options{
      .tries = 3, .ack_timeout = is_urgent ? urgent_ack_wait : ack_wait, .is_urgent = is_urgent};
  auto running = mavlink::run_command(connection_, address_, command, options);
  co_return co_await std::move(running);
}

base::Task<> RoverHelm::engage() {
  if (is_ours_ || loop_.now() < ask_again_) co_return;
  bool const is_anothers = shown_->is_armed && shown_->custom_mode != hold_ && shown_->custom_mode != guided_;
  if (is_anothers) {
    refuse(fmt::format("somebody else drives it in {}", name_of(shown_->custom_mode)));
    co_return;
  }
  is_resting_ = false;
  auto guiding = command(enter(guided_), false);
  if (auto const guided = co_await std::move(guiding); !guided) {
    refuse(guided.error().message);
    co_return;
  }
  auto arming = command(mavlink::arm(), false);
  if (auto const armed = co_await std::move(arming); !armed) {
    refuse(armed.error().message);
    co_return;
  }
  refusal_.clear();
  is_ours_ = true;
  ours_since_ = loop_.now();
}

void RoverHelm::refuse(std::string why) {
  ask_again_ = loop_.now() + times_.ask_again_after;
  auto told = with_its_reason(std::move(why));
  if (told != refusal_) log_.warn("the rover may not drive: " + told);
  refusal_ = std::move(told);
}

base::Task<> RoverHelm::rest() {
  refusal_.clear();
  if (is_ours_ && stands_since(times_.hold_after)) {
    is_ours_ = false;
    is_resting_ = true;
    rest_asked_ = {};
  }
  if (!is_resting_ || loop_.now() - rest_asked_ < between_rests) co_return;
  if (shown_->custom_mode == guided_ && shown_->is_armed) {
    rest_asked_ = loop_.now();
    auto holding = command(enter(hold_), false);
    (void)co_await std::move(holding);
  } else if (shown_->custom_mode != hold_ || !shown_->is_armed) {
    is_resting_ = false;  // it rests, or somebody else has it
  } else if (stands_since(times_.disarm_after)) {
    rest_asked_ = loop_.now();
    auto disarming = command(mavlink::disarm(), false);
    (void)co_await std::move(disarming);
  }
}

base::Task<> RoverHelm::pursue_kill() {
  if (shown_->custom_mode == hold_ && !shown_->is_armed) {
    if (!kill_shown_) {
      kill_shown_ = loop_.now();
      log_.warn(fmt::format("killed: in HOLD and disarmed, as it showed after {:.2f} s",
                            base::to_seconds(*kill_shown_ - kill_asked_)));
    }
    co_return;
  }
  bool const is_pilots = kill_shown_ && loop_.now() - *kill_shown_ > times_.late_commands_end;
  if (is_pilots) co_return;
  auto holding = command(enter(hold_), true);
  (void)co_await std::move(holding);
  auto disarming = command(mavlink::disarm(), true);
  auto const disarmed = co_await std::move(disarming);
  if (!disarmed && disarmed.error().kind == base::ErrorKind::refused) {
    auto forcing = command(mavlink::force_disarm(), true);
    (void)co_await std::move(forcing);
  }
  send(mavlink::request_message(mavlink::MessageId::heartbeat));
  auto const until = loop_.now() + heartbeat_wait;
  while (loop_.now() < until && !(shown_->custom_mode == hold_ && !shown_->is_armed))
    co_await changed_.wait_until(until);
}

}  // namespace lapwing::robot::rover
