#include "map/grid/png.hpp"

#include <png.h>

#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace lapwing::map {
namespace {

/// By libpng's reader, as red, green, blue and opacity.
std::vector<Colour> read(std::string const& png, int side) {
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0) << image.message;
  EXPECT_EQ(image.width, static_cast<png_uint_32>(side));
  EXPECT_EQ(image.height, static_cast<png_uint_32>(side));
  image.format = PNG_FORMAT_RGBA;
  std::vector<Colour> pixels(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  EXPECT_NE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr), 0) << image.message;
  return pixels;
}

TEST(Png, IsThePicture) {
  std::vector<Shade> shades(256);
  std::iota(shades.begin(), shades.end(), Shade{0});
  for (auto const& palette : {scale_palette(), trinary_palette()}) {
    auto const pixels = read(png_of(shades, 16, palette), 16);
    for (std::size_t i = 0; i < shades.size(); ++i) EXPECT_EQ(pixels[i], palette[i]) << i;
  }
  EXPECT_EQ(read(png_of(std::vector<Shade>{255}, 1, scale_palette()), 1).front(), (Colour{0, 0, 0, 255}));
}

TEST(Png, HasThePaletteOfMapServer) {
  EXPECT_EQ(scale_palette()[0].opacity, 0);
  EXPECT_EQ(scale_palette()[127], (Colour{255, 255, 255, 255}));
  EXPECT_EQ(scale_palette()[255], (Colour{0, 0, 0, 255}));
  for (std::size_t shade = 1; shade < 256; ++shade)
    EXPECT_NEAR((255 - scale_palette()[shade].red) / 255.0, *probability_of(static_cast<Shade>(shade)), 0.003);
  EXPECT_EQ(trinary_palette()[shade_of(Evidence::of_probability(0.7))].red, 0);
  EXPECT_EQ(trinary_palette()[shade_of(Evidence::of_probability(0.5))].red, 205);
  EXPECT_EQ(trinary_palette()[shade_of(Evidence::of_probability(0.1))].red, 254);
}

TEST(Png, LetsTheGroundBeSeenBelowACarPark) {
  EXPECT_EQ(parking_palette()[0].opacity, 0);
  auto const parking = parking_palette()[127];
  auto const other = parking_palette()[255];
  EXPECT_GT(parking.red, 200);
  EXPECT_LT(other.red, 100);
  for (auto const& colour : {parking, other}) {
    EXPECT_GT(colour.opacity, 64);
    EXPECT_LT(colour.opacity, 128);
  }
  EXPECT_EQ(&palette_for("hawk parking"), &parking_palette());
  EXPECT_EQ(&palette_for("floor"), &scale_palette());
  EXPECT_EQ(&palette_for("robot 1"), &scale_palette());
}

TEST(Png, IsSmallForAnEvenPicture) {
  EXPECT_LT(png_of(std::vector<Shade>(65'536, 127), 256, scale_palette()).size(), 2'500U) << "1 KiB of it are colours";
}

}  // namespace
}  // namespace lapwing::map
