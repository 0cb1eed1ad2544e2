#include "fleet/mission/mission_end.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace lapwing::fleet {

using namespace std::chrono_literals;
using Kind = MissionVerdict::Kind;

namespace {

// A mission that ended before may still be called complete until the autopilot has begun the new one.
constexpr base::Duration begun_for_sure = 3s;
// Autopilots disarm by themselves after landing; one that is set up not to is done as well.
constexpr base::Duration landed_for_good = 5s;

// The mode after the mission, or the disarming after a landing, may show before the news that the last item was begun
// or reached, which a bad link may have to repeat.
constexpr base::Duration news_of_the_end = 5s;

bool last_item_was_current(MissionShape const& shape, MissionSight const& sight) {
  return sight.current_seq.value_or(-1) >= shape.last_nav_seq || sight.reached_seq.value_or(-1) >= shape.last_nav_seq;
}

/// What was heard last may be one item old.
bool may_have_ended(MissionShape const& shape, MissionSight const& sight) {
  return std::max(sight.current_seq.value_or(0), sight.reached_seq.value_or(0)) >= shape.last_nav_seq - 1;
}

bool last_place_is_reached(MissionShape const& shape, MissionSight const& sight) {
  return shape.ending == MissionEnding::at_place && sight.reached_seq.value_or(-1) >= shape.last_nav_seq;
}

/// Motors that go off in the air make no landing.
bool is_down(MissionSight const& sight) {
  return !sight.armed && !sight.sinks;
}

/// Some autopilots leave AUTO by themselves at the end (ArduPlane to RTL, PX4 to LOITER), and the news of both may
/// arrive in either order.
bool ended_before(MissionShape const& shape, MissionSight const& sight) {
  if (!last_item_was_current(shape, sight)) return false;
  if (sight.mode_is_return || sight.reports_complete || last_place_is_reached(shape, sight)) return true;
  return is_down(sight) && shape.ending == MissionEnding::on_ground;
}

MissionVerdict outside_auto(MissionShape const& shape, MissionSight const& sight) {
  if (ended_before(shape, sight)) return {Kind::done};
  if (!sight.failsafe.empty())
    return {Kind::failed, fmt::format("mode changed to {} by the vehicle: {}", sight.mode, sight.failsafe)};
  if (sight.mode_for < sight.reason_wait) return {};
  if (may_have_ended(shape, sight) && sight.mode_for < news_of_the_end) return {};
  if (!sight.armed) return {Kind::failed, fmt::format("disarmed and mode changed to {}", sight.mode)};
  return {Kind::failed, fmt::format("mode changed to {} by operator", sight.mode)};
}

}  // namespace

MissionVerdict judge(MissionShape const& shape, MissionSight const& sight) {
  if (sight.fell) return {Kind::failed, "its motors went off in the air, and it fell"};
  if (!sight.mode_is_auto) return outside_auto(shape, sight);
  if (!sight.armed && sight.sinks) return {};
  if (sight.reports_complete && (sight.was_active || sight.since_start >= begun_for_sure)) return {Kind::done};
  if (last_place_is_reached(shape, sight)) return {Kind::done};
  if (shape.ending == MissionEnding::on_ground && last_item_was_current(shape, sight)) {
    if (is_down(sight)) return {Kind::done};
    if (sight.on_ground_for.value_or(0s) >= landed_for_good) return {Kind::done};
  }
  if (!sight.armed && sight.disarmed_for >= news_of_the_end)
    return {Kind::failed, fmt::format("disarmed at item {} of {}", sight.current_seq.value_or(0), shape.last_nav_seq)};
  return {};
}

}  // namespace lapwing::fleet
