#include <utility>  // before Asio: Boost 1.74 uses std::exchange without including it

#include "link/internal/stream.hpp"

#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

namespace lapwing::link::internal {

namespace {

using boost::asio::posix::stream_descriptor;

/// A second of the fastest serial line in use, many seconds of a radio's.
std::size_t constexpr queue_limit = 128 * 1024;

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

struct Stream::Descriptor {
  stream_descriptor handle;
  bool is_socket;
};

Stream::Stream(base::Loop& loop, int descriptor, LinkCounters& counters, Data data, Ended ended)
    : counters_(counters), data_(std::move(data)), ended_(std::move(ended)) {
  int type = 0;
  socklen_t size = sizeof(type);
  bool const is_socket = getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) == 0;
  descriptor_ = std::make_unique<Descriptor>(Descriptor{stream_descriptor(loop.io(), descriptor), is_socket});
  wait_to_read();
}

Stream::~Stream() = default;

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

bool Stream::send(Bytes bytes) {
  if (!descriptor_->handle.is_open() || queue_.size() + bytes.size() > queue_limit) {
    ++counters_.send_failures;
    return false;
  }
  ++counters_.chunks_sent;
  queue_.insert(queue_.end(), bytes.begin(), bytes.end());
  if (!writing_) write();
  return true;
}

void Stream::wait_to_write() {
  writing_ = true;
  descriptor_->handle.async_wait(stream_descriptor::wait_write,
                                 [this, alive = std::weak_ptr(alive_)](boost::system::error_code error) {
                                   if (alive.expired() || error) return;
                                   writing_ = false;
                                   write();
                                 });
}

void Stream::write() {
  std::array<std::uint8_t, 4096> chunk;
  while (!queue_.empty()) {
    auto const size = std::min(queue_.size(), chunk.size());
    std::copy_n(queue_.begin(), size, chunk.begin());
    auto const fd = descriptor_->handle.native_handle();
    // A socket whose far end is gone must report it, not end the process with SIGPIPE.
    auto const sent =
        descriptor_->is_socket ? ::send(fd, chunk.data(), size, MSG_NOSIGNAL) : ::write(fd, chunk.data(), size);
    if (sent < 0 && would_block(errno)) return wait_to_write();
    if (sent < 0) return end(std::strerror(errno));
    counters_.bytes_sent += static_cast<std::uint64_t>(sent);
    queue_.erase(queue_.begin(), queue_.begin() + sent);
  }
}

void Stream::end(std::string why) {
  if (!descriptor_->handle.is_open()) return;
  boost::system::error_code ignored;
  descriptor_->handle.close(ignored);
  ended_(std::move(why));
}

}  // namespace lapwing::link::internal
