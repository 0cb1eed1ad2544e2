#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include <nlohmann/json.hpp>

#include "station/feeds/feed.hpp"

namespace lapwing::station::testing {

/// Who watches a feed and takes what it lacks, a piece at a time, as `Viewers` has it sent.
class FeedViewer {
 public:
  /// `take` is given each message, and whether what was there before does not count any more.
  using Take = std::function<void(nlohmann::json const&, bool is_whole)>;
  FeedViewer(Feed& feed, Take take) : feed_(feed), take_(std::move(take)) {}

  /// One piece; false when there is nothing more of what the feed has seen.
  bool take_one(std::size_t room) {
    auto const newest = feed_.refresh({});
    if (revision_ == newest) return false;
    auto const news = feed_.since(revision_, {}, room);
    bool is_whole = news.is_whole;
    for (auto const& frame : news.frames) {
      most_bytes_ = std::max(most_bytes_, frame.content.size());
      bytes_ += frame.content.size();
      ++messages_;
      take_(nlohmann::json::parse(frame.content), std::exchange(is_whole, false));
      if (frame.revision > 0) revision_ = frame.revision;
    }
    if (news.frames.empty()) revision_ = newest;
    return true;
  }
  void catch_up(std::size_t room = std::size_t{64} * 1024) {
    while (take_one(room)) {
    }
  }

  [[nodiscard]] std::uint64_t revision() const { return revision_; }
  [[nodiscard]] std::size_t messages() const { return messages_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }
  [[nodiscard]] std::size_t most_bytes() const { return most_bytes_; }

 private:
  Feed& feed_;
  Take take_;
  std::uint64_t revision_ = 0;
  std::size_t messages_ = 0;
  std::size_t bytes_ = 0;
  std::size_t most_bytes_ = 0;
};

}  // namespace lapwing::station::testing
