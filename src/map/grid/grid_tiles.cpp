#include "map/grid/grid_tiles.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <Eigen/Core>

#include "map/features/placement.hpp"

namespace lapwing::map {

namespace {

using Pixel = Eigen::Vector2d;  ///< from the tile's north western corner, x east, y south

/// Web Mercator at one zoom, in pixels.
class Mercator {
 public:
  explicit Mercator(XyzTile tile) : tile_(tile), world_px_(std::ldexp(tile_px, tile.zoom)) {}

  [[nodiscard]] geo::Wgs84 place_at(Pixel const& pixel) const {
    Pixel const share = (pixel + origin()) / world_px_;
    return {.lat_rad = std::atan(std::sinh(std::numbers::pi * (1.0 - 2.0 * share.y()))),
            .lon_rad = (2.0 * share.x() - 1.0) * std::numbers::pi};
  }
  /// In the turn that is nearest to the tile.
  [[nodiscard]] Pixel pixel_at(geo::Wgs84 place) const {
    Pixel const share((place.lon_rad / std::numbers::pi + 1.0) / 2.0,
                      (1.0 - std::asinh(std::tan(place.lat_rad)) / std::numbers::pi) / 2.0);
    Pixel pixel = share * world_px_ - origin();
    pixel.x() -= world_px_ * std::round((pixel.x() - tile_px / 2.0) / world_px_);
    return pixel;
  }

 private:
  [[nodiscard]] Pixel origin() const {
    return Pixel(static_cast<double>(tile_.x), static_cast<double>(tile_.y)) * tile_px;
  }

  XyzTile tile_;
  double world_px_;
};

/// The upright rectangle in pixels round one of a grid.
Eigen::AlignedBox2d pixels_of(geo::Box<GridFrame> const& box,
                              geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid, geo::Site const& site,
                              Mercator const& mercator) {
  Eigen::AlignedBox2d pixels;
  for (auto const& corner : {box.least, box.most, geo::Point<GridFrame>(box.least.x(), box.most.y()),
                             geo::Point<GridFrame>(box.most.x(), box.least.y())})
    pixels.extend(mercator.pixel_at(place_of(site, site_from_grid * corner)));
  return pixels;
}

/// Where the pixels of a tile lie in a grid: exact on a lattice, straight between. On one of 64 pixels that is off by a
/// hundredth of a pixel where those are largest, and an exact place costs a microsecond.
class Lattice {
 public:
  Lattice(Mercator const& mercator, geo::Site const& site,
          geo::Transform<GridFrame, geo::SiteFrame> const& grid_from_site) {
    for (int row = 0; row < knots; ++row) {
      for (int column = 0; column < knots; ++column) {
        auto const place = mercator.place_at(Pixel(column, row) * step_px);
        knots_m_[index(row, column)] = (grid_from_site * point_of(site, place.lon_rad, place.lat_rad)).v;
      }
    }
  }

  [[nodiscard]] Eigen::Vector2d at(Pixel const& pixel) const {
    auto const column = std::clamp(static_cast<int>(pixel.x() / step_px), 0, knots - 2);
    auto const row = std::clamp(static_cast<int>(pixel.y() / step_px), 0, knots - 2);
    Eigen::Vector2d const share = pixel / step_px - Pixel(column, row);
    auto const along = [&](int of_row) -> Eigen::Vector2d {
      auto const& west = knots_m_[index(of_row, column)];
      return west + share.x() * (knots_m_[index(of_row, column + 1)] - west);
    };
    Eigen::Vector2d const north = along(row);
    return north + share.y() * (along(row + 1) - north);
  }
  /// A side of a pixel in the middle of the tile.
  [[nodiscard]] double pixel_m() const {
    Pixel const middle = Pixel::Constant(tile_px / 2.0);
    return (at(middle + Pixel(1.0, 0.0)) - at(middle)).norm();
  }

  static constexpr double step_px = 64.0;

 private:
  static constexpr int knots = 5;
  static constexpr std::size_t index(int row, int column) {
    return static_cast<std::size_t>(row) * knots + static_cast<std::size_t>(column);
  }

  std::array<Eigen::Vector2d, std::size_t{knots} * knots> knots_m_;
};

/// How closely to look at the grid: which level, and how often along a pixel. A square of the level must not fall
/// between two looks, however it is turned: its side is at least the diagonal between them.
struct Scale {
  int level = 0;
  int looks = 1;
};

Scale scale_of(double pixel_m, double resolution_m) {
  double const cells = std::numbers::sqrt2 * pixel_m / resolution_m;  // along the diagonal of a pixel
  int const level = std::clamp(static_cast<int>(std::ceil(std::log2(cells / 2.0))), 0, GridPyramid::levels - 1);
  return {.level = level, .looks = std::max(1, static_cast<int>(std::ceil(std::ldexp(cells, -level) - 1e-9)))};
}

/// Draws rows of looks, which are pixels or parts of them, into one picture.
class Brush {
 public:
  Brush(GridPyramid const& grid, Lattice const& lattice, Scale scale)
      : grid_(grid),
        lattice_(lattice),
        scale_(scale),
        squares_a_m_(1.0 / (grid.resolution_m() * std::ldexp(1.0, scale.level))),
        shades_(std::size_t{tile_px} * tile_px) {}

