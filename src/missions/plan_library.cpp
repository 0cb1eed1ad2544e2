#include "missions/plan_library.hpp"

#include <fmt/format.h>

#include "missions/mission_task.hpp"

namespace lapwing::missions {

base::Result<std::shared_ptr<tasks::PlatformTask const>> find_plan(PlanLibrary const& library, std::string_view name) {
  auto const found = library.find(name);
  if (found == library.end()) {
    auto const hint = library.empty() ? "name a mission of this script, or give plan files with --plans DIR" : "";
    return base::fail(base::ErrorKind::not_found, fmt::format("there is no plan called '{}'", name), hint);
  }
  if (!found->second) return std::unexpected(found->second.error());
  return std::make_shared<MissionTask const>(*found->second);
}

std::vector<std::string> names_of(PlanLibrary const& library) {
  std::vector<std::string> names;
  for (auto const& [name, plan] : library) names.push_back(name);
  return names;
}

}  // namespace lapwing::missions
