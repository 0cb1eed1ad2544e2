#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "link/operator_link/carrier/tcp.hpp"

#include <netinet/tcp.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include <fmt/format.h>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"

namespace lapwing::link::operator_link {

namespace {

using namespace std::chrono_literals;
using boost::asio::ip::tcp;
using boost::asio::posix::stream_descriptor;
using Error = boost::system::error_code;

/// What may wait in the kernel (which takes twice that): a command waits behind it.
constexpr int socket_buffer = 64 * 1024;
/// Where no descriptor is left for another connection, there is none at once.
constexpr base::Duration accept_again_after = 100ms;
/// A far end that acknowledges nothing for so long is gone. With frames pings find that out; old parts have none.
constexpr int unacknowledged_ms = 3000;
constexpr int asked_after_s = 1;
constexpr int asked_every_s = 1;
constexpr int asked_times = 2;

void prepare(int descriptor) {
  auto const set = [descriptor](int level, int option, int value) {
    (void)::setsockopt(descriptor, level, option, &value, sizeof(value));
  };
  set(IPPROTO_TCP, TCP_NODELAY, 1);
  set(SOL_SOCKET, SO_SNDBUF, socket_buffer);
  set(IPPROTO_TCP, TCP_USER_TIMEOUT, unacknowledged_ms);
  set(SOL_SOCKET, SO_KEEPALIVE, 1);
  set(IPPROTO_TCP, TCP_KEEPIDLE, asked_after_s);
  set(IPPROTO_TCP, TCP_KEEPINTVL, asked_every_s);
  set(IPPROTO_TCP, TCP_KEEPCNT, asked_times);
}

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

/// An IPv6 address may stand in brackets.
std::string bare(std::string const& host) {
  bool const is_bracketed = host.size() > 2 && host.front() == '[' && host.back() == ']';
  return is_bracketed ? host.substr(1, host.size() - 2) : host;
}

class TcpStream final : public ByteStream {
 public:
  TcpStream(base::Loop& loop, tcp::socket socket, std::string peer)
      : loop_(loop), peer_(std::move(peer)), handle_(loop.io()) {
    Error ignored;
    socket.non_blocking(true, ignored);
    prepare(socket.native_handle());
    handle_.assign(socket.release(ignored), ignored);
  }

  [[nodiscard]] std::string peer_name() const override { return peer_; }
  void start(Events events) override {
    events_ = std::move(events);
    is_started_ = true;
    wait_to_read();
  }
  void write(Bytes bytes) override {
    if (!handle_.is_open()) return;
    waiting_.insert(waiting_.end(), bytes.begin(), bytes.end());
    if (!is_writing_) send_waiting();
  }
  [[nodiscard]] std::size_t backlog() const override { return waiting_.size() - sent_; }
  void pause(bool is_paused) override {
    is_paused_ = is_paused;
    if (is_started_) wait_to_read();
  }
  void close() override {
    events_ = {};
    Error ignored;
    handle_.close(ignored);
  }

 private:
  void wait_to_read() {
    if (is_paused_ || is_reading_ || !handle_.is_open()) return;
    is_reading_ = true;
    handle_.async_wait(stream_descriptor::wait_read, [this, alive = std::weak_ptr(alive_)](Error error) {
      if (alive.expired() || error) return;
      is_reading_ = false;
      read();
    });
  }

  void read() {
    if (is_paused_ || !handle_.is_open()) return;
    std::array<std::uint8_t, 64 * 1024> buffer;
    auto const got = ::read(handle_.native_handle(), buffer.data(), buffer.size());
    if (got < 0 && !would_block(errno)) return end_later(std::strerror(errno));
    if (got == 0) return end_later("closed by the far end");
    if (got > 0 && events_.data) {
      auto const alive = std::weak_ptr(alive_);
      auto const data = events_.data;
      data({buffer.data(), static_cast<std::size_t>(got)});
      if (alive.expired()) return;
    }
    wait_to_read();
  }

  void send_waiting() {
    while (sent_ < waiting_.size()) {
      auto const sent = ::send(handle_.native_handle(), waiting_.data() + sent_, waiting_.size() - sent_, MSG_NOSIGNAL);
      if (sent < 0 && would_block(errno)) return wait_to_write();
      if (sent < 0) return end_later(std::strerror(errno));
      sent_ += static_cast<std::size_t>(sent);
    }
    waiting_.clear();
    sent_ = 0;
  }

  void wait_to_write() {
    is_writing_ = true;
    handle_.async_wait(stream_descriptor::wait_write, [this, alive = std::weak_ptr(alive_)](Error error) {
      if (alive.expired() || error) return;
      is_writing_ = false;
      send_waiting();
      auto const drained = events_.drained;
      if (waiting_.empty() && handle_.is_open() && drained) drained();
    });
  }

  /// Whoever writes or reads may be on the stack.
  void end_later(std::string why) {
    Error ignored;
    handle_.close(ignored);
    loop_.post([this, why = std::move(why), alive = std::weak_ptr(alive_)] {
      if (alive.expired() || !events_.ended) return;
      auto const ended = std::exchange(events_, {}).ended;
      ended(why);
    });
  }

