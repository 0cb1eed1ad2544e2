#include "link/url.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include <fmt/format.h>

namespace lapwing::link {

namespace {

struct Scheme {
  Transport transport;
  std::string_view name;
  std::string_view example;
};
auto constexpr schemes = std::to_array<Scheme>({
    {Transport::udp_in, "udpin", "udpin://0.0.0.0:14550"},
    {Transport::udp_out, "udpout", "udpout://127.0.0.1:14550"},
    {Transport::udp_bcast, "udpbcast", "udpbcast://192.168.1.255:14550"},
    {Transport::tcp_in, "tcpin", "tcpin://0.0.0.0:5760"},
    {Transport::tcp_out, "tcpout", "tcpout://127.0.0.1:5760"},
    {Transport::serial, "serial", "serial:///dev/ttyUSB0:57600"},
});

Scheme const& scheme_of(Transport transport) {
  for (auto const& scheme : schemes)
    if (scheme.transport == transport) return scheme;
  return schemes.front();
}

std::unexpected<base::Error> wrong(std::string_view text, std::string_view what, std::string_view example) {
  return base::fail(base::ErrorKind::invalid_input, fmt::format("link '{}': {}", text, what),
                    fmt::format("write it like {}", example));
}

constexpr std::string_view usual_baud = "57600";  ///< of telemetry radios, and what pymavlink and MAVSDK take

/// What other tools write, in our words; anything else as it is. pymavlink and MAVProxy: `udp:0.0.0.0:14550`,
/// `tcp:127.0.0.1:5760`, `/dev/ttyACM0,115200`; MAVSDK: `udp://:14540`, `tcp://127.0.0.1:5760`.
std::string in_our_words(std::string_view text) {
  if (text.starts_with("/dev/")) {
    auto const comma = text.find(',');
    bool const has_baud = comma != std::string_view::npos;
    return fmt::format("serial://{}:{}", text.substr(0, comma), has_baud ? text.substr(comma + 1) : usual_baud);
  }
  auto const colon = text.find(':');
  if (colon == std::string_view::npos) return std::string(text);
  auto const kind = text.substr(0, colon);
  auto const rest = text.substr(colon + 1);
  bool const has_slashes = rest.starts_with("//");
  auto const place = has_slashes ? rest.substr(2) : rest;
  if (kind == "tcp") return fmt::format("tcpout://{}", place);
  if (kind == "udp" && !has_slashes) return fmt::format("udpin://{}", place);
  if (kind == "udp" && place.starts_with(':')) return fmt::format("udpin://0.0.0.0{}", place);
  bool const is_ours = std::ranges::find(schemes, kind, &Scheme::name) != schemes.end();
  return is_ours && !has_slashes ? fmt::format("{}://{}", kind, place) : std::string(text);
}

/// What people mean who write something else.
std::string_view meant_by(std::string_view scheme) {
  if (scheme == "udp") return "udpin://0.0.0.0:14550 to listen or udpout://127.0.0.1:14550 to send";
  return "udpin://0.0.0.0:14550, udpout://, udpbcast://, tcpin://, tcpout:// or serial:///dev/ttyUSB0:57600";
}

constexpr std::string_view flow_on = "?flow=on";

std::optional<std::uint32_t> number(std::string_view digits) {
  std::uint32_t value = 0;
  auto const* const end = digits.data() + digits.size();
  auto const [stopped, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc{} || stopped != end || digits.empty()) return std::nullopt;
  return value;
}

}  // namespace

std::string_view to_string(Transport transport) {
  return scheme_of(transport).name;
}

std::string to_string(Url const& url) {
  return fmt::format("{}://{}:{}{}", to_string(url.transport), url.host, url.port_or_baud,
                     url.flow_control ? flow_on : "");
}

base::Result<Url> parse_url(std::string_view written) {
  auto const ours = in_our_words(written);
  std::string_view const text = ours;
  auto const slashes = text.find("://");
  auto const name = text.substr(0, slashes);
  Scheme const* scheme = nullptr;
  for (auto const& candidate : schemes)
    if (candidate.name == name) scheme = &candidate;
  if (slashes == std::string_view::npos)
    return wrong(text, "there is no '://' in it", meant_by(text.substr(0, text.find(':'))));
  if (!scheme) return wrong(text, fmt::format("'{}' is no kind of link", name), meant_by(name));

  auto rest = text.substr(slashes + 3);
  bool const flow_control = scheme->transport == Transport::serial && rest.ends_with(flow_on);
  if (flow_control) rest.remove_suffix(flow_on.size());
  auto const colon = rest.rfind(':');
  bool const is_serial = scheme->transport == Transport::serial;
  auto const what = is_serial ? "baud rate" : "port";
  if (colon == std::string_view::npos) return wrong(text, fmt::format("the {} is missing", what), scheme->example);
  auto const host = rest.substr(0, colon);
  if (host.empty()) return wrong(text, is_serial ? "the device is missing" : "the address is missing", scheme->example);
  auto const value = number(rest.substr(colon + 1));
  if (!value) return wrong(text, fmt::format("'{}' is no {}", rest.substr(colon + 1), what), scheme->example);

  // A listening port of 0 means any free one.
  bool const listens = scheme->transport == Transport::udp_in || scheme->transport == Transport::tcp_in;
  if (!is_serial && (*value > 65535 || (*value == 0 && !listens)))
    return wrong(text, "a port is a number from 1 to 65535", scheme->example);
  if (is_serial && *value == 0) return wrong(text, "the baud rate cannot be 0", scheme->example);
  return Url{scheme->transport, std::string(host), *value, flow_control};
}

}  // namespace lapwing::link
