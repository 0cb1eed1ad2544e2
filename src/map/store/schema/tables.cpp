#include "map/store/schema/tables.hpp"

#include <map>
#include <string>

#include <fmt/format.h>

#include "map/features/properties.hpp"

namespace lapwing::map::schema {

namespace {

using sql::Column;
using sql::Table;
using enum sql::ColumnKind;

std::string shape_of(LayerKind layer) {
  switch (layer) {
    case LayerKind::slots:
    case LayerKind::areas: return "POLYGON";
    case LayerKind::walls:
    case LayerKind::tracks: return "LINESTRING";
    case LayerKind::points_of_interest: return "POINT";
    case LayerKind::pictures: return "GEOMETRY";
  }
  std::unreachable();
}

sql::ColumnKind kind_of(PropertyKind kind) {
  switch (kind) {
    case PropertyKind::boolean: return boolean;
    case PropertyKind::integer: return integer;
    case PropertyKind::real: return real;
    case PropertyKind::text: return text;
    case PropertyKind::time: return time;
  }
  std::unreachable();
}

/// GeoPackage's times end at milliseconds: beside each stands what it was exactly, in nanoseconds since 1970.
void add_column(std::vector<Column>& columns, std::string const& name, sql::ColumnKind kind, bool is_required) {
  columns.push_back({name, kind, is_required});
  if (kind == time) columns.push_back({name + "_ns", integer, is_required});
}

Table make_layer_table(LayerKind layer) {
  std::vector<Column> columns = {
      {"fid", key},          {"geom", shape, true, shape_of(layer)},
      {"id", text, true},    {"site", text, true},
      {"floor", text, true}, {"writer", text, true},
  };
  add_column(columns, "at", time, true);
  columns.push_back({"held_over", text});
  columns.push_back({"revision", integer, true});
  for (auto const& property : properties_of(layer))
    add_column(columns, std::string(property.name), kind_of(property.kind), false);
  return {.name = std::string(name_of(layer)),
          .about = fmt::format("The layer {} of the map", name_of(layer)),
          .columns = std::move(columns),
          .key = {"id"},
          .indices = {{"revision"}}};
}

}  // namespace

Table const& layer_table(LayerKind layer) {
  static auto const tables = [] {
    std::map<LayerKind, Table> made;
    for (auto const kind : all_layers) made.emplace(kind, make_layer_table(kind));
    return made;
  }();
  return tables.at(layer);
}

namespace table {

Table const about = {.name = "lapwing_store",
                     .about = "What is known of the store itself",
                     .columns = {{"name", text, true}, {"value", text, true}},
                     .key = {"name"}};

Table const revision = {.name = "lapwing_revision",
                        .about = "How many batches have been written; who writes holds its one row",
                        .columns = {{"one", integer, true}, {"revision", integer, true}},
                        .key = {"one"}};

Table const sites = {.name = "sites",
                     .about = "Map frames: x east, y north, in metres from the anchor",
                     .columns = {{"id", text, true},
                                 {"latitude_deg", real, true},
                                 {"longitude_deg", real, true},
                                 {"altitude_m", real, true},
                                 {"revision", integer, true}},
                     .key = {"id"}};

Table const floors = {.name = "floors",
                      .about = "Levels of sites, and where their plans lie",
                      .columns = {{"site", text, true},
                                  {"id", text, true},
                                  {"name", text, true},
                                  {"up_m", real, true},
                                  {"plan_x_m", real, true},
                                  {"plan_y_m", real, true},
                                  {"plan_yaw_rad", real, true}},
                      .key = {"site", "id"},
                      .owner = {"sites", {"site"}}};

Table const removed = {.name = "removed",
                       .about = "When features were taken away, so that older news of them are known as such",
                       .columns = {{"layer", text, true},
                                   {"id", text, true},
                                   {"site", text, true},
                                   {"floor", text, true},
                                   {"writer", text, true},
                                   {"at_ns", integer, true},
                                   {"revision", integer, true}},
                       .key = {"layer", "id"},
                       .indices = {{"revision"}}};

Table const grids = {.name = "grids",
                     .about = "Occupancy grids: where their cells lie",
                     .columns = {{"site", text, true},
                                 {"floor", text, true},
                                 {"name", text, true},
                                 {"resolution_m", real, true},
                                 {"origin_x_m", real, true},
                                 {"origin_y_m", real, true},
                                 {"origin_yaw_rad", real, true},
                                 {"writer", text, true},
                                 {"at_ns", integer, true},
                                 {"revision", integer, true}},
                     .key = {"site", "floor", "name"}};

Table const grid_tiles = {.name = "grid_tiles",
                          .about = "256 x 256 cells each: zlib, 16 bits a cell, row by row from the lowest",
                          .columns = {{"site", text, true},
                                      {"floor", text, true},
                                      {"name", text, true},
                                      {"x", integer, true},
                                      {"y", integer, true},
                                      {"cells", bytes},
                                      {"at_ns", integer, true},
                                      {"revision", integer, true}},
                          .key = {"site", "floor", "name", "x", "y"},
                          .indices = {{"revision"}},
                          .owner = {"grids", {"site", "floor", "name"}}};

Table const blobs = {
    .name = "blobs",
    .about = "Pictures by the SHA-256 of their bytes",
    .columns = {{"hash", text, true}, {"bytes", integer, true}, {"at_ns", integer, true}, {"media_type", text, true}},
    .key = {"hash"},
    .indices = {{"at_ns"}}};

Table const blob_bytes = {.name = "blob_bytes",
                          .about = "The bytes of pictures, where they do not lie in files",
                          .columns = {{"hash", text, true}, {"content", bytes, true}},
                          .key = {"hash"},
                          .owner = {"blobs", {"hash"}}};

Table const sessions = {
    .name = "sessions",
    .about = "Runs of stations whose past is kept",
    .columns = {{"id", text, true}, {"name", text, true}, {"began_ns", integer, true}, {"ended_ns", integer, true}},
    .key = {"id"}};

Table const shown_chunks = {.name = "shown_chunks",
                            .about = "What viewers were shown: frames of one feed in the order of time, zlib",
                            .columns = {{"session", text, true},
                                        {"feed", text, true},
                                        {"number", integer, true},
                                        {"first_ns", integer, true},
                                        {"last_ns", integer, true},
                                        {"whole_ns", integer},
                                        {"frames", integer, true},
                                        {"content", bytes, true}},
                            .key = {"session", "feed", "number"},
                            .indices = {{"session", "first_ns"}, {"last_ns"}},
                            .owner = {"sessions", {"session"}}};

Table const tile_shades = {
    .name = "tile_shades",
    .about = "How tiles of grids looked, by a hash of that: zlib, 8 bits a cell",
    .columns = {{"name", text, true}, {"base", text, true}, {"last_ns", integer, true}, {"shades", bytes, true}},
    .key = {"name"},
    .indices = {{"base"}, {"last_ns"}}};

}  // namespace table

std::vector<Table const*> const& all_tables() {
  static auto const tables = [] {
    std::vector<Table const*> all = {&table::about,      &table::revision, &table::sites,        &table::floors,
                                     &table::removed,    &table::grids,    &table::grid_tiles,   &table::blobs,
                                     &table::blob_bytes, &table::sessions, &table::shown_chunks, &table::tile_shades};
    for (auto const layer : all_layers) all.push_back(&layer_table(layer));
    return all;
  }();
  return tables;
}

}  // namespace lapwing::map::schema