  base::Loop& loop_;
  std::string peer_;
  stream_descriptor handle_;
  Events events_;
  std::vector<std::uint8_t> waiting_;
  std::size_t sent_ = 0;  ///< of it
  bool is_started_ = false;
  bool is_reading_ = false;
  bool is_writing_ = false;
  bool is_paused_ = false;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  // handlers outlive the stream and look at it weakly
};

std::string peer_of(tcp::socket const& socket) {
  Error error;
  auto const end = socket.remote_endpoint(error);
  return error ? std::string("nobody") : fmt::format("{}:{}", end.address().to_string(), end.port());
}

class TcpListener final : public Listener {
 public:
  TcpListener(base::Loop& loop, tcp::acceptor acceptor) : loop_(loop), acceptor_(std::move(acceptor)), scope_(loop) {}

  [[nodiscard]] std::string name() const override {
    Error error;
    auto const end = acceptor_.local_endpoint(error);
    return fmt::format("{}:{}", end.address().to_string(), end.port());
  }
  [[nodiscard]] std::uint16_t port() const override {
    Error error;
    return acceptor_.local_endpoint(error).port();
  }
  void start(Accept accept) override {
    accept_ = std::move(accept);
    wait();
  }

 private:
  void wait() {
    acceptor_.async_accept([this, alive = std::weak_ptr(alive_)](Error error, tcp::socket socket) {
      if (alive.expired() || error == boost::asio::error::operation_aborted) return;
      if (error) return scope_.spawn(wait_later());
      auto peer = peer_of(socket);
      accept_(std::make_unique<TcpStream>(loop_, std::move(socket), std::move(peer)));
      wait();
    });
  }
  base::Task<> wait_later() {
    co_await loop_.sleep(accept_again_after);
    wait();
  }

  base::Loop& loop_;
  tcp::acceptor acceptor_;
  Accept accept_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);
  base::Scope scope_;
};

/// One attempt to connect. Handlers hold it: they may come after whoever wanted the connection has gone.
struct Attempt {
  explicit Attempt(base::Loop& loop) : resolver(loop.io()), socket(loop.io()), ended(loop) {}
  tcp::resolver resolver;
  tcp::socket socket;
  base::Notifier ended;
  bool is_over = false;  ///< with an answer, or given up
  Error error;

  void finish(Error result) {
    if (std::exchange(is_over, true)) return;
    error = result;
    ended.notify_all();
  }
};

class TcpDialler final : public Dialler {
 public:
  TcpDialler(base::Loop& loop, std::string host, std::uint16_t port, base::Duration timeout)
      : loop_(loop), host_(std::move(host)), port_(port), timeout_(timeout) {}

  [[nodiscard]] std::string name() const override { return fmt::format("{}:{}", host_, port_); }

  [[nodiscard]] base::Task<base::Result<std::unique_ptr<ByteStream>>> dial() override {
    auto const attempt = std::make_shared<Attempt>(loop_);
    struct GiveUp {
      Attempt& attempt;
      ~GiveUp() {
        attempt.is_over = true;
        Error ignored;
        attempt.resolver.cancel();
        attempt.socket.close(ignored);
      }
    } const give_up{*attempt};
    begin(attempt);
    auto const deadline = loop_.now() + timeout_;
    while (!attempt->is_over && loop_.now() < deadline) co_await attempt->ended.wait_until(deadline);
    if (!attempt->is_over)
      co_return base::fail(base::ErrorKind::timed_out, fmt::format("{} does not answer", name()),
                           "Look whether the far end runs and the network reaches it.");
    if (attempt->error)
      co_return base::fail(base::ErrorKind::lost,
                           fmt::format("cannot connect to {}: {}", name(), attempt->error.message()),
                           "Look whether the far end runs, and at the port.");
    co_return std::make_unique<TcpStream>(loop_, std::move(attempt->socket), name());
  }

 private:
  void begin(std::shared_ptr<Attempt> const& attempt) const {
    attempt->resolver.async_resolve(
        bare(host_), std::to_string(port_), [attempt](Error error, tcp::resolver::results_type const& found) {
          if (error || attempt->is_over) return attempt->finish(error);
          boost::asio::async_connect(attempt->socket, found,
                                     [attempt](Error result, tcp::endpoint const&) { attempt->finish(result); });
        });
  }

  base::Loop& loop_;
  std::string host_;
  std::uint16_t port_;
  base::Duration timeout_;
};

}  // namespace

base::Result<std::unique_ptr<Listener>> listen_tcp(base::Loop& loop, std::string const& address, std::uint16_t port) {
  Error error;
  auto const where = boost::asio::ip::make_address(bare(address), error);
  if (error)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("'{}' is no address to listen on", address),
                      "Give one of this machine's: 127.0.0.1 (this machine only), 0.0.0.0 (every network).");
  tcp::endpoint const endpoint(where, port);
  tcp::acceptor acceptor(loop.io());
  acceptor.open(endpoint.protocol(), error);
  // Connections of an earlier run that linger must not keep the port; a program that listens there still does.
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(tcp::acceptor::max_listen_connections, error);
  if (error)
    return base::fail(base::ErrorKind::io, fmt::format("cannot listen on {}:{}: {}", address, port, error.message()),
                      "Choose another port (0: any that is free), or end the program that has it.");
  return std::make_unique<TcpListener>(loop, std::move(acceptor));
}

std::unique_ptr<Dialler> dial_tcp(base::Loop& loop, std::string host, std::uint16_t port, base::Duration timeout) {
  return std::make_unique<TcpDialler>(loop, std::move(host), port, timeout);
}

bool is_loopback(std::string const& address) {
  Error error;
  auto const where = boost::asio::ip::make_address(bare(address), error);
  return !error && where.is_loopback();
}

}  // namespace lapwing::link::operator_link
