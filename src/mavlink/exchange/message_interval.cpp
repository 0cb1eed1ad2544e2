#include "mavlink/exchange/message_interval.hpp"

#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/inbox.hpp"

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

base::Task<base::Result<std::optional<base::Duration>>> message_interval(Connection& connection, Address target,
                                                                         MessageId message, CommandOptions options) {
  auto const id = std::to_underlying(message);
  Inbox told(connection, target,
             wanting<MessageInterval>([message](MessageInterval const& heard) { return heard.message == message; }));
  Command const command{MavCmd::get_message_interval, {static_cast<float>(id)}};
  auto const asked = co_await run_command(connection, target, command, options);
  // Told, though the acknowledgement was lost, is told.
  auto const deadline = connection.loop().now() + (asked ? options.ack_timeout : base::Duration{});
  auto const got = co_await told.next(deadline);
  if (got) {
    auto const interval = std::get<MessageInterval>(*got).interval;
    co_return interval ? std::optional<base::Duration>(*interval) : std::nullopt;
  }
  if (!asked) co_return std::unexpected(asked.error());
  co_return base::fail(base::ErrorKind::timed_out,
                       fmt::format("vehicle {} did not tell how often it sends message {}", target.system, id));
}

base::Task<base::Result<>> restore_message_interval(Connection& connection, Address target, MessageId message,
                                                    std::optional<base::Duration> interval, CommandOptions options) {
  constexpr double stops = -1.0;
  auto const command = interval_command(message, interval ? base::to_seconds(*interval) * 1e6 : stops);
  return run_command(connection, target, command, options);
}

base::Task<base::Result<>> reset_message_interval(Connection& connection, Address target, MessageId message,
                                                  CommandOptions options) {
  return run_command(connection, target, interval_command(message, 0.0), options);
}

}  // namespace lapwing::mavlink
