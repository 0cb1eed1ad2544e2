#pragma once

#include "map/live/live_map.hpp"
#include "station/feeds/whole_text_feed.hpp"

namespace lapwing::station {

/// Which sites there are, with their anchors and floors, as `sites` messages. The map outlives it.
class SitesFeed final : public WholeTextFeed {
 public:
  explicit SitesFeed(map::LiveMap const& map) : map_(map) {}
  [[nodiscard]] std::string_view name() const override { return "map.sites"; }

 private:
  [[nodiscard]] std::string text() const override;
  map::LiveMap const& map_;
};

}  // namespace lapwing::station
