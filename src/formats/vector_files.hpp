#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "formats/base_map.hpp"
#include "formats/map_contents.hpp"

/// Layers of features in the files of GIS and office programs, by GDAL/OGR.
namespace lapwing::formats {

enum class VectorFormat { geopackage, geojson, kml, kmz, csv };

/// Writes the layers that have features. GeoPackage, KML and KMZ: one file, a table or folder a layer. GeoJSON and CSV
/// hold one layer a file: `path` is a folder then, with `slots.geojson`, ... In every one a feature has its id, site,
/// floor, writer, time and properties; times are text in KML and CSV. `sites` goes along as a layer of points, so that
/// reading it back finds the floors. An existing file is replaced. Errors: io; cancelled.
[[nodiscard]] base::Result<> write_vectors(MapContents const& contents, VectorFormat format,
                                           std::filesystem::path const& path, Progress const& progress = {});

struct ReadOptions {
  /// What features without a layer's name in table, folder or file are; empty: such a file is an error.
  std::optional<map::LayerKind> layer = {};
  /// Where features without a site of their own lie.
  std::optional<geo::Site> site = {};
  std::string floor = {};
  /// Of features that name no writer and time; a time of zero is now.
  map::Account account = {.writer = "import"};
};

/// Reads any file that OGR's drivers for files know, in any coordinate system that it names. Without `site` and without
/// sites in the file, one called `imported` is anchored amid what was read. Errors: invalid_input names the layer, the
/// feature and what is wrong with it; io. Nothing is read of a file with an error.
[[nodiscard]] base::Result<MapContents> read_vectors(std::filesystem::path const& path,
                                                     ReadOptions const& options = {});

}  // namespace lapwing::formats
