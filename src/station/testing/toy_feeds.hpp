#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "station/feeds/feed.hpp"

/// Feeds as whoever has something to show would write them.
namespace lapwing::station::testing {

/// Notes in the order in which they were written, as texts. It keeps the last few: who missed more is told all anew.
class NotesFeed : public Feed {
 public:
  static constexpr std::size_t kept = 3;

  void write(std::string text) {
    notes_.push_back(std::move(text));
    ++revision_;
    if (notes_.size() > kept) notes_.pop_front();
  }

  [[nodiscard]] std::string_view name() const override { return "notes"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint) override { return revision_; }
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint, std::size_t) const override {
    auto const missed = revision_ - revision;
    bool const is_whole = revision == 0 || missed > notes_.size();
    std::string list;
    for (std::size_t i = is_whole ? 0 : notes_.size() - missed; i < notes_.size(); ++i)
      list += fmt::format("{}\"{}\"", list.empty() ? "" : ",", notes_[i]);
    return {is_whole, {{.content = fmt::format(R"({{"type":"notes","notes":[{}]}})", list), .revision = revision_}}};
  }

 private:
  std::deque<std::string> notes_;
  std::uint64_t revision_ = 1;
};

/// Numbered tiles of a map, as bytes: the number as one byte, then what is drawn. Each has the revision at which it
/// changed last, so nothing needs to be kept for those who are slow, and a map goes in as many pieces as it takes.
class TilesFeed : public Feed {
 public:
  explicit TilesFeed(std::size_t limit = std::size_t{64} * 1024) : limit_(limit) {}

  void draw(char number, std::string picture) { tiles_[number] = {std::move(picture), ++revision_}; }
  /// The most bytes that it gave at once.
  [[nodiscard]] std::size_t most_at_once() const { return most_at_once_; }

  [[nodiscard]] std::string_view name() const override { return "tiles"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint) override { return revision_; }
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint, std::size_t room) const override {
    std::vector<std::pair<std::uint64_t, char>> newer;
    for (auto const& [number, tile] : tiles_)
      if (tile.revision > revision) newer.emplace_back(tile.revision, number);
    std::ranges::sort(newer);
    News news{.is_whole = revision == 0, .frames = {}};
    std::size_t bytes = 0;
    for (auto const& [changed, number] : newer) {
      news.frames.push_back({.content = number + tiles_.at(number).picture, .is_binary = true, .revision = changed});
      bytes += news.frames.back().content.size();
      if (bytes >= room) break;
    }
    most_at_once_ = std::max(most_at_once_, bytes);
    return news;
  }
  [[nodiscard]] std::size_t max_unsent_bytes() const override { return limit_; }

 private:
  struct Tile {
    std::string picture;
    std::uint64_t revision = 0;
  };
  std::map<char, Tile> tiles_;
  std::uint64_t revision_ = 1;
  std::size_t limit_;
  mutable std::size_t most_at_once_ = 0;
};

}  // namespace lapwing::station::testing
