#if defined(__GNUC__) && !defined(__clang__)
// g++ 12 takes the frame allocator of Asio's coroutines, inlined by half, for a mismatch.
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "station/http/http_server.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include <fmt/format.h>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <boost/beast/websocket/stream.hpp>

#include "station/http/access.hpp"
#include "station/http/internal/beast_messages.hpp"
#include "station/http/internal/connection_places.hpp"
#include "station/http/internal/outbox.hpp"
#include "station/http/internal/pending_answer.hpp"
#include "station/http/internal/web_socket_options.hpp"
#include "station/http/static_files.hpp"
#include "station/messages/message_pace.hpp"

namespace lapwing::station {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::redirect_error;
using asio::use_awaitable;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

/// A connection is a WebSocket stream from the start; plain HTTP is spoken on the layer below it until the upgrade.
struct Connection {
  Connection(tcp::socket socket, internal::Places::Guest place) : stream(std::move(socket)), guest(place) {}
  beast::tcp_stream& transport() { return stream.next_layer(); }

  websocket::stream<beast::tcp_stream> stream;
  internal::Places::Guest guest;
  bool is_known = false;    ///< has sent a request that carried the token, if one is needed
  bool has_spoken = false;  ///< over its WebSocket
  SessionId session{};
  std::chrono::steady_clock::time_point took_last{};  ///< when it took the last message, or had none to take
  internal::Outbox outbox;
};

/// Whom an address counts for: itself; of IPv6 the network of 64 bits, of which one machine may use any address.
std::string network_of(asio::ip::address const& address) {
  if (!address.is_v6() || address.to_v6().is_v4_mapped()) return address.to_string();
  auto bytes = address.to_v6().to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), std::uint8_t{0});
  return asio::ip::address_v6(bytes).to_string();
}

using Parser = http::request_parser<http::string_body>;

/// What came, as far as it could be read, and the answer that it gets without being carried out.
struct Received {
  std::optional<HttpRequest> asked;
  std::optional<HttpResponse> answer;
  bool is_malformed = false;
};

}  // namespace

/// Everything that connections share. They may outlive the server by a turn of the loop: `closed` tells them.
struct HttpServer::Core : std::enable_shared_from_this<HttpServer::Core> {
  Core(base::Loop& loop, Options given, base::Logger logger)
      : io(loop.io()),
        options(std::move(given)),
        log(std::move(logger)),
        acceptor(io),
        places({.all = options.max_connections, .strangers_per_address = options.max_strangers_per_address}) {}

  asio::io_context& io;
  Options options;
  base::Logger log;
  AccessPolicy policy;
  Router router;
  WebSocketEvents events;
  tcp::acceptor acceptor;
  internal::Places places;
  std::map<internal::Places::Guest, std::shared_ptr<Connection>> connections;
  std::map<SessionId, std::shared_ptr<Connection>> sessions;
  std::set<std::shared_ptr<asio::steady_timer>> timers;
  std::set<std::shared_ptr<internal::PendingAnswer>> pending;
  std::uint64_t last_session = 0;
  bool closed = false;

  base::Result<> listen();
  void close();
  Reply answer(HttpRequest const& request) const;
  asio::awaitable<HttpResponse> finish(std::shared_ptr<Reply> reply);
  asio::awaitable<void> accept_connections();
  asio::awaitable<void> serve(std::shared_ptr<Connection> connection);
  asio::awaitable<error_code> hear(std::shared_ptr<Connection> connection, beast::flat_buffer& buffer);
  asio::awaitable<bool> serve_request(std::shared_ptr<Connection> connection, beast::flat_buffer& buffer);
  Received judge(Connection& connection, Parser const& parser);
  asio::awaitable<error_code> read_body(std::shared_ptr<Connection> connection, beast::flat_buffer& buffer,
                                        Parser& parser, Received& received);
  asio::awaitable<bool> respond(std::shared_ptr<Connection> connection, Parser& parser, Received& received);
  std::optional<HttpResponse> refuse_session();
  asio::awaitable<void> drain(std::shared_ptr<Connection> connection);
  asio::awaitable<void> serve_websocket(std::shared_ptr<Connection> connection,
                                        http::request<http::string_body> request, HttpRequest asked);
  void write_next(std::shared_ptr<Connection> const& connection);
  void repeat(std::shared_ptr<asio::steady_timer> const& timer, std::chrono::milliseconds period,
              std::function<void()> function);
};

