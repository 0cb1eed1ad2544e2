#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <linux/sock_diag.h>

#include <array>
#include <cstring>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "link/internal/datagrams.hpp"
#include "link/internal/links.hpp"

namespace lapwing::link::internal {

namespace {

using boost::asio::ip::udp;
using Error = boost::system::error_code;

/// Room for a burst of parameters, or for a tenth of a second of a busy router in which the program does not listen. In
/// more, telemetry would grow old before it is lost.
int constexpr buffer_size = 4 * 1024 * 1024;

udp::endpoint endpoint_of(Peer peer) {
  return {boost::asio::ip::address_v4(static_cast<std::uint32_t>(peer.key >> 16U)),
          static_cast<std::uint16_t>(peer.key & 0xFFFFU)};
}

Peer peer_at(udp::endpoint const& endpoint) {
  return {static_cast<std::uint64_t>(endpoint.address().to_v4().to_uint()) << 16U | endpoint.port()};
}

/// "in" is bound and answers whoever speaks. "out" is connected to one address and hears that alone, as ArduPilot's
/// udpclient does. "bcast" calls to everybody until one answers, then speaks to that one, as pymavlink does. Each sends
/// from the socket on which it listens.
class UdpLink final : public ByteLink {
 public:
  UdpLink(udp::socket socket, std::string name, Transport transport, std::optional<Peer> target)
      : socket_(std::move(socket)),
        name_(std::move(name)),
        target_(target),
        is_connected_(transport == Transport::udp_out),
        is_calling_(transport == Transport::udp_bcast) {}

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string peer_name(Peer peer) const override {
    auto const endpoint = endpoint_of(peer);
    return fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
  }
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] std::vector<Peer> standing_peers() const override {
    return target_ ? std::vector<Peer>{*target_} : std::vector<Peer>{};
  }

  [[nodiscard]] LinkCounters counters() const override {
    auto counters = counters_;
    std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
    socklen_t size = sizeof(memory);
    if (::getsockopt(descriptor(), SOL_SOCKET, SO_MEMINFO, memory.data(), &size) == 0)
      counters.overruns = memory[SK_MEMINFO_DROPS];
    return counters;
  }

  void start(Receive receive) override {
    receive_ = std::move(receive);
    wait();
  }

  bool send(Peer peer, Bytes bytes, Urgency urgency) override {
    bool const may_wait = urgency == Urgency::batched;
    if (!may_wait || writer_.is_full()) flush();
    writer_.add(peer, bytes);
    return may_wait || write();
  }

  void flush() override {
    if (!writer_.empty()) write();
  }

 private:
  [[nodiscard]] int descriptor() const { return const_cast<udp::socket&>(socket_).native_handle(); }

  bool write() {
    auto const outcome = writer_.write(descriptor(), is_connected_);
    counters_.chunks_sent += outcome.sent;
    counters_.bytes_sent += outcome.bytes;
    counters_.send_failures += outcome.failed;
    last_error_ = outcome.failed > 0 ? std::strerror(outcome.error) : "";
    return outcome.failed == 0;
  }

  void wait() {
    socket_.async_wait(udp::socket::wait_read, [this, alive = std::weak_ptr(alive_)](Error error) {
      if (alive.expired() || error == boost::asio::error::operation_aborted) return;
      drain();
      wait();
    });
  }

  /// A few batches: looking again is cheaper than to be woken again, but others must have their turn.
  void drain() {
    for (int rounds = 4; rounds > 0; --rounds) {
      auto const datagrams = reader_.read(descriptor());
      if (datagrams.empty()) return;
      deliver(datagrams);
    }
  }

  void deliver(std::span<DatagramReader::Datagram const> datagrams) {
    if (std::exchange(is_calling_, false)) target_ = datagrams.front().from;
    for (auto const& [from, bytes] : datagrams) {
      ++counters_.chunks_received;
      counters_.bytes_received += bytes.size();
      receive_(from, bytes);
    }
    tell_drained();
  }

  udp::socket socket_;
  std::string name_;
  std::optional<Peer> target_;
  bool is_connected_;
  bool is_calling_;
  Receive receive_;
  LinkCounters counters_;
  std::string last_error_;
  DatagramReader reader_;
  DatagramWriter writer_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
};

base::Result<udp::endpoint> resolve(base::Loop& loop, Url const& url) {
  udp::resolver resolver(loop.io());
  Error error;
  auto const found = resolver.resolve(udp::v4(), url.host, std::to_string(url.port_or_baud), error);
  if (error || found.empty())
    return base::fail(base::ErrorKind::io, fmt::format("link {}: cannot find host '{}'", to_string(url), url.host),
                      "check the name, or write its IPv4 address");
  return found.begin()->endpoint();
}

/// Beyond the system's limit (rmem_max) where this process may, else up to it.
void enlarge_buffers(int socket) {
  auto const set = [socket](int option) {
    return ::setsockopt(socket, SOL_SOCKET, option, &buffer_size, sizeof(buffer_size)) == 0;
  };
  if (!set(SO_RCVBUFFORCE)) set(SO_RCVBUF);
  if (!set(SO_SNDBUFFORCE)) set(SO_SNDBUF);
}

}  // namespace

base::Result<std::unique_ptr<ByteLink>> open_udp(base::Loop& loop, Url const& url) {
  auto const address = resolve(loop, url);
  if (!address) return std::unexpected(address.error());
  bool const is_in = url.transport == Transport::udp_in;
  Error error;
  udp::socket socket(loop.io());
  socket.open(udp::v4(), error);
  if (!error) socket.non_blocking(true, error);
  if (!error && is_in) socket.bind(*address, error);
  if (!error && url.transport == Transport::udp_bcast) socket.set_option(udp::socket::broadcast(true), error);
  if (!error && url.transport == Transport::udp_out) socket.connect(*address, error);
  if (error) return cannot_bind(url, error.value());
  enlarge_buffers(socket.native_handle());

  Error ignored;
  Url actual = url;
  if (is_in) actual.port_or_baud = socket.local_endpoint(ignored).port();
  auto const target = is_in ? std::nullopt : std::optional(peer_at(*address));
  return std::make_unique<UdpLink>(std::move(socket), to_string(actual), url.transport, target);
}

}  // namespace lapwing::link::internal
