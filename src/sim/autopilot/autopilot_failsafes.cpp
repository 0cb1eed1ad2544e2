// What goes wrong in flight, and what the vehicle does about it by itself. Texts and the conditions on which a vehicle
// carries on are those that ArduCopter, ArduRover and ArduPlane 4.7 gave in the same situations.

#include <algorithm>

#include <fmt/core.h>

#include "mavlink/wire/modes.hpp"
#include "sim/autopilot/autopilot.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;
using mavlink::MavSeverity;
using vehicle::Family;

namespace {

constexpr std::string_view radio_name = "Radio";
constexpr std::string_view ground_name = "GCS";

}  // namespace

void Autopilot::act(Reaction const& reaction) {
  for (auto const behaviour : reaction) {
    if (mode_->behaviour == behaviour) return;
    if (change_mode(mode_for(kind_, behaviour).number) == mavlink::MavResult::accepted) return;
  }
}

void Autopilot::watch_health() {
  watch_ground_station();
  watch_radio();
  watch_gps();
  watch_estimate();
  watch_battery();
  watch_fence();
  watch_setpoints();
}

/// PX4 leaves OFFBOARD when nobody guides it any more.
void Autopilot::watch_setpoints() {
  if (mode_->number != mavlink::px4_offboard || !kind_.is_px4() || !setpoint_heard_) return;
  if (now_ - *setpoint_heard_ <= tuning_.guided_timeout) return;
  outbox_.say(MavSeverity::warning, "Failsafe activated: no offboard signal");
  change_mode(mode_for(kind_, Behaviour::hold).number);
}

void Autopilot::watch_ground_station() {
  using enum SilenceWatch::Event;
  auto const event = ground_station_.update(now_, safety_.ground.watched, safety_.ground.patience);
  if (event == none) return;
  if (!kind_.is_px4()) return event == lost ? lose_link(ground_name, safety_.ground) : regain_link(ground_name);
  outbox_.say(MavSeverity::warning, event == lost ? "Failsafe activated: connection to ground station lost"
                                                  : "Connection to ground station regained");
  bool const lands = mode_->behaviour == Behaviour::land;
  if (event == lost && armed_ && !lands) act(safety_.ground.reaction);
}

void Autopilot::watch_radio() {
  if (safety_.signal == RadioSignal::good) radio_.heard(now_);
  auto const patience =
      safety_.signal == RadioSignal::low_throttle ? safety_.low_throttle_patience : safety_.radio.patience;
  auto const event = radio_.update(now_, safety_.radio.watched, patience);
  if (airframe_.family == Family::plane) return watch_plane_radio(event);
  if (event == SilenceWatch::Event::lost) lose_link(radio_name, safety_.radio);
  if (event == SilenceWatch::Event::returned) regain_link(radio_name);
}

/// An aeroplane waits for a while whether the transmitter comes back. What a pilot flies circles meanwhile.
void Autopilot::watch_plane_radio(SilenceWatch::Event event) {
  if (event == SilenceWatch::Event::lost) {
    outbox_.say(MavSeverity::warning, "Throttle failsafe on");
    bool const is_piloted = mode_->behaviour == Behaviour::manual;
    if (is_piloted) act({Behaviour::circle});
    outbox_.say(MavSeverity::warning, is_piloted ? fmt::format("RC Short Failsafe: switched to {}", mode_->name)
                                                 : std::string("RC Short Failsafe On"));
    link_failsafe_ = true;
    long_radio_loss_at_ = now_ + safety_.long_after;
  }
  if (long_radio_loss_at_ && now_ >= *long_radio_loss_at_) {
    long_radio_loss_at_.reset();
    lose_link("RC Long", safety_.radio);
  }
  if (event == SilenceWatch::Event::returned) {
    outbox_.say(MavSeverity::warning, "Throttle failsafe off");
    outbox_.say(MavSeverity::warning, long_radio_loss_at_ ? "Short Failsafe Cleared" : "RC Long Failsafe Cleared");
    long_radio_loss_at_.reset();
    link_failsafe_ = ground_station_.active();
  }
}

