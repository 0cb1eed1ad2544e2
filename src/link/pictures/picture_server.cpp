#include "link/pictures/picture_server.hpp"

#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include <array>
#include <chrono>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>

#include "base/text/constant_time.hpp"

namespace lapwing::link::pictures {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Error = boost::system::error_code;

constexpr std::chrono::seconds request_time{5};
/// A viewer that takes nothing for so long is gone.
constexpr std::chrono::seconds stall_time{10};
constexpr std::uint32_t largest_request = 8192;
/// Little waits in the kernel: what waits there is old when it comes.
constexpr int kernel_bytes = 64 * 1024;
constexpr std::string_view after_picture = "\r\n--picture\r\n";

std::string answer_head() {
  return "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\nCache-Control: no-store\r\n"
         "X-Content-Type-Options: nosniff\r\nCross-Origin-Resource-Policy: same-origin\r\nConnection: close\r\n\r\n"
         "--picture\r\n";
}

std::string refusal(std::string_view status, std::string_view why) {
  return fmt::format("HTTP/1.1 {}\r\nContent-Type: text/plain\r\nContent-Length: {}\r\nConnection: close\r\n\r\n{}",
                     status, why.size(), why);
}

/// The seconds have six places: a double of today's has no more.
std::string part_head(Picture const& picture) {
  auto const us = std::chrono::floor<std::chrono::microseconds>(picture.taken).time_since_epoch().count();
  constexpr std::int64_t us_per_s = 1'000'000;
  return fmt::format("Content-Type: image/jpeg\r\nContent-Length: {}\r\nX-Timestamp: {}.{:06}\r\n\r\n",
                     picture.jpeg->size(), us / us_per_s, us % us_per_s);
}

/// A page of elsewhere whose name was made to point here (DNS rebinding) asks for that name.
bool is_asked_by_address(std::string_view host) {
  if (auto const colon = host.rfind(':'); colon != std::string_view::npos && !host.ends_with(']'))
    host = host.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  Error fault;
  asio::ip::make_address(std::string(host), fault);
  return !fault || host == "localhost";
}

bool carries(std::string_view authorization, std::string_view token) {
  constexpr std::string_view bearer = "Bearer ";
  return authorization.starts_with(bearer) && base::equal_in_constant_time(authorization.substr(bearer.size()), token);
}

std::optional<View> view_at(std::string_view target) {
  for (auto const view : {View::raw, View::annotated})
    if (target == path_of(view)) return view;
  return std::nullopt;
}

}  // namespace

class PictureServer::Core : public std::enable_shared_from_this<Core> {
 public:
  Core(base::Loop& loop, ServeSettings const& settings)
      : io_(loop.io()),
        acceptor_(loop.io()),
        pause_(loop.io()),
        most_viewers_(settings.most_viewers),
        token_(settings.token) {}

  Error listen(tcp::endpoint const& at) {
    Error error;
    acceptor_.open(at.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(at, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    return error;
  }
  [[nodiscard]] std::string_view token() const { return token_; }
  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }
  void accept();
  void close();
  [[nodiscard]] bool is_watched(View view) const;
  void offer(View view, Picture const& picture);

 private:
  class Viewer;
  void forget(Viewer const* viewer) {
    std::erase_if(viewers_, [viewer](auto const& one) { return one.get() == viewer; });
  }

  asio::io_context& io_;
  tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  std::size_t most_viewers_;
  std::string token_;
  std::vector<std::shared_ptr<Viewer>> viewers_;
};

/// One connection: a request, then pictures until either side ends it.
class PictureServer::Core::Viewer : public std::enable_shared_from_this<Viewer> {
 public:
  Viewer(tcp::socket socket, std::weak_ptr<Core> core) : stream_(std::move(socket)), core_(std::move(core)) {
    Error ignored;
    stream_.socket().set_option(tcp::no_delay(true), ignored);
    stream_.socket().set_option(asio::socket_base::send_buffer_size(kernel_bytes), ignored);
  }

  [[nodiscard]] std::optional<View> view() const { return view_; }

  void start(bool is_full) {
    parser_.header_limit(largest_request);
    stream_.expires_after(request_time);
    http::async_read_header(stream_, buffer_, parser_, [self = shared_from_this(), is_full](Error error, std::size_t) {
      if (error) return self->end();
      self->answer(is_full);
    });
  }

  void show(Picture const& picture) {
    waiting_ = picture;
    if (!sending_) send_next();
  }

  void end() {
    Error ignored;
    stream_.socket().close(ignored);
    if (auto const core = core_.lock()) core->forget(this);
  }

