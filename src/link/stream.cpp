#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "link/internal/stream.hpp"

#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

namespace lapwing::link::internal {

namespace {

using boost::asio::posix::stream_descriptor;

/// Perishable packets may wait for a slow line for this long.
double constexpr perishable_wait_s = 1.0;
/// All packets together: what comes later is no answer to what was, and its sender has said it again.
double constexpr longest_wait_s = 2.0;
/// What may wait in the driver of a slow line: enough to keep it busy until the next look.
double constexpr driver_wait_s = 0.1;
/// What may wait in the kernel for a TCP peer; it takes twice that. Enough for 1 MB/s over 50 ms.
int constexpr socket_buffer = 32 * 1024;

SendQueue::Limits limits_for(std::optional<double> bytes_per_s) {
  SendQueue::Limits limits;
  if (!bytes_per_s) return limits;
  auto constexpr few_packets = 4 * std::size_t{280};
  auto const bytes_in = [&](double wait_s) {
    return std::max(few_packets, static_cast<std::size_t>(*bytes_per_s * wait_s));
  };
  limits.perishable_bytes = bytes_in(perishable_wait_s);
  limits.all_bytes = std::max(limits.perishable_bytes, bytes_in(longest_wait_s));
  return limits;
}

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

struct Stream::Descriptor {
  stream_descriptor handle;
  bool is_socket;
};

Stream::Stream(base::Loop& loop, End end, LinkCounters& counters, Data data, Ended ended)
    : counters_(counters),
      data_(std::move(data)),
      ended_(std::move(ended)),
      loop_(loop),
      bytes_per_s_(end.bytes_per_s),
      queue_(limits_for(end.bytes_per_s)),
      scope_(loop) {
  // Fails for what is no socket.
  bool const is_socket = setsockopt(end.descriptor, SOL_SOCKET, SO_SNDBUF, &socket_buffer, sizeof(socket_buffer)) == 0;
  descriptor_ = std::make_unique<Descriptor>(Descriptor{stream_descriptor(loop.io(), end.descriptor), is_socket});
  wait_to_read();
}

Stream::~Stream() {
  counters_.bytes_queued -= bytes_counted_;
}

void Stream::wait_to_read() {
  descriptor_->handle.async_wait(stream_descriptor::wait_read,
                                 [this, alive = std::weak_ptr(alive_)](boost::system::error_code error) {
                                   if (alive.expired() || error) return;
                                   read();
                                 });
}

void Stream::read() {
  std::array<std::uint8_t, 16 * 1024> buffer;
  auto const got = ::read(descriptor_->handle.native_handle(), buffer.data(), buffer.size());
  if (got < 0 && !would_block(errno)) return end(std::strerror(errno));
  if (got == 0) return end("closed by the far end");
  if (got > 0) {
    ++counters_.chunks_received;
    counters_.bytes_received += static_cast<std::uint64_t>(got);
    data_({buffer.data(), static_cast<std::size_t>(got)});
  }
  wait_to_read();
}

bool Stream::send(Bytes packet, Urgency urgency) {
  bool const is_taken = descriptor_->handle.is_open() && queue_.push(packet, urgency, loop_.now());
  if (is_taken)
    ++counters_.chunks_sent;
  else
    ++counters_.send_failures;
  if (is_taken && !writing_) write();
  count();
  return is_taken;
}

void Stream::count() {
  counters_.bytes_queued += queue_.bytes() - bytes_counted_;
  counters_.perishable_dropped += queue_.dropped() - drops_counted_;
  bytes_counted_ = queue_.bytes();
  drops_counted_ = queue_.dropped();
}

void Stream::wait_to_write() {
  writing_ = true;
  descriptor_->handle.async_wait(stream_descriptor::wait_write,
                                 [this, alive = std::weak_ptr(alive_)](boost::system::error_code error) {
                                   if (alive.expired() || error) return;
                                   writing_ = false;
                                   write();
                                   count();
                                 });
}

void Stream::write() {
  auto const now = loop_.now();
  for (auto packet = queue_.front(now); !packet.empty(); packet = queue_.front(now)) {
    if (waits_for_line()) return;
    auto const fd = descriptor_->handle.native_handle();
    // A socket whose far end is gone must report it, not end the process with SIGPIPE.
    auto const sent = descriptor_->is_socket ? ::send(fd, packet.data(), packet.size(), MSG_NOSIGNAL)
                                             : ::write(fd, packet.data(), packet.size());
    if (sent < 0 && would_block(errno)) return wait_to_write();
    if (sent < 0) return end(std::strerror(errno));
    counters_.bytes_sent += static_cast<std::uint64_t>(sent);
    queue_.pop(static_cast<std::size_t>(sent));
  }
}

/// A terminal driver takes kilobytes, which are a second of a slow line. Nothing tells when they are out but looking.
bool Stream::waits_for_line() {
  int waiting = 0;
  if (!bytes_per_s_ || ioctl(descriptor_->handle.native_handle(), TIOCOUTQ, &waiting) != 0) return false;
  double const wait_s = waiting / *bytes_per_s_;
  if (wait_s < driver_wait_s) return false;
  writing_ = true;
  scope_.spawn(write_after(base::from_seconds(wait_s - driver_wait_s / 2)));
  return true;
}

base::Task<void> Stream::write_after(base::Duration time) {
  co_await loop_.sleep(time);
  writing_ = false;
  write();
  count();
}

void Stream::end(std::string why) {
  if (!descriptor_->handle.is_open()) return;
  boost::system::error_code ignored;
  descriptor_->handle.close(ignored);
  ended_(std::move(why));
}

}  // namespace lapwing::link::internal
