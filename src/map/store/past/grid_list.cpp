#include "map/store/past/grid_list.hpp"

#include <array>
#include <cstdint>
#include <utility>

#include "map/store/past/bytes.hpp"

namespace lapwing::map::past {

namespace {

constexpr std::size_t name_bytes = 16;
constexpr std::string_view digits = "0123456789abcdef";

void append_text(std::string& to, std::string const& text) {
  append(to, static_cast<std::uint16_t>(text.size()));
  to += text;
}

std::optional<std::string> take_bytes(std::string_view& from, std::size_t size) {
  if (from.size() < size) return std::nullopt;
  std::string bytes(from.substr(0, size));
  from.remove_prefix(size);
  return bytes;
}

std::optional<std::string> take_text(std::string_view& from) {
  auto const size = take<std::uint16_t>(from);
  return size ? take_bytes(from, *size) : std::nullopt;
}

/// Sixteen zeros stand for no name.
std::string name_as_bytes(std::string const& name) {
  std::string bytes(name_bytes, '\0');
  for (std::size_t i = 0; i + 1 < name.size(); i += 2)
    bytes[i / 2] = static_cast<char>(digits.find(name[i]) << 4U | digits.find(name[i + 1]));
  return bytes;
}

std::string name_from_bytes(std::string const& bytes) {
  if (bytes.find_first_not_of('\0') == std::string::npos) return {};
  std::string name;
  for (char const byte : bytes) {
    name += digits[static_cast<unsigned char>(byte) >> 4U];
    name += digits[static_cast<unsigned char>(byte) & 15U];
  }
  return name;
}

std::optional<GridPlace> place_of(std::array<double, 7> const& numbers) {
  auto const& [resolution_m, x_m, y_m, yaw_rad, lat_rad, lon_rad, alt_m] = numbers;
  if (!(resolution_m >= 0.001 && resolution_m <= 100.0)) return std::nullopt;
  return GridPlace{.resolution_m = resolution_m,
                   .site_from_grid = {geo::Point<geo::SiteFrame>(x_m, y_m), yaw_rad},
                   .anchor = {.lat_rad = lat_rad, .lon_rad = lon_rad, .alt_m = alt_m}};
}

}  // namespace

std::string packed(GridList const& list) {
  std::string bytes;
  for (auto const& text : {list.key.site, list.key.floor, list.key.name}) append_text(bytes, text);
  auto const& [resolution_m, site_from_grid, anchor] = list.place;
  auto const origin = site_from_grid.origin();
  for (double const number :
       {resolution_m, origin.x(), origin.y(), site_from_grid.yaw_rad(), anchor.lat_rad, anchor.lon_rad, anchor.alt_m})
    append(bytes, number);
  append(bytes, static_cast<std::uint8_t>(list.is_anew ? 1 : 0));
  append(bytes, static_cast<std::uint32_t>(list.tiles.size()));
  for (auto const& [key, name] : list.tiles) {
    append(bytes, key.x);
    append(bytes, key.y);
    bytes += name_as_bytes(name);
  }
  return bytes;
}

std::optional<GridList> unpacked_list(std::string_view bytes) {
  auto site = take_text(bytes);
  auto floor = take_text(bytes);
  auto name = take_text(bytes);
  if (!site || !floor || !name) return std::nullopt;
  std::array<double, 7> numbers = {};
  for (auto& number : numbers) {
    auto const taken = take<double>(bytes);
    if (!taken) return std::nullopt;
    number = *taken;
  }
  auto const place = place_of(numbers);
  auto const is_anew = take<std::uint8_t>(bytes);
  auto const count = take<std::uint32_t>(bytes);
  if (!place || !is_anew || !count) return std::nullopt;
  GridList list{.key = {*std::move(site), *std::move(floor), *std::move(name)},
                .place = *place,
                .is_anew = (*is_anew & 1U) != 0,
                .tiles = {}};
  for (std::uint32_t i = 0; i < *count; ++i) {
    auto const x = take<std::int32_t>(bytes);
    auto const y = take<std::int32_t>(bytes);
    auto const tile = take_bytes(bytes, name_bytes);
    if (!x || !y || !tile) return std::nullopt;
    list.tiles[{*x, *y}] = name_from_bytes(*tile);
  }
  return bytes.empty() ? std::optional(std::move(list)) : std::nullopt;
}

void apply(GridList&& list, PastGrids& grids) {
  auto& grid = grids[list.key];
  if (list.is_anew) grid.tiles.clear();
  grid.place = list.place;
  for (auto& [key, name] : list.tiles) {
    if (name.empty())
      grid.tiles.erase(key);
    else
      grid.tiles[key] = std::move(name);
  }
}

}  // namespace lapwing::map::past
