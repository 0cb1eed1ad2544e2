#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/time.hpp"

namespace lapwing::station {

/// One message of a feed: a JSON object as text, or bytes in a form of the feed's own.
struct Frame {
  std::string content;
  bool is_binary = false;
  /// What a viewer has once it has taken this one. 0: it only has something together with the frame behind it.
  std::uint64_t revision = 0;
};

/// What a viewer has to take in order.
struct News {
  bool is_whole = false;  ///< the viewer forgets what it had
  std::vector<Frame> frames;
};

/// One kind of thing that viewers are shown, such as vehicles, the log or an occupancy map, whoever has it.
///
/// The station asks it several times a second whether anything is new, and sends each viewer what that viewer lacks.
/// How a feed keeps what viewers may have missed is its own affair: one that knows for each of its things at which
/// revision it changed last needs no history at all, and a viewer that was slow is told the newest alone. Thread-bound.
class Feed {
 public:
  virtual ~Feed() = default;

  /// By which viewers subscribe to it; no other feed of the station has it.
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Looks at what it shows, and gives the revision of that: never 0, and greater than before when anything is new.
  [[nodiscard]] virtual std::uint64_t refresh(base::TimePoint now) = 0;
  /// What leads from `revision` to the one that `refresh` gave last; the whole when `revision` is 0 or too long ago.
  /// The last frame has a revision. A feed that is large leaves off at some frame that has one, once its frames hold
  /// `room` bytes, and is asked for the rest when these are gone.
  [[nodiscard]] virtual News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const = 0;
  /// How many of its bytes may wait for a slow viewer; until they are gone it is sent nothing more of this feed. What
  /// is ready for the network goes first, so this is also how long every other feed may have to wait behind it.
  [[nodiscard]] virtual std::size_t max_unsent_bytes() const { return std::size_t{64} * 1024; }
};

}  // namespace lapwing::station
