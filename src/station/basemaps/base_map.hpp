#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "map/basemaps/tile_archive.hpp"

namespace lapwing::station {

/// Tiles that browsers get from somewhere else.
struct TileAddressTemplate {
  std::string url;  ///< with {z}, {x} and {y}
  std::uint32_t greatest_zoom = 19;
};

/// Ground drawn as GeoJSON by who made the world (polygons and lines with a `kind`), so that a demo is a place at once.
struct DrawnGround {
  std::filesystem::path file;
};

/// What lies under everything on the map; viewers choose one.
struct BaseMap {
  std::string id;    ///< in addresses: letters, digits, '-' and '_'
  std::string name;  ///< for people
  std::string attribution = {};
  std::variant<TileAddressTemplate, std::shared_ptr<map::TileArchive const>, DrawnGround> source;
};

}  // namespace lapwing::station
