#include "host/simulation/world_place.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "base/testing/temporary_folder.hpp"

namespace lapwing::host {
namespace {

struct WorldPlaceTest : ::testing::Test {
  base::Result<geo::Wgs84> place_of(std::string const& text) const {
    std::ofstream(folder.path() / "world.toml") << text;
    return world_place((folder.path() / "world.toml").string());
  }
  base::testing::TemporaryFolder folder;
};

TEST_F(WorldPlaceTest, IsTheAnchorWhateverElseStandsInTheFile) {
  auto const place = place_of("name = \"Park\"\nanchor = [41.1780, -8.5980, 90]\n[[row]]\nstart = [1, 2]\n");
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->lat_deg(), 41.1780, 1e-9);
  EXPECT_NEAR(place->lon_deg(), -8.5980, 1e-9);
  EXPECT_DOUBLE_EQ(place->alt_m, 90.0);
}

TEST_F(WorldPlaceTest, IsAnErrorWhereThereIsNone) {
  for (auto const* text : {"", "name = \"Park\"\n", "anchor = [41, -8]\n", "anchor = [91, 0, 0]\n",
                           "anchor = [0, 181, 0]\n", "anchor = \"here\"\n", "anchor = ["}) {
    auto const place = place_of(text);
    ASSERT_FALSE(place) << text;
    EXPECT_EQ(place.error().kind, base::ErrorKind::invalid_input);
  }
  EXPECT_FALSE(world_place((folder.path() / "absent.toml").string()));
}

}  // namespace
}  // namespace lapwing::host