base::Result<> HttpServer::Core::listen() {
  error_code error;
  auto const address = asio::ip::make_address(options.address, error);
  if (error) {
    return base::fail(base::ErrorKind::invalid_input, fmt::format("{} is no IP address to listen on.", options.address),
                      "Give one of this machine's addresses, such as 127.0.0.1.");
  }
  policy = {address.is_loopback(), options.host_names, options.token};
  if (!address.is_loopback() && options.token.empty()) {
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("Listening on {} would let the whole network command the vehicles.", options.address),
                      "Set a token, or listen on 127.0.0.1.");
  }
  tcp::endpoint const endpoint(address, static_cast<unsigned short>(options.port));
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use) {
    return base::fail(base::ErrorKind::io,
                      fmt::format("Port {} on {} is in use by another program.", options.port, options.address),
                      "Choose another with --port N (0 picks a free one), or end the other program.");
  }
  if (error) {
    return base::fail(base::ErrorKind::io,
                      fmt::format("Cannot listen on {} port {}: {}.", options.address, options.port, error.message()),
                      "Choose another with --port N.");
  }
  asio::co_spawn(io, accept_connections(), asio::detached);
  return {};
}

void HttpServer::Core::close() {
  closed = true;
  router = {};
  events = {};
  error_code ignored;
  acceptor.close(ignored);
  for (auto const& timer : timers) timer->cancel(ignored);
  // The work uses what ends with the server's owner; the connection itself may wake later.
  for (auto const& one : pending) {
    one->work = {};
    one->ended.cancel(ignored);
  }
  for (auto const& [guest, connection] : connections) connection->transport().close();
}

Reply HttpServer::Core::answer(HttpRequest const& request) const {
  bool const is_api = request.path.starts_with("/api/");
  if (is_api || router.knows(request)) return router.answer(request);
  if (request.method != "GET" && request.method != "HEAD") {
    auto response = problem(405, fmt::format("{} does not work on files.", request.method));
    response.headers.push_back({"Allow", "GET, HEAD"});
    return response;
  }
  return static_file(options.static_root, request);
}

/// Waits for the work to end, if it is any. When the server closes meanwhile, what it gives goes nowhere.
asio::awaitable<HttpResponse> HttpServer::Core::finish(std::shared_ptr<Reply> reply) {
  auto const self = shared_from_this();
  if (auto* const response = std::get_if<HttpResponse>(reply.get())) co_return std::move(*response);
  auto const waiting =
      std::make_shared<internal::PendingAnswer>(io, std::get<base::Task<HttpResponse>>(std::move(*reply)));
  pending.insert(waiting);
  waiting->work.on_end(internal::PendingAnswer::wake, waiting.get());
  waiting->work.start();
  error_code ignored;
  if (!waiting->work.done()) co_await waiting->ended.async_wait(redirect_error(use_awaitable, ignored));
  pending.erase(waiting);
  if (closed) co_return HttpResponse{};
  co_return waiting->work.take();
}

asio::awaitable<void> HttpServer::Core::accept_connections() {
  auto const self = shared_from_this();
  while (!closed) {
    error_code error;
    auto socket = co_await acceptor.async_accept(redirect_error(use_awaitable, error));
    if (closed) co_return;
    if (error) {
      // Out of file descriptors, or the peer went away: the former mends itself when connections end.
      asio::steady_timer pause(io, std::chrono::milliseconds(100));
      co_await pause.async_wait(redirect_error(use_awaitable, error));
      continue;
    }
    auto const peer = socket.remote_endpoint(error);
    auto const entrance = places.enter(error ? std::string() : network_of(peer.address()));
    if (entrance.must_leave)
      if (auto const found = connections.find(*entrance.must_leave); found != connections.end())
        found->second->transport().close();
    if (!entrance.guest) continue;  // closes the socket
    socket.set_option(tcp::no_delay(true), error);
    auto connection = std::make_shared<Connection>(std::move(socket), *entrance.guest);
    connections.emplace(*entrance.guest, connection);
    asio::co_spawn(io, serve(connection), asio::detached);
  }
}