void Autopilot::lose_link(std::string_view type, LossSettings const& loss) {
  if (airframe_.family == Family::rover) return lose_link_on_rover(type, loss);
  if (airframe_.family == Family::plane) return lose_link_on_plane(type, loss);
  lose_link_on_copter(type, loss);
}

/// On the ground, or in a mode in which the throttle stick is down: it need not fly home.
bool Autopilot::is_disarmed_by_failsafes() const {
  if (airframe_.family != Family::copter || kind_.is_px4()) return false;
  if (mode_->behaviour == Behaviour::manual) return true;
  if (mode_->behaviour == Behaviour::mission && take_off_allowed_) return false;
  return landed_;
}

std::string_view Autopilot::reason_to_carry_on(LossSettings const& loss, bool is_radio) const {
  bool const battery_lands = battery_watch_.active() && mode_->behaviour == Behaviour::land;
  if (battery_lands || (safety_.finishes_landing && mode_->behaviour == Behaviour::land)) return "Continuing Landing";
  if (mode_->behaviour == Behaviour::mission && loss.keeps_mission)
    return is_radio ? "Continuing Auto" : "Continuing Auto Mode";
  if (mode_->behaviour == Behaviour::guided && loss.keeps_guided) return "Continuing Guided Mode";
  bool const is_piloted = mode_->behaviour == Behaviour::manual || mode_->behaviour == Behaviour::sink;
  return is_piloted && loss.keeps_pilot ? "Continuing Pilot Control" : "";
}

void Autopilot::lose_link_on_copter(std::string_view type, LossSettings const& loss) {
  bool const is_radio = type == radio_name;
  bool const disarms = is_disarmed_by_failsafes() && (armed_ || is_radio);
  auto const why = disarms ? std::string_view("Disarming") : reason_to_carry_on(loss, is_radio);
  link_failsafe_ = true;
  outbox_.say(MavSeverity::warning, fmt::format("{} Failsafe{}{}", type, why.empty() ? "" : " - ", why));
  if (disarms && armed_) do_disarm(words_.disarmed_by_command);
  if (armed_ && why.empty()) act(loss.reaction);
}

/// Not while it is driving home or stands already.
void Autopilot::lose_link_on_rover(std::string_view type, LossSettings const& loss) {
  if (mode_->behaviour == Behaviour::return_home || mode_->name == "HOLD") return;
  link_failsafe_ = true;
  outbox_.say(MavSeverity::warning, fmt::format("{} Failsafe", type));
  bool const carries_on = mode_->behaviour == Behaviour::mission && loss.keeps_mission;
  if (carries_on) return outbox_.say(MavSeverity::warning, "Failsafe - Continuing Auto Mode");
  act(loss.reaction);
}

void Autopilot::lose_link_on_plane(std::string_view type, LossSettings const& loss) {
  link_failsafe_ = true;
  bool const carries_on = !reason_to_carry_on(loss, false).empty() || mode_->behaviour == Behaviour::return_home;
  if (!carries_on) act(loss.reaction);
  outbox_.say(MavSeverity::warning, fmt::format("{} Failsafe On: {}", type, mode_->name));
}

void Autopilot::regain_link(std::string_view type) {
  bool const was_told = std::exchange(link_failsafe_, radio_.active() || ground_station_.active());
  if (airframe_.family == Family::plane) return outbox_.say(MavSeverity::warning, fmt::format("{} Failsafe Off", type));
  bool const is_rover = airframe_.family == Family::rover;
  if (is_rover && !was_told) return;
  outbox_.say(is_rover ? MavSeverity::info : MavSeverity::warning, fmt::format("{} Failsafe Cleared", type));
}

void Autopilot::watch_gps() {
  if (safety_.gps_is_cut_off == gps_is_cut_off_) return;
  gps_is_cut_off_ = safety_.gps_is_cut_off;
  if (gps_is_cut_off_) {
    lose_gps();
  } else {
    restore_gps();
  }
}

void Autopilot::watch_estimate() {
  bool const failed = start_up_.estimate_lost(now_);
  if (failed && !estimate_failed_ && armed_) {
    outbox_.say(MavSeverity::critical, "EKF variance");
    bool const matters = mode_->needs_position || safety_.in_every_mode;
    if (!safety_.on_estimate_lost.empty() && matters) {
      act(safety_.on_estimate_lost);
      outbox_.say(MavSeverity::critical, fmt::format("EKF Failsafe: changed to {} Mode", mode_->name));
    }
  }
  estimate_failed_ = failed && (estimate_failed_ || armed_);
}

