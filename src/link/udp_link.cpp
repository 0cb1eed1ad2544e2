#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <array>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "link/internal/links.hpp"

namespace lapwing::link::internal {

namespace {

using boost::asio::ip::udp;
using Error = boost::system::error_code;

/// Room for a burst of parameters or a moment in which the program does not listen.
int constexpr receive_buffer = 4 * 1024 * 1024;
/// Datagrams taken in one go, before others have their turn.
int constexpr batch = 64;

/// An IPv4 address and port fit into the key, so that no table of peers is needed.
Peer peer_at(udp::endpoint const& endpoint) {
  return {static_cast<std::uint64_t>(endpoint.address().to_v4().to_uint()) << 16U | endpoint.port()};
}

udp::endpoint endpoint_of(Peer peer) {
  return {boost::asio::ip::address_v4(static_cast<std::uint32_t>(peer.key >> 16U)),
          static_cast<std::uint16_t>(peer.key & 0xFFFFU)};
}

std::string text(udp::endpoint const& endpoint) {
  return fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
}

/// Both kinds: "in" is bound and answers whoever speaks; "out" is connected to one address and hears that alone, as
/// ArduPilot's udpclient does. Either sends from the socket on which it listens.
class UdpLink final : public ByteLink {
 public:
  UdpLink(udp::socket socket, std::string name, std::optional<Peer> target)
      : socket_(std::move(socket)), name_(std::move(name)), target_(target) {}

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string peer_name(Peer peer) const override { return text(endpoint_of(peer)); }
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] LinkCounters counters() const override { return counters_; }
  [[nodiscard]] std::vector<Peer> standing_peers() const override {
    return target_ ? std::vector<Peer>{*target_} : std::vector<Peer>{};
  }

  void start(Receive receive) override {
    receive_ = std::move(receive);
    wait();
  }

  bool send(Peer peer, Bytes bytes) override {
    Error error;
    auto const buffer = boost::asio::buffer(bytes.data(), bytes.size());
    send_once(peer, buffer, error);
    // Nobody listened when the last datagram arrived there; that was news about that one, this one has not gone out
    // yet.
    if (error == boost::asio::error::connection_refused) send_once(peer, buffer, error);
    if (error && error != boost::asio::error::connection_refused) {
      ++counters_.send_failures;
      last_error_ = error.message();
      return false;
    }
    last_error_.clear();
    ++counters_.chunks_sent;
    counters_.bytes_sent += bytes.size();
    return true;
  }

 private:
  void send_once(Peer peer, boost::asio::const_buffer buffer, Error& error) {
    error.clear();
    if (target_)
      socket_.send(buffer, 0, error);
    else
      socket_.send_to(buffer, endpoint_of(peer), 0, error);
  }

  void wait() {
    socket_.async_wait(udp::socket::wait_read, [this, alive = std::weak_ptr(alive_)](Error error) {
      if (alive.expired() || error == boost::asio::error::operation_aborted) return;
      drain();
      wait();
    });
  }

  void drain() {
    for (int i = 0; i < batch; ++i) {
      udp::endpoint from;
      Error error;
      auto const size = socket_.receive_from(boost::asio::buffer(buffer_), from, 0, error);
      if (error == boost::asio::error::connection_refused) continue;  // see send
      if (error) return;                                              // nothing more for now
      ++counters_.chunks_received;
      counters_.bytes_received += size;
      receive_(peer_at(from), {buffer_.data(), size});
    }
  }

  udp::socket socket_;
  std::string name_;
  std::optional<Peer> target_;
  Receive receive_;
  LinkCounters counters_;
  std::string last_error_;
  std::array<std::uint8_t, 65536> buffer_;
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

}  // namespace

base::Result<std::unique_ptr<ByteLink>> open_udp(base::Loop& loop, Url const& url) {
  auto const address = resolve(loop, url);
  if (!address) return std::unexpected(address.error());
  bool const out = url.transport == Transport::udp_out;
  Error error;
  udp::socket socket(loop.io());
  socket.open(udp::v4(), error);
  if (!error) socket.non_blocking(true, error);
  if (!error && !out) socket.bind(*address, error);
  if (!error && out) socket.connect(*address, error);
  if (error) return cannot_bind(url, error.value());
  Error ignored;  // the kernel may allow less
  socket.set_option(boost::asio::socket_base::receive_buffer_size(receive_buffer), ignored);

  Url actual = url;
  if (!out) actual.port_or_baud = socket.local_endpoint(ignored).port();
  auto const target = out ? std::optional(peer_at(*address)) : std::nullopt;
  return std::make_unique<UdpLink>(std::move(socket), to_string(actual), target);
}

}  // namespace lapwing::link::internal
