#pragma once

#include <cstdint>
#include <stdexcept>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace lapwing::bus::testing {

/// A domain that no other test has while this process lives, whichever it is. It is held by a port that its own
/// participants reach last of all (DDSI-RTPS 9.6.1.1: 7400 + 250 * domain + ...); tests/support/harness.py does the
/// same, and gives no port below those of domain 50 to anybody else.
inline std::uint32_t own_domain() {
  static std::uint32_t const mine = [] {
    constexpr std::uint32_t domains = 50, first_port = 7400, ports_each = 250;
    auto const begin = static_cast<std::uint32_t>(::getpid());
    int const held = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    for (std::uint32_t i = 0; i < domains; ++i) {
      std::uint32_t const domain = 1 + (begin + i) % domains;
      sockaddr_in place{};
      place.sin_family = AF_INET;
      place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      place.sin_port = htons(static_cast<std::uint16_t>(first_port + ports_each * domain + ports_each - 1));
      // The socket is left open: the system closes it with the process.
      if (::bind(held, reinterpret_cast<sockaddr const*>(&place), sizeof place) == 0) return domain;
    }
    throw std::runtime_error("all domains for tests are taken");
  }();
  return mine;
}

}  // namespace lapwing::bus::testing
