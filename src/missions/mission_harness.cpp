#include "missions/mission_harness.hpp"

#include <utility>

#include "missions/mission_task.hpp"
#include "missions/send_message.hpp"
#include "missions/vocabulary.hpp"
#include "plan/estimate.hpp"

namespace lapwing::missions {

MissionHarness::MissionHarness(base::Loop& loop, PlanLibrary plans)
    : HarnessPlatform(loop, missions::vocabulary()), plans_(std::move(plans)) {}

base::Result<std::shared_ptr<tasks::PlatformTask const>> MissionHarness::named_task(std::string_view name) const {
  return plans_.contains(name) ? find_plan(plans_, name) : HarnessPlatform::named_task(name);
}

base::Result<> MissionHarness::perform(tasks::InstructionCall const& call, tasks::VehicleId const& id) {
  if (call.name != send_message().name) return HarnessPlatform::perform(call, id);
  return base::fail(base::ErrorKind::refused, "these vehicles take no raw messages");
}

base::Result<std::optional<base::Duration>> MissionHarness::length_of(tasks::PlatformTask const& task,
                                                                      tasks::VehicleInfo const& vehicle) const {
  auto const* const flown = dynamic_cast<MissionTask const*>(&task);
  if (!flown) return HarnessPlatform::length_of(task, vehicle);
  auto const& mission = flown->mission();
  auto const estimate = plan::estimate(mission, mission.home ? mission.home : vehicle.position);
  return estimate.is_endless ? std::nullopt : std::optional(estimate.duration);
}

}  // namespace lapwing::missions
