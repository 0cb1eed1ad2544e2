#include <fmt/format.h>

#include "plan/estimate.hpp"
#include "plan/plausibility/internal/look.hpp"

/// Battery: how long it takes against how long there is.
namespace lapwing::plan::plausibility::internal {

/// Only said: a script may well mean to break a mission off when the battery is low.
void judge_battery(Look const& look, Findings& out) {
  auto const lasts = endurance(look.situation, look.limits);
  if (!lasts || look.is_alone || look.mission.items.empty()) return;
  auto const estimated = estimate(look.mission, look.situation.position, performance_of(look.situation.family));
  if (estimated.is_endless || estimated.duration <= *lasts) return;
  out.push_back({.rule = Rule::battery,
                 .severity = Severity::warn,
                 .what = fmt::format("the mission takes about {:.0f} min, and the battery lasts about {:.0f} min",
                                     base::to_seconds(estimated.duration) / 60.0, base::to_seconds(*lasts) / 60.0),
                 .meant = "fly it in parts, or end it in time: mission / { battery(v) < 0.3 }"});
}

}  // namespace lapwing::plan::plausibility::internal
