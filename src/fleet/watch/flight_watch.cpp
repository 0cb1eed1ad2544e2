#include "fleet/watch/flight_watch.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

#include "fleet/actions/vehicle_actions.hpp"
#include "fleet/state/failsafe_reason.hpp"
#include "mavlink/wire/modes.hpp"
#include "plan/performance.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Duration;
using base::TimePoint;
using mavlink::MissionState;
using Kind = MissionVerdict::Kind;

namespace {

// A heartbeat that was overtaken by the one that showed the mission mode still names the mode before.
constexpr Duration mode_settles = 2s;
// One word about the mission may be older than our upload; one heartbeat may be another component's.
constexpr Duration believed_after = 2s;
constexpr Duration news_may_be_late = 3s;
constexpr Duration stands_for_good = 5s;
constexpr Duration is_recent = 2s;
constexpr double sinking_m_s = 2.0;  // nothing that stands on the ground; landings end slower
constexpr double falling_m_s = 6.0;

/// A change of mode is told at once, its reason by a text that follows; on a slow link some time later.
Duration reason_wait(mavlink::Connection const& connection, MavlinkVehicle const& craft) {
  constexpr Duration usual = 600ms;
  constexpr Duration longest = 3s;
  return std::min<Duration>(usual + 2 * connection.round_trip(craft.address.system).value_or(Duration{}), longest);
}

MissionVerdict failed(std::string reason, Aftermath aftermath) {
  return {Kind::failed, std::move(reason), aftermath};
}

bool has_jumps(std::vector<mavlink::MissionItem> const& items) {
  return std::ranges::any_of(items, [](auto const& item) {
    return item.command == mavlink::MavCmd::do_jump || item.command == mavlink::MavCmd::do_jump_tag;
  });
}

}  // namespace

FlightWatch::FlightWatch(mavlink::Connection& connection, MavlinkVehicle const& craft, FlightPlan const& plan,
                         std::uint32_t plan_id, base::Logger const& log)
    : connection_(connection),
      craft_(craft),
      plan_(plan),
      plan_id_(plan_id),
      log_(log),
      family_(craft.state.family),
      begun_(connection.loop().now()),
      places_(plan.places, family_),
      legs_(plan.items, plan.home, family_),
      progress_(legs_),
      subscription_(
          connection.subscribe(craft.address.system, [this](mavlink::Received const& received) { take(received); })) {
  if (auto const& position = craft.state.motion.position; position.known()) {
    (void)believed_.note(*position.value, {});
    (void)places_.note(*position.value, 0.0, {});
    position_heard_ = position.heard;
  }
  if (auto const& fence = craft.state.mission.fence.value) fence_breaches_ = fence->breaches;
}

void FlightWatch::begin() {
  begun_ = now();
  has_begun_ = true;
  progress_.note_progress();
}

// ---- what the vehicle tells

void FlightWatch::take(mavlink::Received const& received) {
  if (received.source.component != mavlink::autopilot_component) return;
  if (auto const* position = std::get_if<mavlink::GlobalPosition>(&received.message))
    take_position(*position, received.at);
  if (auto const* current = std::get_if<mavlink::MissionCurrent>(&received.message))
    take_current(*current, received.at);
  if (auto const* fence = std::get_if<mavlink::FenceStatus>(&received.message)) take_fence(*fence, received.at);
  if (auto const* reached = std::get_if<mavlink::MissionItemReached>(&received.message)) {
    places_.note_reached(reached->seq);
    progress_.note_progress();
  }
}

void FlightWatch::take_position(mavlink::GlobalPosition const& heard, TimePoint now) {
  std::optional<geo::Wgs84> const place = heard.position;
  bool const is_empty = !place || (place->lat_rad == 0.0 && place->lon_rad == 0.0);
  if (is_empty || (craft_.heard->fix && *craft_.heard->fix < mavlink::GpsFix::fix_3d)) return;
  // By the vehicle's own clock where it goes on: a simulated one may live faster or slower than this program.
  auto const by_ours = position_heard_ ? now - *position_heard_ : Duration{};
  auto const by_its = clock_ ? heard.since_boot - *clock_ : Duration{};
  if (by_its < Duration{}) return;  // overtaken by a later one
  clock_ = heard.since_boot;
  position_heard_ = now;
  auto const velocity_m_s = std::optional(heard.velocity_m_s).value_or(geo::Ned{});
  sinks_m_s_ = velocity_m_s.down;
  if (has_begun_ && !craft_.heard->is_armed && plan::flies(family_) && sinks_m_s_ >= falling_m_s) fell_ = true;
  auto const at_most = std::max<Duration>(by_ours, by_its);
  if (!believed_.note(*place, at_most)) return tell_jump();
  double const speed_m_s = std::hypot(velocity_m_s.north, velocity_m_s.east);
  if (places_.note(*place, speed_m_s, at_most) > 0) progress_.note_progress();
  if (has_begun_) progress_.note(*place, by_its > Duration{} ? by_its : by_ours);
}

