#pragma once

#include <cstdint>
#include <iosfwd>
#include <optional>
#include <span>
#include <vector>

#include "base/time.hpp"
#include "mavlink/wire/frame.hpp"

namespace lapwing::mavlink {

// Telemetry logs (".tlog") as Mission Planner, QGroundControl, MAVProxy and pymavlink write and read them: for each
// packet eight bytes of big-endian microseconds since 1970 (UTC), then the packet as it travelled.
// https://mavlink.io/en/services/ does not describe them; mavutil.mavlogfile of pymavlink is the reference.

/// Appends one entry to `out`.
void append_tlog(std::vector<std::uint8_t>& out, base::UtcTime at, Frame const& frame);

struct TlogEntry {
  base::UtcTime at{};
  std::span<std::uint8_t const> packet;  ///< lives until the next entry is read
};

/// Reads a log from its begin to its end, however long it is, in constant memory. Skips what is no entry, a
/// half-written last one for example, and goes on behind it.
class TlogReader {
 public:
  /// `in` outlives the reader.
  explicit TlogReader(std::istream& in) : in_(in) {}

  /// Nothing at the end.
  [[nodiscard]] std::optional<TlogEntry> next();
  [[nodiscard]] std::uint64_t skipped_bytes() const { return skipped_bytes_; }

 private:
  void refill();
  void drop(std::size_t bytes);

  std::istream& in_;
  std::vector<std::uint8_t> buffer_;
  std::size_t begin_ = 0;  ///< of what was not read yet
  std::uint64_t skipped_bytes_ = 0;
};

}  // namespace lapwing::mavlink
