#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mavlink/path/link_report.hpp"

namespace lapwing::mavlink::internal {

/// Makes one stream of what several paths bring of one source.
///
/// The same packet, come a second time over another path within 2 s, is dropped whoever sent it: it says nothing new.
/// Where the paths lead to one vehicle, one of them speaks for each repeated report (so that a slow link's old position
/// does not mix with a quick link's new one): the first, until it leaves that report out for 2 s or the best path
/// brings it; and what the vehicle tells every link once (texts, photos) is heard once. Replies are never dropped.
class PathMerge {
 public:
  struct Look {
    bool is_news = true;
    std::optional<PeerRef> copy_of{};  ///< the same packet came over this path
  };
  /// `is_one`: all paths lead to one vehicle. `is_best`: commands go over this path.
  [[nodiscard]] Look look(Frame const& frame, PeerRef from, bool is_one, bool is_best, base::TimePoint now);

 private:
  struct Seen {
    PeerRef from{};
    base::TimePoint at = base::TimePoint::min();
    std::uint32_t message_id = 0;
    std::uint32_t hash = 0;  ///< the packet's checksum, or of an event's content
  };
  struct Speaker {
    std::uint32_t message_id = 0;
    PeerRef from{};
    base::TimePoint at{};
  };
  [[nodiscard]] bool speaks(std::uint32_t message_id, PeerRef from, bool is_best, base::TimePoint now);
  [[nodiscard]] bool is_first_to_tell(Frame const& frame, PeerRef from, base::TimePoint now);

  std::array<Seen, 256> by_seq_{};
  std::array<Seen, 32> events_{};  ///< a ring
  std::size_t next_event_ = 0;
  std::vector<Speaker> speakers_;
};

}  // namespace lapwing::mavlink::internal
