#pragma once

#include <string>

#include "map/store/sql/table.hpp"

/// What makes an SQLite file a GeoPackage (OGC 12-128r18, version 1.3), so that QGIS and GDAL open it as it is.
namespace lapwing::map::schema {

/// For a new file: its marks and the tables of GeoPackage's own.
[[nodiscard]] std::string geopackage_statements();
/// For a table that has been made: its entries there. Those with a shape are feature layers with an R-tree, kept by
/// triggers; the others are listed as this program's extension.
[[nodiscard]] std::string registration_statements(sql::Table const& table);
/// Its content has changed.
[[nodiscard]] std::string touch_statement();  // $1: its name

}  // namespace lapwing::map::schema