/// ArduPilot calls a breach over as soon as it acts on it; the count tells of it still.
void FlightWatch::take_fence(mavlink::FenceStatus const& heard, TimePoint now) {
  bool const is_new = fence_breaches_ && heard.breach_count > *fence_breaches_;
  if (is_new) fence_breached_ = now;
  fence_breaches_ = heard.breach_count;
}

void FlightWatch::take_current(mavlink::MissionCurrent const& heard, TimePoint now) {
  bool const was_in_the_air = item_ && legs_.is_in_the_air(*item_);
  item_ = heard.seq;
  progress_.note_item(heard.seq);
  if (!was_in_the_air) in_the_air_since_ = now;
  // Unknown autopilots may count what ArduPilot does not.
  int const total = heard.total.value_or(0);
  int const all = static_cast<int>(plan_.items.size());
  bool const may_be_all = craft_.state.autopilot == vehicle::Autopilot::other && total == all - 1;
  std::string differs;
  if (heard.state == MissionState::no_mission) {
    differs = "another station cleared its mission in flight";
  } else if (plan_id_ != 0 && heard.mission_id != 0 && heard.mission_id != plan_id_) {
    differs = "another station changed its mission in flight";
  } else if (heard.total && total != plan_.flown_items() && !may_be_all) {
    differs = fmt::format("another station changed its mission in flight: it has {} item{}, {} were uploaded", total,
                          total == 1 ? "" : "s", plan_.flown_items());
  }
  other_mission_ = std::move(differs);
  if (other_mission_.empty()) return other_mission_since_.reset();
  if (!other_mission_since_) other_mission_since_ = now;
}

// ---- what is made of it

MissionVerdict FlightWatch::look() {
  if (craft_.state.family != family_) return judge_other_kind();
  other_kind_since_.reset();
  auto const seen = sight();
  if (!seen.mode_is_auto && seen.since_start < mode_settles) return {};
  tell_skipped_items();
  auto verdict = judge(plan_.shape, seen);
  bool const is_still_ours = seen.mode_is_auto && seen.armed;
  bool const is_open = verdict.kind == Kind::done || (verdict.kind == Kind::running && seen.mode_is_auto);
  auto const aftermath = is_still_ours ? Aftermath::stop_mode : Aftermath::none;
  if (auto foreign = foreign_mission(); foreign && is_open) return failed(*std::move(foreign), aftermath);
  if (verdict.kind == Kind::done) return judge_end(aftermath);
  ended_at_.reset();
  if (verdict.kind == Kind::failed || !is_still_ours) return verdict;
  return judge_way();
}

MissionSight FlightWatch::sight() const {
  auto const& trace = craft_.heard->trace;
  auto const return_mode = mavlink::mode_for(craft_.state.autopilot, family_, mavlink::ModeRole::rtl);
  return {.since_start = now() - begun_,
          .mode_is_auto = in_mission_mode(craft_),
          .mode_is_return = craft_.heard->custom_mode == return_mode,
          .mode = mode_name(craft_, craft_.heard->custom_mode),
          .mode_for = now() - craft_.heard->mode_changed,
          .armed = craft_.heard->is_armed,
          .disarmed_for = craft_.heard->is_armed ? Duration{} : now() - craft_.heard->armed_changed,
          .was_active = trace.was_active,
          .reports_complete = trace.reports_complete,
          .current_seq = trace.current_seq,
          .reached_seq = trace.reached_seq,
          .on_ground_for = trace.on_ground_for(),
          .failsafe = recent_failsafe(craft_.state, now(), fence_breached_),
          .reason_wait = reason_wait(connection_, craft_),
          .sinks = plan::flies(family_) && sinks_m_s_ >= sinking_m_s && silence() < is_recent,
          .fell = fell_};
}

