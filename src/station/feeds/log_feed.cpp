#include "station/feeds/log_feed.hpp"

#include <algorithm>

#include "station/messages/messages.hpp"

namespace lapwing::station {

std::uint64_t LogFeed::refresh(base::TimePoint) {
  return revision_ = history_->last_sequence() + 1;
}

News LogFeed::since(std::uint64_t revision, base::TimePoint, std::size_t) const {
  bool const is_whole = revision == 0;
  auto lines = history_->after(is_whole ? 0 : revision - 1);
  auto const later = std::ranges::find_if(lines, [&](LogLine const& line) { return line.sequence >= revision_; });
  lines.erase(later, lines.end());
  if (!is_whole && lines.empty()) return {};
  return {.is_whole = is_whole, .frames = {{.content = log_message(lines), .revision = revision_}}};
}

}  // namespace lapwing::station
