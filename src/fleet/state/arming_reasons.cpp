#include "fleet/state/arming_reasons.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace lapwing::fleet {

namespace {

constexpr std::array<std::string_view, 4> beginnings{"PreArm: ", "Arm: ", "Preflight Fail: ", "Arming denied"};
constexpr std::size_t reasons_kept = 20;
constexpr base::Duration good_for = std::chrono::seconds(75);  // two repetitions may be lost

}  // namespace

bool note_arming_reason(std::vector<vehicle::StatusText>& reasons, vehicle::StatusText const& text) {
  auto const begins = [&](std::string_view beginning) { return text.text.starts_with(beginning); };
  if (std::ranges::none_of(beginnings, begins)) return false;
  std::erase_if(reasons, [&](vehicle::StatusText const& known) { return known.text == text.text; });
  reasons.push_back(text);
  if (reasons.size() > reasons_kept) reasons.erase(reasons.begin());
  return true;
}

bool forget_old_arming_reasons(std::vector<vehicle::StatusText>& reasons, base::TimePoint now) {
  return std::erase_if(reasons, [now](vehicle::StatusText const& reason) { return now - reason.heard > good_for; }) > 0;
}

}  // namespace lapwing::fleet
