#include "map/store/sql/wkb.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace lapwing::map::sql {
namespace {

std::string bytes_of(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  return bytes;
}

std::vector<LonLatGeometry> const samples = {
    LonLat{8.5, 47.25},
    LonLatLine{{8.5, 47.25}, {8.75, 47.5}, {180.25, -90.0}},
    LonLatArea{{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}}, {{1, 1}, {1, 2}, {2, 2}, {1, 1}}},
};

TEST(Wkb, OfAPointIsWhatTheStandardSays) {
  // POINT(2 4), by hand after OGC 06-103r4.
  EXPECT_EQ(shape_of(LonLat{2.0, 4.0}).wkb, bytes_of("010100000000000000000000400000000000001040"));
  // The same with the bytes the other way round.
  EXPECT_EQ(read_wkb(bytes_of("000000000140000000000000004010000000000000")), LonLatGeometry(LonLat(2.0, 4.0)));
}

TEST(Wkb, IsReadAsItWasWritten) {
  for (auto const& sample : samples) EXPECT_EQ(read_wkb(shape_of(sample).wkb), sample);
}

TEST(Wkb, ComesOutOfEveryWrapping) {
  for (auto const& sample : samples) {
    auto const shape = shape_of(sample);
    EXPECT_EQ(unwrap(shape.wkb), shape);
    EXPECT_EQ(unwrap(geopackage_blob(shape)), shape);
    EXPECT_EQ(unwrap(ewkb(shape)), shape);
  }
}

TEST(Wkb, KnowsItsBounds) {
  auto const shape = shape_of(samples[1]);
  EXPECT_EQ(shape.least_lon, 8.5);
  EXPECT_EQ(shape.most_lon, 180.25);
  EXPECT_EQ(shape.least_lat, -90.0);
  EXPECT_EQ(shape.most_lat, 47.5);
}

TEST(Wkb, TellsItsBoundsInTheHeaderOfAGeoPackage) {
  auto const shape = shape_of(samples[1]);
  auto const told = envelope_of(geopackage_blob(shape));
  ASSERT_TRUE(told);
  EXPECT_EQ(told->least_lon, shape.least_lon);
  EXPECT_EQ(told->most_lon, shape.most_lon);
  EXPECT_EQ(told->least_lat, shape.least_lat);
  EXPECT_EQ(told->most_lat, shape.most_lat);
  EXPECT_FALSE(envelope_of(geopackage_blob(shape_of(samples[0])))) << "a point is its own bounds";
  EXPECT_FALSE(envelope_of(geopackage_blob(shape).substr(0, 20)));
}

TEST(Wkb, CutAnywhereIsNone) {
  for (auto const& sample : samples) {
    auto const blob = geopackage_blob(shape_of(sample));
    for (std::size_t size = 0; size < blob.size(); ++size) EXPECT_FALSE(unwrap(blob.substr(0, size))) << size;
    EXPECT_FALSE(unwrap(blob + "x"));
  }
}

TEST(Wkb, TakesNoMemoryForCountsWithoutBytes) {
  EXPECT_FALSE(read_wkb(bytes_of("0102000000ffffffff")));
  EXPECT_FALSE(read_wkb(bytes_of("0103000000ffffffff")));
  EXPECT_FALSE(read_wkb(bytes_of("010300000001000000ffffffff")));
}

TEST(Wkb, HasNoPlaceForWhatIsNoNumber) {
  EXPECT_FALSE(read_wkb(shape_of(LonLat{std::numeric_limits<double>::quiet_NaN(), 1.0}).wkb));
  EXPECT_FALSE(unwrap(shape_of(LonLatArea()).wkb)) << "it has no points";
}

}  // namespace
}  // namespace lapwing::map::sql