asio::awaitable<void> HttpServer::Core::serve(std::shared_ptr<Connection> connection) {
  auto const self = shared_from_this();
  beast::flat_buffer buffer;
  while (!closed && co_await serve_request(connection, buffer)) {
  }
  connection->transport().close();
  places.leave(connection->guest);
  connections.erase(connection->guest);
}

/// Who asks and for what, of which the header tells; who may not ask is told so before the body of what he asks is
/// read.
Received HttpServer::Core::judge(Connection& connection, Parser const& parser) {
  Received received;
  auto& asked = received.asked;
  auto& answer = received.answer;
  asked = internal::plain(parser.get());
  if (!asked) {
    answer = problem(400, "The request's target is badly encoded.");
    return received;
  }
  asked->opens_websocket = websocket::is_upgrade(parser.get()) && asked->path == options.websocket_path;
  answer = refusal(policy, *asked);
  if (answer) return received;
  if (is_trusted(policy, *asked)) {
    connection.is_known = true;
    places.set(connection.guest, internal::Places::Standing::served);
  }
  if (asked->opens_websocket) answer = refuse_session();
  return received;
}

asio::awaitable<error_code> HttpServer::Core::read_body(std::shared_ptr<Connection> connection,
                                                        beast::flat_buffer& buffer, Parser& parser,
                                                        Received& received) {
  auto& answer = received.answer;
  auto& transport = connection->transport();
  transport.expires_after(options.request_timeout);
  auto const longest = answer ? 0 : router.max_body_bytes(*received.asked).value_or(options.max_body_bytes);
  if (!answer && parser.content_length().value_or(0) > longest) answer = problem(413, "The body is too long.");
  parser.body_limit(longest);
  error_code error;
  if (!answer && !parser.is_done())
    co_await http::async_read(transport, buffer, parser, redirect_error(use_awaitable, error));
  co_return error;
}

/// Waits for the first bytes of a request. Who sends less than a request's head has had his turn, and gives way to who
/// has not.
asio::awaitable<error_code> HttpServer::Core::hear(std::shared_ptr<Connection> connection, beast::flat_buffer& buffer) {
  error_code error;
  if (connection->is_known || buffer.size() > 0) co_return error;
  auto const room = buffer.prepare(4096);
  auto const came = co_await connection->transport().async_read_some(room, redirect_error(use_awaitable, error));
  buffer.commit(came);
  std::string_view const said(static_cast<char const*>(buffer.cdata().data()), buffer.size());
  if (!said.contains("\r\n\r\n")) places.set(connection->guest, internal::Places::Standing::stranger);
  co_return error;
}

/// One request and its answer; true when another may follow on the same connection.
asio::awaitable<bool> HttpServer::Core::serve_request(std::shared_ptr<Connection> connection,
                                                      beast::flat_buffer& buffer) {
  auto& transport = connection->transport();
  Parser parser;
  parser.header_limit(static_cast<std::uint32_t>(options.max_header_bytes));
  parser.body_limit(std::max(options.max_body_bytes, router.largest_body_bytes()));
  transport.expires_after(connection->is_known ? options.request_timeout : options.first_request_timeout);
  error_code error = co_await hear(connection, buffer);
  if (!error) co_await http::async_read_header(transport, buffer, parser, redirect_error(use_awaitable, error));
  Received received;
  if (!error) {
    received = judge(*connection, parser);
    if (!received.answer && received.asked->opens_websocket) {
      co_await serve_websocket(connection, parser.release(), *std::move(received.asked));
      co_return false;
    }
    error = co_await read_body(connection, buffer, parser, received);
  }
  if (closed || (error && !internal::is_malformed(error))) co_return false;
  if (error) received.answer = problem(internal::status_of(error), error.message());
  received.is_malformed = error.failed();
  co_return co_await respond(connection, parser, received);
}

