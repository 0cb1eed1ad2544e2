#include "station/feeds/tasks_feed.hpp"

#include <utility>

#include "station/messages/messages.hpp"

namespace lapwing::station {

std::uint64_t TasksFeed::refresh(base::TimePoint) {
  auto message = tasks_message(script_.task_trees());
  if (message == message_) return revision_;
  message_ = std::move(message);
  return ++revision_;
}

News TasksFeed::since(std::uint64_t, base::TimePoint, std::size_t) const {
  return {.is_whole = true, .frames = {{.content = message_, .revision = revision_}}};
}

}  // namespace lapwing::station
