#include "fleet/alarms/conditions.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include <fmt/format.h>

#include "fleet/state/failsafe_reason.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::TimePoint;
using vehicle::AlarmKind;
using vehicle::Severity;
using vehicle::VehicleState;

namespace {

constexpr double charge_slack = 0.02;       // estimates from the voltage waver under load
constexpr base::Duration text_holds = 60s;  // of a failsafe that no heartbeat confirms: nobody tells when it is over
constexpr base::Duration may_be_landing = 10s;
constexpr double stands_m_s = 0.5;

bool is_armed(VehicleState const& state) {
  return state.arming.armed.value.value_or(false);
}

/// On the ground and disarmed nothing can happen to it.
Severity grave_in_flight(VehicleState const& state) {
  bool const is_flying = state.motion.landed.value == false;
  return is_armed(state) || is_flying ? Severity::critical : Severity::warning;
}

/// Where it was when it was last heard, in words that follow its name.
std::string last_known(VehicleState const& state) {
  bool const is_flying = state.motion.landed.value == false;
  if (is_flying && state.motion.relative_alt_m.value)
    return fmt::format("last known in the air at {:.0f} m", *state.motion.relative_alt_m.value);
  if (is_flying) return "last known in the air";
  if (is_armed(state)) return "last known armed";
  return state.arming.armed.value ? "last known disarmed" : "";
}

/// Decides for one vehicle; one function a kind.
struct Judge {
  VehicleState const& state;
  Circumstances const& circumstances;
  TimePoint now;
  std::vector<Condition> found = {};

  void add(AlarmKind kind, Severity severity, TimePoint since, std::string_view what) {
    found.push_back({kind, severity, since, fmt::format("{} {}", state.name, what)});
  }
  [[nodiscard]] bool stands(AlarmKind kind) const {
    return std::ranges::find(circumstances.standing, kind) != circumstances.standing.end();
  }

  void judge_link() {
    if (state.links.connection == vehicle::Connection::conflict)
      return found.push_back({AlarmKind::conflict, Severity::critical, now, state.links.conflict});
    auto const since = std::max(state.links.heard, state.links.heartbeat_heard);
    if (state.links.connection == vehicle::Connection::lost)
      return add(AlarmKind::lost, grave_in_flight(state), since,
                 fmt::format("lost: silent for {:.0f} s", base::to_seconds(now - state.links.heartbeat_heard)));
    if (!state.links.is_silent) return;
    auto const where = last_known(state);
    add(AlarmKind::silent, grave_in_flight(state), since, where.empty() ? "silent" : "silent, " + where);
  }

  /// By the vehicle's own word, for it knows its failsafes, or by our limits, for it may have none: whichever is worse.
  void judge_battery() {
    using vehicle::Charge;
    auto worst = Charge::ok;
    double share = 1.0;
    if (auto const& battery = state.power.battery.value) {
      share = battery->remaining;
      worst = battery->charge;
      if (worst < Charge::low && is_below(circumstances.battery.low, AlarmKind::battery_low)) worst = Charge::low;
      if (is_below(circumstances.battery.critical, AlarmKind::battery_critical)) worst = Charge::critical;
    }
    for (auto const& battery : state.power.further_batteries) {
      auto const charge = battery.value->charge;
      if (charge <= worst || charge == Charge::ok) continue;
      worst = charge;
      share = battery.value->remaining;
    }
    auto const left = fmt::format("{:.0f} % left", std::clamp(share, 0.0, 1.0) * 100.0);
    if (worst == Charge::low) add(AlarmKind::battery_low, Severity::warning, now, "battery low: " + left);
    if (worst == Charge::critical)
      add(AlarmKind::battery_critical, grave_in_flight(state), now, "battery nearly empty: " + left);
  }
  [[nodiscard]] bool is_below(double limit, AlarmKind kind) const {
    return state.power.battery.value->remaining < limit + (stands(kind) ? charge_slack : 0.0);
  }

  /// The text says what it is, the heartbeat how long it goes on. What was only said counts for a while.
  void judge_failsafe() {
    for (auto const& text : std::views::reverse(state.recent_texts)) {
      if (!state.arming.is_in_trouble && text.text.contains("leared")) break;
      if (!tells_failsafe(text.text) || is_of_other_kind(text.text)) continue;
      if (!state.arming.is_in_trouble && text.heard + text_holds < now) break;
      return add(AlarmKind::failsafe, grave_in_flight(state), text.heard, "failsafe: " + text.text);
    }
    if (state.arming.is_in_trouble)
      add(AlarmKind::failsafe, grave_in_flight(state), now, "says that its state is critical");
  }
  /// Of the fence and of batteries that are merely low there is more than a text.
  [[nodiscard]] static bool is_of_other_kind(std::string_view text) {
    bool const is_fence = text.contains("reached");
    bool const is_charge = text.starts_with("Battery ") && !text.contains("ailsafe");
    return is_fence || is_charge;
  }

  void judge_fence() {
    auto const& fence = state.mission.fence.value;
    if (!fence || !fence->is_breached) return;
    add(AlarmKind::fence, grave_in_flight(state), now,
        fence->type.empty() ? std::string("fence breached") : fmt::format("fence breached: {}", fence->type));
  }

  void judge_mode() {
    if (!is_armed(state) || !state.foreign_mode.known()) return;
    add(AlarmKind::foreign_mode, Severity::warning, state.foreign_mode.heard,
        fmt::format("changed its mode: {}, not asked for here", *state.foreign_mode.value));
  }

  /// Ground vehicles tell no landing: what has no speed stands.
  void judge_leaving() {
    if (!is_armed(state) || !circumstances.left_at || now - *circumstances.left_at < may_be_landing) return;
    if (state.motion.landed.value == false) return;
    auto const& velocity = state.motion.velocity_m_s.value;
    if (!velocity || std::hypot(velocity->north, velocity->east, velocity->down) > stands_m_s) return;
    add(AlarmKind::left_armed, Severity::warning, *circumstances.left_at, "stands armed, and nobody commands it");
  }
};

}  // namespace

std::vector<Condition> conditions_of(VehicleState const& state, Circumstances const& circumstances, TimePoint now) {
  Judge judge{state, circumstances, now};
  judge.judge_link();
  judge.judge_battery();
  judge.judge_failsafe();
  judge.judge_fence();
  judge.judge_mode();
  judge.judge_leaving();
  return std::move(judge.found);
}

}  // namespace lapwing::fleet