/// True when it has gone out and the connection may stay.
asio::awaitable<bool> HttpServer::Core::respond(std::shared_ptr<Connection> connection, Parser& parser,
                                                Received& received) {
  bool const is_whole = parser.is_done();
  bool const keep_alive = is_whole && !received.is_malformed && parser.get().keep_alive();
  bool const is_head = parser.get().method() == http::verb::head;
  if (!received.answer) {
    received.asked->body = std::move(parser.get().body());
    auto const reply = std::make_shared<Reply>(answer(*received.asked));
    received.answer = co_await finish(reply);
    if (closed) co_return false;
  }
  auto& transport = connection->transport();
  auto const message = internal::wire(*std::move(received.answer), is_head, keep_alive);
  transport.expires_after(options.request_timeout);
  error_code error;
  co_await http::async_write(transport, message, redirect_error(use_awaitable, error));
  using enum internal::Places::Standing;
  places.set(connection->guest, connection->is_known ? resting : stranger);
  if (!error && !is_whole) co_await drain(connection);
  co_return !error && keep_alive;
}

/// Takes what was still on its way and throws it away, for a moment: a connection that is closed before is reset, and
/// the client may never read why.
asio::awaitable<void> HttpServer::Core::drain(std::shared_ptr<Connection> connection) {
  constexpr auto moment = std::chrono::seconds(1);
  constexpr std::size_t most = std::size_t{16} * 1024 * 1024;
  auto& transport = connection->transport();
  error_code error;
  transport.socket().shutdown(tcp::socket::shutdown_send, error);
  transport.expires_after(moment);
  std::vector<char> scrap(64 * 1024);
  for (std::size_t taken = 0; !error && taken < most;) {
    auto const more = co_await transport.async_read_some(asio::buffer(scrap), redirect_error(use_awaitable, error));
    taken += more;
  }
}

/// Nothing when there is room for one more, by ending one that nobody misses if need be: that takes nothing of what it
/// is sent, or else that has watched for longest without ever saying a word.
std::optional<HttpResponse> HttpServer::Core::refuse_session() {
  if (sessions.size() < options.max_sessions) return std::nullopt;
  auto const now = std::chrono::steady_clock::now();
  std::shared_ptr<Connection> goes;
  bool is_stalled = false;
  for (auto const& [session, connection] : sessions) {
    bool const stalls = !connection->outbox.empty() && now - connection->took_last > options.stall_timeout;
    if (!stalls && (connection->has_spoken || goes)) continue;
    if (stalls && is_stalled && goes->took_last <= connection->took_last) continue;
    goes = connection;
    is_stalled = is_stalled || stalls;
  }
  if (!goes)
    return problem(503, "Too many viewers are connected.",
                   "Close one; requests over HTTP, an emergency stop among them, are answered all the same.");
  log.warn(fmt::format("{} viewers are connected: one that {} makes room for another", sessions.size(),
                       is_stalled ? "takes nothing of what it is sent" : "never said a word"));
  sessions.erase(goes->session);
  goes->transport().close();
  return std::nullopt;
}

asio::awaitable<void> HttpServer::Core::serve_websocket(std::shared_ptr<Connection> connection,
                                                        http::request<http::string_body> request, HttpRequest asked) {
  auto& stream = connection->stream;
  connection->transport().expires_never();  // from here on the WebSocket's own time-outs and pings count
  auto timeouts = websocket::stream_base::timeout::suggested(beast::role_type::server);
  timeouts.idle_timeout = std::chrono::seconds(30);
  timeouts.keep_alive_pings = true;
  stream.set_option(timeouts);
  internal::keep_kernel_backlog_short(connection->transport().socket());
  stream.set_option(internal::compression_for(options.compression, connection->transport().socket(), asked));
  stream.read_message_max(options.max_body_bytes);
  error_code error;
  co_await stream.async_accept(request, redirect_error(use_awaitable, error));
  if (error || closed) co_return;
  connection->session = SessionId{++last_session};
  sessions.emplace(connection->session, connection);
  if (events.opened) events.opened(connection->session, asked);

  beast::flat_buffer buffer;
  internal::MessagePace pace;
  asio::steady_timer rest(io);
  while (!closed) {
    co_await stream.async_read(buffer, redirect_error(use_awaitable, error));
    if (error || closed) break;
    auto const bytes = buffer.cdata();
    connection->has_spoken = true;
    if (events.received) events.received(connection->session, {static_cast<char const*>(bytes.data()), bytes.size()});
    buffer.consume(buffer.size());
    auto const wait = pace.take(std::chrono::steady_clock::now());
    if (wait == std::chrono::milliseconds(0)) continue;
    rest.expires_after(wait);
    co_await rest.async_wait(redirect_error(use_awaitable, error));
  }
  sessions.erase(connection->session);
  if (events.closed) events.closed(connection->session);
}

