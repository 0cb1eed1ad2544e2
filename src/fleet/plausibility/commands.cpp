#include "fleet/plausibility/commands.hpp"

#include <fmt/format.h>

#include "fleet/actions/operator_actions.hpp"
#include "fleet/plausibility/doubts.hpp"
#include "fleet/plausibility/own_fence.hpp"
#include "fleet/plausibility/own_home.hpp"
#include "mavlink/exchange/mission_transfer.hpp"
#include "plan/files/vehicle_plan.hpp"
#include "plan/plausibility/judge.hpp"

namespace lapwing::fleet {

namespace plausibility = plan::plausibility;
using base::Result;
using base::Task;
using vehicle::Action;

namespace {

/// An operator waits for the start: what takes longer to fetch is started by its number of items alone.
constexpr int most_items_fetched = 100;

/// The mission that the vehicle holds, as far as it tells within the moment that there is.
Task<std::optional<plan::Mission>> held_mission(MavlinkVehicle& craft) {
  auto const& known = craft.state.mission.progress.value;
  if (known && known->total > most_items_fetched) co_return std::nullopt;
  constexpr mavlink::TransferOptions quickly{.tries = 3, .silence_limit = std::chrono::seconds(2), .restarts = 0};
  auto held =
      co_await mavlink::download_mission(craft.connection, craft.address, mavlink::MissionType::mission, quickly);
  if (!held) co_return std::nullopt;
  co_return plan::mission_from(held->items, craft.state.autopilot);
}

/// Of a vehicle that is not armed, a mode may be chosen at leisure, and resuming is refused anyway.
bool flies_the_plan_now(MavlinkVehicle const& craft, vehicle::VehicleCommand const& command) {
  bool const arms = command.action == Action::start_mission || command.action == Action::arm;
  return flies_the_plan(craft, command) && (arms || craft.heard->is_armed);
}

Task<plausibility::Findings> findings_of(MavlinkVehicle& craft, vehicle::VehicleCommand command,
                                         plausibility::Settings settings, Neighbours neighbours, base::Logger log) {
  bool const goes_somewhere = command.action == Action::go_to && command.place;
  bool const takes_off = command.action == Action::take_off;
  bool const flies_plan = flies_the_plan_now(craft, command);
  // What stops a vehicle waits for nothing. A mixture of plans is no plan, and is refused as that.
  if (!(goes_somewhere || takes_off || flies_plan) || craft.holds_parts()) co_return plausibility::Findings{};
  co_await learn_home(craft, hasty);
  co_await learn_fence(craft, hasty, std::move(log));
  std::optional<plan::Mission> held;
  if (flies_plan) held = co_await held_mission(craft);
  auto const situation = situation_of(craft, neighbours);
  if (goes_somewhere) co_return judge(plausibility::GoTo{*command.place, command.height_m}, situation, settings);
  if (takes_off) co_return judge_take_off(command.height_m.value_or(usual_take_off_height_m), situation, settings);
  co_return judge_start(held, situation, settings);
}

}  // namespace

Result<plausibility::Settings> settings_for(vehicle::VehicleCommand const& command,
                                            plausibility::Settings const& settings) {
  auto mine = settings;
  for (auto const& [rule, reason] : command.allow) {
    auto allowed = plausibility::allowance(rule, reason);
    if (!allowed) return std::unexpected(allowed.error());
    mine.allowed.insert_or_assign(allowed->first, std::move(allowed->second));
  }
  return mine;
}

Task<Result<>> heed_command(MavlinkVehicle& craft, vehicle::VehicleCommand const& command,
                            plausibility::Settings settings, Neighbours const& neighbours, Doubts& doubts,
                            base::Logger const& log) {
  auto const action = command.action;
  auto const findings = co_await findings_of(craft, command, std::move(settings), neighbours, log);
  co_return doubts.heed(findings, fmt::format("{} of {}", to_string(action), craft.state.name), log);
}

}  // namespace lapwing::fleet
