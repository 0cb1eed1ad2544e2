#include "station/feeds/alarms_feed.hpp"

#include <utility>

#include "station/messages/alarm_messages.hpp"

namespace lapwing::station {

std::uint64_t AlarmsFeed::refresh(base::TimePoint) {
  if (!alarms_ || looked_at_ == alarms_->revision()) return revision_;
  looked_at_ = alarms_->revision();
  return ++revision_;
}

/// With their ages as they are now.
News AlarmsFeed::since(std::uint64_t, base::TimePoint now, std::size_t) const {
  return {.is_whole = true, .frames = {{.content = alarms_message(alarms_, now), .revision = revision_}}};
}

}  // namespace lapwing::station
