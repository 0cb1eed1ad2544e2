#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "link/internal/links.hpp"
#include "link/internal/stream.hpp"

namespace lapwing::link::internal {

namespace {

using namespace std::chrono_literals;
using boost::asio::ip::tcp;
using Error = boost::system::error_code;

base::Duration constexpr retry_period = 1s;
/// Of one server: more than a fleet and its programs, and no more descriptors than a process has.
std::size_t constexpr max_clients = 256;
/// Where no descriptor is left for another client, there is none at once.
base::Duration constexpr accept_again_after = 100ms;

/// A far end that acknowledges nothing for so long is gone, and with it what was sent to it: a radio link that comes
/// back after a minute must not bring the commands of a minute ago.
base::Duration constexpr unacknowledged_for = 5s;
/// With nothing on its way a far end is asked whether it is there: when it was silent for so long, so often, so many
/// times.
base::Duration constexpr asked_after = 5s;
base::Duration constexpr asked_every = 2s;
int constexpr asked_times = 2;

void end_when_silent(int descriptor) {
  auto const set = [descriptor](int level, int option, std::int64_t value) {
    int const number = static_cast<int>(value);
    (void)::setsockopt(descriptor, level, option, &number, sizeof(number));
  };
  using std::chrono::duration_cast;
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, duration_cast<std::chrono::milliseconds>(unacknowledged_for).count());
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, duration_cast<std::chrono::seconds>(asked_after).count());
  set(IPPROTO_TCP, TCP_KEEPINTVL, duration_cast<std::chrono::seconds>(asked_every).count());
  set(IPPROTO_TCP, TCP_KEEPCNT, asked_times);
}

/// The socket's descriptor, ready for a Stream. Small messages must not wait for one another (Nagle).
int release(tcp::socket socket) {
  Error ignored;
  socket.set_option(tcp::no_delay(true), ignored);
  socket.non_blocking(true, ignored);
  end_when_silent(socket.native_handle());
  return socket.release(ignored);
}

/// An IPv6 address stands in brackets in a URL.
std::string bare_host(std::string const& host) {
  bool const is_bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return is_bracketed ? host.substr(1, host.size() - 2) : host;
}

class TcpOut final : public ByteLink {
 public:
  TcpOut(base::Loop& loop, Url url)
      : loop_(loop), url_(std::move(url)), resolver_(loop.io()), changed_(loop), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return to_string(url_); }
  [[nodiscard]] std::string peer_name(Peer) const override {
    return fmt::format("{}:{}", url_.host, url_.port_or_baud);
  }
  [[nodiscard]] LinkState state() const override { return connected_ ? LinkState::open : LinkState::opening; }
  [[nodiscard]] std::string last_error() const override { return connected_ ? std::string() : last_error_; }
  [[nodiscard]] LinkCounters counters() const override { return counters_; }
  [[nodiscard]] std::vector<Peer> standing_peers() const override {
    return connected_ ? std::vector<Peer>{Peer{}} : std::vector<Peer>{};
  }
  void start(Receive receive) override {
    receive_ = std::move(receive);
    scope_.spawn(keep_connected());
  }
  bool send(Peer, Bytes bytes, Urgency urgency) override {
    if (connected_) return stream_->send(bytes, urgency);
    ++counters_.send_failures;
    return false;
  }

 private:
  base::Task<void> keep_connected() {
    for (;;) {
      connecting_ = true;
      begin_to_connect();
      while (connecting_ || connected_) co_await changed_.wait();
      stream_.reset();
      co_await loop_.sleep(retry_period);
    }
  }

  void begin_to_connect() {
    resolver_.async_resolve(
        bare_host(url_.host), std::to_string(url_.port_or_baud),
        [this, alive = std::weak_ptr(alive_)](Error error, tcp::resolver::results_type const& found) {
          if (alive.expired()) return;
          if (error) return failed(fmt::format("cannot find host '{}'", url_.host));
          connect(found);
        });
  }

  void connect(tcp::resolver::results_type const& found) {
    auto socket = std::make_shared<tcp::socket>(loop_.io());  // lives in the handler
    boost::asio::async_connect(*socket, found,
                               [this, socket, alive = std::weak_ptr(alive_)](Error error, tcp::endpoint const&) {
                                 if (alive.expired()) return;
                                 if (error) return failed(error.message());
                                 adopt(release(std::move(*socket)));
                               });
  }

  void adopt(int descriptor) {
    stream_ = std::make_unique<Stream>(
        loop_, Stream::End{descriptor}, counters_,
        [this](Bytes bytes) {
          receive_(Peer{}, bytes);
          tell_drained();
        },
        [this](std::string why) { failed(std::move(why)); });
    connecting_ = false;
    connected_ = true;
    changed_.notify_all();
  }

  void failed(std::string why) {
    last_error_ = std::move(why);
    connecting_ = connected_ = false;
    changed_.notify_all();
  }

  base::Loop& loop_;
  Url url_;
  tcp::resolver resolver_;
  Receive receive_;
  LinkCounters counters_;
  std::unique_ptr<Stream> stream_;
  bool connecting_ = false;
  bool connected_ = false;
  std::string last_error_;
  base::Notifier changed_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope scope_;
};

