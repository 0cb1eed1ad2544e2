#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "link/byte_link.hpp"

namespace lapwing::link::internal {

/// What waits for a slow stream, as whole packets, so that a drop never cuts one: commands before what is perishable,
/// each in its order.
///
/// Perishable packets beyond their limit push out the oldest of them; so do commands when the whole is full. Only when
/// no perishable one is left is anything refused. A packet that has begun to go out is finished first, whatever comes.
class SendQueue {
 public:
  struct Limits {
    std::size_t all_bytes = 128 * 1024;
    std::size_t perishable_bytes = 64 * 1024;
  };
  explicit SendQueue(Limits limits) : limits_(limits) {}

  /// False when it was refused: there is no room, and none to be made.
  bool push(Bytes packet, Urgency urgency);
  /// What goes out next; empty when nothing waits.
  [[nodiscard]] Bytes front();
  /// `size` bytes of `front()` went out.
  void pop(std::size_t size);

  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::uint64_t dropped() const { return dropped_; }

 private:
  using Packet = std::vector<std::uint8_t>;
  void drop_oldest();

  Limits limits_;
  std::deque<Packet> urgent_;
  std::deque<Packet> perishable_;
  std::optional<Packet> going_out_;
  std::size_t gone_ = 0;  ///< bytes of it
  std::size_t bytes_ = 0;
  std::size_t perishable_bytes_ = 0;
  std::uint64_t dropped_ = 0;
};

}  // namespace lapwing::link::internal
