#include "station/feeds/plans_feed.hpp"

#include <nlohmann/json.hpp>

#include "station/messages/feed_json.hpp"

namespace lapwing::station {

namespace {

std::string plan_message(vehicle::VehicleId const& id, std::vector<geo::Wgs84> const& path) {
  Json places = Json::array();
  for (auto const& place : path) places.push_back(position_json(place));
  return dump({{"type", "plan"}, {"vehicle", id.text}, {"path", std::move(places)}});
}

}  // namespace

std::uint64_t PlansFeed::refresh(base::TimePoint) {
  bool is_news = false;
  for (auto const* state : registry_.all()) {
    auto& plan = plans_[state->id];
    auto const revision = registry_.revision(state->id);
    if (revision == plan.looked_at) continue;
    plan.looked_at = revision;
    if (plan.path == state->mission.planned_path) continue;
    plan.path = state->mission.planned_path;
    plan.revision = revision_ + 1;
    is_news = true;
  }
  if (is_news) ++revision_;
  return revision_;
}

/// Of a whole a vehicle without a plan is part, too: the viewer may hold an old one from before it lost the station.
News PlansFeed::since(std::uint64_t revision, base::TimePoint, std::size_t) const {
  News news{.is_whole = revision == 0, .frames = {}};
  for (auto const* state : registry_.all()) {
    auto const plan = plans_.find(state->id);
    if (plan == plans_.end() || (revision > 0 && plan->second.revision <= revision)) continue;
    news.frames.push_back({.content = plan_message(state->id, plan->second.path)});
  }
  if (!news.frames.empty()) news.frames.back().revision = revision_;
  return news;
}

}  // namespace lapwing::station
