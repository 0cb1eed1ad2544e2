#include "station/messages/log_history.hpp"

#include <algorithm>

#include "base/flood_gate.hpp"

namespace lapwing::station {

namespace {

bool is_error(LogLine const& line) {
  return line.record.level == base::LogLevel::error;
}

}  // namespace

void LogHistory::add(base::LogRecord const& record) {
  if (limit_ == 0) return;
  if (lines_.size() >= limit_) make_room();
  lines_.push_back({++last_sequence_, record});
  if (!is_error(lines_.back())) ++counts_[record.source];
}

void LogHistory::make_room() {
  auto const most = std::ranges::max_element(counts_, {}, [](auto const& count) { return count.second; });
  if (most == counts_.end()) return lines_.pop_front();  // errors alone
  auto const oldest = std::ranges::find_if(
      lines_, [&](LogLine const& line) { return !is_error(line) && line.record.source == most->first; });
  lines_.erase(oldest);
  if (--most->second == 0) counts_.erase(most);
}

std::vector<LogLine> LogHistory::after(std::uint64_t sequence) const {
  auto const first = std::ranges::upper_bound(lines_, sequence, {}, &LogLine::sequence);
  return {first, lines_.end()};
}

std::shared_ptr<LogHistory const> keep_log(base::LogHub& hub, std::size_t limit) {
  auto const history = std::make_shared<LogHistory>(limit);
  hub.add_sink(base::without_floods([weak = std::weak_ptr(history)](base::LogRecord const& record) {
    if (auto const kept = weak.lock()) kept->add(record);
  }));
  return history;
}

}  // namespace lapwing::station