/// ArduPilot looks at its battery only while it is armed; of its vehicles only copters tell that they act.
void Autopilot::watch_battery() {
  if (!armed_ && !kind_.is_px4()) return;
  auto const reached = battery_watch_.update(now_, battery_, safety_.battery);
  if (!reached) return;
  bool const critical = *reached == BatteryWatch::Level::critical;
  outbox_.say(MavSeverity::warning,
              fmt::format("Battery 1 is {} {:.2f}V used {:.0f} mAh", critical ? "critical" : "low",
                          battery_.voltage_v(), battery_.used_mah()));
  auto const& reaction = critical ? safety_.on_critical_battery : safety_.on_low_battery;
  bool const disarms = is_disarmed_by_failsafes();
  bool const is_copter = airframe_.family == Family::copter;
  if (is_copter && !kind_.is_px4())
    outbox_.say(MavSeverity::warning, disarms ? "Battery Failsafe - Disarming" : "Battery Failsafe");
  if (kind_.is_px4() && !reaction.empty()) outbox_.say(MavSeverity::warning, "Failsafe activated: battery");
  if (disarms) return do_disarm(words_.disarmed_by_command);
  bool const goes_on_landing = safety_.finishes_landing && mode_->behaviour == Behaviour::land;
  if (armed_ && !goes_on_landing) act(reaction);
}

void Autopilot::watch_fence() {
  auto const news = fence_.update({.body = body_,
                                   .site = site_,
                                   .home = home_,
                                   .plan = plans_.fence,
                                   .settings = safety_.fence,
                                   .position_ok = navigation_.position_ok,
                                   .now = now_});
  if (fence_.breached() == 0) fence_took_over_ = false;
  if (news.is_first) outbox_.fence_breached = true;
  if (!kind_.is_px4()) tell_of_the_fence(news);
  if (news.calls_for_action && armed_) answer_breach(news.breached);
}

void Autopilot::tell_of_the_fence(FenceWatch::News const& news) {
  auto const notice = [&](std::string text) { outbox_.say(MavSeverity::notice, std::move(text)); };
  if (news.floor_on) notice(*news.floor_on ? "Min Alt fence enabled (auto enable)" : "Min Alt fence auto-disabled");
  if (news.near_m) notice(fmt::format("{} in {:.1f}m", fence_names(fence_.near() & ~fence_.breached()), *news.near_m));
  if (news.left_margin != 0) notice(fence_names(news.left_margin) + " cleared margin breach");
  if (!safety_.fence.tells_breach) return;
  if (news.calls_for_action && armed_) notice(fence_names(news.breached) + " breached");
  if (news.is_over && !landed_) notice("Fence breach cleared");
}

/// Far outside something is wrong with the estimate, or with the fence: then it comes down or stops where it is.
void Autopilot::answer_breach(unsigned limits) {
  auto const& fence = safety_.fence;
  if (kind_.is_px4()) outbox_.say(MavSeverity::notice, "Failsafe activated: Fence breached");
  if (fence.action.empty()) return;
  bool const is_copter = airframe_.family == Family::copter && !kind_.is_px4();
  if (is_copter && landed_) return do_disarm(words_.disarmed_by_command);
  bool const is_far = fence_.depth_m(limits, body_.position_m, home_, fence) > fence.give_up_m;
  act(is_far ? fence.far_action : fence.action);
  fence_took_over_ = true;
  // An aeroplane that is guided back flies home at half the height between floor and ceiling.
  bool const guides_back = airframe_.family == Family::plane && fence.action.front() == Behaviour::guided;
  if (guides_back)
    guided().go_to(body_.position_m,
                   {home_.north, home_.east, home_.down - 0.5 * (std::max(0.0, fence.lowest_m) + fence.highest_m)});
}

std::string Autopilot::objection() const {
  auto const fence = fence_.objection(safety_.fence);
  return fence.empty() && radio_.active() ? "Radio failsafe on" : fence;
}

}  // namespace lapwing::sim
