#pragma once

/// A GeoPackage as the first version of the store made it, with one door and one picture in it: it had only pictures of
/// JPEG, and did not tell which properties are older than the rest.
namespace lapwing::map::testing {

inline constexpr auto first_version = R"sql(
CREATE TABLE gpkg_spatial_ref_sys (srs_name TEXT NOT NULL, srs_id INTEGER PRIMARY KEY, organization TEXT NOT NULL,
  organization_coordsys_id INTEGER NOT NULL, definition TEXT NOT NULL, description TEXT);
CREATE TABLE gpkg_contents (table_name TEXT NOT NULL PRIMARY KEY, data_type TEXT NOT NULL, identifier TEXT UNIQUE,
  description TEXT DEFAULT '', last_change DATETIME NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ','now')), min_x
  DOUBLE, min_y DOUBLE, max_x DOUBLE, max_y DOUBLE, srs_id INTEGER);
CREATE TABLE gpkg_geometry_columns (table_name TEXT NOT NULL, column_name TEXT NOT NULL, geometry_type_name TEXT NOT
  NULL, srs_id INTEGER NOT NULL, z TINYINT NOT NULL, m TINYINT NOT NULL);
CREATE TABLE gpkg_extensions (table_name TEXT, column_name TEXT, extension_name TEXT NOT NULL, definition TEXT NOT
  NULL, scope TEXT NOT NULL);
CREATE TABLE lapwing_store (name TEXT NOT NULL, value TEXT NOT NULL, PRIMARY KEY (name));
CREATE TABLE lapwing_revision (one INTEGER NOT NULL, revision INTEGER NOT NULL, PRIMARY KEY (one));
CREATE TABLE sites (id TEXT NOT NULL, latitude_deg DOUBLE NOT NULL, longitude_deg DOUBLE NOT NULL, altitude_m DOUBLE
  NOT NULL, revision INTEGER NOT NULL, PRIMARY KEY (id));
CREATE TABLE floors (site TEXT NOT NULL, id TEXT NOT NULL, name TEXT NOT NULL, up_m DOUBLE NOT NULL, plan_x_m DOUBLE
  NOT NULL, plan_y_m DOUBLE NOT NULL, plan_yaw_rad DOUBLE NOT NULL, PRIMARY KEY (site, id), FOREIGN KEY (site)
  REFERENCES sites ON DELETE CASCADE);
CREATE TABLE removed (layer TEXT NOT NULL, id TEXT NOT NULL, site TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT
  NOT NULL, at_ns INTEGER NOT NULL, revision INTEGER NOT NULL, PRIMARY KEY (layer, id));
CREATE INDEX removed_by_revision ON removed (revision);
CREATE TABLE grids (site TEXT NOT NULL, floor TEXT NOT NULL, name TEXT NOT NULL, resolution_m DOUBLE NOT NULL,
  origin_x_m DOUBLE NOT NULL, origin_y_m DOUBLE NOT NULL, origin_yaw_rad DOUBLE NOT NULL, writer TEXT NOT NULL,
  at_ns INTEGER NOT NULL, revision INTEGER NOT NULL, PRIMARY KEY (site, floor, name));
CREATE TABLE grid_tiles (site TEXT NOT NULL, floor TEXT NOT NULL, name TEXT NOT NULL, x INTEGER NOT NULL, y INTEGER
  NOT NULL, cells BLOB, at_ns INTEGER NOT NULL, revision INTEGER NOT NULL, PRIMARY KEY (site, floor, name, x, y),
  FOREIGN KEY (site, floor, name) REFERENCES grids ON DELETE CASCADE);
CREATE INDEX grid_tiles_by_revision ON grid_tiles (revision);
CREATE TABLE blobs (hash TEXT NOT NULL, bytes INTEGER NOT NULL, at_ns INTEGER NOT NULL, PRIMARY KEY (hash));
CREATE TABLE blob_bytes (hash TEXT NOT NULL, content BLOB NOT NULL, PRIMARY KEY (hash), FOREIGN KEY (hash)
  REFERENCES blobs ON DELETE CASCADE);
CREATE TABLE sessions (id TEXT NOT NULL, name TEXT NOT NULL, began_ns INTEGER NOT NULL, ended_ns INTEGER NOT NULL,
  PRIMARY KEY (id));
CREATE TABLE shown_chunks (session TEXT NOT NULL, feed TEXT NOT NULL, number INTEGER NOT NULL, first_ns INTEGER NOT
  NULL, last_ns INTEGER NOT NULL, whole_ns INTEGER, frames INTEGER NOT NULL, content BLOB NOT NULL, PRIMARY KEY
  (session, feed, number), FOREIGN KEY (session) REFERENCES sessions ON DELETE CASCADE);
CREATE INDEX shown_chunks_by_session_first_ns ON shown_chunks (session, first_ns);
CREATE INDEX shown_chunks_by_last_ns ON shown_chunks (last_ns);
CREATE TABLE slots (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom POLYGON NOT NULL, id TEXT NOT NULL, site
  TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL, revision
  INTEGER NOT NULL, state TEXT, taken_probability DOUBLE, seen_at DATETIME, seen_at_ns INTEGER, seen_by TEXT, name
  TEXT, UNIQUE (id));
CREATE INDEX slots_by_revision ON slots (revision);
CREATE TABLE walls (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom LINESTRING NOT NULL, id TEXT NOT NULL, site
  TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL, revision
  INTEGER NOT NULL, thickness_m DOUBLE, height_m DOUBLE, UNIQUE (id));
CREATE INDEX walls_by_revision ON walls (revision);
CREATE TABLE points_of_interest (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom POINT NOT NULL, id TEXT NOT
  NULL, site TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL,
  revision INTEGER NOT NULL, height_m DOUBLE, kind TEXT, name TEXT, text TEXT, picture TEXT, facing_rad DOUBLE,
  confidence DOUBLE, covariance_xx_m2 DOUBLE, covariance_xy_m2 DOUBLE, covariance_yy_m2 DOUBLE, UNIQUE (id));
CREATE INDEX points_of_interest_by_revision ON points_of_interest (revision);
CREATE VIRTUAL TABLE rtree_points_of_interest_geom USING rtree(id, minx, maxx, miny, maxy);
CREATE TRIGGER rtree_points_of_interest_geom_insert AFTER INSERT ON points_of_interest WHEN (NEW.geom NOT NULL AND
  NOT ST_IsEmpty(NEW.geom)) BEGIN INSERT OR REPLACE INTO rtree_points_of_interest_geom VALUES (NEW.fid,
  ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_points_of_interest_geom_update1 AFTER UPDATE OF geom ON points_of_interest WHEN OLD.fid =
  NEW.fid AND (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom)) BEGIN INSERT OR REPLACE INTO
  rtree_points_of_interest_geom VALUES (NEW.fid, ST_MinX(NEW.geom), ST_MaxX(NEW.geom), ST_MinY(NEW.geom),
  ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_points_of_interest_geom_update2 AFTER UPDATE OF geom ON points_of_interest WHEN OLD.fid =
  NEW.fid AND (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom)) BEGIN DELETE FROM rtree_points_of_interest_geom WHERE id =
  OLD.fid; END;
CREATE TRIGGER rtree_points_of_interest_geom_update3 AFTER UPDATE ON points_of_interest WHEN OLD.fid != NEW.fid AND
  (NEW.geom NOTNULL AND NOT ST_IsEmpty(NEW.geom)) BEGIN DELETE FROM rtree_points_of_interest_geom WHERE id =
  OLD.fid; INSERT OR REPLACE INTO rtree_points_of_interest_geom VALUES (NEW.fid, ST_MinX(NEW.geom),
  ST_MaxX(NEW.geom), ST_MinY(NEW.geom), ST_MaxY(NEW.geom)); END;
CREATE TRIGGER rtree_points_of_interest_geom_update4 AFTER UPDATE ON points_of_interest WHEN OLD.fid != NEW.fid AND
  (NEW.geom ISNULL OR ST_IsEmpty(NEW.geom)) BEGIN DELETE FROM rtree_points_of_interest_geom WHERE id IN (OLD.fid,
  NEW.fid); END;
CREATE TRIGGER rtree_points_of_interest_geom_delete AFTER DELETE ON points_of_interest WHEN OLD.geom NOT NULL BEGIN
  DELETE FROM rtree_points_of_interest_geom WHERE id = OLD.fid; END;
CREATE TABLE pictures (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom GEOMETRY NOT NULL, id TEXT NOT NULL,
  site TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL,
  revision INTEGER NOT NULL, image TEXT, thumbnail TEXT, media_type TEXT, width_px INTEGER, height_px INTEGER,
  taken_at DATETIME, taken_at_ns INTEGER, vehicle TEXT, camera_x_m DOUBLE, camera_y_m DOUBLE, up_m DOUBLE, camera_qx
  DOUBLE, camera_qy DOUBLE, camera_qz DOUBLE, camera_qw DOUBLE, UNIQUE (id));
CREATE INDEX pictures_by_revision ON pictures (revision);
CREATE TABLE tracks (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom LINESTRING NOT NULL, id TEXT NOT NULL,
  site TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL,
  revision INTEGER NOT NULL, vehicle TEXT, began_at DATETIME, began_at_ns INTEGER, times_s TEXT, ups_m TEXT,
  thinning INTEGER, UNIQUE (id));
CREATE INDEX tracks_by_revision ON tracks (revision);
CREATE TABLE areas (fid INTEGER PRIMARY KEY AUTOINCREMENT NOT NULL, geom POLYGON NOT NULL, id TEXT NOT NULL, site
  TEXT NOT NULL, floor TEXT NOT NULL, writer TEXT NOT NULL, at DATETIME NOT NULL, at_ns INTEGER NOT NULL, revision
  INTEGER NOT NULL, purpose TEXT, name TEXT, lowest_m DOUBLE, highest_m DOUBLE, UNIQUE (id));
CREATE INDEX areas_by_revision ON areas (revision);
INSERT INTO lapwing_store VALUES ('schema_version', '1');
INSERT INTO lapwing_revision VALUES (1, 4);
INSERT INTO sites VALUES ('office', 47.4, 8.5, 420.0, 1);
INSERT INTO floors VALUES ('office', '0', 'Ground floor', 0.0, 0.0, 0.0, 0.0);
INSERT INTO points_of_interest (geom, id, site, floor, writer, at, at_ns, revision, height_m, kind, name)
  VALUES (x'47500001E6100000010100000000000000000021403333333333B34740', 'door 1', 'office', '0', 'robot 1',
          '2026-03-01T09:30:00.123Z', 1772357400123456789, 4, 1.4, 'door', '221');
INSERT INTO blobs VALUES ('ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad', 3, 1772357400123456789);
)sql";

}  // namespace lapwing::map::testing
