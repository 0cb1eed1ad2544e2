#include <array>
#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "station/testing/http_client.hpp"

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <boost/beast/websocket/stream.hpp>

namespace lapwing::station::testing {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using boost::system::error_code;

namespace {

tcp::endpoint server_at(int port) {
  return {asio::ip::address_v4::loopback(), static_cast<unsigned short>(port)};
}

/// Runs the loop until the started operation has called its handler.
struct Waited {
  explicit Waited(base::Loop& on) : loop(on) {}
  auto handler() {
    return [this](error_code result, auto...) {
      error = result;
      done = true;
    };
  }
  bool ok() {
    return run_until(loop, [this] { return done; }) && !error;
  }

  base::Loop& loop;
  error_code error;
  bool done = false;
};

http::request<http::string_body> wire(Ask const& ask, int port) {
  http::request<http::string_body> request;
  request.version(11);
  request.method_string(ask.method);
  request.target(ask.target);
  request.set(http::field::host, ask.host.empty() ? fmt::format("127.0.0.1:{}", port) : ask.host);
  for (auto const& header : ask.headers) request.set(header.name, header.value);
  request.body() = ask.body;
  request.prepare_payload();
  return request;
}

base::Task<void> watch(base::Loop& loop, std::function<bool()> const& condition) {
  // Asio's completions do not wake coroutines of the loop, so look again every millisecond; the deadline only ends a
  // failure.
  auto const deadline = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (!condition() && std::chrono::steady_clock::now() < deadline) co_await loop.sleep(std::chrono::milliseconds(1));
}

}  // namespace

bool run_until(base::Loop& loop, std::function<bool()> condition) {
  loop.run_until_done(watch(loop, condition));
  return condition();
}

std::string Answer::header(std::string_view name) const {
  for (auto const& h : headers) {
    if (equal_ignoring_case(h.name, name)) return h.value;
  }
  return {};
}

Answer ask(base::Loop& loop, int port, Ask request) {
  beast::tcp_stream stream(loop.io());
  Waited connected(loop);
  stream.async_connect(server_at(port), connected.handler());
  if (!connected.ok()) return {};
  auto const message = wire(request, port);
  Waited written(loop);
  http::async_write(stream, message, written.handler());
  if (!written.ok()) return {};
  beast::flat_buffer buffer;
  http::response_parser<http::string_body> parser;
  parser.skip(request.method == "HEAD");
  Waited read(loop);
  http::async_read(stream, buffer, parser, read.handler());
  if (!read.ok()) return {};
  auto response = parser.release();
  Answer answer{static_cast<int>(response.result_int()), {}, response.body()};
  for (auto const& field : response) {
    answer.headers.push_back({std::string(field.name_string()), std::string(field.value())});
  }
  return answer;
}

std::string ask_raw(base::Loop& loop, int port, std::string const& bytes) {
  tcp::socket socket(loop.io());
  Waited connected(loop);
  socket.async_connect(server_at(port), connected.handler());
  if (!connected.ok()) return {};
  Waited written(loop);
  asio::async_write(socket, asio::buffer(bytes), written.handler());
  if (!written.ok()) return {};
  std::string answer;
  Waited read(loop);
  asio::async_read(socket, asio::dynamic_buffer(answer), read.handler());
  (void)read.ok();  // ends with end_of_file
  return answer;
}

struct RawConnection::State : std::enable_shared_from_this<State> {
  explicit State(base::Loop& on) : loop(on), socket(on.io()) {}
  void read() {
    socket.async_read_some(asio::buffer(piece), [self = shared_from_this()](error_code error, std::size_t size) {
      self->received.append(self->piece.data(), size);
      self->is_over = static_cast<bool>(error);
      if (!error) self->read();
    });
  }

