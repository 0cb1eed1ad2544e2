#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "link/operator_link/carrier/tcp.hpp"
#include "link/operator_link/carrier/tls.hpp"
#include "link/operator_link/client.hpp"
#include "link/operator_link/server.hpp"

/// Operator links over TCP, with TLS or without.
namespace lapwing::link::operator_link {

struct ServeSettings {
  std::string address = "127.0.0.1";
  std::uint16_t port = default_port;
  std::optional<TlsServerSettings> tls{};
  Server::Options server{};
};

struct ConnectSettings {
  std::string host = "127.0.0.1";
  std::uint16_t port = default_port;
  std::optional<TlsClientSettings> tls{};
  base::Duration connect_timeout = std::chrono::seconds(5);
  Client::Options client{};
};

/// Error: also invalid_input where the whole network could command the vehicle: beyond loopback a token or a client's
/// certificate is asked for, in JSON mode, which knows no token, a certificate.
[[nodiscard]] base::Result<std::unique_ptr<Server>> serve(base::Loop& loop, ServeSettings settings,
                                                          Server::Events events);
[[nodiscard]] base::Result<std::unique_ptr<Client>> connect(base::Loop& loop, ConnectSettings settings,
                                                            PeerSession::Events events);

}  // namespace lapwing::link::operator_link
