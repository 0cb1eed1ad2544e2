#include "fleet/mission/mission_run.hpp"

#include <functional>

#include <fmt/format.h>

#include "fleet/mission/flight_plan.hpp"
#include "fleet/plausibility/doubts.hpp"
#include "fleet/plausibility/own_fence.hpp"
#include "fleet/plausibility/own_home.hpp"
#include "fleet/state/telemetry.hpp"
#include "fleet/watch/flight_watch.hpp"
#include "mavlink/exchange/command.hpp"
#include "mavlink/exchange/plan_replacement.hpp"
#include "plan/capabilities.hpp"
#include "plan/plausibility/judge.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using base::TimePoint;

namespace {

constexpr mavlink::TransferOptions transfer{.tries = 12};
// For a link that loses a third of its packets: one in a thousand fails.
constexpr mavlink::CommandOptions patient{.tries = 12, .ack_timeout = 1s, .expiry = 15s};

base::Error named(std::string_view what, base::Error error) {
  error.message = fmt::format("{}: {}", what, error.message);
  return error;
}

/// Phase 1: nothing is sent to a vehicle that cannot be told apart from another one, or that is not there.
Result<> claim(RunContext const& context) {
  auto const& craft = context.craft;
  if (auto const conflict = context.connection.conflict(craft.address.system))
    return fail(ErrorKind::lost, fmt::format("two vehicles use system id {}: {} and {}", craft.address.system,
                                             conflict->first, conflict->second));
  if (!craft.is_connected()) return fail(ErrorKind::lost, fmt::format("{} is not connected", craft.state.name));
  return {};
}

/// Two addresses that claimed the system id a moment ago may be a restart or two vehicles. The second shows within
/// seconds, and then the run is ended from outside; until then nothing is sent that might reach the wrong one.
Task<> wait_until_one(RunContext context) {
  auto const& connection = context.connection;
  while (connection.is_contested(context.craft.address.system)) co_await connection.loop().sleep(100ms);
}

/// The mission that the vehicle held is not kept: it is there to be replaced, and fetching it first
/// would double the time to take-off. A failure leaves none, rather than a part of each.
mavlink::ReplaceOptions replace_options(RunContext const& context) {
  return {.transfer = transfer,
          .autopilot = context.craft.heard->mav_autopilot,
          .verifies = context.options.verifies,
          .keeps_old = false};
}

/// Phases 3 and 4.
Task<Result<>> transfer_mission(RunContext context, FlightPlan const& plan, RunRecord& record) {
  auto options = replace_options(context);
  options.progress = [&record](std::string_view phase, std::size_t done, std::size_t total) {
    record.progress = fmt::format("{} {}/{}", phase, done, total);
  };
  auto items = plan.items;
  co_return co_await mavlink::replace_plan(context.connection, context.craft.address, std::move(items),
                                           mavlink::MissionType::mission, std::move(options), record.upload);
}

/// So that a vehicle that flew a part of another mission begins this one at its begin. Autopilots without the command
/// know the message.
Task<Result<>> select_first_item(RunContext context, std::uint16_t seq) {
  auto& craft = context.craft;
  auto const command = mavlink::set_current_item(seq);
  auto const set = co_await mavlink::run_command(context.connection, craft.address, command, patient);
  if (set) co_return Result<>{};
  if (set.error().kind != ErrorKind::refused) co_return std::unexpected(named("selecting the first item", set.error()));
  constexpr int tries = 5;
  for (int attempt = 0; attempt < tries; ++attempt) {
    auto const asked = context.connection.loop().now();
    mavlink::MissionSetCurrent const message{.seq = seq};
    if (auto sent = context.connection.send(craft.address, message); !sent) co_return sent;
    std::function<bool()> is_current = [&craft, seq, asked] {
      return craft.state.mission.progress.known() && craft.state.mission.progress.heard > asked &&
             craft.state.mission.progress.value->current_seq == seq;
    };
    if (co_await craft.changed.wait_for(std::move(is_current), 2s)) co_return Result<>{};
  }
  co_return fail(ErrorKind::refused,
                 fmt::format("the vehicle would not begin at item {}: {}", seq, set.error().message));
}

/// Whether the mission makes sense for the vehicle as it is now.
Result<> heed(RunContext const& context, plan::Mission const& mission, Doubts& doubts) {
  auto const situation = situation_of(context.craft, context.options.neighbours);
  auto const findings = plan::plausibility::judge(mission, situation, context.options.plausibility);
  return doubts.heed(findings, fmt::format("{}: '{}'", context.craft.state.name, mission.name),
                     context.log.named("plausibility"));
}

/// From here on every return goes there, a failsafe's too.
void tell_home(RunContext const& context, geo::Wgs84 home) {
  auto const& state = context.craft.state;
  auto const from = state.motion.home.value ? state.motion.home.value : state.motion.position.value;
  double const moved_m = from ? geo::surface_distance_m(*from, home) : 0.0;
  if (moved_m > context.options.plausibility.limits.gps_error_m)
    context.log.info(
        fmt::format("{}: home moves {:.0f} m, to {:.5f}, {:.5f}", state.name, moved_m, home.lat_deg(), home.lon_deg()));
}

/// The script's `home` becomes the vehicle's. A vehicle that refuses keeps its own, which is safe.
Task<> set_home(RunContext context, geo::Wgs84 home) {
  tell_home(context, home);
  auto const command = mavlink::set_home(home);
  auto const set = co_await mavlink::run_command(context.connection, context.craft.address, command, patient);
  if (!set) context.log.warn(fmt::format("{} keeps its own home: {}", context.craft.state.name, set.error().message));
}

/// How far and how long the vehicle should fly, from where it is now.
plan::Estimate expectation(plan::Mission const& mission, vehicle::VehicleState const& state) {
  return plan::estimate(mission, state.motion.position.value, plan::performance_of(state.family),
                        state.motion.heading_rad.value.value_or(0.0));
}

/// Phase 5.
Task<Result<>> start(RunContext context, plan::Mission const& mission, FlightPlan const& plan, RunRecord& record) {
  record.progress = "starting";
  if (mission.home) co_await set_home(context, *mission.home);
  if (auto selected = co_await select_first_item(context, plan.first_seq); !selected) co_return selected;
  begin_trace(context.craft);
  auto const expected = expectation(mission, context.craft.state);
  record.may_have_armed = !context.craft.heard->is_armed;
  ActionOptions const how{};
  auto started = co_await arm_and_start(context.connection, context.craft, how);
  if (!started) co_return started;
  record.has_begun = true;
  record.flown = plan::Flown{.estimate = expected, .path_m = 0.0, .duration = {}};
  record.begun = context.connection.loop().now();
  record.path_before_m = context.craft.heard->path_m;
  context.log.info(fmt::format("{} flies '{}'", context.craft.state.name, mission.name));
  co_return Result<>{};
}

/// Phases 6 and 7.
Task<Result<>> follow(RunContext context, FlightPlan const& plan, RunRecord& record, FlightWatch& watch) {
  auto& craft = context.craft;
  auto& loop = context.connection.loop();
  watch.begin();
  while (true) {
    record.progress =
        fmt::format("item {}/{}", craft.heard->trace.current_seq.value_or(plan.first_seq), plan.last_seq());
    auto verdict = watch.look();
    if (verdict.kind == MissionVerdict::Kind::done) co_return Result<>{};
    record.aftermath = verdict.aftermath;
    if (verdict.kind == MissionVerdict::Kind::failed) co_return fail(ErrorKind::refused, std::move(verdict.reason));
    co_await craft.changed.wait_until(loop.now() + 500ms);
  }
}

}  // namespace

