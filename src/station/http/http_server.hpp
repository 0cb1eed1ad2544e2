#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// Names one WebSocket connection for as long as the server lives.
enum class SessionId : std::uint64_t {};

/// What happens on WebSocket connections. Called on the loop; `closed` comes once for every `opened`, except at the
/// server's end.
struct WebSocketEvents {
  std::function<void(SessionId, HttpRequest const&)> opened;  ///< with the request that asked for it
  std::function<void(SessionId, std::string_view text)> received;
  std::function<void(SessionId)> drained;  ///< all that was queued for it has gone to the network
  std::function<void(SessionId)> closed;
};

/// An HTTP and WebSocket server on the loop's thread: API routes, files of one folder, one WebSocket endpoint.
///
/// All of Boost Asio and Beast is behind this interface. Thread-bound to its loop, which must outlive it.
class HttpServer {
 public:
  /// Which WebSockets compress what they send (permessage-deflate, RFC 7692), if the client offers it. On one machine
  /// it costs processor time and saves nothing.
  enum class Compression { never, to_other_machines, always };

  struct Options {
    std::string address = "127.0.0.1";
    int port = 8080;                         ///< 0 picks a free one
    std::filesystem::path static_root = {};  ///< of the web app; empty: no files are served
    std::string websocket_path = "/api/v1/ws";
    std::string token = {};                    ///< API requests must carry it; must be set beyond loopback
    std::vector<std::string> host_names = {};  ///< further names of this machine that browsers may use
    Compression compression = Compression::to_other_machines;
    /// When all are taken, the one that has done nothing for longest gives way to who comes
    /// (internal/connection_places.hpp).
    std::size_t max_connections = 256;
    std::size_t max_strangers_per_address = 192;  ///< connections that have shown no token; with none set, no request
    std::size_t max_sessions = 64;                ///< WebSockets among them
    std::size_t max_header_bytes = 16 * 1024;
    std::size_t max_body_bytes = 1024 * 1024;    ///< of a WebSocket message, and of a request whose route says nothing
    std::size_t max_backlog_bytes = 512 * 1024;  ///< unsent bytes of a WebSocket's lane 0 above which `send` refuses
    std::chrono::milliseconds first_request_timeout{5'000};  ///< for the head of a connection's first request
    std::chrono::milliseconds request_timeout{15'000};       ///< for all of a request, and to keep an idle connection
    std::chrono::milliseconds stall_timeout{
        5'000};  ///< a session that takes nothing for so long may be ended for another
  };

  /// Listens at once. Fails with a message for the operator when the port is taken or the address is not this
  /// machine's.
  [[nodiscard]] static base::Result<std::unique_ptr<HttpServer>> open(base::Loop& loop, Options options,
                                                                      base::Logger log);
  ~HttpServer();
  HttpServer(HttpServer const&) = delete;
  HttpServer& operator=(HttpServer const&) = delete;

  [[nodiscard]] int port() const;
  /// For people and browsers: "http://127.0.0.1:8080/".
  [[nodiscard]] std::string url() const;

  void set_router(Router router);
  void set_websocket(WebSocketEvents events);
  /// Calls `function` again and again in wall time, which browsers live in, however fast the loop's time runs.
  void every(std::chrono::milliseconds period, std::function<void()> function);

  struct Message {
    std::shared_ptr<std::string const> content;
    bool is_binary = false;
  };
  /// Messages that wait for the network are counted by lane, so that those of one do not keep out those of another.
  /// All lanes share the session's one stream: what is queued first goes first.
  struct Lane {
    std::size_t number = 0;
    std::size_t max_unsent_bytes = 0;
  };
  /// Queues messages, all or none. False when the session is gone or so slow that the lane would hold too much: the
  /// caller decides what to leave out, since only it knows which messages newer ones replace. An empty lane takes any.
  [[nodiscard]] bool send(SessionId session, std::span<Message const> messages, Lane lane);
  /// The same on lane 0, up to `max_backlog_bytes`.
  [[nodiscard]] bool send(SessionId session, std::span<Message const> messages);
  /// Bytes queued on that lane and not yet given to the network; 0 for a session that is gone.
  [[nodiscard]] std::size_t unsent_bytes(SessionId session, std::size_t lane = 0) const;

 private:
  struct Core;
  explicit HttpServer(std::shared_ptr<Core> core);
  std::shared_ptr<Core> core_;  // shared with connections, which end a turn later than the server
};

}  // namespace lapwing::station
