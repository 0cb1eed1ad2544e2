#include "link/operator_link/endpoints.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

base::Result<> check_guarded(ServeSettings const& settings) {
  auto const& end = settings.server.end;
  bool const asks_certificate = settings.tls && !settings.tls->client_authority.empty();
  bool const asks_token = !end.token.empty() && end.mode == Mode::framed;
  if (is_loopback(settings.address) || asks_certificate || asks_token) return {};
  return base::fail(
      base::ErrorKind::invalid_input,
      fmt::format("an operator link on {} would let the whole network command the vehicle", settings.address),
      end.mode == Mode::json ? "JSON mode knows no token: ask clients for a certificate, or listen on 127.0.0.1."
                             : "Set a token, ask clients for a certificate, or listen on 127.0.0.1.");
}

}  // namespace

base::Result<std::unique_ptr<Server>> serve(base::Loop& loop, ServeSettings settings, Server::Events events) {
  if (auto const guarded = check_guarded(settings); !guarded) return std::unexpected(guarded.error());
  auto listener = listen_tcp(loop, settings.address, settings.port);
  if (listener && settings.tls)
    listener = secure(loop, *std::move(listener), *settings.tls, settings.server.end.hello_timeout);
  if (!listener) return std::unexpected(listener.error());
  return Server::open(loop, *std::move(listener), std::move(settings.server), std::move(events));
}

base::Result<std::unique_ptr<Client>> connect(base::Loop& loop, ConnectSettings settings, PeerSession::Events events) {
  auto dialler =
      base::Result<std::unique_ptr<Dialler>>(dial_tcp(loop, settings.host, settings.port, settings.connect_timeout));
  if (settings.tls)
    dialler = secure(loop, *std::move(dialler), settings.host, *settings.tls, settings.client.end.hello_timeout);
  if (!dialler) return std::unexpected(dialler.error());
  return Client::open(loop, *std::move(dialler), std::move(settings.client), std::move(events));
}

}  // namespace lapwing::link::operator_link
