#pragma once

#include <string>

#include "map/live/live_map.hpp"
#include "station/map/geo_words.hpp"
#include "station/messages/feed_json.hpp"

/// What is told of a grid beside its cells. For .cpp files.
namespace lapwing::station {

/// Its key, resolution, account, bounds, and where its tiles lie.
[[nodiscard]] Json grid_json(map::GridKey const& key, map::GridRecord const& record, geo::Site const& site);
/// The address of its pictures with {z}, {x} and {y}, from the root of the station; with a revision they may be kept.
[[nodiscard]] std::string grid_pictures(map::GridKey const& key, std::string_view run, map::Revision revision);
/// Round all of its tiles; nothing for an empty one.
[[nodiscard]] std::optional<LonLatBox> grid_bounds(map::OccupancyGrid const& grid, geo::Site const& site);
/// From this web-mercator zoom on a cell has a pixel or more.
[[nodiscard]] int finest_zoom(map::OccupancyGrid const& grid, geo::Site const& site);

}  // namespace lapwing::station
