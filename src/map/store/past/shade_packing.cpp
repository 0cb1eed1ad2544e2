#include "map/store/past/shade_packing.hpp"

#include <algorithm>
#include <functional>

#include "map/store/blobs/sha256.hpp"
#include "map/store/rows/zlib.hpp"

namespace lapwing::map::past {

namespace {

std::string_view bytes_of(TileShades const& shades) {
  return {reinterpret_cast<char const*>(shades.data()), shades.size()};
}

}  // namespace

std::string name_of(TileShades const& shades) {
  // Half of it tells as many tiles apart as there will ever be, and stands in every list.
  return blobs::sha256(bytes_of(shades)).substr(0, 32);
}

std::string packed(TileShades const& shades) {
  return rows::deflated(bytes_of(shades));
}

std::string packed(TileShades const& shades, TileShades const& base) {
  TileShades differences;
  std::ranges::transform(shades, base, differences.begin(), std::minus());
  return rows::deflated(bytes_of(differences));
}

std::shared_ptr<TileShades const> unpacked(std::string_view bytes, TileShades const* base) {
  auto const inflated = rows::inflated(bytes, sizeof(TileShades));
  if (!inflated || inflated->size() != sizeof(TileShades)) return nullptr;
  auto shades = std::make_shared<TileShades>();
  auto const as_shade = [](char byte) { return static_cast<Shade>(byte); };
  std::ranges::transform(*inflated, shades->begin(), as_shade);
  if (base) std::ranges::transform(*shades, *base, shades->begin(), std::plus());
  return shades;
}

}  // namespace lapwing::map::past
