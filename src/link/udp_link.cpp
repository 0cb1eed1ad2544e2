#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <linux/sock_diag.h>

#include <array>
#include <cstring>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "link/internal/datagrams.hpp"
#include "link/internal/links.hpp"

namespace lapwing::link::internal {

namespace {

using namespace std::chrono_literals;
using boost::asio::ip::udp;
using Error = boost::system::error_code;

/// Room for a burst of parameters, or for a tenth of a second of a busy router in which the program does not listen. In
/// more, telemetry would grow old before it is lost.
int constexpr buffer_size = 4 * 1024 * 1024;

base::Duration constexpr lookup_period = 1s;

udp::endpoint endpoint_of(Peer peer) {
  return {boost::asio::ip::address_v4(static_cast<std::uint32_t>(peer.key >> 16U)),
          static_cast<std::uint16_t>(peer.key & 0xFFFFU)};
}

Peer peer_at(udp::endpoint const& endpoint) {
  return {static_cast<std::uint64_t>(endpoint.address().to_v4().to_uint()) << 16U | endpoint.port()};
}

/// "in" is bound and answers whoever speaks. "out" is connected to one address and hears that alone, as ArduPilot's
/// udpclient does. "bcast" calls to everybody until one answers, then speaks to that one, as pymavlink does. Each sends
/// from the socket on which it listens. Far ends are looked up until one is found and there is a way to it: a companion
/// computer may come after the station, and its network after its programs.
class UdpLink final : public ByteLink {
 public:
  UdpLink(base::Loop& loop, udp::socket socket, Url url)
      : loop_(loop),
        socket_(std::move(socket)),
        resolver_(loop.io()),
        url_(std::move(url)),
        is_connected_(url_.transport == Transport::udp_out),
        is_calling_(url_.transport == Transport::udp_bcast),
        answered_(loop),
        scope_(loop) {}

  /// Where it goes to. What is heard on a connected socket is from there alone.
  [[nodiscard]] Error aim(udp::endpoint const& target) {
    Error error;
    if (is_connected_) socket_.connect(target, error);
    if (!error) target_ = peer_at(target);
    last_error_ = error ? fmt::format("{}: {}", peer_name(peer_at(target)), error.message()) : "";
    return error;
  }

  [[nodiscard]] std::string name() const override { return to_string(url_); }
  [[nodiscard]] std::string peer_name(Peer peer) const override {
    auto const endpoint = endpoint_of(peer);
    return fmt::format("{}:{}", endpoint.address().to_string(), endpoint.port());
  }
  [[nodiscard]] LinkState state() const override { return is_aimed() ? LinkState::open : LinkState::opening; }
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
    if (!is_aimed()) scope_.spawn(look_up());
  }

  bool send(Peer peer, Bytes bytes, Urgency urgency) override {
    if (!is_aimed()) {
      ++counters_.send_failures;
      return false;
    }
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
  [[nodiscard]] bool is_aimed() const { return url_.transport == Transport::udp_in || target_; }

  base::Task<> look_up() {
    while (!is_aimed()) {
      bool has_answer = false;
      resolver_.async_resolve(udp::v4(), url_.host, std::to_string(url_.port_or_baud),
                              [this, &has_answer, alive = std::weak_ptr(alive_)](Error error, auto const& found) {
                                if (alive.expired()) return;
                                if (error || found.empty())
                                  last_error_ = fmt::format("cannot find host '{}'", url_.host);
                                else
                                  (void)aim(found.begin()->endpoint());  // it notes what is wrong
                                has_answer = true;
                                answered_.notify_all();
                              });
      while (!has_answer) co_await answered_.wait();
      if (!is_aimed()) co_await loop_.sleep(lookup_period);
    }
  }

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

  base::Loop& loop_;
  udp::socket socket_;
  udp::resolver resolver_;
  Url url_;
  std::optional<Peer> target_;  ///< of "out" and "bcast"
  bool is_connected_;
  bool is_calling_;
  Receive receive_;
  LinkCounters counters_;
  std::string last_error_;
  DatagramReader reader_;
  DatagramWriter writer_;
  base::Notifier answered_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope scope_;
};

/// Where an address stands; a name is to be looked up.
std::optional<udp::endpoint> literal(Url const& url) {
  Error error;
  auto const address = boost::asio::ip::make_address_v4(url.host, error);
  if (error) return std::nullopt;
  return udp::endpoint(address, static_cast<std::uint16_t>(url.port_or_baud));
}

/// A network may come up after this program.
bool may_come_right(Error error) {
  using namespace boost::asio::error;
  return error == network_unreachable || error == host_unreachable || error == network_down;
}

/// One of this machine's own addresses, which has to be known at once.
base::Result<udp::endpoint> own_address(base::Loop& loop, Url const& url) {
  if (auto const address = literal(url)) return *address;
  udp::resolver resolver(loop.io());
  Error error;
  auto const found = resolver.resolve(udp::v4(), url.host, std::to_string(url.port_or_baud), error);
  if (error || found.empty())
    return base::fail(base::ErrorKind::io, fmt::format("link {}: cannot find host '{}'", to_string(url), url.host),
                      "listen on 127.0.0.1 (this machine only) or 0.0.0.0 (every network)");
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
  Error error;
  Url actual = url;
  udp::socket socket(loop.io());
  socket.open(udp::v4(), error);
  if (!error) socket.non_blocking(true, error);
  if (!error && url.transport == Transport::udp_bcast) socket.set_option(udp::socket::broadcast(true), error);
  if (!error && url.transport == Transport::udp_in) {
    auto const address = own_address(loop, url);
    if (!address) return std::unexpected(address.error());
    socket.bind(*address, error);
    Error ignored;
    actual.port_or_baud = socket.local_endpoint(ignored).port();
  }
  if (error) return cannot_bind(url, error.value());
  enlarge_buffers(socket.native_handle());
  auto link = std::make_unique<UdpLink>(loop, std::move(socket), actual);
  if (auto const target = literal(url); target && url.transport != Transport::udp_in) {
    error = link->aim(*target);
    if (error && !may_come_right(error)) return cannot_bind(url, error.value());
  }
  return link;
}

}  // namespace lapwing::link::internal
