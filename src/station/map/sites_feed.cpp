#include "station/map/sites_feed.hpp"

#include "station/map/site_json.hpp"

namespace lapwing::station {

std::string SitesFeed::text() const {
  return sites_message(map_);
}

}  // namespace lapwing::station
