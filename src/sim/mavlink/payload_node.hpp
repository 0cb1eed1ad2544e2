#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/log.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::sim {

/// A camera or gimbal that speaks MAVLink for itself, on a link of its own beside its vehicle's autopilot, as those of
/// PX4 vehicles do: heartbeats of its own type, answers to commands and questions that are meant for it.
///
/// Passive as the flight controller that it belongs to. Thread-bound to the loop.
class PayloadNode {
 public:
  struct Setup {
    mavlink::Address self;
    mavlink::MavType type = mavlink::MavType::generic;
    std::optional<mavlink::SigningKey> signing_key = std::nullopt;
  };
  struct Ports {
    /// What became of a command; nothing for one that is not for such a component.
    std::function<std::optional<mavlink::MavResult>(mavlink::CommandInt const&)> perform;
    /// What REQUEST_MESSAGE asks for; nothing for what it does not have.
    std::function<std::optional<mavlink::Message>(mavlink::MessageId, float argument)> report;
    std::function<bool()> silent;
  };
  PayloadNode(base::Loop& loop, Setup const& setup, Ports ports, std::unique_ptr<link::ByteLink> link,
              base::Logger log);
  PayloadNode(PayloadNode const&) = delete;
  PayloadNode& operator=(PayloadNode const&) = delete;

  /// Sends its heartbeat when it is due.
  void step(base::Duration now);
  /// Tells everybody.
  void tell(mavlink::Message const& message);
  [[nodiscard]] std::uint8_t component() const { return connection_.self().component; }

 private:
  void receive(mavlink::Received const& received);
  void answer(mavlink::CommandInt const& command, mavlink::Address from);
  [[nodiscard]] std::optional<mavlink::MavResult> perform(mavlink::CommandInt const& command, mavlink::Address from);

  mavlink::MavType type_;
  Ports ports_;
  mavlink::Connection connection_;
  mavlink::Subscription subscription_;
  base::Duration next_heartbeat_{};
};

/// COMMAND_LONG says the same as COMMAND_INT with the place in floats and altitudes above home.
[[nodiscard]] mavlink::CommandInt as_command_int(mavlink::CommandLong const& command);

}  // namespace lapwing::sim
