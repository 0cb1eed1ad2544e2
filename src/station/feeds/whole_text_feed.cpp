#include "station/feeds/whole_text_feed.hpp"

#include <utility>

namespace lapwing::station {

std::uint64_t WholeTextFeed::refresh(base::TimePoint) {
  auto message = text();
  if (message == message_) return revision_;
  message_ = std::move(message);
  return ++revision_;
}

News WholeTextFeed::since(std::uint64_t, base::TimePoint, std::size_t) const {
  return {.is_whole = true, .frames = {{.content = message_, .revision = revision_}}};
}

}  // namespace lapwing::station
