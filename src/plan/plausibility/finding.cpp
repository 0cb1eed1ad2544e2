#include "plan/plausibility/finding.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace lapwing::plan::plausibility {

namespace {

/// In the order of the rules.
constexpr std::array<std::string_view, 12> names{"home_moved", "too_far",     "zero_coordinates", "outside_fence",
                                                 "battery",    "home_height", "below_ground",     "take_off_height",
                                                 "ceiling",    "no_take_off", "empty_mission",    "shared_pad"};

}  // namespace

std::string_view to_string(Rule rule) {
  return names.at(static_cast<std::size_t>(std::to_underlying(rule)));
}

std::optional<Rule> rule_from(std::string_view name) {
  auto const found = std::ranges::find(names, name);
  if (found == names.end()) return std::nullopt;
  return static_cast<Rule>(found - names.begin());
}

std::span<std::string_view const> rule_names() {
  return names;
}

std::string to_text(Finding const& finding) {
  return fmt::format("{}{}{} [{}]", finding.what, finding.meant.empty() ? "" : "; ", finding.meant,
                     to_string(finding.rule));
}

Finding const* refusal(Findings const& findings) {
  auto const found = std::ranges::find_if(findings, &Finding::refuses);
  return found == findings.end() ? nullptr : &*found;
}

}  // namespace lapwing::plan::plausibility
