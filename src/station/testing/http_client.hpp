#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "station/http/http.hpp"

/// A small HTTP and WebSocket client for tests, on the same loop as the server under test. Every call runs the loop
/// until the answer is there, or five seconds of wall time have passed.
namespace lapwing::station::testing {

struct Answer {
  int status = 0;  ///< 0: the connection ended without an answer
  std::vector<HttpHeader> headers;
  std::string body;
  [[nodiscard]] std::string header(std::string_view name) const;
};

struct Ask {
  std::string method = "GET";
  std::string target = "/";
  std::vector<HttpHeader> headers = {};
  std::string body = {};
  std::string host = {};            ///< of the Host header; empty: the server's own address
  bool offers_compression = false;  ///< of a WebSocket: permessage-deflate
};

/// One request on a connection of its own.
[[nodiscard]] Answer ask(base::Loop& loop, int port, Ask request);
/// The bytes as they are, for what no honest client would send. Returns everything that came back before the connection
/// ended.
[[nodiscard]] std::string ask_raw(base::Loop& loop, int port, std::string const& bytes);

/// A connection that does what it is told, byte by byte: idle ones, slow ones, ones that ask twice.
class RawConnection {
 public:
  [[nodiscard]] static std::unique_ptr<RawConnection> open(base::Loop& loop, int port);
  ~RawConnection();

  void send(std::string const& bytes);
  /// What came so far, once it holds `part`; what came at all when it never does.
  [[nodiscard]] std::string receive(std::string_view part);
  /// The server has ended it.
  [[nodiscard]] bool is_over() const;

 private:
  struct State;
  explicit RawConnection(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

class WebSocketClient {
 public:
  /// Connects; nothing when the server refuses the upgrade.
  [[nodiscard]] static std::unique_ptr<WebSocketClient> open(base::Loop& loop, int port, Ask request);
  ~WebSocketClient();

  void send(std::string text);
  /// The next message, waiting for it; nothing when the server closed the connection or none came in time.
  [[nodiscard]] std::optional<std::string> receive();
  /// Whether the message that `receive` gave last came as bytes.
  [[nodiscard]] bool last_was_binary() const;
  /// Reads nothing more until `resume`: a viewer on a bad network.
  void pause();
  void resume();

 private:
  struct State;
  explicit WebSocketClient(std::shared_ptr<State> state);
  std::shared_ptr<State> state_;
};

/// Runs the loop until `condition` holds; false when it does not within five seconds.
[[nodiscard]] bool run_until(base::Loop& loop, std::function<bool()> condition);

}  // namespace lapwing::station::testing
