// Archives of map tiles in SQLite, as other programs write them.
#include "map/basemaps/mbtiles.hpp"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <fstream>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::map {
namespace {

struct MbTilesTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  std::filesystem::path file = temporary.path() / "archive.mbtiles";

  void write(std::string const& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(file.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
    sqlite3_close(database);
  }
};

constexpr auto tables =
    "CREATE TABLE metadata (name text, value text);"
    "CREATE TABLE tiles (zoom_level integer, tile_column integer, tile_row integer, tile_data blob);";

TEST_F(MbTilesTest, CountsRowsFromTheSouth) {
  write(std::string(tables) +
        "INSERT INTO tiles VALUES (1, 0, 1, 'north'), (1, 0, 0, 'south');"
        "INSERT INTO metadata VALUES ('name', 'Yard'), ('format', 'webp'), ('minzoom', '1'), ('maxzoom', '4'),"
        "('bounds', '-10, -5,10,5'), ('attribution', 'us');");
  auto const archive = TileArchive::open(file);
  ASSERT_TRUE(archive) << archive.error().message;
  EXPECT_EQ((*archive)->tile({1, 0, 0}).value(), "north");
  EXPECT_EQ((*archive)->tile({1, 0, 1}).value(), "south");
  EXPECT_EQ((*archive)->tile({1, 1, 1}).value(), std::nullopt);
  EXPECT_EQ((*archive)->tile({30, 1, 1}).value(), std::nullopt);
  auto const& info = (*archive)->info();
  EXPECT_EQ(info.name, "Yard");
  EXPECT_EQ(info.media_type, "image/webp");
  EXPECT_EQ(info.greatest_zoom, 4U);
  EXPECT_EQ(info.bounds_deg, (std::array{-10.0, -5.0, 10.0, 5.0}));
}

TEST_F(MbTilesTest, NamesTheLayersOfVectorTiles) {
  write(
      std::string(tables) +
      R"(INSERT INTO metadata VALUES ('format', 'pbf'), ('json', '{"vector_layers":[{"id":"water"},{"id":7},8,{"id":"roads"}]}');)");
  auto const archive = TileArchive::open(file).value();
  auto const& info = archive->info();
  EXPECT_EQ(info.encoding, "gzip");
  EXPECT_EQ(info.vector_layers, std::vector<std::string>({"water", "roads"}));
}

TEST_F(MbTilesTest, ReadsTilesFromViews) {
  write(
      "CREATE TABLE metadata (name text, value text); CREATE TABLE images (id integer, data blob);"
      "INSERT INTO images VALUES (1, 'seen'); CREATE TABLE map (z integer, x integer, y integer, id integer);"
      "INSERT INTO map VALUES (0, 0, 0, 1); CREATE VIEW tiles AS SELECT z AS zoom_level, x AS tile_column, y AS "
      "tile_row,"
      "data AS tile_data FROM map JOIN images ON map.id = images.id;");
  auto const archive = TileArchive::open(file);
  ASSERT_TRUE(archive);
  EXPECT_EQ((*archive)->tile({0, 0, 0}).value(), "seen");
}

TEST_F(MbTilesTest, WhatIsNoArchiveIsToldWithTheReason) {
  EXPECT_EQ(TileArchive::open(file).error().kind, base::ErrorKind::io);
  write("CREATE TABLE cars (name text);");
  EXPECT_NE(TileArchive::open(file).error().message.find("no map tiles"), std::string::npos);
  std::ofstream(file, std::ios::trunc) << "II*";
  auto const other = TileArchive::open(file);
  EXPECT_NE(other.error().message.find("neither MBTiles nor PMTiles"), std::string::npos);
  EXPECT_NE(other.error().hint.find("lapwing basemap"), std::string::npos);
}

TEST_F(MbTilesTest, CountsWithAnUntidyMetadataTable) {
  write(std::string(tables) +
        "INSERT INTO metadata VALUES ('maxzoom', 'many'), ('bounds', 'everywhere'), ('format', NULL);");
  auto const archive = TileArchive::open(file);
  ASSERT_TRUE(archive);
  EXPECT_EQ((*archive)->info().greatest_zoom, 22U);
  EXPECT_EQ((*archive)->info().bounds_deg[0], -180.0);
}

}  // namespace
}  // namespace lapwing::map
