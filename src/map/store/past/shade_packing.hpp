#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "map/grid/grid_pyramid.hpp"

namespace lapwing::map::past {

/// How a tile looked, as it is kept: whole, or as what is different in another one.
struct PackedShades {
  std::string name;  ///< 32 hexadecimal digits, of the SHA-256 of its shades
  std::string base;  ///< name of the other one; empty: it is whole
  std::string bytes;
};

[[nodiscard]] std::string name_of(TileShades const& shades);
/// zlib streams, of the shades, and of their differences modulo 256.
[[nodiscard]] std::string packed(TileShades const& shades);
[[nodiscard]] std::string packed(TileShades const& shades, TileShades const& base);
/// Null for what is none.
[[nodiscard]] std::shared_ptr<TileShades const> unpacked(std::string_view bytes, TileShades const* base);

}  // namespace lapwing::map::past
