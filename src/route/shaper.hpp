#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"
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

/// Lets as many frames go as a link may take, and of the others keeps those that are worth it: orders in order and
/// first, as long as they are fresh; then what else is of the class `command`; of telemetry the newest of each kind,
/// which takes the place of the one that waited. Telemetry and bulk take turns. Time comes from the caller; no memory
/// is asked for once every kind of message was seen.
class Shaper {
 public:
  static constexpr std::size_t max_single = 256;    ///< orders that wait; as many other commands, as many of bulk
  static constexpr std::size_t max_streams = 4096;  ///< kinds of telemetry

  explicit Shaper(Limits const& limits);

  enum class Verdict {
    go,         ///< send it now
    waits,      ///< kept until `release`
    replaced,   ///< kept in the place of an older one, which is dropped
    displaced,  ///< kept; too many orders wait, and the oldest is dropped
    refused,    ///< dropped: too many wait
  };
  [[nodiscard]] Verdict offer(mavlink::FrameView const& frame, base::TimePoint now);
  struct Released {
    std::span<std::uint8_t const> bytes;
    MessageClass message_class;
  };
  /// The next frame that may go now; valid until the next call.
  [[nodiscard]] std::optional<Released> release(base::TimePoint now);
  /// How many were dropped since the last call because they had waited for too long (`shelf_life`).
  [[nodiscard]] std::uint64_t take_expired() { return std::exchange(expired_, 0); }
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
    base::TimePoint expires = base::TimePoint::max();
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
    MessageClass message_class;
    std::vector<Kept> kept;
    Ring order;  ///< of indices in `kept`
  };
  /// Two lines are of the class `command`.
  enum LineId : std::size_t { orders, commands, telemetry, bulk };
  [[nodiscard]] static LineId line_of(mavlink::FrameView const& frame);
  [[nodiscard]] bool is_next(LineId line) const;
  [[nodiscard]] base::TimePoint ready(MessageClass c, std::size_t size, base::TimePoint now) const;
  [[nodiscard]] base::TimePoint front_ready(Line const& line, base::TimePoint now) const;
  void pay(MessageClass c, std::size_t size, base::TimePoint now);
  [[nodiscard]] Verdict keep_single(LineId line, mavlink::FrameView const& frame, base::TimePoint now);
  [[nodiscard]] Verdict keep_newest(mavlink::FrameView const& frame);
  void drop_expired(base::TimePoint now);
  void forget_idle_streams();
  [[nodiscard]] Released release_front(LineId id, base::TimePoint now);

  Gate all_;
  std::array<Gate, message_classes> gates_;
  std::array<Line, 4> lines_;
  std::unordered_map<StreamKey, std::uint32_t, KeyHash> streams_;  ///< index in the telemetry line's `kept`
  bool bulk_is_next_ = false;
  std::uint64_t expired_ = 0;
};

}  // namespace lapwing::route
