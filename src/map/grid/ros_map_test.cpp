#include "map/grid/ros_map.hpp"

#include <string>

#include <gtest/gtest.h>

namespace lapwing::map {
namespace {

/// A wall, a free cell, one that nobody is sure of, and two that were never seen.
OccupancyGrid few_cells() {
  OccupancyGrid grid(0.05);
  grid.set({-2, 3}, Evidence::of_probability(0.9));
  grid.set({-1, 3}, Evidence::of_probability(0.1));
  grid.set({0, 4}, Evidence::of_probability(0.5));
  return grid;
}

RosMap of(OccupancyGrid const& grid, RosMapOptions const& options = {}) {
  return ros_map(grid, seen_box(grid).value(), "floor", options);
}

std::string pixels(RosMap const& map) {
  return map.pgm.substr(map.pgm.find("\n255\n") + 5);
}

double number_of(std::string const& yaml, std::string const& key) {
  return std::stod(yaml.substr(yaml.find(key + ": ") + key.size() + 2));
}

TEST(RosMap, HasTheRowsFromAboveAndNoEmptyEdge) {
  auto const map = of(few_cells());
  EXPECT_TRUE(map.pgm.starts_with("P5\n")) << map.pgm.substr(0, 20);
  EXPECT_NE(map.pgm.find("\n3 2\n255\n"), std::string::npos);
  EXPECT_EQ(pixels(map), "\xCD\xCD\xCD" + std::string(1, '\0') + "\xFE\xCD");
  EXPECT_NE(map.yaml.find("image: floor.pgm\nmode: trinary\nresolution: 0.05\norigin: [-0.1, 0.15, 0]"),
            std::string::npos)
      << map.yaml;
}

TEST(RosMap, IsReadWithUnknownCellsUnknown) {
  // By the rule of map_server: occupied above occupied_thresh, free below free_thresh, else unknown.
  auto const yaml = of(few_cells()).yaml;
  auto const darkness = [](int value) { return (255 - value) / 255.0; };
  EXPECT_GT(darkness(0), number_of(yaml, "occupied_thresh"));
  EXPECT_LT(darkness(254), number_of(yaml, "free_thresh"));
  EXPECT_GT(darkness(205), number_of(yaml, "free_thresh"));
  EXPECT_LT(darkness(205), number_of(yaml, "occupied_thresh"));
}

TEST(RosMap, OfTheRawModeHasPercent) {
  auto const map = of(few_cells(), {.is_raw = true});
  EXPECT_EQ(pixels(map), "\xFF\xFF\x32\x5A\x0A\xFF");
  EXPECT_NE(map.yaml.find("mode: raw"), std::string::npos);
}

TEST(SeenBox, IsNothingWhereNothingWasSeen) {
  EXPECT_FALSE(seen_box(OccupancyGrid(0.05)));
}

}  // namespace
}  // namespace lapwing::map
