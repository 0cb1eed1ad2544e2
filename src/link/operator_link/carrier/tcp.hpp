#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "base/async/loop.hpp"
#include "link/operator_link/carrier/byte_stream.hpp"

namespace lapwing::link::operator_link {

/// The port of operator links.
inline constexpr std::uint16_t default_port = 3000;

/// Waits for TCP connections on an address of this machine; port 0 takes a free one. Error: invalid_input (no address),
/// io (taken, not this machine's).
[[nodiscard]] base::Result<std::unique_ptr<Listener>> listen_tcp(base::Loop& loop, std::string const& address,
                                                                 std::uint16_t port);

/// Connects to a host by name or address; an attempt ends after `timeout`.
[[nodiscard]] std::unique_ptr<Dialler> dial_tcp(base::Loop& loop, std::string host, std::uint16_t port,
                                                base::Duration timeout);

/// Whether nobody but this machine reaches it: 127.0.0.0/8, ::1.
[[nodiscard]] bool is_loopback(std::string const& address);

}  // namespace lapwing::link::operator_link
