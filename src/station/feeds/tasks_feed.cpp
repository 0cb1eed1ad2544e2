#include "station/feeds/tasks_feed.hpp"

#include "station/messages/messages.hpp"

namespace lapwing::station {

std::string TasksFeed::text() const {
  return tasks_message(script_.task_trees());
}

}  // namespace lapwing::station
