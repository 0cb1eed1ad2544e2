#pragma once

#include <memory>
#include <vector>

#include "link/operator_link/carrier/byte_stream.hpp"
#include "link/operator_link/wire/protocol.hpp"

namespace lapwing::link::operator_link {

/// A connection on which frames are spoken. Like its stream it must not be destroyed from within its own callbacks;
/// once `ended` was called it is of no use.
class Channel {
 public:
  struct Events {
    std::function<void(Speech)> heard;
    std::function<void()> drained;
    std::function<void(std::string why)> ended;
  };
  explicit Channel(std::unique_ptr<ByteStream> stream) : stream_(std::move(stream)) {}
  Channel(Channel const&) = delete;
  Channel& operator=(Channel const&) = delete;

  void start(Events events);
  /// From the next frame on others hear it.
  void hand_over(Events events) { events_ = std::move(events); }
  /// Frames may now be as long as messages are.
  void trust() { reader_.allow(longest_body); }
  /// Says it with what is said until `flush`.
  void say(Speech const& speech) { write(unsent_, speech); }
  void flush();
  [[nodiscard]] bool has_room() const { return unsent_.size() + stream_->backlog() < most_backlog; }
  [[nodiscard]] std::string peer_name() const { return stream_->peer_name(); }
  void close();

 private:
  /// Enough to keep a line busy until the next turn; more would only make a command wait behind it.
  static constexpr std::size_t most_backlog = 64 * 1024;

  void take(Bytes bytes);
  void end(std::string why);

  std::unique_ptr<ByteStream> stream_;
  Events events_;
  FrameReader reader_;
  std::vector<std::uint8_t> unsent_;
  bool is_closed_ = false;
};

}  // namespace lapwing::link::operator_link