class TcpIn final : public ByteLink {
 public:
  TcpIn(base::Loop& loop, tcp::acceptor acceptor, std::string name)
      : loop_(loop), acceptor_(std::move(acceptor)), name_(std::move(name)), scope_(loop) {}

  [[nodiscard]] std::string name() const override { return name_; }
  [[nodiscard]] std::string peer_name(Peer peer) const override {
    auto const found = clients_.find(peer);
    return found == clients_.end() ? fmt::format("client {}", peer.key) : found->second.name;
  }
  [[nodiscard]] LinkState state() const override { return LinkState::open; }
  [[nodiscard]] std::string last_error() const override { return last_error_; }
  [[nodiscard]] LinkCounters counters() const override { return counters_; }
  [[nodiscard]] std::vector<Peer> standing_peers() const override {
    std::vector<Peer> peers;
    for (auto const& [peer, client] : clients_) peers.push_back(peer);
    return peers;
  }
  void start(Receive receive) override {
    receive_ = std::move(receive);
    accept();
  }
  bool send(Peer peer, Bytes bytes, Urgency urgency) override {
    auto const found = clients_.find(peer);
    if (found != clients_.end()) return found->second.stream->send(bytes, urgency);
    ++counters_.send_failures;
    return false;
  }

 private:
  struct Client {
    std::string name;
    std::unique_ptr<Stream> stream;
    base::TimePoint heard;
  };

  void accept() {
    acceptor_.async_accept([this, alive = std::weak_ptr(alive_)](Error error, tcp::socket socket) {
      if (alive.expired() || error == boost::asio::error::operation_aborted) return;
      last_error_ = error ? fmt::format("cannot take a client: {}", error.message()) : "";
      if (error) return scope_.spawn(accept_later());
      adopt(std::move(socket));
      accept();
    });
  }

  base::Task<> accept_later() {
    co_await loop_.sleep(accept_again_after);
    accept();
  }

  void adopt(tcp::socket socket) {
    if (clients_.size() >= max_clients) make_room();
    Peer const peer{next_key_++};
    Error ignored;
    auto const far_end = socket.remote_endpoint(ignored);
    auto stream = std::make_unique<Stream>(
        loop_, Stream::End{release(std::move(socket))}, counters_,
        [this, peer](Bytes bytes) {
          clients_.find(peer)->second.heard = loop_.now();
          receive_(peer, bytes);
          tell_drained();
        },
        [this, peer](std::string const&) { forget_later(peer); });
    clients_[peer] = {fmt::format("{}:{}", far_end.address().to_string(), far_end.port()), std::move(stream),
                      loop_.now()};
  }

  /// For one who wants to speak, the one that was silent for longest goes.
  void make_room() {
    clients_.erase(std::ranges::min_element(clients_, {}, [](auto const& entry) { return entry.second.heard; }));
  }

  void forget_later(Peer peer) {
    loop_.post([this, peer, alive = std::weak_ptr(alive_)] {
      if (!alive.expired()) clients_.erase(peer);
    });
  }

  base::Loop& loop_;
  tcp::acceptor acceptor_;
  std::string name_;
  Receive receive_;
  LinkCounters counters_;
  std::map<Peer, Client> clients_;
  std::uint64_t next_key_ = 1;
  std::string last_error_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope scope_;
};

}  // namespace

std::unique_ptr<ByteLink> open_tcp_out(base::Loop& loop, Url const& url) {
  return std::make_unique<TcpOut>(loop, url);
}

base::Result<std::unique_ptr<ByteLink>> open_tcp_in(base::Loop& loop, Url const& url) {
  Error error;
  auto const address = boost::asio::ip::make_address(bare_host(url.host), error);
  if (error)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("link {}: '{}' is no address", to_string(url), url.host),
                      "listen on 127.0.0.1 (this machine only), 0.0.0.0 (every network) or [::] (IPv6, too)");
  tcp::endpoint const endpoint(address, static_cast<std::uint16_t>(url.port_or_baud));
  tcp::acceptor acceptor(loop.io());
  acceptor.open(endpoint.protocol(), error);
  // Connections of an earlier run that linger must not keep the port; a program that listens there still does.
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(tcp::acceptor::max_listen_connections, error);
  if (error) return cannot_bind(url, error.value());
  Url actual = url;
  actual.port_or_baud = acceptor.local_endpoint(error).port();
  return std::make_unique<TcpIn>(loop, std::move(acceptor), to_string(actual));
}

}  // namespace lapwing::link::internal
