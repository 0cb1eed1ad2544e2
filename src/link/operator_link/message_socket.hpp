#pragma once

#include <expected>
#include <memory>
#include <string>
#include <variant>

#include "link/operator_link/endpoints.hpp"

namespace lapwing::link::operator_link {

/// What a message socket's routines can end with.
enum class SocketError : std::uint8_t {
  connection_timeout,  ///< `init`: nobody was there in time
  failed_to_send,      ///< `send_message_sync`: not connected, or not confirmed in time
  no_messages,         ///< `get_message`: none has come
  queue_full,          ///< `send_message_async`: there is no room for it
  cannot_begin,        ///< `init`: the port is taken, a file is missing
};
[[nodiscard]] std::string_view to_string(SocketError error);

struct SocketFailure {
  SocketError error;
  std::string message;  ///< for people: what happened
  std::string hint;     ///< and what to do; may be empty
};
template <class T = void>
using SocketResult = std::expected<T, SocketFailure>;

/// A socket for texts between two programs: one serves, the other connects. Texts arrive whole, once and in order,
/// however often the connection breaks in between; they are durable messages of an operator link, which whoever wants
/// commands or heartbeats uses itself.
///
/// Thread-bound to its loop, which outlives it; where others block, this waits as a coroutine. `init` comes first.
class MessageSocket {
 public:
  struct Times {
    base::Duration connect = std::chrono::seconds(10);
    base::Duration send = std::chrono::seconds(5);
  };
  /// The server's end: `init` waits for the first client, whoever it is.
  MessageSocket(base::Loop& loop, ServeSettings settings, Times times);
  MessageSocket(base::Loop& loop, ConnectSettings settings, Times times);
  MessageSocket(MessageSocket const&) = delete;
  MessageSocket& operator=(MessageSocket const&) = delete;
  ~MessageSocket();

  /// Error: connection_timeout, cannot_begin. May be tried again.
  [[nodiscard]] base::Task<SocketResult<>> init();
  /// Waits until the far end's program has it, over a reconnection if need be. Error: failed_to_send; the text may
  /// still arrive.
  [[nodiscard]] base::Task<SocketResult<>> send_message_sync(std::string text);
  /// Waits for nothing. Error: queue_full (which the seed's queue, having no end, never is).
  [[nodiscard]] SocketResult<> send_message_async(std::string text);
  /// The earliest that has not been got. Error: no_messages.
  [[nodiscard]] SocketResult<std::string> get_message();
  [[nodiscard]] bool is_connected() const;
  /// What was not sent is lost, unless its queue has a folder. A later `init` begins anew.
  void close();
  /// Of a server: where it listens, once `init` was called.
  [[nodiscard]] std::uint16_t port() const { return server_ ? server_->port() : 0; }

 private:
  [[nodiscard]] PeerSession* session() const;
  [[nodiscard]] SocketResult<> begin();

  base::Loop& loop_;
  std::variant<ServeSettings, ConnectSettings> settings_;
  Times times_;
  std::shared_ptr<Server> server_;  // tasks that wait hold it beyond `close`
  std::shared_ptr<Client> client_;
};

}  // namespace lapwing::link::operator_link
