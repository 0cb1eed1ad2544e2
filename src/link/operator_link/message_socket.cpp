#include "link/operator_link/message_socket.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

std::unexpected<SocketFailure> failure(SocketError error, std::string message, std::string hint = {}) {
  return std::unexpected(SocketFailure{error, std::move(message), std::move(hint)});
}

std::unexpected<SocketFailure> failure(SocketError error, base::Error const& why) {
  return failure(error, why.message, why.hint);
}

}  // namespace

std::string_view to_string(SocketError error) {
  switch (error) {
    case SocketError::connection_timeout: return "ConnectionTimeout";
    case SocketError::failed_to_send: return "FailedToSend";
    case SocketError::no_messages: return "NoMessagesError";
    case SocketError::queue_full: return "QueueFull";
    case SocketError::cannot_begin: return "CannotBegin";
  }
  return "unknown";
}

MessageSocket::MessageSocket(base::Loop& loop, ServeSettings settings, Times times)
    : loop_(loop), settings_(std::move(settings)), times_(times) {
  // One far end: whoever connects first is the one, and only he comes in.
  std::get<ServeSettings>(settings_).server.most_peers = 1;
}

MessageSocket::MessageSocket(base::Loop& loop, ConnectSettings settings, Times times)
    : loop_(loop), settings_(std::move(settings)), times_(times) {}

MessageSocket::~MessageSocket() = default;

PeerSession* MessageSocket::session() const {
  if (client_) return &client_->session();
  auto const all = server_ ? server_->sessions() : std::vector<PeerSession*>();
  return all.empty() ? nullptr : all.front();
}

SocketResult<> MessageSocket::begin() {
  if (auto const* const to_serve = std::get_if<ServeSettings>(&settings_)) {
    auto opened = serve(loop_, *to_serve, {});
    if (!opened) return failure(SocketError::cannot_begin, opened.error());
    server_ = *std::move(opened);
    return {};
  }
  auto opened = connect(loop_, std::get<ConnectSettings>(settings_), {});
  if (!opened) return failure(SocketError::cannot_begin, opened.error());
  client_ = *std::move(opened);
  return {};
}

base::Task<SocketResult<>> MessageSocket::init() {
  close();
  if (auto const begun = begin(); !begun) co_return begun;
  auto const client = client_;
  auto const server = server_;
  auto& changed = client ? client->session().changed() : server->changed();
  auto const deadline = loop_.now() + times_.connect;
  while (!is_connected() && loop_.now() < deadline) {
    co_await changed.wait_until(deadline);
    if (client != client_ || server != server_)
      co_return failure(SocketError::connection_timeout, "the socket was closed meanwhile");
  }
  if (is_connected()) co_return SocketResult<>();
  auto const why = client_ ? client_->last_error() : std::string("nobody has connected");
  auto const where = client_ ? client_->name() : server_->name();
  close();
  co_return failure(SocketError::connection_timeout,
                    fmt::format("no connection on {} within {:.1f} s: {}", where, base::to_seconds(times_.connect),
                                why.empty() ? "no answer" : why),
                    "Look whether the program at the far end runs, and at address, port and token.");
}

base::Task<SocketResult<>> MessageSocket::send_message_sync(std::string text) {
  if (session() == nullptr)
    co_return failure(SocketError::failed_to_send, "nobody has ever connected",
                      "Call init first, and see what it says.");
  auto const client = client_;
  auto const server = server_;
  auto delivery = session()->deliver({.kind = Kind::durable, .text = std::move(text)}, times_.send);
  auto const delivered = co_await delivery;
  if (!delivered) co_return failure(SocketError::failed_to_send, delivered.error());
  co_return SocketResult<>();
}

SocketResult<> MessageSocket::send_message_async(std::string text) {
  if (session() == nullptr)
    return failure(SocketError::queue_full, "nobody has ever connected, so nothing can wait for him",
                   "Call init first.");
  auto const sent = session()->send({.kind = Kind::durable, .text = std::move(text)});
  if (!sent) return failure(SocketError::queue_full, sent.error());
  return {};
}

SocketResult<std::string> MessageSocket::get_message() {
  auto message = session() != nullptr ? session()->take() : std::nullopt;
  if (!message) return failure(SocketError::no_messages, "no message has come", "Ask again later.");
  return std::move(message->text);
}

bool MessageSocket::is_connected() const {
  return session() != nullptr && session()->is_connected();
}

void MessageSocket::close() {
  if (client_) client_->close();
  if (server_) server_->close();
  client_.reset();
  server_.reset();
}

}  // namespace lapwing::link::operator_link
