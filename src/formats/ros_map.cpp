#include "formats/ros_map.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <vector>

#include "formats/internal/gdal.hpp"
#include "formats/internal/grid_cells.hpp"

namespace lapwing::formats {

namespace {

using base::ErrorKind;
using base::fail;
using map::Cell;
using map::Evidence;
using map::OccupancyGrid;

std::uint8_t pixel_of(Evidence evidence, RosMapOptions const& options) {
  if (options.is_raw)
    return evidence.is_seen() ? static_cast<std::uint8_t>(std::lround(evidence.probability() * 100.0)) : 255;
  if (!evidence.is_seen()) return 205;
  if (evidence.probability() >= options.taken_threshold) return 0;
  if (evidence.probability() <= options.free_threshold) return 254;
  return 205;
}

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

bool read_bands(GDALDataset& data, Pixels& pixels) {
  auto const count = static_cast<std::size_t>(pixels.width) * static_cast<std::size_t>(pixels.height);
  int const bands = data.GetRasterCount();
  int const colours = bands >= 3 ? 3 : 1;
  bool const has_alpha = bands == 2 || bands == 4;
  std::vector<std::uint16_t> sums(count, 0);
  std::vector<std::uint8_t> row(count);
  auto const read = [&](int band) {
    return data.GetRasterBand(band)->RasterIO(GF_Read, 0, 0, pixels.width, pixels.height, row.data(), pixels.width,
                                              pixels.height, GDT_Byte, 0, 0, nullptr) == CE_None;
  };
  for (int band = 1; band <= colours; ++band) {
    if (!read(band)) return false;
    for (std::size_t i = 0; i < count; ++i) sums[i] = static_cast<std::uint16_t>(sums[i] + row[i]);
  }
  pixels.values.resize(count);
  for (std::size_t i = 0; i < count; ++i) pixels.values[i] = static_cast<std::uint8_t>(sums[i] / colours);
  if (has_alpha && !read(bands)) return false;
  if (has_alpha) pixels.alpha = row;
  return true;
}

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
                             RosMapOptions const& options) {
  auto const seen = internal::seen_cells(grid, name);
  if (!seen) return std::unexpected(seen.error());
  auto const& box = *seen;
  auto const pgm = folder / (name + ".pgm");
  std::ofstream picture(pgm, std::ios::binary);
  picture << fmt::format("P5\n# {} m a cell, written by lapwing\n{} {}\n255\n", grid.resolution_m(), box.width,
                         box.height);
  std::string row(static_cast<std::size_t>(box.width), '\0');
  for (std::int64_t y = box.height - 1; y >= 0; --y) {
    for (std::int64_t x = 0; x < box.width; ++x) {
      Cell const cell{static_cast<std::int32_t>(box.least.x + x), static_cast<std::int32_t>(box.least.y + y)};
      row[static_cast<std::size_t>(x)] = static_cast<char>(pixel_of(grid.at(cell), options));
    }
    picture.write(row.data(), static_cast<std::streamsize>(row.size()));
  }
  auto const corner = grid.site_from_grid() *
                      geo::Point<map::GridFrame>(box.least.x * grid.resolution_m(), box.least.y * grid.resolution_m());
  std::ofstream yaml(folder / (name + ".yaml"));
  yaml << fmt::format(
      "image: {}.pgm\nmode: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: {}\nfree_thresh: "
      "{}\n",
      name, options.is_raw ? "raw" : "trinary", grid.resolution_m(), corner.x(), corner.y(),
      grid.site_from_grid().yaw_rad(), options.taken_threshold, options.free_threshold);
  picture.close();
  yaml.close();
  if (!picture || !yaml)
    return fail(ErrorKind::io, fmt::format("{} cannot be written", pgm.string()), "is there room on the disk?");
  return {};
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
