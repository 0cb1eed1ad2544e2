#include "station/map/grids/grids_feed.hpp"

#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "station/testing/feed_viewer.hpp"
#include "station/testing/grid_demo.hpp"

namespace lapwing::station {
namespace {

using nlohmann::json;
using namespace std::chrono_literals;
using testing::put_tiles;

struct GridsFeedTest : ::testing::Test, testing::MapDemo {
  GridsFeedTest()
      : viewer(feed, [this](json const& message, bool is_whole) {
          EXPECT_EQ(message["type"], "grids");
          EXPECT_EQ(message["full"], is_whole);
          if (is_whole) grids.clear();
          for (auto const& grid : message["grids"]) grids[grid["name"]] = grid;
        }) {}

  GridsFeed feed{live, std::make_shared<GridPlaces>(live), "run"};
  std::map<std::string, json> grids;
  testing::FeedViewer viewer;
};

TEST_F(GridsFeedTest, TellsWhichGridsThereAre) {
  viewer.catch_up();
  EXPECT_EQ(viewer.messages(), 1U) << "none is news, too";
  put_tiles(*this, {{0, 0}, {1, 0}}, now());
  viewer.catch_up();
  auto const& grid = grids["floor"];
  EXPECT_EQ(grid["site"], "yard");
  EXPECT_EQ(grid["floor"], "0");
  EXPECT_EQ(grid["resolution_m"], 0.5);
  EXPECT_EQ(grid["writer"], "robot 1");
  EXPECT_EQ(grid["full"], true);
  EXPECT_NEAR(grid["bounds"][0].get<double>(), 8.0, 1e-6);
  EXPECT_NEAR(grid["bounds"][2].get<double>(), 8.0 + 256.0 / 76'057.0, 1e-5) << "256 m at that latitude";
  EXPECT_NEAR(grid["tiling"]["x"][0].get<double>(), 128.0 / 76'057.0, 1e-5);
  EXPECT_NEAR(grid["tiling"]["y"][1].get<double>(), 128.0 / 111'170.0, 1e-5);
  EXPECT_EQ(grid["pictures"], fmt::format("/api/v1/grids/yard/0/floor/tiles/{{z}}/{{x}}/{{y}}.png?revision=run-{}",
                                          grid["revision"].dump()));
}

TEST_F(GridsFeedTest, TellsWhichTilesChanged) {
  put_tiles(*this, {{0, 0}, {1, 0}, {-1, -1}}, now());
  viewer.catch_up();
  EXPECT_FALSE(viewer.take_one(1000));
  put_tiles(*this, {{-1, -1}}, now() + 1s);
  viewer.catch_up();
  EXPECT_EQ(grids["floor"]["full"], false);
  EXPECT_EQ(grids["floor"]["changed"], json::parse("[[-1,-1]]"));
}

TEST_F(GridsFeedTest, TellsAllOfWhatMovedOrIsMadeAnew) {
  put_tiles(*this, {{0, 0}}, now());
  viewer.catch_up();
  auto const before = grids["floor"];
  live.put_site(testing::yard(geo::Wgs84::from_degrees(48.0, 8.0)));
  viewer.catch_up();
  EXPECT_EQ(grids["floor"]["full"], true);
  EXPECT_NE(grids["floor"]["pictures"], before["pictures"]) << "what browsers keep of it lies elsewhere";
  EXPECT_NEAR(grids["floor"]["bounds"][1].get<double>() - before["bounds"][1].get<double>(), 1.0, 0.001);
  put_tiles(*this, {{0, 0}}, now() + 1s, testing::floor_grid, 0.25);
  viewer.catch_up();
  EXPECT_EQ(grids["floor"]["full"], true);
  EXPECT_EQ(grids["floor"]["resolution_m"], 0.25);
}

TEST_F(GridsFeedTest, GoesOnWhereItLeftOff) {
  for (int i = 0; i < 10; ++i) put_tiles(*this, {{i, 0}}, now(), {"yard", "0", fmt::format("{}", i)});
  live.put_site(testing::yard(geo::Wgs84::from_degrees(48.0, 8.0)));
  put_tiles(*this, {{7, 0}}, now() + 1s, {"yard", "0", "extra"});
  viewer.catch_up(1);
  EXPECT_EQ(grids.size(), 11U);
}

}  // namespace
}  // namespace lapwing::station
