#include "apps/vehicles/mission/vehicle_plans.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plan/capabilities.hpp"
#include "plan/files/vehicle_plan.hpp"

namespace lapwing::apps {

using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using mavlink::MissionType;

namespace {

/// Of a plan for one vehicle and one of the three lists.
std::vector<mavlink::MissionItem> items_for(MissionType type, plan::Plan const& plan,
                                            fleet::MavlinkVehicle const& craft, std::vector<std::string>& lost) {
  auto const& state = craft.state;
  if (type == MissionType::fence) return plan::fence_items(plan::simple_fence(plan.fence, lost));
  if (type == MissionType::rally) return plan::rally_items(plan.rally);
  auto const home = state.motion.home.value ? state.motion.home.value : plan.mission.planned_home;
  return plan::for_autopilot(plan.mission, state.autopilot, home, state.family);
}

bool has(MissionType type, plan::Plan const& plan) {
  if (type == MissionType::fence) return !plan.fence.empty();
  if (type == MissionType::rally) return !plan.rally.empty();
  return !plan.mission.items.empty() || !plan.patterns.empty();
}

Result<> take(MissionType type, std::vector<mavlink::MissionItem> const& items, fleet::MavlinkVehicle const& craft,
              plan::Plan& plan) {
  if (type == MissionType::mission) {
    plan.mission = plan::mission_from(items, craft.state.autopilot);
    return {};
  }
  if (type == MissionType::fence) {
    auto fence = plan::fence_from(items);
    if (!fence) return fail(fence.error().kind, fmt::format("the vehicle's fence: {}", fence.error().message));
    plan.fence = *std::move(fence);
    return {};
  }
  auto rally = plan::rally_from(items);
  if (!rally) return fail(rally.error().kind, fmt::format("the vehicle's rally points: {}", rally.error().message));
  plan.rally = *std::move(rally);
  return {};
}

mavlink::TransferProgress transfer_progress(ShowProgress const& show, MissionType type) {
  return [show, phase = fmt::format("downloading {}", to_string(type))](std::size_t done, std::size_t total) {
    if (show) show(phase, done, total);
  };
}

}  // namespace

Result<std::vector<MissionType>> parse_types(std::string const& text) {
  using enum MissionType;
  if (text == "all") return std::vector{fence, rally, mission};
  for (auto const type : {mission, fence, rally})
    if (text == to_string(type)) return std::vector{type};
  return fail(ErrorKind::invalid_input, fmt::format("--type {} is not known", text),
              "use mission, fence, rally or all");
}

std::string_view to_string(MissionType type) {
  if (type == MissionType::fence) return "fence";
  return type == MissionType::rally ? "rally" : "mission";
}

Result<Uploads> uploads_for(std::string_view file, plan::Plan const& plan, std::vector<MissionType> const& types,
                            fleet::MavlinkVehicle const& craft) {
  Uploads uploads;
  for (auto const type : types) {
    if (!has(type, plan)) continue;
    if (type == MissionType::mission) {
      if (auto const flown = plan::mission_to_fly(file, plan); !flown) return std::unexpected(flown.error());
    }
    auto items = items_for(type, plan, craft, uploads.lost);
    if (items.empty()) continue;
    if (type == MissionType::mission) {
      auto wrong = plan::objection(items, craft.state.autopilot, craft.state.family);
      if (wrong) return fail(ErrorKind::invalid_input, fmt::format("{}: {}", file, wrong->message), wrong->hint);
    }
    uploads.lists.push_back({type, std::move(items)});
  }
  if (uploads.lists.empty())
    return fail(ErrorKind::invalid_input, fmt::format("{}: there is nothing in it to upload", file),
                uploads.lost.empty() ? "" : uploads.lost.front());
  return uploads;
}

Task<Result<>> upload_lists(fleet::MavlinkVehicle const& craft, std::vector<UploadList> lists, ShowProgress show,
                            std::vector<ListReport>& reports) {
  reports.reserve(lists.size());  // a replacement under way is written to while the list grows
  for (auto& list : lists) {
    auto& report = reports.emplace_back(ListReport{.type = list.type, .items = list.items.size(), .outcome = "failed"});
    mavlink::ReplaceOptions options{.transfer = patient_transfer, .autopilot = craft.heard->mav_autopilot};
    options.progress = [&show, type = list.type](std::string_view phase, std::size_t done, std::size_t total) {
      if (show) show(fmt::format("{}: {}", to_string(type), phase), done, total);
    };
    auto const replaced = co_await mavlink::replace_plan(craft.connection, craft.address, std::move(list.items),
                                                         list.type, std::move(options), report.replacement);
    if (!replaced) {
      report.error = replaced.error().message;
      co_return fail(replaced.error().kind, fmt::format("{}: {}", to_string(list.type), report.error),
                     replaced.error().hint);
    }
    report.outcome = report.replacement.written == 0 ? "unchanged" : "uploaded";
  }
  co_return Result<>{};
}

Task<Result<>> download_lists(fleet::MavlinkVehicle const& craft, std::vector<MissionType> types, ShowProgress show,
                              plan::Plan& plan, std::vector<ListReport>& reports) {
  for (auto const type : types) {
    auto& report = reports.emplace_back(ListReport{.type = type, .outcome = "failed"});
    auto progress = transfer_progress(show, type);
    mavlink::HeldPlan none_known;
    auto const held = co_await mavlink::download_mission(craft.connection, craft.address, type, patient_transfer,
                                                         std::move(progress), std::move(none_known));
    if (!held) {
      report.error = held.error().message;
      bool const is_unknown_there = held.error().kind == ErrorKind::refused && types.size() > 1;
      if (!is_unknown_there) co_return std::unexpected(held.error());
      report.outcome = "not supported";
      continue;
    }
    if (auto taken = take(type, held->items, craft, plan); !taken) co_return taken;
    report.items = held->items.size();
    report.outcome = "downloaded";
  }
  co_return Result<>{};
}

Task<Result<>> clear_lists(fleet::MavlinkVehicle const& craft, std::vector<MissionType> types,
                           std::vector<ListReport>& reports) {
  for (auto const type : types) {
    auto& report = reports.emplace_back(ListReport{.type = type, .outcome = "failed"});
    auto const cleared = co_await mavlink::clear_mission(craft.connection, craft.address, type, patient_transfer);
    if (!cleared) {
      report.error = cleared.error().message;
      co_return cleared;
    }
    report.outcome = "cleared";
  }
  co_return Result<>{};
}

}  // namespace lapwing::apps