Duration FlightWatch::silence() const {
  return position_heard_ ? now() - *position_heard_ : Duration::max() / 2;
}

MissionVerdict FlightWatch::judge_other_kind() {
  if (!other_kind_since_) other_kind_since_ = now();
  if (now() - *other_kind_since_ < believed_after) return {};
  return failed(fmt::format("it calls itself a {} now, and was a {} when the mission began: what its modes mean is "
                            "not known any more",
                            to_string(craft_.state.family), to_string(family_)),
                Aftermath::none);
}

std::optional<std::string> FlightWatch::foreign_mission() const {
  // ArduPilot's "Auto mission changed, restarted command" and "... but failed to restart command".
  for (auto const& text : std::views::reverse(craft_.state.recent_texts)) {
    if (text.heard < begun_) break;
    if (text.component == mavlink::autopilot_component && text.text.starts_with("Auto mission changed"))
      return fmt::format("another station changed its mission in flight: {}", text.text);
  }
  if (other_mission_since_ && has_begun_ && now() - std::max(*other_mission_since_, begun_) >= believed_after)
    return other_mission_;
  return std::nullopt;
}

MissionVerdict FlightWatch::judge_end(Aftermath aftermath) {
  auto const unpassed = places_.unpassed(silence());
  if (unpassed.empty()) return {Kind::done};
  if (!ended_at_) ended_at_ = now();
  if (now() - *ended_at_ < news_may_be_late) return {};
  return failed(fmt::format("it came to the mission's end without passing {} ({} of {} place{})", items_text(unpassed),
                            unpassed.size(), places_.size(), places_.size() == 1 ? "" : "s"),
                aftermath);
}

MissionVerdict FlightWatch::judge_way() {
  if (auto const& jump = believed_.jump(); jump && jump->lasts >= believed_after)
    return failed(to_text(*jump) + " and stays there: where it is, is not known", Aftermath::hold);
  if (stands_in_the_middle())
    return failed(fmt::format("it stands on the ground with its motors running at item {} of {}", item_.value_or(0),
                              plan_.shape.last_nav_seq),
                  Aftermath::stop_mode);
  return judge_progress();
}

bool FlightWatch::stands_in_the_middle() const {
  auto const& trace = craft_.heard->trace;
  bool const should_fly = family_ == vehicle::Family::copter && item_ && legs_.is_in_the_air(*item_);
  if (!should_fly || !in_the_air_since_ || !trace.on_ground_since) return false;
  return trace.on_ground_heard - std::max(*trace.on_ground_since, *in_the_air_since_) >= stands_for_good;
}

MissionVerdict FlightWatch::judge_progress() {
  constexpr int patiences = 2;
  auto const patience = progress_.patience();
  auto const stalled_for = progress_.stalled_for();
  if (!patience || stalled_for < *patience) {
    has_told_stall_ = false;
    return {};
  }
  auto const text = fmt::format("no progress at item {} of {} for {:.0f} s", progress_.seq(), plan_.shape.last_nav_seq,
                                base::to_seconds(stalled_for));
  if (stalled_for >= patiences * *patience) return failed(text, Aftermath::stop_mode);
  if (!has_told_stall_)
    log_.warn(fmt::format("{}: {}; after {:.0f} s its task fails", craft_.state.name, text,
                          base::to_seconds(patiences * *patience)));
  has_told_stall_ = true;
  return {};
}

void FlightWatch::tell_jump() {
  auto const& jump = believed_.jump();
  if (jump->lasts == Duration{}) log_.warn(fmt::format("{}: {}", craft_.state.name, to_text(*jump)));
}

/// Where jumps lead back, what was not passed may still come.
void FlightWatch::tell_skipped_items() {
  auto const* const present = item_ ? legs_.at(*item_) : nullptr;
  if (has_told_skipped_ || !present || has_jumps(plan_.items)) return;
  auto unpassed = places_.unpassed(silence());
  std::erase_if(unpassed, [&](int seq) { return seq >= present->seq; });
  if (unpassed.empty()) return skipped_since_.reset();
  if (!skipped_since_) skipped_since_ = now();
  if (now() - *skipped_since_ < news_may_be_late) return;
  has_told_skipped_ = true;
  log_.warn(fmt::format("{}: it is at item {} and has not passed {}: another station or its pilot has chosen the item",
                        craft_.state.name, present->seq, items_text(unpassed)));
}

}  // namespace lapwing::fleet
