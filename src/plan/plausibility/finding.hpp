#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What a look at a mission or a command, before anything moves, has to say about it.
namespace lapwing::plan::plausibility {

enum class Rule {
  home_moved,        ///< the vehicle's home would go far from where it stands
  too_far,           ///< a place is far from the vehicle, or from the place before it
  zero_coordinates,  ///< latitude 0, longitude 0: off Africa, and what a forgotten value looks like
  outside_fence,     ///< a place or the way there is outside a fence: the vehicle's own, or the plan's
  battery,           ///< it takes longer than the battery lasts
  home_height,       ///< the mission's home is far above or below the ground on which the vehicle stands
  below_ground,      ///< a place at or below the ground of home
  take_off_height,   ///< a take-off that does not leave the ground, or hardly
  ceiling,           ///< a place high above home
  no_take_off,       ///< it stands on the ground, and the mission does not take off
  empty_mission,     ///< there is nothing to fly
  shared_pad,        ///< it would land on another vehicle, or has another's pad for its home
};
/// As settings and messages name it: "home_moved".
[[nodiscard]] std::string_view to_string(Rule rule);
[[nodiscard]] std::optional<Rule> rule_from(std::string_view name);
[[nodiscard]] std::span<std::string_view const> rule_names();

enum class Severity {
  refuse,  ///< nothing is sent, unless the rule is allowed by name
  warn     ///< it is said
};

struct Finding {
  Rule rule{};
  Severity severity = Severity::refuse;
  std::optional<std::size_t> item = std::nullopt;  ///< counts the mission's items from 0
  std::string what;                                ///< what is wrong, with figures
  std::string meant = {};                          ///< what was probably meant; may be empty
  std::optional<std::string> allowed_because = std::nullopt;

  [[nodiscard]] bool refuses() const { return severity == Severity::refuse && !allowed_because; }
};
using Findings = std::vector<Finding>;

/// "home would be moved 278 km ...: perhaps it is the script of another place [home_moved]"
[[nodiscard]] std::string to_text(Finding const& finding);
/// The first that refuses, or null.
[[nodiscard]] Finding const* refusal(Findings const& findings);

}  // namespace lapwing::plan::plausibility