 private:
  void answer(bool is_full) {
    auto const& request = parser_.get();
    auto const text = [](beast::string_view view) { return std::string_view(view.data(), view.size()); };
    auto const view = view_at(text(request.target()));
    if (!is_asked_by_address(text(request[http::field::host])))
      return refuse("403 Forbidden", "ask by this machine's address\n");
    auto const core = core_.lock();
    if (!core) return end();
    if (!core->token().empty() && !carries(text(request[http::field::authorization]), core->token()))
      return refuse("401 Unauthorized", "this camera asks for its token\n");
    if (request.method() != http::verb::get) return refuse("405 Method Not Allowed", "pictures are asked for by GET\n");
    if (!view) return refuse("404 Not Found", "there are /raw.mjpg and /annotated.mjpg\n");
    if (is_full) return refuse("503 Service Unavailable", "as many look at the camera as it allows\n");
    head_ = answer_head();
    sending_ = true;
    view_ = view;
    stream_.expires_never();
    await_end();
    stream_.expires_after(stall_time);
    asio::async_write(stream_, asio::buffer(head_),
                      [self = shared_from_this()](Error error, std::size_t) { self->sent(error); });
  }

  void refuse(std::string_view status, std::string_view why) {
    head_ = refusal(status, why);
    asio::async_write(stream_, asio::buffer(head_), [self = shared_from_this()](Error, std::size_t) { self->end(); });
  }

  /// A viewer says nothing more: what comes is its end.
  void await_end() {
    stream_.async_read_some(asio::buffer(ignored_), [self = shared_from_this()](Error, std::size_t) { self->end(); });
  }

  void send_next() {
    current_ = *std::exchange(waiting_, std::nullopt);
    head_ = part_head(*current_);
    sending_ = true;
    stream_.expires_after(stall_time);
    std::array<asio::const_buffer, 3> const parts{asio::buffer(head_), asio::buffer(*current_->jpeg),
                                                  asio::buffer(after_picture.data(), after_picture.size())};
    asio::async_write(stream_, parts, [self = shared_from_this()](Error error, std::size_t) { self->sent(error); });
  }

  void sent(Error error) {
    if (error) return end();
    sending_ = false;
    current_.reset();
    if (waiting_) send_next();
  }

  beast::tcp_stream stream_;
  std::weak_ptr<Core> core_;
  beast::flat_buffer buffer_;
  http::request_parser<http::empty_body> parser_;
  std::optional<View> view_;
  std::string head_;
  std::array<char, 64> ignored_{};
  bool sending_ = false;
  std::optional<Picture> current_;
  std::optional<Picture> waiting_;
};

void PictureServer::Core::accept() {
  acceptor_.async_accept([self = shared_from_this()](Error error, tcp::socket socket) {
    if (!self->acceptor_.is_open()) return;
    if (error) {  // no descriptor is left, and none will be at once
      self->pause_.expires_after(std::chrono::milliseconds(100));
      return self->pause_.async_wait([self](Error) {
        if (self->acceptor_.is_open()) self->accept();
      });
    }
    // Who is told that it is full needs a place, too: beyond twice as many nobody is told anything.
    auto const count = self->viewers_.size();
    if (count < 2 * self->most_viewers_) {
      self->viewers_.push_back(std::make_shared<Viewer>(std::move(socket), self));
      std::shared_ptr<Viewer>(self->viewers_.back())->start(count >= self->most_viewers_);
    }
    self->accept();
  });
}

void PictureServer::Core::close() {
  Error ignored;
  acceptor_.close(ignored);
  pause_.cancel();
  for (auto const& viewer : std::vector(viewers_)) viewer->end();
}

bool PictureServer::Core::is_watched(View view) const {
  for (auto const& viewer : viewers_)
    if (viewer->view() == view) return true;
  return false;
}

void PictureServer::Core::offer(View view, Picture const& picture) {
  for (auto const& viewer : std::vector(viewers_))
    if (viewer->view() == view) viewer->show(picture);
}

base::Result<std::unique_ptr<PictureServer>> PictureServer::open(base::Loop& loop, ServeSettings const& settings) {
  Error error;
  auto const address = asio::ip::make_address(settings.address, error);
  if (!error && !address.is_loopback() && settings.token.empty())
    return base::fail(
        base::ErrorKind::invalid_input,
        fmt::format("other machines reach {}: whoever is on the network would see the pictures", settings.address),
        "name a token_file under [stream], or keep address = \"127.0.0.1\"");
  auto core = std::make_shared<Core>(loop, settings);
  if (!error) error = core->listen({address, settings.port});
  if (error)
    return base::fail(
        base::ErrorKind::io,
        fmt::format("pictures cannot be offered at {}:{}: {}", settings.address, settings.port, error.message()),
        "choose another port, or an address of this machine: [stream] port and address");
  core->accept();
  return std::unique_ptr<PictureServer>(new PictureServer(std::move(core)));
}

PictureServer::PictureServer(std::shared_ptr<Core> core) : core_(std::move(core)) {}
// NOLINTNEXTLINE(bugprone-exception-escape): nothing throws there but for want of memory, which ends the program.
PictureServer::~PictureServer() {
  core_->close();
}
std::uint16_t PictureServer::port() const {
  return core_->port();
}
bool PictureServer::is_watched(View view) const {
  return core_->is_watched(view);
}
void PictureServer::offer(View view, Picture const& picture) {
  core_->offer(view, picture);
}

}  // namespace lapwing::link::pictures
