#include "plan/plausibility/judge.hpp"

#include <algorithm>

#include "plan/plausibility/internal/look.hpp"

namespace lapwing::plan::plausibility {

namespace {

Findings sorted(Findings findings, Settings const& settings) {
  std::ranges::stable_partition(findings, [](Finding const& finding) { return finding.severity == Severity::refuse; });
  return marked(std::move(findings), settings);
}

}  // namespace

Findings judge(Mission const& mission, Situation const& situation, Settings const& settings) {
  internal::Look const look(mission, situation, settings.limits, false);
  Findings findings;
  internal::judge_where(look, findings);
  internal::judge_height(look, findings);
  internal::judge_sequence(look, findings);
  internal::judge_fence(look, findings);
  internal::judge_own_fence(look, findings);
  internal::judge_battery(look, findings);
  internal::judge_pads(look, findings);
  return sorted(std::move(findings), settings);
}

Findings judge_alone(Mission const& mission, Settings const& settings) {
  Situation const nothing;
  internal::Look const look(mission, nothing, settings.limits, true);
  Findings findings;
  internal::judge_where(look, findings);
  internal::judge_height(look, findings);
  internal::judge_sequence(look, findings);
  return sorted(std::move(findings), settings);
}

}  // namespace lapwing::plan::plausibility
