#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "mavlink/codec/messages.hpp"

namespace lapwing::fleet {

/// The modes that a vehicle lists itself (AVAILABLE_MODES), for numbers that no table knows: PX4's external modes, Lua
/// scripts, newer firmware.
class ModeList {
 public:
  void take(mavlink::AvailableModes const& heard);
  /// True when the list is another one than before.
  bool take(mavlink::AvailableModesMonitor const& heard);
  /// "Spiral"; nothing for a mode that it has not named.
  [[nodiscard]] std::optional<std::string> name(std::uint32_t custom_mode) const;
  /// Places in the list, from 1, that were not heard though others were.
  [[nodiscard]] std::vector<std::uint8_t> missing() const;
  void clear() { *this = {}; }

 private:
  struct Mode {
    std::uint32_t custom_mode = 0;
    std::string name;
  };
  std::uint8_t count_ = 0;
  std::map<std::uint8_t, Mode> modes_;  ///< by place
  std::optional<std::uint8_t> seq_;
};

}  // namespace lapwing::fleet
