#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/time.hpp"
#include "mavlink/frame.hpp"
#include "route/message_class.hpp"
#include "route/token_bucket.hpp"

namespace lapwing::route {

/// How much may go out. Infinity: no limit.
struct Rate {
  double bytes_per_s = std::numeric_limits<double>::infinity();
  double messages_per_s = std::numeric_limits<double>::infinity();
};

struct Limits {
  Rate all = {};
  std::array<Rate, message_classes> by_class = {};  ///< each within `all`
  [[nodiscard]] bool any() const;
};

/// Lets as many frames go as a link may take, and of the others keeps those that are worth it: commands in order and
/// first, of telemetry the newest of each kind, which takes the place of the one that waited. Telemetry and bulk take
/// turns. Time comes from the caller; no memory is asked for once every kind of message was seen.
class Shaper {
 public:
  static constexpr std::size_t max_single = 256;    ///< commands that wait; as many of bulk
  static constexpr std::size_t max_streams = 4096;  ///< kinds of telemetry

  explicit Shaper(Limits const& limits);

  enum class Verdict {
    go,        ///< send it now
    waits,     ///< kept until `release`
    replaced,  ///< kept in the place of an older one, which is dropped
    refused,   ///< dropped: too many wait
  };
  [[nodiscard]] Verdict offer(mavlink::FrameView const& frame, base::TimePoint now);
  /// The next frame that may go now; valid until the next call.
  [[nodiscard]] std::optional<std::span<std::uint8_t const>> release(base::TimePoint now);
  /// When the next may go; TimePoint::max() when none waits.
  [[nodiscard]] base::TimePoint next_release(base::TimePoint now) const;
  [[nodiscard]] std::size_t waiting() const;

 private:
  /// Both buckets of a rate.
  class Gate {
   public:
    explicit Gate(Rate const& rate);
    [[nodiscard]] base::TimePoint ready(std::size_t size, base::TimePoint now) const;
    void take(std::size_t size, base::TimePoint now);

   private:
    TokenBucket bytes_;
    TokenBucket messages_;
  };
  struct Kept {
    std::array<std::uint8_t, mavlink::max_frame_size> bytes;
    std::size_t size = 0;
    bool waits = false;  ///< of telemetry
    StreamKey stream;
    void keep(mavlink::FrameView const& frame);
    [[nodiscard]] std::span<std::uint8_t const> view() const { return {bytes.data(), size}; }
  };
  /// First in, first out, in a fixed room.
  struct Ring {
    explicit Ring(std::size_t capacity) : indices(capacity) {}
    std::vector<std::uint32_t> indices;
    std::size_t first = 0;
    std::size_t count = 0;
    [[nodiscard]] bool full() const { return count == indices.size(); }
    [[nodiscard]] std::uint32_t front() const { return indices[first]; }
    void push(std::uint32_t index) { indices[(first + count++) % indices.size()] = index; }
    void pop();
  };
  struct KeyHash {
    std::size_t operator()(StreamKey const& key) const {
      return (key.source_and_id * 0x9E3779B97F4A7C15U) ^ key.instance;
    }
  };
  struct Line {
    explicit Line(std::size_t capacity) : order(capacity) {}
    std::vector<Kept> kept;
    Ring order;  ///< of indices in `kept`
  };

  [[nodiscard]] Line& line(MessageClass c) { return lines_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] Line const& line(MessageClass c) const { return lines_[static_cast<std::size_t>(c)]; }
  [[nodiscard]] base::TimePoint ready(MessageClass c, std::size_t size, base::TimePoint now) const;
  [[nodiscard]] base::TimePoint front_ready(MessageClass c, base::TimePoint now) const;
  void pay(MessageClass c, std::size_t size, base::TimePoint now);
  [[nodiscard]] Verdict keep_single(Line& line, mavlink::FrameView const& frame);
  [[nodiscard]] Verdict keep_newest(mavlink::FrameView const& frame);
  void forget_idle_streams();
  [[nodiscard]] std::span<std::uint8_t const> release_front(MessageClass c, base::TimePoint now);

  Gate all_;
  std::array<Gate, message_classes> gates_;
  std::array<Line, message_classes> lines_;
  std::unordered_map<StreamKey, std::uint32_t, KeyHash> streams_;  ///< index in the telemetry line's `kept`
  bool bulk_is_next_ = false;
};

}  // namespace lapwing::route
