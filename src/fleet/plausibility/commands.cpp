#include "fleet/plausibility/commands.hpp"

#include <fmt/format.h>

#include "fleet/plausibility/doubts.hpp"
#include "mavlink/mission_transfer.hpp"
#include "plan/plausibility/judge.hpp"
#include "plan/vehicle_plan.hpp"

namespace lapwing::fleet {

namespace plausibility = plan::plausibility;
using base::Result;
using base::Task;
using vehicle::Action;

namespace {

/// An operator waits for the start: what takes longer to fetch is started by its number of items alone.
constexpr int most_items_fetched = 100;

/// The mission that the vehicle holds, as far as it tells within the moment that there is.
Task<std::optional<plan::Mission>> held_mission(Craft& craft) {
  auto const& known = craft.state.mission.value;
  if (known && known->total > most_items_fetched) co_return std::nullopt;
  constexpr mavlink::TransferOptions quickly{.tries = 3, .silence_limit = std::chrono::seconds(2), .restarts = 0};
  auto held =
      co_await mavlink::download_mission(craft.connection, craft.address, mavlink::MissionType::mission, quickly);
  if (!held) co_return std::nullopt;
  co_return plan::mission_from(held->items, craft.state.autopilot);
}

Task<plausibility::Findings> findings_of(Craft& craft, vehicle::VehicleCommand command, plausibility::Settings settings,
                                         Neighbours neighbours) {
  // What it holds is no plan, and is refused as that.
  if (craft.holds_parts) co_return plausibility::Findings{};
  std::optional<plan::Mission> held;
  if (command.action == Action::start_mission) held = co_await held_mission(craft);
  auto const situation = situation_of(craft, neighbours);
  switch (command.action) {
    case Action::go_to:
      if (!command.place) break;
      co_return judge(plausibility::GoTo{*command.place, command.height_m}, situation, settings);
    case Action::take_off:
      if (!command.height_m) break;
      co_return judge_take_off(*command.height_m, situation, settings);
    case Action::start_mission:
    case Action::resume_mission: co_return judge_start(held, situation, settings);
    default: break;
  }
  co_return plausibility::Findings{};
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

Task<Result<>> heed_command(Craft& craft, vehicle::VehicleCommand const& command, plausibility::Settings settings,
                            Neighbours const& neighbours, base::Logger const& log) {
  auto const action = command.action;
  auto const findings = co_await findings_of(craft, command, std::move(settings), neighbours);
  Doubts doubts;
  co_return doubts.heed(findings, fmt::format("{} of {}", to_string(action), craft.state.name), log);
}

}  // namespace lapwing::fleet
