#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lapwing::mavlink::internal {

/// Which packets were sent last, to know them when they come back over a broadcast address, another link or a router.
/// By their contents: other ground stations have the same usual ids.
class Echoes {
 public:
  void note_sent(std::uint8_t seq, std::uint16_t checksum) {
    sent_[next_] = key(seq, checksum);
    next_ = (next_ + 1) % sent_.size();
  }
  [[nodiscard]] bool has(std::uint8_t seq, std::uint16_t checksum) const {
    return std::ranges::find(sent_, key(seq, checksum)) != sent_.end();
  }

 private:
  static std::uint32_t key(std::uint8_t seq, std::uint16_t checksum) {
    constexpr std::uint32_t used = 1U << 24U;
    return used | static_cast<std::uint32_t>(seq) << 16U | checksum;
  }
  std::array<std::uint32_t, 1024> sent_{};  // of a busy station's second
  std::size_t next_ = 0;
};

}  // namespace lapwing::mavlink::internal
