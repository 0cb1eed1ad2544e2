// Where a station's map is kept, and what happens where it cannot be.
#include "host/map/station_map.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

using ::lapwing::map::LayerKind;
using ::lapwing::map::LiveMap;
namespace fs = std::filesystem;

struct StationMapTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  fs::path folder = temporary.path() / "data";
  base::Loop loop{base::Loop::Pace{.unpaced = true, .begins_at = base::UtcTime(std::chrono::hours(500'000))}};
  base::LogHub hub;
  base::Logger log{hub, "test"};

  void SetUp() override { setenv("XDG_DATA_HOME", folder.c_str(), 1); }
  void TearDown() override { unsetenv("XDG_DATA_HOME"); }
  std::unique_ptr<StationMap> open(LiveMap& map, StoreSettings const& settings = {}) {
    auto kept = StationMap::open(loop, map, settings, log);
    EXPECT_TRUE(kept) << kept.error().message;
    return kept ? *std::move(kept) : nullptr;
  }
  void put_wall(LiveMap& map) const {
    map.put_site(geo::Site::make("yard", geo::Wgs84::from_degrees(41.0, -8.0)).value());
    auto const put = map.put({.id = "w",
                              .site = "yard",
                              .account = {.writer = "1", .at = loop.utc_now()},
                              .content = ::lapwing::map::Wall{.line = {{{0.0, 0.0}, {5.0, 0.0}}}}});
    ASSERT_TRUE(put) << put.error().message;
  }
  LiveMap new_map() {
    return LiveMap([this] { return loop.utc_now(); });
  }
};

TEST_F(StationMapTest, IsThereAgainAtTheNextStart) {
  {
    auto map = new_map();
    auto const kept = open(map);
    put_wall(map);
  }
  auto map = new_map();
  auto const kept = open(map);
  EXPECT_EQ(map.size(LayerKind::walls), 1U);
  EXPECT_EQ(kept->address(), usual_store().string());
}

TEST_F(StationMapTest, ASecondStationKeepsItsOwnWhileItRuns) {
  auto first_map = new_map();
  auto const first = open(first_map);
  fs::path elsewhere;
  {
    auto second_map = new_map();
    auto const second = open(second_map);
    elsewhere = second->address();
    EXPECT_NE(elsewhere, usual_store());
    EXPECT_TRUE(fs::exists(elsewhere));
  }
  EXPECT_FALSE(fs::exists(elsewhere));
}

TEST_F(StationMapTest, APlaceThatWasNamedIsThatOneOrAnError) {
  auto first_map = new_map();
  auto const first = open(first_map);
  auto second_map = new_map();
  auto const second = StationMap::open(loop, second_map,
                                       {.place = StoreSettings::Place::named, .address = usual_store().string()}, log);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, base::ErrorKind::refused);
}

}  // namespace
}  // namespace lapwing::host
