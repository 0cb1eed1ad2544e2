#include <cerrno>
#include <cstring>

#include <fmt/format.h>

#include "link/byte_link.hpp"
#include "link/internal/links.hpp"

namespace lapwing::link {

base::Result<std::unique_ptr<ByteLink>> open(base::Loop& loop, Url const& url) {
  switch (url.transport) {
    case Transport::udp_in:
    case Transport::udp_out:
    case Transport::udp_bcast: return internal::open_udp(loop, url);
    case Transport::tcp_in: return internal::open_tcp_in(loop, url);
    case Transport::tcp_out: return internal::open_tcp_out(loop, url);
    case Transport::serial: return internal::open_serial(loop, url);
  }
  return base::fail(base::ErrorKind::invalid_input, "unknown kind of link");
}

std::unexpected<base::Error> internal::cannot_bind(Url const& url, int system_error) {
  auto const text = to_string(url);
  if (system_error == EADDRINUSE) {
    Url other = url;
    other.port_or_baud = url.port_or_baud < 65535 ? url.port_or_baud + 1 : url.port_or_baud - 1;
    return base::fail(base::ErrorKind::io, fmt::format("link {}: port {} is already in use", text, url.port_or_baud),
                      fmt::format("stop the program that uses it (another ground station?), or use another port: {}",
                                  to_string(other)));
  }
  if (system_error == EADDRNOTAVAIL)
    return base::fail(base::ErrorKind::io, fmt::format("link {}: {} is not an address of this machine", text, url.host),
                      "listen on 127.0.0.1 (this machine only) or 0.0.0.0 (every network)");
  if (system_error == EACCES)
    return base::fail(base::ErrorKind::io, fmt::format("link {}: no permission for port {}", text, url.port_or_baud),
                      "use a port above 1023");
  return base::fail(base::ErrorKind::io, fmt::format("link {}: {}", text, std::strerror(system_error)));
}

}  // namespace lapwing::link
