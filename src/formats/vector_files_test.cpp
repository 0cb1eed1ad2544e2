// What goes into a file comes out again, and what comes from elsewhere is taken or refused with its place.
#include "formats/vector_files.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/testing/temporary_folder.hpp"
#include "formats/testing/same_map.hpp"
#include "map/testing/random_features.hpp"

namespace lapwing::formats {
namespace {

using map::LayerKind;
namespace files = std::filesystem;

struct VectorFilesTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  files::path folder = temporary.path();

  static geo::Site yard(double lon_deg = -8.5981) {
    return geo::Site::make("yard", geo::Wgs84::from_degrees(41.1784, lon_deg, 120.0),
                           {{.id = "0"}, {.id = "1", .name = "First", .up_m = 3.5}})
        .value();
  }

  static MapContents some_of_each(geo::Site const& site, int count = 20) {
    MapContents contents;
    contents.sites.emplace(site.id(), site);
    map::testing::RandomFeatures random(7);
    for (auto const layer : map::all_layers) {
      for (int i = 0; i < count; ++i) {
        auto feature = random.feature(layer, fmt::format("{}-{}", map::name_of(layer), i), site.id());
        if (i % 3 == 0) feature.floor = "1";
        contents.features.push_back(std::move(feature));
      }
    }
    return contents;
  }

  files::path write(std::string const& name, std::string const& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
};

struct Case {
  VectorFormat format;
  std::string file;
  friend std::ostream& operator<<(std::ostream& out, Case const& one) { return out << one.file; }
};

struct RoundTrip : VectorFilesTest, ::testing::WithParamInterface<Case> {};

TEST_P(RoundTrip, EveryLayerComesOutAsItWentIn) {
  auto const contents = some_of_each(yard());
  auto const path = folder / GetParam().file;
  auto const written = write_vectors(contents, GetParam().format, path);
  ASSERT_TRUE(written) << written.error().message;
  auto const read = read_vectors(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(testing::first_difference(contents, *read), "");
}

TEST_P(RoundTrip, AcrossTheAntimeridianToo) {
  auto const contents = some_of_each(yard(179.9999), 5);
  auto const path = folder / GetParam().file;
  ASSERT_TRUE(write_vectors(contents, GetParam().format, path));
  auto const read = read_vectors(path);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(testing::first_difference(contents, *read), "");
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Values(Case{VectorFormat::geopackage, "map.gpkg"},
                                           Case{VectorFormat::geojson, "geojson"}, Case{VectorFormat::kml, "map.kml"},
                                           Case{VectorFormat::kmz, "map.kmz"}, Case{VectorFormat::csv, "csv"}));

TEST_F(VectorFilesTest, AFileFromElsewhereGetsTheSiteAndLayerThatItIsReadFor) {
  auto const path = write("doors.geojson", R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{"name":"221","confidence":"0.75"},"geometry":{"type":"Point","coordinates":[-8.5981,41.1784]}}]})");
  EXPECT_NE(read_vectors(path).error().message.find("none of the map's layers"), std::string::npos);
  auto const read = read_vectors(path, {.layer = LayerKind::points_of_interest, .site = yard()});
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->features.size(), 1U);
  auto const& point = std::get<map::PointOfInterest>(read->features[0].content);
  EXPECT_EQ(point.name, "221");
  EXPECT_EQ(point.confidence, 0.75) << "a number that was kept as text";
  EXPECT_NEAR(point.position.x(), 0.0, 1e-3);
  EXPECT_EQ(read->features[0].account.writer, "import");
}

TEST_F(VectorFilesTest, CoordinatesOfOtherSystemsAreBroughtHere) {
  auto const path =
      write("areas.geojson",
            R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:3857"}},"features":[
    {"type":"Feature","properties":{},"geometry":{"type":"MultiPolygon","coordinates":[[[[-957136,5038340],[-957036,5038340],[-957036,5038440],[-957136,5038340]]]]}}]})");
  auto const read = read_vectors(path);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->sites.count("imported"), 1U);
  EXPECT_NEAR(read->sites.find("imported")->second.anchor().lat_deg(), 41.17, 0.05);
}

TEST_F(VectorFilesTest, MistakesAreToldWithTheirPlace) {
  auto const refused = [&](std::string const& geometry, std::string const& properties = "{}") {
    auto const path =
        write("slots.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":)" +
                                   properties + R"(,"geometry":)" + geometry + "}]}");
    auto const read = read_vectors(path, {.site = yard()});
    return read ? std::string() : read.error().message;
  };
  std::string const square =
      R"({"type":"Polygon","coordinates":[[[-8.598,41.178],[-8.597,41.178],[-8.597,41.179],[-8.598,41.178]]]})";
  EXPECT_EQ(refused(square), "");
  EXPECT_NE(refused(square, R"({"taken_probability":1.3})").find("`slots`, feature 0"), std::string::npos);
  EXPECT_NE(refused(square, R"({"state":"full"})").find("`state`"), std::string::npos);
  EXPECT_NE(refused(square, R"({"seen_at":"yesterday"})").find("\"yesterday\", not a time"), std::string::npos);
  EXPECT_NE(refused(R"({"type":"Point","coordinates":[-8.598,41.178]})"), "");
  EXPECT_NE(
      refused(
          R"({"type":"Polygon","coordinates":[[[-8.598,41.178],[-8.597,41.179],[-8.597,41.178],[-8.598,41.179],[-8.598,41.178]]]})"),
      "")
      << "a bow tie";
  EXPECT_NE(refused("null").find("no geometry"), std::string::npos);
  EXPECT_NE(refused(R"({"type":"Polygon","coordinates":[[[20,41.178],[20.1,41.178],[20,41.179],[20,41.178]]]})"), "")
      << "far from the site";
  EXPECT_NE(refused(square, R"({"site":"moon"})"), "") << refused(square, R"({"site":"moon"})");
}

TEST_F(VectorFilesTest, WhatIsNoFileOfMapsIsRefused) {
  EXPECT_FALSE(read_vectors(folder / "missing.gpkg"));
  EXPECT_FALSE(read_vectors(write("text.gpkg", "hello")));
  EXPECT_FALSE(read_vectors(write("deep.geojson", std::string(100'000, '['))));
  EXPECT_FALSE(read_vectors(folder)) << "only files that cannot be read";
}

TEST_F(VectorFilesTest, AnExistingFileIsReplaced) {
  auto const path = folder / "map.gpkg";
  ASSERT_TRUE(write_vectors(some_of_each(yard(), 9), VectorFormat::geopackage, path));
  ASSERT_TRUE(write_vectors(some_of_each(yard(), 2), VectorFormat::geopackage, path));
  EXPECT_EQ(read_vectors(path)->features.size(), 2U * map::all_layers.size());
}

TEST_F(VectorFilesTest, AFolderThatCannotBeMadeIsTold) {
  auto const blocked = write("file", "");
  auto const written = write_vectors(some_of_each(yard(), 1), VectorFormat::geojson, blocked / "inside");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().kind, base::ErrorKind::io);
}

}  // namespace
}  // namespace lapwing::formats
