#include "formats/ros_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/files/replace_file.hpp"
#include "formats/internal/gdal.hpp"
#include "formats/internal/grid_cells.hpp"
#include "map/ros_files/ros_map_file.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using map::OccupancyGrid;
using Pixels = map::MapPicture;

/// 0 to 255, whatever depth the band has: 1, 2, 4 or 16 bits are as common as 8 in floor plans.
bool read_band(GDALRasterBand& band, Pixels const& pixels, std::vector<std::uint8_t>& values) {
  values.resize(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height));
  auto const read_as = [&](void* into, GDALDataType type) {
    return band.RasterIO(GF_Read, 0, 0, pixels.width, pixels.height, into, pixels.width, pixels.height, type, 0, 0,
                         nullptr) == CE_None;
  };
  if (band.GetRasterDataType() == GDT_UInt16) {
    std::vector<std::uint16_t> wide(values.size());
    if (!read_as(wide.data(), GDT_UInt16)) return false;
    std::ranges::transform(wide, values.begin(),
                           [](std::uint16_t value) { return static_cast<std::uint8_t>(value / 257); });
    return true;
  }
  if (!read_as(values.data(), GDT_Byte)) return false;
  auto const* const bits = band.GetMetadataItem("NBITS", "IMAGE_STRUCTURE");
  int const depth = bits == nullptr ? 8 : std::atoi(bits);
  if (depth >= 1 && depth < 8 && band.GetColorTable() == nullptr) {
    int const greatest = (1 << depth) - 1;
    for (auto& value : values) value = static_cast<std::uint8_t>(std::min<int>(value, greatest) * 255 / greatest);
  }
  return true;
}

/// A palette's pixels are numbers of colours.
void look_up(GDALColorTable const& colours, Pixels& pixels) {
  std::array<std::uint8_t, 256> grey = {};
  std::array<std::uint8_t, 256> alpha = {};
  for (int i = 0; i < std::min(colours.GetColorEntryCount(), 256); ++i) {
    auto const* const entry = colours.GetColorEntry(i);
    grey[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>((entry->c1 + entry->c2 + entry->c3) / 3);
    alpha[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(entry->c4);
  }
  pixels.alpha.resize(pixels.values.size());
  for (std::size_t i = 0; i < pixels.values.size(); ++i) {
    pixels.alpha[i] = alpha[pixels.values[i]];
    pixels.values[i] = grey[pixels.values[i]];
  }
}

bool read_bands(GDALDataset& data, Pixels& pixels) {
  int const bands = data.GetRasterCount();
  if (bands < 3) {
    auto& band = *data.GetRasterBand(1);
    if (!read_band(band, pixels, pixels.values)) return false;
    if (band.GetColorTable() != nullptr) look_up(*band.GetColorTable(), pixels);
  } else {
    std::vector<std::uint16_t> sums(static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height),
                                    0);
    std::vector<std::uint8_t> values;
    for (int band = 1; band <= 3; ++band) {
      if (!read_band(*data.GetRasterBand(band), pixels, values)) return false;
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + values[i]);
    }
    pixels.values.resize(sums.size());
    std::ranges::transform(sums, pixels.values.begin(),
                           [](std::uint16_t sum) { return static_cast<std::uint8_t>(sum / 3); });
  }
  bool const has_alpha = bands == 2 || bands == 4;
  return !has_alpha || read_band(*data.GetRasterBand(bands), pixels, pixels.alpha);
}

/// What GDAL takes for a picture.
base::Result<Pixels> read_pixels(std::filesystem::path const& path) {
  Pixels pixels;
  bool is_too_large = false;
  auto const done = internal::with_gdal(fmt::format("{} cannot be read as a picture", path.string()), [&] {
    std::array const drivers = {"PNM", "PNG", "JPEG", "BMP", "GTiff", static_cast<char const*>(nullptr)};
    GDALDatasetUniquePtr const data(
        GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY, drivers.data(), nullptr, nullptr));
    if (!data || data->GetRasterCount() < 1) return false;
    pixels.width = data->GetRasterXSize();
    pixels.height = data->GetRasterYSize();
    is_too_large = std::int64_t{pixels.width} * pixels.height > internal::most_cells;
    return is_too_large || read_bands(*data, pixels);
  });
  if (!done) return fail(ErrorKind::invalid_input, done.error().message);
  if (is_too_large)
    return fail(ErrorKind::invalid_input,
                fmt::format("{} has {} x {} cells, more than 400 million", path.string(), pixels.width, pixels.height));
  return pixels;
}

}  // namespace

base::Result<> write_ros_map(OccupancyGrid const& grid, std::filesystem::path const& folder, std::string const& name,
                             map::RosMapOptions const& options) {
  auto const box = internal::seen_cells(grid, name);
  if (!box) return std::unexpected(box.error());
  auto const map = map::ros_map(grid, *box, name, options);
  if (auto done = base::replace_file(folder / (name + ".pgm"), map.pgm); !done) return done;
  return base::replace_file(folder / (name + ".yaml"), map.yaml);
}

base::Result<OccupancyGrid> read_ros_map(std::filesystem::path const& yaml) {
  return map::read_ros_map(yaml, read_pixels);
}

}  // namespace lapwing::formats
