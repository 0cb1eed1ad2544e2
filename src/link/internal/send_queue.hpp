#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "link/byte_link.hpp"

namespace lapwing::link::internal {

/// What waits for a slow stream, as whole packets, so that a drop never cuts one: what is urgent before commands, and
/// those before what is perishable, each in its order.
///
/// Perishable packets beyond their limit push out the oldest of them; so do commands when the whole is full. Only when
/// no perishable one is left is anything refused: commands, as an older one may be the cause of the newer. What is
/// urgent pushes out the oldest command, too. What has waited for too long, because the line stands still or the far
/// end takes little, does not go out any more: its sender has said it again. A packet that has begun to go out is
/// finished first, whatever comes.
class SendQueue {
 public:
  struct Limits {
    std::size_t all_bytes = 128 * 1024;
    std::size_t perishable_bytes = 64 * 1024;
    base::Duration wait = std::chrono::seconds(3);  ///< more than what fits into a line of known speed takes
  };
  explicit SendQueue(Limits limits) : limits_(limits) {}

  /// False when it was refused: there is no room, and none to be made.
  bool push(Bytes packet, Urgency urgency, base::TimePoint now);
  /// What goes out next; empty when nothing waits.
  [[nodiscard]] Bytes front(base::TimePoint now);
  /// `size` bytes of `front()` went out.
  void pop(std::size_t size);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  struct Packet {
    std::vector<std::uint8_t> bytes;
    base::TimePoint since;
  };
  /// By what goes first.
  enum Line : std::size_t { urgent, prompt, perishable };
  [[nodiscard]] static Line line_of(Urgency urgency);
  void drop_oldest(Line line);
  void drop_old(base::TimePoint now);

  Limits limits_;
  std::array<std::deque<Packet>, 3> lines_;
  std::optional<Packet> going_out_;
  std::size_t gone_ = 0;  ///< bytes of it
  std::size_t bytes_ = 0;
  std::size_t perishable_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace lapwing::link::internal
