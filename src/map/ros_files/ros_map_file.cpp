#include "map/ros_files/ros_map_file.hpp"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <utility>

#include "map/ros_files/pgm.hpp"

namespace lapwing::map {

namespace {

using base::ErrorKind;
using base::fail;

/// What the .yaml says.
struct MapFile {
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

base::Result<MapFile> parsed(YAML::Node const& root) {
  auto const wrong = [](std::string text) {
    return fail(ErrorKind::invalid_input, std::move(text),
                "a ROS map has image, resolution, origin: [x, y, yaw], occupied_thresh, free_thresh and negate");
  };
  if (!root.IsMap()) return wrong("it is no YAML mapping");
  for (auto const* key : {"image", "resolution", "origin"}) {
    if (!root[key]) return wrong(fmt::format("it has no `{}`", key));
  }
  MapFile map;
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
  if (!std::ranges::all_of(map.origin, [](double number) { return std::abs(number) <= farthest_m; }))
    return wrong("its `origin` is no place within 100 km");
  if (map.mode != "trinary" && map.mode != "scale" && map.mode != "raw")
    return wrong(fmt::format("its `mode` is `{}`, not trinary, scale or raw", map.mode));
  if (!(0.0 <= map.free_threshold && map.free_threshold < map.taken_threshold && map.taken_threshold <= 1.0))
    return wrong("its thresholds are not 0 <= free_thresh < occupied_thresh <= 1");
  return map;
}

/// What a pixel says, by the rules of map_server: `share` is how dark it is, 0 to 1.
Evidence evidence_of(std::uint8_t value, bool is_transparent, MapFile const& map) {
  if (map.mode == "raw") return value <= 100 ? Evidence::of_probability(value / 100.0) : Evidence();
  double const share = (map.is_negated ? value : 255 - value) / 255.0;
  if (share > map.taken_threshold) return Evidence::of_probability(0.97);
  if (share < map.free_threshold) return Evidence::of_probability(0.03);
  if (map.mode == "trinary" || is_transparent) return {};
  return Evidence::of_probability((share - map.free_threshold) / (map.taken_threshold - map.free_threshold));
}

/// Nothing: it is another picture.
std::optional<base::Result<MapPicture>> read_as_pgm(std::filesystem::path const& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(2, '\0');
  if (!file.read(bytes.data(), 2) || !is_pgm(bytes)) return {};
  bytes.append(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  auto picture = read_pgm(bytes);
  if (!picture)
    return base::Result<MapPicture>(fail(ErrorKind::invalid_input,
                                         fmt::format("{} cannot be read: {}", path.string(), picture.error().message),
                                         picture.error().hint));
  return MapPicture{picture->width, picture->height, std::move(picture->values), {}};
}

void fill(OccupancyGrid& grid, MapPicture const& pixels, MapFile const& map) {
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

base::Result<OccupancyGrid> read_ros_map(std::filesystem::path const& yaml, ReadPicture const& read_other) {
  auto const wrong = [&](std::string const& why, std::string hint = {}) {
    return fail(ErrorKind::invalid_input, fmt::format("{} is no ROS map: {}", yaml.string(), why), std::move(hint));
  };
  base::Result<MapFile> map;
  try {
    map = parsed(YAML::LoadFile(yaml.string()));
  } catch (YAML::BadFile const&) {
    return fail(ErrorKind::io, fmt::format("{} cannot be read", yaml.string()));
  } catch (YAML::Exception const& exception) {
    return wrong(exception.msg + place_in(exception.mark));
  }
  if (!map) return wrong(map.error().message, map.error().hint);
  auto const image = map->image.is_absolute() ? map->image : yaml.parent_path() / map->image;
  auto pgm = read_as_pgm(image);
  auto const pixels = pgm ? *std::move(pgm) : read_other(image);
  if (!pixels) return std::unexpected(pixels.error());
  OccupancyGrid grid(map->resolution_m, {SitePoint(map->origin[0], map->origin[1]), map->origin[2]});
  fill(grid, *pixels, *map);
  return grid;
}

}  // namespace lapwing::map
