// Plan files: any bytes either are refused with a reason or give a mission that can be made ready for every vehicle.
#include <cmath>
#include <cstdint>
#include <string_view>

#include "plan/capabilities.hpp"
#include "plan/estimate.hpp"
#include "plan/plan_file.hpp"
#include "require.hpp"

namespace {

using namespace lapwing::plan;
using lapwing::fuzz::require;
using lapwing::vehicle::Autopilot;
using lapwing::vehicle::Family;

void check_mission(Mission const& mission) {
  require(!mission.items.empty() && mission.items.size() <= max_mission_items);
  require(std::isfinite(estimate(mission).path_m));
  for (auto const autopilot : {Autopilot::ardupilot, Autopilot::px4}) {
    for (auto const family : {Family::copter, Family::plane, Family::rover}) {
      auto const items = for_autopilot(mission, autopilot, mission.planned_home, family);
      for (std::size_t i = 0; i < items.size(); ++i) require(items[i].seq == i);
      if (auto const wrong = objection(items, autopilot, family)) require(!wrong->message.empty());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
  std::string_view const text(reinterpret_cast<char const*>(data), size);
  auto const plan = read_plan("fuzz.plan", text);
  if (plan) {
    check_mission(plan->mission);
  } else {
    require(!plan.error().message.empty());
  }
  return 0;
}
