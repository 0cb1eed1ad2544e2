#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/async/scope.hpp"
#include "link/byte_link.hpp"
#include "link/internal/send_queue.hpp"

namespace lapwing::link::internal {

/// An open byte stream (TCP connection or terminal line) on the loop: reads until it ends, writes through a bounded
/// queue of whole packets. The kernel's own queue behind it is kept short, so that commands do not wait in it behind
/// old telemetry.
class Stream {
 public:
  using Data = std::function<void(Bytes)>;
  using Ended = std::function<void(std::string why)>;

  struct End {
    int descriptor = -1;                  ///< open and non-blocking; taken over
    std::optional<double> bytes_per_s{};  ///< what the line carries, if that is known and little
  };
  /// `ended` is called once, from the loop; destroy the stream on a later turn. Counts into `counters`, which must live
  /// as long.
  Stream(base::Loop& loop, End end, LinkCounters& counters, Data data, Ended ended);
  Stream(Stream const&) = delete;
  Stream& operator=(Stream const&) = delete;
  ~Stream();

  /// False when the queue is full: the far end takes less than it is sent.
  bool send(Bytes packet, Urgency urgency);

 private:
  void wait_to_read();
  void read();
  void wait_to_write();
  void write();
  [[nodiscard]] bool waits_for_line();
  base::Task<void> write_after(base::Duration time);
  void count();
  void end(std::string why);

  struct Descriptor;
  std::unique_ptr<Descriptor> descriptor_;
  LinkCounters& counters_;
  Data data_;
  Ended ended_;
  base::Loop& loop_;
  std::optional<double> bytes_per_s_;
  SendQueue queue_;
  std::size_t bytes_counted_ = 0;  ///< of the queue, in `counters_`
  std::uint64_t drops_counted_ = 0;
  bool writing_ = false;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  // handlers outlive the stream and look at it weakly
  base::Scope scope_;
};

}  // namespace lapwing::link::internal
