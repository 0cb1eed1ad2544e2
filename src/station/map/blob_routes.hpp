#pragma once

#include "map/store/picture_store.hpp"
#include "station/http/router.hpp"

namespace lapwing::station {

/// The HTTP face of the pictures of the map. Null: none are kept, all is refused. It outlives the router and its work.
void add_blob_routes(Router& router, map::PictureStore* blobs);

/// A picture of a camera has 5 to 20 MB.
inline constexpr std::size_t max_picture_bytes = std::size_t{32} * 1024 * 1024;

}  // namespace lapwing::station
