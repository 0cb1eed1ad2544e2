#pragma once

#include "mavlink/command.hpp"

namespace lapwing::mavlink {

/// Asks for `message` every `interval` on this link. Errors: as run_command; a message that the vehicle lacks is
/// refused.
base::Task<base::Result<>> set_message_interval(Connection& connection, Address target, MessageId message,
                                                base::Duration interval, CommandOptions options = {});
/// Back to what the vehicle sends by itself.
base::Task<base::Result<>> reset_message_interval(Connection& connection, Address target, MessageId message,
                                                  CommandOptions options = {});

}  // namespace lapwing::mavlink