  base::Loop& loop;
  tcp::socket socket;
  std::array<char, 4096> piece{};
  std::string received;
  bool is_over = false;
};

RawConnection::RawConnection(std::shared_ptr<State> state) : state_(std::move(state)) {}
RawConnection::~RawConnection() {
  error_code ignored;
  state_->socket.close(ignored);
}

std::unique_ptr<RawConnection> RawConnection::open(base::Loop& loop, int port) {
  auto state = std::make_shared<State>(loop);
  Waited connected(loop);
  state->socket.async_connect(server_at(port), connected.handler());
  if (!connected.ok()) return nullptr;
  state->read();
  return std::unique_ptr<RawConnection>(new RawConnection(std::move(state)));
}

void RawConnection::send(std::string const& bytes) {
  Waited written(state_->loop);
  asio::async_write(state_->socket, asio::buffer(bytes), written.handler());
  (void)written.ok();
}

std::string RawConnection::receive(std::string_view part) {
  (void)run_until(state_->loop, [&] { return state_->is_over || state_->received.contains(part); });
  return state_->received;
}

bool RawConnection::is_over() const {
  return state_->is_over;
}

struct WebSocketClient::State : std::enable_shared_from_this<State> {
  explicit State(base::Loop& on) : loop(on), stream(on.io()) {}
  void read() {
    reading = true;
    stream.async_read(buffer, [self = shared_from_this()](error_code error, std::size_t) {
      self->reading = false;
      if (error) {
        self->ended = true;
        return;
      }
      self->messages.push_back({beast::buffers_to_string(self->buffer.cdata()), self->stream.got_binary()});
      self->buffer.consume(self->buffer.size());
      if (!self->paused) self->read();
    });
  }

  base::Loop& loop;
  websocket::stream<beast::tcp_stream> stream;
  beast::flat_buffer buffer;
  struct Message {
    std::string content;
    bool is_binary = false;
  };
  std::deque<Message> messages;
  bool last_was_binary = false;
  bool reading = false;
  bool paused = false;
  bool ended = false;
};

WebSocketClient::WebSocketClient(std::shared_ptr<State> state) : state_(std::move(state)) {}
WebSocketClient::~WebSocketClient() {
  state_->stream.next_layer().close();
}

std::unique_ptr<WebSocketClient> WebSocketClient::open(base::Loop& loop, int port, Ask request) {
  auto state = std::make_shared<State>(loop);
  Waited connected(loop);
  state->stream.next_layer().async_connect(server_at(port), connected.handler());
  if (!connected.ok()) return nullptr;
  state->stream.set_option(websocket::stream_base::decorator([&request](websocket::request_type& upgrade) {
    for (auto const& header : request.headers) upgrade.set(header.name, header.value);
  }));
  websocket::permessage_deflate compression;
  compression.client_enable = request.offers_compression;
  state->stream.set_option(compression);
  auto const host = request.host.empty() ? fmt::format("127.0.0.1:{}", port) : request.host;
  Waited upgraded(loop);
  state->stream.async_handshake(host, request.target, upgraded.handler());
  if (!upgraded.ok()) return nullptr;
  state->read();
  return std::unique_ptr<WebSocketClient>(new WebSocketClient(std::move(state)));
}

void WebSocketClient::send(std::string text) {
  Waited written(state_->loop);
  state_->stream.async_write(asio::buffer(text), written.handler());
  (void)written.ok();
}

std::optional<std::string> WebSocketClient::receive() {
  auto& messages = state_->messages;
  (void)run_until(state_->loop, [&] { return !messages.empty() || state_->ended; });
  if (messages.empty()) return std::nullopt;
  auto message = std::move(messages.front());
  messages.pop_front();
  state_->last_was_binary = message.is_binary;
  return std::move(message.content);
}

bool WebSocketClient::last_was_binary() const {
  return state_->last_was_binary;
}

void WebSocketClient::pause() {
  state_->paused = true;
}

void WebSocketClient::resume() {
  state_->paused = false;
  if (!state_->reading && !state_->ended) state_->read();
}

}  // namespace lapwing::station::testing
