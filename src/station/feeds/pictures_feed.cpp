#include "station/feeds/pictures_feed.hpp"

#include <algorithm>
#include <utility>

#include <nlohmann/json.hpp>

#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

/// Those with numbers behind the one and up to the other; `is_full` when the viewer is to forget those that it has.
std::string pictures_message(vehicle::VehicleState const& state, int behind, int newest, bool is_full) {
  Json list = Json::array();
  for (auto const& picture : state.payload.pictures.value->recent) {
    if (picture.number <= behind || picture.number > newest) continue;
    auto json = position_json(picture.position);
    json["number"] = picture.number;
    json["relative_alt_m"] = rounded(picture.relative_alt_m, 1);
    list.push_back(std::move(json));
  }
  return dump({{"type", "pictures"}, {"vehicle", state.id.text}, {"full", is_full}, {"pictures", std::move(list)}});
}

}  // namespace

std::uint64_t PicturesFeed::refresh(base::TimePoint) {
  bool is_news = false;
  for (auto const* state : registry_.all()) {
    auto& album = albums_[state->id];
    auto const revision = registry_.revision(state->id);
    if (revision == album.looked_at) continue;
    album.looked_at = revision;
    auto const& pictures = state->payload.pictures.value;
    if (!pictures || pictures->recent.empty() || pictures->recent.back().number <= album.newest) continue;
    album.arrivals.push_back({revision_ + 1, std::exchange(album.newest, pictures->recent.back().number)});
    // What came before the oldest that is kept need not be told apart any more.
    auto const oldest = pictures->recent.front().number;
    while (album.arrivals.size() > 1 && album.arrivals[1].behind < oldest) album.arrivals.pop_front();
    is_news = true;
  }
  if (is_news) ++revision_;
  return revision_;
}

News PicturesFeed::since(std::uint64_t revision, base::TimePoint, std::size_t) const {
  bool const is_whole = revision == 0;
  News news{.is_whole = is_whole, .frames = {}};
  for (auto const* state : registry_.all()) {
    auto const album = albums_.find(state->id);
    if (album == albums_.end() || album->second.newest == 0) continue;
    auto const& arrivals = album->second.arrivals;
    auto const first = std::ranges::upper_bound(arrivals, revision, {}, &Arrival::revision);
    if (first == arrivals.end()) continue;
    auto const behind = is_whole ? 0 : first->behind;
    news.frames.push_back({.content = pictures_message(*state, behind, album->second.newest, is_whole)});
  }
  if (!news.frames.empty()) news.frames.back().revision = revision_;
  return news;
}

}  // namespace lapwing::station
