#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::link {

/// What carries the bytes. "in" waits for others on a local address, "out" goes to a remote one, "bcast" to
/// whoever is on a network, until somebody answers.
enum class Transport { udp_in, udp_out, udp_bcast, tcp_in, tcp_out, serial };
[[nodiscard]] std::string_view to_string(Transport transport);

/// Where a link goes, in MAVSDK's spelling: `udpin://0.0.0.0:14550`, `udpout://127.0.0.1:14550`,
/// `udpbcast://192.168.1.255:14550`, `tcpout://host:5760`, `tcpin://0.0.0.0:5760`, `serial:///dev/ttyUSB0:57600` (with
/// RTS/CTS flow control: `...:57600?flow=on`).
struct Url {
  Transport transport = Transport::udp_in;
  std::string host;  ///< host name, IPv4 address, IPv6 address in brackets (TCP) or device path
  std::uint32_t port_or_baud = 0;
  bool flow_control = false;  ///< RTS/CTS, of a serial line

  friend bool operator==(Url const&, Url const&) = default;
};

/// Takes the spellings of pymavlink, MAVProxy (`tcp:127.0.0.1:5760`, `/dev/ttyACM0,115200`) and MAVSDK
/// (`udp://:14540`), too. Error: invalid_input, saying what is wrong and giving a right example.
[[nodiscard]] base::Result<Url> parse_url(std::string_view text);
[[nodiscard]] std::string to_string(Url const& url);

}  // namespace lapwing::link
