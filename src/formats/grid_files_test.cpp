// Occupancy grids in files: GeoTIFF keeps all, ROS maps what map servers know.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "base/testing/temporary_folder.hpp"
#include "formats/grid_geotiff.hpp"
#include "formats/ros_map.hpp"

namespace lapwing::formats {
namespace {

using map::Cell;
using map::Evidence;
using map::OccupancyGrid;
namespace files = std::filesystem;

struct GridFilesTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  files::path folder = temporary.path();
  geo::Site site = geo::Site::make("office", geo::Wgs84::from_degrees(41.1784, -8.5981, 120.0)).value();

  /// A turned room of odd size on both sides of the grid's origin, with a hole that was never seen.
  static OccupancyGrid room() {
    OccupancyGrid grid(0.05, {map::SitePoint(12.0, -7.0), 0.3});
    std::mt19937 random(3);
    for (int x = -37; x < 300; ++x) {
      for (int y = -20; y < 100; ++y) {
        if (x > 10 && x < 20 && y > 10 && y < 20) continue;
        bool const is_wall = x == -37 || x == 299 || y == -20 || y == 99;
        grid.set({x, y}, Evidence::of_log_odds((is_wall ? 3.0 : -3.0) + static_cast<double>(random() % 256) / 256.0));
      }
    }
    return grid;
  }

  /// The evidence at the same place of the site.
  static Evidence same_place(OccupancyGrid const& of, OccupancyGrid const& like, Cell cell) {
    auto const place = like.site_from_grid() * like.centre_of(cell);
    return of.at(of.cell_at(of.site_from_grid().inverse() * place));
  }

  files::path write(std::string const& name, std::string const& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
    return folder / name;
  }
};

TEST_F(GridFilesTest, GeoTiffKeepsEveryCellExactly) {
  auto const grid = room();
  auto const path = folder / "room.tif";
  auto const written = write_grid_geotiff(grid, site, path);
  ASSERT_TRUE(written) << written.error().message;
  auto const read = read_grid_geotiff(path, site);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_NEAR(read->resolution_m(), 0.05, 1e-6);
  for (int x = -40; x < 303; ++x) {
    for (int y = -23; y < 103; ++y) ASSERT_EQ(same_place(*read, grid, {x, y}), grid.at({x, y})) << x << ' ' << y;
  }
}

TEST_F(GridFilesTest, RosMapsKeepFreeTakenAndUnknown) {
  auto const grid = room();
  ASSERT_TRUE(write_ros_map(grid, folder, "map"));
  auto const read = read_ros_map(folder / "map.yaml");
  ASSERT_TRUE(read) << read.error().message;
  for (int x = -40; x < 303; ++x) {
    for (int y = -23; y < 103; ++y) {
      auto const was = grid.at({x, y});
      auto const is = same_place(*read, grid, {x, y});
      ASSERT_EQ(is.is_seen(), was.is_seen()) << x << ' ' << y;
      if (was.is_seen()) {
        ASSERT_EQ(is.probability() > 0.5, was.probability() > 0.5);
      }
    }
  }
}

TEST_F(GridFilesTest, RawRosMapsKeepPercent) {
  auto const grid = room();
  ASSERT_TRUE(write_ros_map(grid, folder, "map", {.is_raw = true}));
  auto const read = read_ros_map(folder / "map.yaml");
  ASSERT_TRUE(read) << read.error().message;
  for (int x = -37; x < 300; ++x)
    ASSERT_NEAR(same_place(*read, grid, {x, 5}).probability(), grid.at({x, 5}).probability(), 0.006);
}

TEST_F(GridFilesTest, ReadsWhatMapSaverWrites) {
  std::string pgm = "P5\n3 2\n255\n";
  for (int const value : {0, 254, 205, 254, 254, 0}) pgm.push_back(static_cast<char>(value));
  write("m.pgm", pgm);
  auto const read = read_ros_map(write("m.yaml",
                                       "image: m.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: "
                                       "0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n"));
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_GT(read->at({0, 1}).probability(), 0.9) << "the first row is the upper one";
  EXPECT_LT(read->at({1, 1}).probability(), 0.1);
  EXPECT_FALSE(read->at({2, 1}).is_seen());
  EXPECT_GT(read->at({2, 0}).probability(), 0.9);
  EXPECT_NEAR((read->site_from_grid() * geo::Point<map::GridFrame>(0.0, 0.0)).y(), 2.0, 1e-12);
}

TEST_F(GridFilesTest, MistakesInRosMapsAreTold) {
  auto const refused = [&](std::string const& yaml) {
    auto const read = read_ros_map(write("bad.yaml", yaml));
    return read ? std::string() : read.error().message + "|" + read.error().hint;
  };
  EXPECT_NE(refused("resolution: 0.05\norigin: [0,0,0]\n").find("`image`"), std::string::npos);
  EXPECT_NE(refused("image: [a\n").find("line"), std::string::npos);
  EXPECT_NE(refused("image: a.pgm\nresolution: tall\norigin: [0,0,0]\n").find("line 2"), std::string::npos);
  EXPECT_NE(refused("image: a.pgm\nresolution: 0\norigin: [0,0,0]\n").find("`resolution`"), std::string::npos);
  EXPECT_NE(refused("image: a.pgm\nresolution: .nan\norigin: [0,0,0]\n").find("`resolution`"), std::string::npos);
  EXPECT_NE(refused("image: a.pgm\nresolution: 0.1\norigin: [.inf,0,0]\n").find("`origin`"), std::string::npos);
  EXPECT_NE(refused("image: a.pgm\nresolution: 0.1\norigin: [0,0,0]\nmode: maybe\n").find("`mode`"), std::string::npos);
  EXPECT_NE(refused("image: missing.pgm\nresolution: 0.1\norigin: [0,0,0]\n").find("missing.pgm"), std::string::npos);
  EXPECT_NE(refused("just words"), "");
  EXPECT_EQ(read_ros_map(folder / "none.yaml").error().kind, base::ErrorKind::io);
}

TEST_F(GridFilesTest, EmptyGridsAndOtherPicturesAreRefused) {
  EXPECT_FALSE(write_ros_map(OccupancyGrid(0.1), folder, "empty"));
  EXPECT_FALSE(write_grid_geotiff(OccupancyGrid(0.1), site, folder / "empty.tif"));
  EXPECT_FALSE(read_grid_geotiff(write("no.tif", "II*"), site));
}

}  // namespace
}  // namespace lapwing::formats
