// Pictures on the ground, and ground that becomes a base map.
#include <gtest/gtest.h>

#include <gdal_priv.h>

#include <fstream>

#include "base/testing/temporary_folder.hpp"
#include "formats/base_map.hpp"
#include "formats/internal/gdal.hpp"
#include "formats/picture_geotiff.hpp"
#include "map/basemaps/tile_archive.hpp"

namespace lapwing::formats {
namespace {

namespace files = std::filesystem;

struct PicturesTest : ::testing::Test {
  base::testing::TemporaryFolder temporary;
  files::path folder = temporary.path();
  geo::Site site = geo::Site::make("yard", geo::Wgs84::from_degrees(41.1784, -8.5981, 120.0)).value();

  void SetUp() override { internal::start_gdal(); }

  /// A PNG whose left half is red and right half blue.
  [[nodiscard]] std::string two_halves(int width, int height) const {
    GDALDatasetUniquePtr const whole(
        GetGDALDriverManager()->GetDriverByName("MEM")->Create("", width, height, 3, GDT_Byte, nullptr));
    for (int band = 1; band <= 3; ++band) {
      std::vector<std::uint8_t> values(static_cast<std::size_t>(width * height));
      for (int i = 0; i < width * height; ++i)
        values[static_cast<std::size_t>(i)] = (i % width < width / 2 ? band == 1 : band == 3) ? 255 : 0;
      EXPECT_EQ(whole->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, width, height, values.data(), width, height,
                                                     GDT_Byte, 0, 0, nullptr),
                CE_None);
    }
    auto const path = folder / "halves.png";
    GDALDatasetUniquePtr(GetGDALDriverManager()->GetDriverByName("PNG")->CreateCopy(path.c_str(), whole.get(), false,
                                                                                    nullptr, nullptr, nullptr))
        .reset();
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  /// The values of the four bands where a point of the site lies.
  static std::array<int, 4> colour_at(files::path const& path, map::SitePoint const& point) {
    GDALDatasetUniquePtr const data(GDALDataset::Open(path.c_str()));
    std::array<double, 6> affine{};
    EXPECT_EQ(data->GetGeoTransform(affine.data()), CE_None);
    int const x = static_cast<int>((point.x() - affine[0]) / affine[1]);
    int const y = static_cast<int>((point.y() - affine[3]) / affine[5]);
    std::array<int, 4> colour{};
    for (int band = 1; band <= 4; ++band)
      EXPECT_EQ(data->GetRasterBand(band)->RasterIO(GF_Read, x, y, 1, 1, &colour[static_cast<std::size_t>(band - 1)], 1,
                                                    1, GDT_Int32, 0, 0, nullptr),
                CE_None);
    return colour;
  }
};

TEST_F(PicturesTest, APictureLiesOnTheGroundThatItShows) {
  map::Picture picture;
  // A tilted view: its far side, which is the upper edge of the picture, is wider.
  picture.footprint = {map::SitePoint(-30, 40), map::SitePoint(30, 40), map::SitePoint(10, 0), map::SitePoint(-10, 0)};
  auto const path = folder / "seen.tif";
  auto const written = write_picture_geotiff(picture, two_halves(200, 100), site, path);
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(colour_at(path, map::SitePoint(-10, 30)), (std::array{255, 0, 0, 255}));
  EXPECT_EQ(colour_at(path, map::SitePoint(10, 30)), (std::array{0, 0, 255, 255}));
  EXPECT_EQ(colour_at(path, map::SitePoint(-5, 2)), (std::array{255, 0, 0, 255}));
  EXPECT_EQ(colour_at(path, map::SitePoint(25, 3))[3], 0) << "beside it nothing is drawn";
}

TEST_F(PicturesTest, BytesThatAreNoPictureAreRefused) {
  map::Picture picture;
  picture.footprint = {map::SitePoint(-1, 1), map::SitePoint(1, 1), map::SitePoint(1, 0), map::SitePoint(-1, 0)};
  EXPECT_FALSE(write_picture_geotiff(picture, "hello", site, folder / "x.tif"));
  picture.footprint.assign(4, map::SitePoint(0, 0));
  EXPECT_FALSE(write_picture_geotiff(picture, two_halves(20, 10), site, folder / "x.tif")) << "no area";
}

TEST_F(PicturesTest, ABaseMapIsMadeOfAGeoTiff) {
  map::Picture picture;
  picture.footprint = {map::SitePoint(-200, 100), map::SitePoint(200, 100), map::SitePoint(200, -100),
                       map::SitePoint(-200, -100)};
  auto const ground = folder / "ground.tif";
  ASSERT_TRUE(write_picture_geotiff(picture, two_halves(800, 400), site, ground));
  auto const archive = folder / "ground.mbtiles";
  double told = 0.0;
  auto const made = write_base_map(ground, archive, [&](double share) {
    EXPECT_GE(share + 1e-9, told);
    told = share;
    return true;
  });
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NEAR(told, 1.0, 1e-6);
  auto const tiles = map::TileArchive::open(archive);
  ASSERT_TRUE(tiles) << tiles.error().message;
  auto const& info = (*tiles)->info();
  EXPECT_LT(info.bounds_deg[0], -8.5981);
  EXPECT_GT(info.bounds_deg[2], -8.5981);
  EXPECT_LE(info.greatest_zoom, 20U);
  EXPECT_LT(info.least_zoom, info.greatest_zoom);
}

TEST_F(PicturesTest, StoppedWorkLeavesNothingBehind) {
  map::Picture picture;
  picture.footprint = {map::SitePoint(-200, 100), map::SitePoint(200, 100), map::SitePoint(200, -100),
                       map::SitePoint(-200, -100)};
  auto const ground = folder / "ground.tif";
  ASSERT_TRUE(write_picture_geotiff(picture, two_halves(800, 400), site, ground));
  auto const before = std::distance(files::directory_iterator(folder), {});
  auto const made = write_base_map(ground, folder / "stopped.mbtiles", [](double) { return false; });
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().kind, base::ErrorKind::cancelled);
  EXPECT_EQ(std::distance(files::directory_iterator(folder), {}), before);
}

TEST_F(PicturesTest, APictureWithoutAPlaceIsToldHowToGoOn) {
  (void)two_halves(20, 10);
  auto const made = write_base_map(folder / "halves.png", folder / "x.mbtiles");
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("does not say where"), std::string::npos);
  EXPECT_FALSE(made.error().hint.empty());
  EXPECT_FALSE(write_base_map(folder / "missing.tif", folder / "x.mbtiles"));
}

}  // namespace
}  // namespace lapwing::formats
