#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"

namespace lapwing::map {

/// A square of the world in web Mercator (EPSG:3857): column from the date line eastwards, row from the north, as XYZ
/// addresses count them.
struct TileAddress {
  std::uint32_t zoom = 0;
  std::uint32_t x = 0;
  std::uint32_t y = 0;

  static constexpr std::uint32_t deepest_zoom = 26;
  [[nodiscard]] constexpr bool is_valid() const { return zoom <= deepest_zoom && x < (1U << zoom) && y < (1U << zoom); }
  friend constexpr bool operator==(TileAddress const&, TileAddress const&) = default;
};

/// What an archive of map tiles says of itself.
struct TileArchiveInfo {
  std::string name = {};
  std::string attribution = {};  ///< whom to thank, as the map must show it; may hold HTML, of others: show it as text
  std::string media_type = {};   ///< "image/png", "image/jpeg", "image/webp", "application/x-protobuf"
  std::string encoding = {};     ///< "gzip" where tiles are packed so; else empty
  std::vector<std::string> vector_layers = {};  ///< of vector tiles: what their layers are called
  std::uint32_t least_zoom = 0;
  std::uint32_t greatest_zoom = 22;
  /// West, south, east, north, in degrees; the whole world where it does not say.
  std::array<double, 4> bounds_deg = {-180.0, -85.0511, 180.0, 85.0511};
};

/// A file full of map tiles, for use without a network. Its functions may be called on any thread, from several at
/// once.
class TileArchive {
 public:
  /// By what the file is, whatever its name: MBTiles 1.3 (SQLite) or PMTiles 3. Errors: io for a file that cannot be
  /// read; invalid_input for another kind, or a damaged one.
  [[nodiscard]] static base::Result<std::shared_ptr<TileArchive const>> open(std::filesystem::path const& path);
  virtual ~TileArchive() = default;

  [[nodiscard]] virtual TileArchiveInfo const& info() const = 0;
  /// As it lies in the archive, packed where `info().encoding` says so. Nothing where there is none. Errors: io;
  /// invalid_input where the archive contradicts itself.
  [[nodiscard]] virtual base::Result<std::optional<std::string>> tile(TileAddress const& address) const = 0;
};

}  // namespace lapwing::map
