#pragma once

#include <string>

#include "base/async/loop.hpp"
#include "map/live/live_map.hpp"
#include "station/http/router.hpp"
#include "station/map/grids/grid_pictures.hpp"
#include "station/past/past_grids.hpp"

namespace lapwing::station {

/// The HTTP face of grids: which there are, their TileJSON, and their pictures, also (`past`, null where nothing is
/// kept) of a moment of the past. `run` tells the pictures of this run of the station from those of another. All of
/// them outlive the router and its work.
void add_grid_routes(Router& router, base::Loop& loop, map::LiveMap const& map, GridPictures& pictures, PastGrids* past,
                     std::string run);

/// The grid that a path names; "-" is the site's ground.
[[nodiscard]] map::GridKey grid_key_of(PathArguments const& arguments);
[[nodiscard]] HttpResponse no_tile();

}  // namespace lapwing::station