  void draw(int from_row, int to_row, int from_column, int to_column) {
    for (int row = from_row; row < to_row; ++row)
      for (int part = 0; part < scale_.looks; ++part)
        draw_looks(row, row + (part + 0.5) / scale_.looks, from_column, to_column);
  }
  [[nodiscard]] std::vector<Shade>& shades() { return shades_; }

 private:
  /// Along one line from west to east, straight from knot to knot.
  void draw_looks(int row, double y_px, int from_column, int to_column) {
    constexpr int step = static_cast<int>(Lattice::step_px);
    for (int column = from_column; column < to_column;) {
      int const end = std::min(to_column, (column / step + 1) * step);
      double const apart_px = 1.0 / scale_.looks;
      Eigen::Vector2d const first = lattice_.at({column + apart_px / 2.0, y_px}) * squares_a_m_;
      Eigen::Vector2d const shift =
          (lattice_.at({column + 1.0, y_px}) - lattice_.at({static_cast<double>(column), y_px})) * squares_a_m_ *
          apart_px;
      auto* shade = &shades_[static_cast<std::size_t>(row) * tile_px + static_cast<std::size_t>(column)];
      int look = 0;
      for (; column < end; ++column, ++shade)
        for (int part = 0; part < scale_.looks; ++part, ++look)
          *shade = std::max(*shade, shade_at(first + look * shift));
    }
  }

  Shade shade_at(Eigen::Vector2d const& square) {
    auto const x = static_cast<std::int32_t>(std::floor(square.x()));
    auto const y = static_cast<std::int32_t>(std::floor(square.y()));
    int const bits = tile_bits - scale_.level;
    TileKey const key{x >> bits, y >> bits};
    if (key != key_) {
      key_ = key;
      auto const* tile = grid_.tile(key);
      squares_ = tile ? tile->level(scale_.level).data() : nullptr;
    }
    if (!squares_) return 0;
    std::int32_t const side = 1 << bits;
    return squares_[(y & (side - 1)) * side + (x & (side - 1))];
  }

  static constexpr int tile_bits = 8;
  static_assert(tile_cells == 1 << tile_bits);

  GridPyramid const& grid_;
  Lattice const& lattice_;
  Scale scale_;
  double squares_a_m_;
  std::vector<Shade> shades_;
  TileKey key_ = {INT32_MIN, INT32_MIN};  ///< a tile that no site is large enough for
  Shade const* squares_ = nullptr;
};

int whole_px(double pixel) {
  return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(tile_px)));
}

}  // namespace

bool is_drawn(XyzTile tile) {
  if (tile.zoom < lowest_zoom || tile.zoom > highest_zoom) return false;
  auto const across = std::int64_t{1} << tile.zoom;
  return tile.x >= 0 && tile.x < across && tile.y >= 0 && tile.y < across;
}

std::optional<std::vector<Shade>> render(GridPyramid const& grid, geo::Site const& site, XyzTile tile) {
  if (!is_drawn(tile) || !grid.extent()) return std::nullopt;
  Mercator const mercator(tile);
  auto const within = pixels_of(*grid.extent(), grid.site_from_grid(), site, mercator);
  int const west = whole_px(std::floor(within.min().x()));
  int const east = whole_px(std::ceil(within.max().x()));
  int const north = whole_px(std::floor(within.min().y()));
  int const south = whole_px(std::ceil(within.max().y()));
  if (west >= east || north >= south) return std::nullopt;
  Lattice const lattice(mercator, site, grid.site_from_grid().inverse());
  Brush brush(grid, lattice, scale_of(lattice.pixel_m(), grid.resolution_m()));
  brush.draw(north, south, west, east);
  auto& shades = brush.shades();
  bool const is_empty = std::ranges::all_of(shades, [](Shade shade) { return shade == 0; });
  return is_empty ? std::nullopt : std::optional(std::move(shades));
}

std::vector<XyzTile> tiles_with(double resolution_m, geo::Transform<geo::SiteFrame, GridFrame> const& site_from_grid,
                                std::span<TileKey const> changed, geo::Site const& site, int zoom, std::size_t most) {
  double const side_m = tile_cells * resolution_m;
  auto const across = std::int64_t{1} << zoom;
  std::set<XyzTile> tiles;
  for (auto const key : changed) {
    geo::Box<GridFrame> const box{{key.x * side_m, key.y * side_m}, {(key.x + 1.0) * side_m, (key.y + 1.0) * side_m}};
    // As seen from the tile in which its corner lies, so that what lies across the antimeridian stays in one piece.
    Pixel const corner = Mercator({zoom, 0, 0}).pixel_at(place_of(site, site_from_grid * box.least)) / tile_px;
    XyzTile const home{zoom, static_cast<std::int64_t>(std::floor(corner.x())),
                       static_cast<std::int64_t>(std::floor(corner.y()))};
    auto const pixels = pixels_of(box, site_from_grid, site, Mercator(home));
    auto const tile_at = [](double px) { return static_cast<std::int64_t>(std::floor(px / tile_px)); };
    for (auto y = home.y + tile_at(pixels.min().y()); y <= home.y + tile_at(pixels.max().y()); ++y) {
      for (auto x = home.x + tile_at(pixels.min().x()); x <= home.x + tile_at(pixels.max().x()); ++x) {
        if (y >= 0 && y < across) tiles.insert({zoom, ((x % across) + across) % across, y});
        if (tiles.size() == most) return {tiles.begin(), tiles.end()};
      }
    }
  }
  return {tiles.begin(), tiles.end()};
}

}  // namespace lapwing::map
