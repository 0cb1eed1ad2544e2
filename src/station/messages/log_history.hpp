#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/log.hpp"
#include "station/messages/messages.hpp"

namespace lapwing::station {

/// The last lines of the log, for viewers that come later. When there are too many, the source that has most of them
/// loses its oldest: however much one says, what the others said stays to be read. Errors go last.
class LogHistory {
 public:
  explicit LogHistory(std::size_t limit) : limit_(limit) {}

  void add(base::LogRecord const& record);
  /// Those with a greater sequence number, oldest first.
  [[nodiscard]] std::vector<LogLine> after(std::uint64_t sequence) const;
  [[nodiscard]] std::uint64_t last_sequence() const { return last_sequence_; }

 private:
  void make_room();

  std::size_t limit_;
  std::deque<LogLine> lines_;
  std::map<std::string, std::size_t> counts_;  ///< by source, errors not counted
  std::uint64_t last_sequence_ = 0;
};

/// Keeps what the hub is told from now on. The hub may outlive the history, and keeps nothing alive.
[[nodiscard]] std::shared_ptr<LogHistory const> keep_log(base::LogHub& hub, std::size_t limit);

}  // namespace lapwing::station
