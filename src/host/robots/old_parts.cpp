#include "host/robots/old_parts.hpp"

#include <fmt/format.h>

#include "link/operator_link/carrier/tcp.hpp"

namespace lapwing::host {

namespace {

std::unexpected<base::Error> refuse(std::string_view text, std::string_view why) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("--old-parts {}: {}", text, why),
                    "write tcpin://127.0.0.1:5771, tcpout://HOST:PORT or serial:///dev/ttyUSB1:115200, and in front of "
                    "it robot2= where it is not robot1");
}

}  // namespace

base::Result<OldParts> parse_old_parts(std::string_view text) {
  OldParts parts;
  auto address = text;
  auto const equals = text.find('=');
  // A link's own settings (`?flow=on`) come behind its ://.
  if (equals != std::string_view::npos && equals < text.find("://")) {
    parts.robot = text.substr(0, equals);
    address = text.substr(equals + 1);
  }
  auto const url = link::parse_url(address);
  if (!url) return refuse(text, url.error().message);
  switch (url->transport) {
    case link::Transport::serial:
    case link::Transport::tcp_out: break;
    case link::Transport::tcp_in:
      if (!link::operator_link::is_loopback(url->host))
        return refuse(text, "the lines have no password, so they are taken on this machine alone");
      break;
    default: return refuse(text, "lines need a stream: TCP or a serial line");
  }
  parts.url = *url;
  return parts;
}

}  // namespace lapwing::host
