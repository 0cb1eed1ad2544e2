#include "map/store/schema/geopackage.hpp"

#include <fmt/format.h>

namespace lapwing::map::schema {

namespace {

/// "GPKG", and 1.3.0.
constexpr auto file_marks = R"(
PRAGMA application_id = 1196444487;
PRAGMA user_version = 10300;
)";

constexpr auto core_tables = R"(
CREATE TABLE gpkg_spatial_ref_sys (
  srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL, organization_coordsys_id INTEGER NOT NULL,
  definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (
  table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE, description TEXT DEFAULT '',
  last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')),
  min_x DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER,
  CONSTRAINT fk_gc_r_srs_id FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_geometry_columns (
  table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL,
  m TINYINT NOT NULL,
  CONSTRAINT pk_geom_cols PRIMARY KEY (table_name, column_name), CONSTRAINT uk_gc_table_name UNIQUE (table_name),
  CONSTRAINT fk_gc_tn FOREIGN KEY (table_name) REFERENCES gpkg_contents(table_name),
  CONSTRAINT fk_gc_srs FOREIGN KEY (srs_id) REFERENCES gpkg_spatial_ref_sys(srs_id));
CREATE TABLE gpkg_extensions (
  table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT NULL, scope TEXT NOT NULL,
  CONSTRAINT ge_tce UNIQUE (table_name, column_name, extension_name));
INSERT INTO gpkg_spatial_ref_sys VALUES
  ('Undefined Cartesian SRS', -1, 'NONE', -1, 'undefined', 'undefined Cartesian coordinate reference system'),
  ('Undefined geographic SRS', 0, 'NONE', 0, 'undefined', 'undefined geographic coordinate reference system'),
  ('WGS 84 geodetic', 4326, 'EPSG', 4326,
   'GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563,AUTHORITY["EPSG","7030"]],AUTHORITY["EPSG","6326"]],PRIMEM["Greenwich",0,AUTHORITY["EPSG","8901"]],UNIT["degree",0.0174532925199433,AUTHORITY["EPSG","9122"]],AXIS["Latitude",NORTH],AXIS["Longitude",EAST],AUTHORITY["EPSG","4326"]]',
   'longitude/latitude coordinates in decimal degrees on the WGS 84 spheroid');
)";

/// {0}: the table, {1}: its shape column, {2}: the kind of its shapes.
constexpr auto feature_entries = R"(
INSERT INTO gpkg_contents (table_name, data_type, identifier, description, srs_id) VALUES ('{0}', 'features', '{0}', '{3}', 4326);
INSERT INTO gpkg_geometry_columns VALUES ('{0}', '{1}', '{2}', 4326, 0, 0);
INSERT INTO gpkg_extensions VALUES ('{0}', '{1}', 'gpkg_rtree_index', 'http://www.geopackage.org/spec120/#extension_rtree', 'write-only');
CREATE VIRTUAL TABLE rtree_{0}_{1} USING rtree(id, minx, maxx, miny, maxy);
)";

/// Annex F.3 of the specification, word by word; what a trigger of that name does, other programs know.
constexpr auto rtree_triggers = R"(
CREATE TRIGGER rtree_{0}_{1}_insert AFTER INSERT ON {0} WHEN (NEW.{1} NOT NULL AND NOT ST_IsEmpty(NEW.{1}))
BEGIN
  INSERT OR REPLACE INTO rtree_{0}_{1} VALUES (NEW.fid, ST_MinX(NEW.{1}), ST_MaxX(NEW.{1}), ST_MinY(NEW.{1}), ST_MaxY(NEW.{1}));
END;
CREATE TRIGGER rtree_{0}_{1}_update1 AFTER UPDATE OF {1} ON {0}
  WHEN OLD.fid = NEW.fid AND (NEW.{1} NOTNULL AND NOT ST_IsEmpty(NEW.{1}))
BEGIN
  INSERT OR REPLACE INTO rtree_{0}_{1} VALUES (NEW.fid, ST_MinX(NEW.{1}), ST_MaxX(NEW.{1}), ST_MinY(NEW.{1}), ST_MaxY(NEW.{1}));
END;
CREATE TRIGGER rtree_{0}_{1}_update2 AFTER UPDATE OF {1} ON {0}
  WHEN OLD.fid = NEW.fid AND (NEW.{1} ISNULL OR ST_IsEmpty(NEW.{1}))
BEGIN
  DELETE FROM rtree_{0}_{1} WHERE id = OLD.fid;
END;
CREATE TRIGGER rtree_{0}_{1}_update3 AFTER UPDATE ON {0}
  WHEN OLD.fid != NEW.fid AND (NEW.{1} NOTNULL AND NOT ST_IsEmpty(NEW.{1}))
BEGIN
  DELETE FROM rtree_{0}_{1} WHERE id = OLD.fid;
  INSERT OR REPLACE INTO rtree_{0}_{1} VALUES (NEW.fid, ST_MinX(NEW.{1}), ST_MaxX(NEW.{1}), ST_MinY(NEW.{1}), ST_MaxY(NEW.{1}));
END;
CREATE TRIGGER rtree_{0}_{1}_update4 AFTER UPDATE ON {0}
  WHEN OLD.fid != NEW.fid AND (NEW.{1} ISNULL OR ST_IsEmpty(NEW.{1}))
BEGIN
  DELETE FROM rtree_{0}_{1} WHERE id IN (OLD.fid, NEW.fid);
END;
CREATE TRIGGER rtree_{0}_{1}_delete AFTER DELETE ON {0} WHEN OLD.{1} NOT NULL
BEGIN
  DELETE FROM rtree_{0}_{1} WHERE id = OLD.fid;
END;
)";

constexpr auto extension_entry =
    "INSERT INTO gpkg_extensions VALUES ('{}', NULL, 'lapwing_store', 'docs/reference/store.md of Lapwing', "
    "'write-only');\n";

}  // namespace

std::string geopackage_statements() {
  return std::string(file_marks) + core_tables;
}

std::string registration_statements(sql::Table const& table) {
  auto const* shape = table.shape_column();
  if (!shape) return fmt::format(extension_entry, table.name);
  return fmt::format(feature_entries, table.name, shape->name, shape->shape, table.about) +
         fmt::format(rtree_triggers, table.name, shape->name);
}

std::string touch_statement() {
  return "UPDATE gpkg_contents SET last_change = strftime('%Y-%m-%dT%H:%M:%fZ', 'now') WHERE table_name = $1";
}

}  // namespace lapwing::map::schema
