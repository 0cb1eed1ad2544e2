#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::route {

/// Finds frames that came before over another way: a loop in the network, or two links to one vehicle.
///
/// Remembers the last frames of each source by their sequence numbers, a table of 256, so that a frame is looked up
/// without a search. A frame counts as a copy when it has number, message and checksum of one that came from another
/// channel within `across`, or from the same channel within `within`. The latter is short: simple senders repeat
/// themselves with a sequence number that never moves.
class Duplicates {
 public:
  static constexpr base::Duration across = std::chrono::seconds(2);
  static constexpr base::Duration within = std::chrono::milliseconds(50);
  /// Sources that are watched. Frames of any beyond are taken as new.
  static constexpr std::size_t max_sources = 1024;

  Duplicates();

  /// True for a copy. Notes the frame otherwise.
  [[nodiscard]] bool is_copy(mavlink::FrameView const& frame, std::uint16_t channel, base::TimePoint now);

 private:
  struct Seen {
    base::TimePoint at{};
    std::uint64_t number = 0;  ///< counted from 1 in the order of arrival; 0: none yet
    std::uint32_t message_id = 0;
    std::uint16_t checksum = 0;
    std::uint16_t channel = 0;
  };
  struct Source {
    std::uint64_t frames = 0;
    std::array<Seen, 256> by_seq{};
  };
  [[nodiscard]] Source* source_of(mavlink::Address address);

  std::unique_ptr<std::array<std::unique_ptr<Source>, 65536>> sources_;  ///< by system and component
  std::size_t count_ = 0;
};

}  // namespace lapwing::route
