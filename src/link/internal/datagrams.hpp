#pragma once

#include <sys/socket.h>

#include <netinet/in.h>

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "link/byte_link.hpp"

/// UDP datagrams by the dozen: one system call for many (recvmmsg, sendmmsg). IPv4, non-blocking sockets.
namespace lapwing::link::internal {

/// Datagrams of one system call. More would make the first of them wait for the last.
inline constexpr std::size_t datagram_batch = 64;

/// An IPv4 address and port fit into the key, so that no table of peers is needed.
[[nodiscard]] Peer peer_at(sockaddr_in const& address);
[[nodiscard]] sockaddr_in address_of(Peer peer);

class DatagramReader {
 public:
  struct Datagram {
    Peer from;
    Bytes bytes;
  };
  DatagramReader();
  DatagramReader(DatagramReader const&) = delete;
  DatagramReader& operator=(DatagramReader const&) = delete;

  /// What lies ready in `socket`, the oldest first, at most a batch. Valid until the next call.
  [[nodiscard]] std::span<Datagram const> read(int socket);

 private:
  std::unique_ptr<std::uint8_t[]> room_;
  std::array<iovec, datagram_batch> pieces_{};
  std::array<mmsghdr, datagram_batch> headers_{};
  std::array<sockaddr_in, datagram_batch> senders_{};
  std::array<Datagram, datagram_batch> datagrams_{};
};

class DatagramWriter {
 public:
  struct Outcome {
    std::size_t sent = 0;
    std::size_t bytes = 0;   ///< of those
    std::size_t failed = 0;  ///< refused by the operating system
    int error = 0;           ///< errno of the last failure
  };
  DatagramWriter();

  [[nodiscard]] bool is_full() const { return count_ == datagram_batch; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  /// Keeps a copy for `write`. Precondition: not full.
  void add(Peer to, Bytes bytes);
  /// Sends what was added, in order, and forgets it. A `connected` socket knows where to.
  [[nodiscard]] Outcome write(int socket, bool connected);

 private:
  void address_all(bool connected);

  std::size_t count_ = 0;
  std::vector<std::uint8_t> room_;
  std::array<std::size_t, datagram_batch> sizes_{};
  std::array<iovec, datagram_batch> pieces_{};
  std::array<mmsghdr, datagram_batch> headers_{};
  std::array<sockaddr_in, datagram_batch> receivers_{};
};

}  // namespace lapwing::link::internal
