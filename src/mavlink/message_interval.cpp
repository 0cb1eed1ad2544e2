#include "mavlink/message_interval.hpp"

namespace lapwing::mavlink {

namespace {

Command interval_command(MessageId message, double interval_us) {
  auto const id = static_cast<float>(static_cast<std::uint32_t>(message));
  return {MavCmd::set_message_interval, {id, static_cast<float>(interval_us)}};
}

}  // namespace

base::Task<base::Result<>> set_message_interval(Connection& connection, Address target, MessageId message,
                                                base::Duration interval, CommandOptions options) {
  auto const command = interval_command(message, base::to_seconds(interval) * 1e6);
  return run_command(connection, target, command, options);
}

base::Task<base::Result<>> reset_message_interval(Connection& connection, Address target, MessageId message,
                                                  CommandOptions options) {
  return run_command(connection, target, interval_command(message, 0.0), options);
}

}  // namespace lapwing::mavlink
