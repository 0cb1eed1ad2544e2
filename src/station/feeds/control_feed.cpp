#include "station/feeds/control_feed.hpp"

#include <algorithm>
#include <utility>

#include "station/messages/control_messages.hpp"

namespace lapwing::station {

std::uint64_t ControlFeed::refresh(base::TimePoint) {
  auto const revision = std::max(emergency_revision_, commands_revision_);
  if (looked_at_ == control_.revision()) return revision;
  looked_at_ = control_.revision();
  if (auto text = emergency_message(control_.emergency()); text != emergency_) {
    emergency_ = std::move(text);
    emergency_revision_ = revision + 1;
  }
  if (auto text = commands_message(control_.commands()); text != commands_) {
    commands_ = std::move(text);
    commands_revision_ = revision + 1;
  }
  return std::max(emergency_revision_, commands_revision_);
}

News ControlFeed::since(std::uint64_t revision, base::TimePoint, std::size_t) const {
  News news{.is_whole = revision == 0, .frames = {}};
  if (emergency_revision_ > revision) news.frames.push_back({.content = emergency_});
  if (commands_revision_ > revision) news.frames.push_back({.content = commands_});
  if (!news.frames.empty()) news.frames.back().revision = std::max(emergency_revision_, commands_revision_);
  return news;
}

}  // namespace lapwing::station
