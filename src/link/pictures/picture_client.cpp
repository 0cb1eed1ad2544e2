#include "link/pictures/picture_client.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::link::pictures {

using namespace std::chrono_literals;

namespace {

/// The link tries again a second after it has lost its far end: looked at so often, no new connection is missed.
constexpr base::Duration look_again = 20ms;

}  // namespace

base::Result<std::unique_ptr<PictureClient>> PictureClient::open(base::Loop& loop, Source const& source, View view) {
  auto link = link::open(loop, {.transport = Transport::tcp_out, .host = source.host, .port_or_baud = source.port});
  if (!link) return std::unexpected(link.error());
  return std::unique_ptr<PictureClient>(new PictureClient(loop, source, view, *std::move(link)));
}

PictureClient::PictureClient(base::Loop& loop, Source source, View view, std::unique_ptr<ByteLink> link)
    : loop_(loop), source_(std::move(source)), view_(view), arrived_(loop), link_(std::move(link)), scope_(loop) {
  link_->start([this](Peer, Bytes bytes) { take(bytes); });
  scope_.spawn(keep_asking());
}

base::Task<> PictureClient::keep_asking() {
  for (;;) {
    while (link_->state() != LinkState::open) co_await loop_.sleep(look_again);
    reader_ = {};
    fault_.clear();
    auto const known = source_.token.empty() ? "" : fmt::format("Authorization: Bearer {}\r\n", source_.token);
    auto const request =
        fmt::format("GET {} HTTP/1.1\r\nHost: localhost\r\n{}Connection: close\r\n\r\n", path_of(view_), known);
    (void)link_->send(Peer{}, {reinterpret_cast<std::uint8_t const*>(request.data()), request.size()});
    while (link_->state() == LinkState::open) co_await loop_.sleep(look_again);
  }
}

void PictureClient::take(Bytes bytes) {
  auto picture = reader_.take({reinterpret_cast<char const*>(bytes.data()), bytes.size()});
  if (!picture) {
    fault_ = picture.error().message;
    return;
  }
  if (!*picture) return;
  fault_.clear();
  newest_ = Numbered{.picture = **std::move(picture), .number = newest_ ? newest_->number + 1 : 1};
  arrived_.notify_all();
}

base::Task<base::Result<PictureClient::Numbered>> PictureClient::next(std::uint64_t after, base::Duration patience) {
  auto const deadline = loop_.now() + patience;
  while (!newest_ || newest_->number == after) {
    if (loop_.now() < deadline) {
      co_await arrived_.wait_until(deadline);
      continue;
    }
    if (link_->state() != LinkState::open || !fault_.empty())
      co_return base::fail(base::ErrorKind::lost,
                           fmt::format("FailedToSend: nothing comes from {}:{}: {}", source_.host, source_.port,
                                       fault_.empty() ? link_->last_error() : fault_),
                           "is [stream] in the drone's file, and is its port reached from here?");
    co_return base::fail(
        base::ErrorKind::timed_out,
        fmt::format("NoImage: the drone is reached and has given no picture for {:.0f} s", base::to_seconds(patience)),
        "the health of its vision says why");
  }
  co_return *newest_;
}

}  // namespace lapwing::link::pictures
