#include "station/feeds/script_feed.hpp"

#include <utility>

#include "station/messages/messages.hpp"

namespace lapwing::station {

std::uint64_t ScriptFeed::refresh(base::TimePoint) {
  auto message = script_message(script_.status());
  if (message == message_) return revision_;
  message_ = std::move(message);
  return ++revision_;
}

News ScriptFeed::since(std::uint64_t, base::TimePoint, std::size_t) const {
  return {.is_whole = true, .frames = {{.content = message_, .revision = revision_}}};
}

}  // namespace lapwing::station
