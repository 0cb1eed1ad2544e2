#include "fleet/state/mode_list.hpp"

#include <algorithm>

namespace lapwing::fleet {

void ModeList::take(mavlink::AvailableModes const& heard) {
  if (heard.index == 0 || heard.name.empty()) return;
  count_ = heard.count;
  modes_[heard.index] = {heard.custom_mode, heard.name};
}

bool ModeList::take(mavlink::AvailableModesMonitor const& heard) {
  bool const is_other = seq_ && *seq_ != heard.seq;
  if (is_other) clear();
  seq_ = heard.seq;
  return is_other;
}

std::optional<std::string> ModeList::name(std::uint32_t custom_mode) const {
  auto const found =
      std::ranges::find_if(modes_, [&](auto const& entry) { return entry.second.custom_mode == custom_mode; });
  if (found == modes_.end()) return std::nullopt;
  return found->second.name;
}

std::vector<std::uint8_t> ModeList::missing() const {
  std::vector<std::uint8_t> places;
  for (unsigned place = 1; place <= count_; ++place)
    if (!modes_.contains(static_cast<std::uint8_t>(place))) places.push_back(static_cast<std::uint8_t>(place));
  return places;
}

}  // namespace lapwing::fleet
