#pragma once

#include <bitset>
#include <cstdint>
#include <optional>
#include <vector>

#include "mavlink/wire/frame.hpp"

namespace lapwing::route {

/// Which frames may pass an endpoint in one direction: by message, and by the system and component that sent them.
/// What is blocked never passes; where something is allowed, nothing else of its kind passes.
class Filter {
 public:
  void allow_message(std::uint32_t id);
  void block_message(std::uint32_t id);
  void allow_system(std::uint8_t id);
  void block_system(std::uint8_t id);
  void allow_component(std::uint8_t id);
  void block_component(std::uint8_t id);

  [[nodiscard]] bool passes(mavlink::FrameView const& frame) const {
    return is_open_ || (systems_.passes(frame.source.system) && components_.passes(frame.source.component) &&
                        passes_message(frame.message_id));
  }

 private:
  struct Ids {
    std::optional<std::bitset<256>> allowed;
    std::bitset<256> blocked;
    [[nodiscard]] bool passes(std::uint8_t id) const { return !blocked[id] && (!allowed || (*allowed)[id]); }
    void allow(std::uint8_t id);
  };
  [[nodiscard]] bool passes_message(std::uint32_t id) const;

  bool is_open_ = true;  ///< nothing was asked for
  Ids systems_;
  Ids components_;
  std::vector<std::uint32_t> allowed_messages_;  ///< sorted
  std::vector<std::uint32_t> blocked_messages_;  ///< sorted
};

}  // namespace lapwing::route
