#include "map/grid/png.hpp"

#include <png.h>

#include <cmath>

#include "base/assert.hpp"

namespace lapwing::map {

namespace {

Palette palette_by(std::uint8_t (*grey_of)(double probability)) {
  Palette palette = {};
  for (std::size_t shade = 1; shade < palette.size(); ++shade) {
    auto const grey = grey_of(*probability_of(static_cast<Shade>(shade)));
    palette[shade] = {grey, grey, grey, 255};
  }
  return palette;
}

}  // namespace

Palette const& scale_palette() {
  static Palette const palette = palette_by(
      [](double probability) { return static_cast<std::uint8_t>(std::lround(255.0 * (1.0 - probability))); });
  return palette;
}

Palette const& trinary_palette() {
  static Palette const palette = palette_by([](double probability) -> std::uint8_t {
    constexpr double taken = 0.65;
    constexpr double free = 0.25;
    constexpr std::uint8_t undecided = 205;
    if (probability > taken) return 0;
    return probability < free ? 254 : undecided;
  });
  return palette;
}

Palette const& parking_palette() {
  static Palette const palette = [] {
    constexpr Colour parking{.red = 255, .green = 255, .blue = 255, .opacity = 90};
    constexpr Colour other{.red = 51, .green = 65, .blue = 85, .opacity = 110};
    Palette made = {};
    for (std::size_t shade = 1; shade < made.size(); ++shade) {
      auto const between = [share = *probability_of(static_cast<Shade>(shade))](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
      };
      made[shade] = {between(parking.red, other.red), between(parking.green, other.green),
                     between(parking.blue, other.blue), between(parking.opacity, other.opacity)};
    }
    return made;
  }();
  return palette;
}

Palette const& palette_for(std::string_view grid) {
  return grid.ends_with("parking") ? parking_palette() : scale_palette();
}

std::string png_of(std::span<Shade const> shades, int side, Palette const& palette) {
  LAPWING_ASSERT(side > 0 && shades.size() == static_cast<std::size_t>(side) * static_cast<std::size_t>(side), side,
                 shades.size());
  png_image image = {};
  image.version = PNG_IMAGE_VERSION;
  image.width = image.height = static_cast<png_uint_32>(side);
  image.format = PNG_FORMAT_RGBA_COLORMAP;
  image.flags = PNG_IMAGE_FLAG_FAST;
  image.colormap_entries = static_cast<png_uint_32>(palette.size());
  std::string png(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = png.size();
  int const written = png_image_write_to_memory(&image, png.data(), &size, 0, shades.data(), 0, palette.data());
  LAPWING_ASSERT(written != 0, image.message);  // into memory of the greatest size there is: only a mistake can fail
  png.resize(size);
  return png;
}

}  // namespace lapwing::map
