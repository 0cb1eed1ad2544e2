#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/http/router.hpp"
#include "station/map/features/feature_query.hpp"
#include "station/messages/feed_json.hpp"

/// Features as GeoJSON (RFC 7946) documents, with links from one to the next. For .cpp files.
namespace lapwing::station {

inline constexpr std::string_view geojson_type = "application/geo+json";

struct Link {
  std::string rel;
  std::string href;
  std::string_view type = "application/json";
  std::string title = {};
};
[[nodiscard]] Json links_json(std::vector<Link> const& links);

/// "http://station:8080", as the client calls this station: links that other programs follow must be whole. A
/// proxy before it that speaks TLS says so with `X-Forwarded-Proto`.
[[nodiscard]] std::string origin_of(HttpRequest const& request);
/// The request's own address.
[[nodiscard]] std::string address_of(HttpRequest const& request);
/// The same with another offset; what was asked for stays.
[[nodiscard]] std::string address_at(HttpRequest const& request, std::size_t offset);

/// Of which `If-Match` and `If-None-Match` tell whether it is the same still.
[[nodiscard]] std::string feature_tag(map::LiveMap const& map, map::FeatureRecord const& record);

/// The page as a FeatureCollection with `numberMatched`, `numberReturned`, `timeStamp`, and links to itself and to the
/// pages beside it. Written beside the loop, so that ten thousand features do not hold up who flies.
[[nodiscard]] Reply feature_collection(base::Loop& loop, map::LiveMap const& map, HttpRequest const& request,
                                       FeatureQuery const& query, std::vector<Link> links);

}  // namespace lapwing::station