std::string_view to_string(RunRecord::Outcome outcome) {
  switch (outcome) {
    case RunRecord::Outcome::running: return "running";
    case RunRecord::Outcome::done: return "done";
    case RunRecord::Outcome::failed: return "failed";
    case RunRecord::Outcome::stopped: return "stopped";
  }
  return "failed";
}

/// Writes what runs on a vehicle, for the functions of this file.
class MissionRun {
 public:
  static void forget_parts(MavlinkVehicle& craft) { craft.runs.write(As<MissionRun>()).parts_left_after.reset(); }
};

Task<mavlink::PlanLeft> clear_part_of_plan(RunContext context) {
  auto options = replace_options(context);
  mavlink::Replacement parts;
  parts.left = mavlink::PlanLeft::unknown;
  co_await mavlink::undo_replacement(context.connection, context.craft.address, mavlink::MissionType::mission,
                                     std::move(options), parts);
  if (parts.left != mavlink::PlanLeft::unknown) MissionRun::forget_parts(context.craft);
  co_return parts.left;
}

Task<Result<>> fly_mission(RunContext context, plan::Mission mission, RunRecord& record) {
  auto& craft = context.craft;
  if (auto claimed = claim(context); !claimed) co_return claimed;
  if (mission.items.empty()) co_return fail(ErrorKind::invalid_input, "the mission has no items");
  co_await wait_until_one(context);
  auto const& shown = craft.state;
  if (auto wrong = plan::objection(flight_plan(mission, shown).items, shown.autopilot, shown.family))
    co_return std::unexpected(*std::move(wrong));
  co_await learn_home(craft, hasty);
  record.lands_at = plan::plausibility::landing_places(mission, shown.motion.home.value);
  // Where it stands is what most words are about: a vehicle that does not know it yet is looked at when it does.
  Doubts doubts;
  if (auto heeded = knows_its_place(craft) ? heed(context, mission, doubts) : Result<>(); !heeded) co_return heeded;

  record.progress = "waiting until the vehicle is ready";
  auto ready = co_await wait_until_ready(craft, context.connection.loop(), context.options.ready_timeout);
  if (!ready) co_return ready;
  record.progress = "asking for its home and its own fence";
  co_await learn_home(craft, thorough);
  co_await learn_fence(craft, thorough, context.log.named("plausibility"));
  if (auto heeded = heed(context, mission, doubts); !heeded) co_return heeded;

  record.progress = "stopping what it does";
  auto quiet = co_await leave_mission(context.connection, craft, context.options.on_stop);
  if (!quiet) co_return quiet;

  auto const plan = flight_plan(mission, craft.state);
  record.items = static_cast<int>(plan.items.size());
  auto transferred = co_await transfer_mission(context, plan, record);
  if (!transferred) co_return transferred;
  MissionRun::forget_parts(craft);
  craft.state.mission.planned_path = plan.path;

  // Perhaps it has landed meanwhile.
  if (auto heeded = heed(context, mission, doubts); !heeded) co_return heeded;
  FlightWatch watch(context.connection, craft, plan, record.upload.held.opaque_id, context.log);
  auto started = co_await start(context, mission, plan, record);
  if (!started) co_return started;
  co_return co_await follow(context, plan, record, watch);
}

}  // namespace lapwing::fleet
