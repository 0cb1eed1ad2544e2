#pragma once

#include <string>

#include "map/live/live_map.hpp"
#include "station/http/router.hpp"
#include "station/map/grids/grid_pictures.hpp"

namespace lapwing::station {

/// The HTTP face of grids: which there are, their TileJSON, and their pictures. `run` tells the pictures of this run of
/// the station from those of another. All of them outlive the router and its work.
void add_grid_routes(Router& router, map::LiveMap const& map, GridPictures& pictures, std::string run);

}  // namespace lapwing::station
