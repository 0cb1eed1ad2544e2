#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "base/async/loop.hpp"
#include "link/operator_link/carrier/byte_stream.hpp"

namespace lapwing::link::operator_link {

/// Of a server. Files are PEM.
struct TlsServerSettings {
  std::filesystem::path certificate;  ///< its own, and those between it and the authority
  std::filesystem::path key;
  std::filesystem::path client_authority{};  ///< only clients with a certificate of this authority come in; empty: all
};

struct TlsClientSettings {
  std::filesystem::path authority;      ///< who has signed the server's certificate, or that certificate itself
  std::string host_name{};              ///< what it must be for: a name or an address; empty: the host that is dialled
  std::filesystem::path certificate{};  ///< this end's own, for servers that ask
  std::filesystem::path key{};
};

/// TLS 1.2 or 1.3 over another carrier. Connections are handed on once the handshake is done; who takes longer than
/// `timeout` for it is dropped. Error (invalid_input, io): a file that cannot be read or does not fit.
[[nodiscard]] base::Result<std::unique_ptr<Listener>> secure(base::Loop& loop, std::unique_ptr<Listener> listener,
                                                             TlsServerSettings const& settings, base::Duration timeout);
/// `host` is what the certificate must be for, unless the settings name another.
[[nodiscard]] base::Result<std::unique_ptr<Dialler>> secure(base::Loop& loop, std::unique_ptr<Dialler> dialler,
                                                            std::string const& host, TlsClientSettings const& settings,
                                                            base::Duration timeout);

}  // namespace lapwing::link::operator_link