void HttpServer::Core::write_next(std::shared_ptr<Connection> const& connection) {
  auto const& message = connection->outbox.front();
  connection->stream.binary(message.is_binary);
  connection->stream.async_write(asio::buffer(*message.content),
                                 [self = shared_from_this(), connection](error_code error, std::size_t) {
                                   if (error || self->closed) return;
                                   connection->outbox.take_out();
                                   connection->took_last = std::chrono::steady_clock::now();
                                   if (!connection->outbox.empty()) return self->write_next(connection);
                                   if (self->events.drained) self->events.drained(connection->session);
                                 });
}

void HttpServer::Core::repeat(std::shared_ptr<asio::steady_timer> const& timer, std::chrono::milliseconds period,
                              std::function<void()> function) {
  timer->expires_after(period);
  timer->async_wait([self = shared_from_this(), timer, period, function = std::move(function)](error_code error) {
    if (error || self->closed) return;
    function();
    self->repeat(timer, period, function);
  });
}

HttpServer::HttpServer(std::shared_ptr<Core> core) : core_(std::move(core)) {}

HttpServer::~HttpServer() {
  core_->close();
}

base::Result<std::unique_ptr<HttpServer>> HttpServer::open(base::Loop& loop, Options options, base::Logger log) {
  auto core = std::make_shared<Core>(loop, std::move(options), std::move(log));
  auto listening = core->listen();
  if (!listening) return std::unexpected(listening.error());
  return std::unique_ptr<HttpServer>(new HttpServer(std::move(core)));
}

int HttpServer::port() const {
  error_code ignored;
  return core_->acceptor.local_endpoint(ignored).port();
}

std::string HttpServer::url() const {
  auto const& address = core_->options.address;
  bool const is_v6 = address.contains(':');
  return is_v6 ? fmt::format("http://[{}]:{}/", address, port()) : fmt::format("http://{}:{}/", address, port());
}

void HttpServer::set_router(Router router) {
  core_->router = std::move(router);
}

void HttpServer::set_websocket(WebSocketEvents events) {
  core_->events = std::move(events);
}

void HttpServer::every(std::chrono::milliseconds period, std::function<void()> function) {
  auto const timer = std::make_shared<asio::steady_timer>(core_->io);
  core_->timers.insert(timer);
  core_->repeat(timer, period, std::move(function));
}

bool HttpServer::send(SessionId session, std::span<Message const> messages) {
  return send(session, messages, {0, core_->options.max_backlog_bytes});
}

bool HttpServer::send(SessionId session, std::span<Message const> messages, Lane lane) {
  auto const found = core_->sessions.find(session);
  if (found == core_->sessions.end()) return false;
  auto const& connection = found->second;
  bool const is_idle = connection->outbox.empty();
  if (!connection->outbox.add(messages, lane)) return false;
  if (!is_idle || connection->outbox.empty()) return true;
  connection->took_last = std::chrono::steady_clock::now();
  core_->write_next(connection);
  return true;
}

std::size_t HttpServer::unsent_bytes(SessionId session, std::size_t lane) const {
  auto const found = core_->sessions.find(session);
  return found == core_->sessions.end() ? 0 : found->second->outbox.unsent_bytes(lane);
}

}  // namespace lapwing::station
