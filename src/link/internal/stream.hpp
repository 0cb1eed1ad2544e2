#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>

#include "link/byte_link.hpp"

namespace lapwing::link::internal {

/// An open byte stream (TCP connection or terminal line) on the loop: reads until it ends, writes through a bounded
/// queue.
class Stream {
 public:
  using Data = std::function<void(Bytes)>;
  using Ended = std::function<void(std::string why)>;

  /// Takes over `descriptor`, which must be non-blocking. `ended` is called once, from the loop; destroy the stream on
  /// a later turn. Counts into `counters`, which must live as long.
  Stream(base::Loop& loop, int descriptor, LinkCounters& counters, Data data, Ended ended);
  Stream(Stream const&) = delete;
  Stream& operator=(Stream const&) = delete;
  ~Stream();

  /// False when the queue is full: the far end takes less than it is sent.
  bool send(Bytes bytes);

 private:
  void wait_to_read();
  void read();
  void wait_to_write();
  void write();
  void end(std::string why);

  struct Descriptor;
  std::unique_ptr<Descriptor> descriptor_;
  LinkCounters& counters_;
  Data data_;
  Ended ended_;
  std::deque<std::uint8_t> queue_;
  bool writing_ = false;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  // handlers outlive the stream and look at it weakly
};

}  // namespace lapwing::link::internal
