#include "link/internal/datagrams.hpp"

#include <cerrno>

#include "base/assert.hpp"

namespace lapwing::link::internal {

namespace {

/// Room for the largest datagram, and a little, so that not all begin in the same set of the processor's cache.
std::size_t constexpr stride = 65536 + 192;

}  // namespace

Peer peer_at(sockaddr_in const& address) {
  return {static_cast<std::uint64_t>(ntohl(address.sin_addr.s_addr)) << 16U | ntohs(address.sin_port)};
}

sockaddr_in address_of(Peer peer) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(static_cast<std::uint32_t>(peer.key >> 16U));
  address.sin_port = htons(static_cast<std::uint16_t>(peer.key & 0xFFFFU));
  return address;
}

// ---- reading

DatagramReader::DatagramReader() : room_(std::make_unique_for_overwrite<std::uint8_t[]>(datagram_batch * stride)) {
  for (std::size_t i = 0; i < datagram_batch; ++i) {
    pieces_[i] = {room_.get() + i * stride, 65536};
    auto& header = headers_[i].msg_hdr;
    header.msg_name = &senders_[i];
    header.msg_iov = &pieces_[i];
    header.msg_iovlen = 1;
  }
}

std::span<DatagramReader::Datagram const> DatagramReader::read(int socket) {
  for (auto& header : headers_) header.msg_hdr.msg_namelen = sizeof(sockaddr_in);
  int count = 0;
  // Nobody listened where an earlier datagram of ours went: said once, and no reason not to read.
  do {
    count = ::recvmmsg(socket, headers_.data(), datagram_batch, MSG_DONTWAIT, nullptr);
  } while (count < 0 && (errno == ECONNREFUSED || errno == EINTR));
  if (count <= 0) return {};
  auto const got = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < got; ++i) {
    datagrams_[i] = {peer_at(senders_[i]), {room_.get() + i * stride, headers_[i].msg_len}};
  }
  return std::span(datagrams_).first(got);
}

// ---- writing

DatagramWriter::DatagramWriter() {
  room_.reserve(datagram_batch * 280);  // of MAVLink's largest packets; grows where more is sent at once
}

void DatagramWriter::add(Peer to, Bytes bytes) {
  LAPWING_ASSERT(!is_full(), count_);
  receivers_[count_] = address_of(to);
  sizes_[count_] = bytes.size();
  room_.insert(room_.end(), bytes.begin(), bytes.end());
  ++count_;
}

void DatagramWriter::address_all(bool connected) {
  auto* at = room_.data();
  for (std::size_t i = 0; i < count_; ++i) {
    pieces_[i] = {at, sizes_[i]};
    at += sizes_[i];
    auto& header = headers_[i].msg_hdr;
    header.msg_name = connected ? nullptr : &receivers_[i];
    header.msg_namelen = connected ? 0 : sizeof(sockaddr_in);
    header.msg_iov = &pieces_[i];
    header.msg_iovlen = 1;
  }
}

DatagramWriter::Outcome DatagramWriter::write(int socket, bool connected) {
  address_all(connected);
  Outcome outcome;
  bool said_refused = false;
  for (std::size_t done = 0; done < count_;) {
    auto const count = ::sendmmsg(socket, &headers_[done], static_cast<unsigned>(count_ - done), MSG_DONTWAIT);
    if (count > 0) {
      for (auto const end = done + static_cast<std::size_t>(count); done < end; ++done) outcome.bytes += sizes_[done];
      outcome.sent += static_cast<std::size_t>(count);
      said_refused = false;
    } else if (errno == ECONNREFUSED && !said_refused) {
      said_refused = true;  // news about an earlier datagram: this one has not gone out yet
    } else if (errno == ECONNREFUSED) {
      ++outcome.sent;  // and nobody listens; as with any datagram, that is no failure to send
      outcome.bytes += sizes_[done++];
      said_refused = false;
    } else if (errno != EINTR) {
      outcome.error = errno;
      ++outcome.failed;
      ++done;
    }
  }
  count_ = 0;
  room_.clear();
  return outcome;
}

}  // namespace lapwing::link::internal
