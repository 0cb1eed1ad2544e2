#pragma once

#include "mavlink/exchange/command.hpp"

namespace lapwing::mavlink {

/// Asks for `message` every `interval` on this link. Errors: as run_command; a message that the vehicle lacks is
/// refused.
base::Task<base::Result<>> set_message_interval(Connection& connection, Address target, MessageId message,
                                                base::Duration interval, CommandOptions options = {});
/// How often the vehicle sends `message` on this link; nothing when it does not. ArduPilot answers before it
/// acknowledges, PX4 after. Errors: as run_command; a vehicle that cannot tell refuses.
base::Task<base::Result<std::optional<base::Duration>>> message_interval(Connection& connection, Address target,
                                                                         MessageId message,
                                                                         CommandOptions options = {});
/// As it was told by `message_interval`; nothing: stops it.
base::Task<base::Result<>> restore_message_interval(Connection& connection, Address target, MessageId message,
                                                    std::optional<base::Duration> interval,
                                                    CommandOptions options = {});
/// Back to what the vehicle sends by itself.
base::Task<base::Result<>> reset_message_interval(Connection& connection, Address target, MessageId message,
                                                  CommandOptions options = {});

}  // namespace lapwing::mavlink
