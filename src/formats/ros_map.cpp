#include "formats/ros_map.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "base/files/replace_file.hpp"
#include "formats/internal/gdal.hpp"
#include "formats/internal/grid_cells.hpp"
#include "formats/pgm.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using map::Evidence;
using map::OccupancyGrid;

struct RosMap {
  std::filesystem::path image;
  double resolution_m = 0.0;
  std::array<double, 3> origin = {};  ///< x, y in metres, yaw in radians: of the lower left corner
  double taken_threshold = 0.65;
  double free_threshold = 0.196;
  bool is_negated = false;
  std::string mode = "trinary";
};

std::string place_in(YAML::Mark const& mark) {
  return mark.is_null() ? std::string() : fmt::format(", line {}", mark.line + 1);
}

base::Result<RosMap> parsed(YAML::Node const& root) {
  auto const wrong = [](std::string text) {
    return fail(ErrorKind::invalid_input, std::move(text),
                "a ROS map has image, resolution, origin: [x, y, yaw], occupied_thresh, free_thresh and negate");
  };
  if (!root.IsMap()) return wrong("it is no YAML mapping");
  for (auto const* key : {"image", "resolution", "origin"}) {
    if (!root[key]) return wrong(fmt::format("it has no `{}`", key));
  }
  RosMap map;
  map.image = root["image"].as<std::string>();
  map.resolution_m = root["resolution"].as<double>();
  if (root["origin"].size() < 2) return wrong("its `origin` has fewer than two numbers");
  for (std::size_t i = 0; i < std::min<std::size_t>(3, root["origin"].size()); ++i)
    map.origin[i] = root["origin"][i].as<double>();
  map.taken_threshold = root["occupied_thresh"].as<double>(map.taken_threshold);
  map.free_threshold = root["free_thresh"].as<double>(map.free_threshold);
  map.is_negated =
      root["negate"] && root["negate"].as<std::string>() != "0" && root["negate"].as<std::string>() != "false";
  map.mode = root["mode"].as<std::string>(map.mode);
  if (!(map.resolution_m >= 0.001 && map.resolution_m <= 100.0))
    return wrong(fmt::format("its `resolution` is {}, not from 0.001 to 100 m a cell", map.resolution_m));
  if (!std::ranges::all_of(map.origin, [](double number) { return std::abs(number) <= map::farthest_m; }))
    return wrong("its `origin` is no place within 100 km");
  if (map.mode != "trinary" && map.mode != "scale" && map.mode != "raw")
    return wrong(fmt::format("its `mode` is `{}`, not trinary, scale or raw", map.mode));
  if (!(0.0 <= map.free_threshold && map.free_threshold < map.taken_threshold && map.taken_threshold <= 1.0))
    return wrong("its thresholds are not 0 <= free_thresh < occupied_thresh <= 1");
  return map;
}

/// What a pixel says, by the rules of map_server: `share` is how dark it is, 0 to 1.
Evidence evidence_of(std::uint8_t value, bool is_transparent, RosMap const& map) {
  if (map.mode == "raw") return value <= 100 ? Evidence::of_probability(value / 100.0) : Evidence();
  double const share = (map.is_negated ? value : 255 - value) / 255.0;
  if (share > map.taken_threshold) return Evidence::of_probability(0.97);
  if (share < map.free_threshold) return Evidence::of_probability(0.03);
  if (map.mode == "trinary" || is_transparent) return {};
  return Evidence::of_probability((share - map.free_threshold) / (map.taken_threshold - map.free_threshold));
}

/// The picture's first band, rows from above; the mean of three where it has colours; alpha apart.
struct Pixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;
  std::vector<std::uint8_t> alpha;  ///< empty: none
};

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

/// GDAL knows neither plain grey maps nor greatest values other than 255.
std::optional<base::Result<Pixels>> read_as_pgm(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(2, '\0');
  if (!file.read(bytes.data(), 2) || !is_pgm(bytes)) return {};
  bytes.append(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  auto picture = read_pgm(bytes);
  if (!picture)
    return base::Result<Pixels>(fail(ErrorKind::invalid_input,
                                     fmt::format("{} cannot be read: {}", path.string(), picture.error().message),
                                     picture.error().hint));
  return Pixels{picture->width, picture->height, std::move(picture->values), {}};
}

base::Result<Pixels> read_pixels(std::filesystem::path const& path) {
  if (auto pgm = read_as_pgm(path)) return std::move(*pgm);
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

void fill(OccupancyGrid& grid, Pixels const& pixels, RosMap const& map) {
  std::array<std::array<Evidence, 256>, 2> meaning;
  for (int value = 0; value < 256; ++value) {
    meaning[0][static_cast<std::size_t>(value)] = evidence_of(static_cast<std::uint8_t>(value), false, map);
    meaning[1][static_cast<std::size_t>(value)] = evidence_of(static_cast<std::uint8_t>(value), true, map);
  }
  for (int row = 0; row < pixels.height; ++row) {
    std::int32_t const y = pixels.height - 1 - row;
    for (int x = 0; x < pixels.width; ++x) {
      auto const at =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(pixels.width) + static_cast<std::size_t>(x);
      bool const is_transparent = !pixels.alpha.empty() && pixels.alpha[at] < 255;
      auto const evidence = meaning[is_transparent ? 1 : 0][pixels.values[at]];
      if (evidence.is_seen()) grid.set({x, y}, evidence);
    }
  }
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
  auto const wrong = [&](std::string const& why, std::string hint = {}) {
    return fail(ErrorKind::invalid_input, fmt::format("{} is no ROS map: {}", yaml.string(), why), std::move(hint));
  };
  base::Result<RosMap> map;
  try {
    map = parsed(YAML::LoadFile(yaml.string()));
  } catch (YAML::BadFile const&) {
    return fail(ErrorKind::io, fmt::format("{} cannot be read", yaml.string()));
  } catch (YAML::Exception const& exception) {
    return wrong(exception.msg + place_in(exception.mark));
  }
  if (!map) return wrong(map.error().message, map.error().hint);
  auto const image = map->image.is_absolute() ? map->image : yaml.parent_path() / map->image;
  auto const pixels = read_pixels(image);
  if (!pixels) return std::unexpected(pixels.error());
  OccupancyGrid grid(map->resolution_m, {map::SitePoint(map->origin[0], map->origin[1]), map->origin[2]});
  fill(grid, *pixels, *map);
  return grid;
}

}  // namespace lapwing::formats
