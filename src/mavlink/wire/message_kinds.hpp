#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "link/byte_link.hpp"
#include "mavlink/wire/frame.hpp"

/// What kind of talk a message is, where several links lead to one vehicle, one link is slow, or packets are passed on.
/// By the wire's ids: most of these are messages that this program passes on and never decodes.
namespace lapwing::mavlink {

/// One property of a message; a message has several.
enum class Kind : std::uint16_t {
  bulk =
      1U << 0U,  ///< much, may take its time: files, logs, pictures, corrections, pieces of which none replaces another
  asks_for_bulk = 1U << 1U,  ///< what follows is much: lists of parameters, logs
  perishable = 1U << 2U,     ///< worth little when it is late, because the next one says it anew
  setpoint = 1U << 3U,       ///< where to go, which way to lie, or what to do with the motors, now
  replaced = 1U << 4U,  ///< for one vehicle, and yet a value: an old position of a stick must not come after a new one
  state = 1U << 5U,     ///< a report that a vehicle repeats on each of its links, at each link's own rate
  event = 1U << 6U,     ///< what a vehicle tells once, on each of its links
  single = 1U << 7U,    ///< for all, and yet not replaced by the next of its kind: answers, texts, events
  clock =
      1U << 8U,  ///< carries the vehicle's clock in milliseconds or finer: two vehicles hardly ever send the same one
  order = 1U << 9U,    ///< tells a vehicle what to do: of no use when it comes late
  answer = 1U << 10U,  ///< belongs to an order, and never comes too late
};

/// One row of the table of messages that are anything but a plain command or report.
struct MessageKinds {
  std::uint32_t id = 0;
  std::string_view name;
  std::uint16_t kinds = 0;  ///< of Kind
};
/// In ascending order of ids.
[[nodiscard]] std::span<MessageKinds const> message_kinds();
[[nodiscard]] bool is(std::uint32_t message_id, Kind kind);

/// What a message that we send asks of the link that carries it.
enum class Traffic {
  command,  ///< little, must arrive soon: commands, missions, acknowledgements
  bulk,     ///< much, may take its time: parameters, files, logs, corrections
};
[[nodiscard]] Traffic traffic_of(std::uint32_t message_id);

/// How soon it is wanted at the far end. Urgent is what may stop a vehicle: a mode, return, land, disarm, terminate.
[[nodiscard]] link::Urgency urgency_of(Frame const& frame);

/// Helps to tell one vehicle from another: TIMESYNC, AUTOPILOT_VERSION, GLOBAL_POSITION_INT.
[[nodiscard]] inline bool tells_identity(MessageId id) {
  return id == MessageId::timesync || id == MessageId::autopilot_version || id == MessageId::global_position_int;
}

}  // namespace lapwing::mavlink
