#include "slam/walls/wall_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include <Eigen/Dense>

namespace lapwing::slam {
namespace {

using map::Cell;

/// A taken cell, and which way its surroundings lie.
struct Piece {
  Eigen::Vector2d at;     ///< its middle, metres
  Eigen::Vector2d along;  ///< unit length, either way round; zero where there is no direction
  Eigen::Vector2d open;   ///< unit length, to the side that is free; zero where both are
  double straight = 0.0;  ///< 1 where all around lies on one line
  bool is_used = false;
};

/// That both can be of one surface by the sides that are free beside them.
bool face_alike(Eigen::Vector2d const& a, Eigen::Vector2d const& b) {
  return a.dot(b) >= 0.0;
}

/// Where a set of places lies: the line with the least squared distances, and its ends.
struct Fit {
  Eigen::Vector2d middle;
  Eigen::Vector2d along;
  double first = 0.0;  ///< of the ends along the line, from the middle
  double last = 0.0;
  double spread = 0.0;
  double straight = 0.0;  ///< 1 where they lie on the line, 0 where they lie as far to all sides

  [[nodiscard]] double beside(Eigen::Vector2d const& place) const {
    Eigen::Vector2d const way = place - middle;
    return std::abs(along.x() * way.y() - along.y() * way.x());
  }
  [[nodiscard]] double on_line(Eigen::Vector2d const& place) const { return along.dot(place - middle); }
  [[nodiscard]] double length() const { return last - first; }
};

struct Moments {
  double count = 0.0;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();

  void add(Eigen::Vector2d const& place) {
    count += 1.0;
    sum += place;
    squares += place * place.transpose();
  }
  [[nodiscard]] Eigen::Matrix2d covariance() const {
    Eigen::Vector2d const mean = sum / count;
    return squares / count - mean * mean.transpose();
  }
};

/// A number a cell, in tiles as the grid has them: the neighbours of a cell mostly lie in the tile that was looked into
/// last.
class CellNumbers {
 public:
  void set(Cell cell, std::int32_t number) {
    auto& tile = tiles_[key_of(cell)];
    if (!tile) {
      tile = std::make_unique<Tile>();
      tile->fill(none);
    }
    (*tile)[place_of(cell)] = number;
  }
  /// Less than zero: none.
  [[nodiscard]] std::int32_t at(Cell cell) const {
    auto const key = key_of(cell);
    if (!last_ || key != last_key_) {
      auto const found = tiles_.find(key);
      last_ = found == tiles_.end() ? nullptr : found->second.get();
      last_key_ = key;
    }
    return last_ ? (*last_)[place_of(cell)] : none;
  }

 private:
  static constexpr std::int32_t none = -1;
  using Tile = std::array<std::int32_t, std::size_t{map::tile_cells} * map::tile_cells>;
  static std::uint64_t key_of(Cell cell) {
    auto const [x, y] = map::tile_of(cell);
    return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U) | static_cast<std::uint32_t>(y);
  }
  static std::size_t place_of(Cell cell) {
    constexpr std::int32_t within = map::tile_cells - 1;
    return static_cast<std::size_t>(cell.y & within) * map::tile_cells + static_cast<std::size_t>(cell.x & within);
  }

  std::unordered_map<std::uint64_t, std::unique_ptr<Tile>> tiles_;
  mutable Tile const* last_ = nullptr;
  mutable std::uint64_t last_key_ = 0;
};

/// The taken cells of a grid that have free ground beside them, by where they lie.
class Pieces {
 public:
  Pieces(map::OccupancyGrid const& grid, WallOptions const& options)
      : grid_(grid),
        cell_m_(grid.resolution_m()),
        reach_(cells_in(options.around_m)),
        open_reach_(cells_in(options.open_m)),
        free_up_to_(1.0 - options.taken_from) {
    for (auto const& [key, tile] : grid.tiles()) {
      for (int i = 0; i < map::tile_cells * map::tile_cells; ++i) {
        auto const evidence = tile->cells[static_cast<std::size_t>(i)];
        if (!evidence.is_seen() || evidence.probability() < options.taken_from) continue;
        add({key.x * map::tile_cells + i % map::tile_cells, key.y * map::tile_cells + i / map::tile_cells});
      }
    }
    for (std::size_t i = 0; i < pieces_.size(); ++i) look_around(i);
  }

  [[nodiscard]] std::size_t size() const { return pieces_.size(); }
  [[nodiscard]] Piece& operator[](std::size_t i) { return pieces_[i]; }
  [[nodiscard]] Piece const& operator[](std::size_t i) const { return pieces_[i]; }

  /// Calls with the number of each taken cell within so many cells of this one in both directions.
  template <class Visit>
  void for_each_near(std::size_t i, int reach, Visit const& visit) const {
    auto const cell = cells_[i];
    for (int y = -reach; y <= reach; ++y) {
      for (int x = -reach; x <= reach; ++x) {
        auto const found = numbers_.at({cell.x + x, cell.y + y});
        if (found >= 0 && static_cast<std::size_t>(found) != i) visit(static_cast<std::size_t>(found));
      }
    }
  }

 private:
  void add(Cell cell) {
    bool has_free_ground = false;
    for_each_free_near(cell, [&](Eigen::Vector2d const&) { has_free_ground = true; });
    if (!has_free_ground) return;
    numbers_.set(cell, static_cast<std::int32_t>(pieces_.size()));
    cells_.push_back(cell);
    pieces_.push_back({.at = {(cell.x + 0.5) * cell_m_, (cell.y + 0.5) * cell_m_},
                       .along = Eigen::Vector2d::Zero(),
                       .open = Eigen::Vector2d::Zero()});
  }
  [[nodiscard]] int cells_in(double length_m) const {
    return std::max(1, static_cast<int>(std::lround(length_m / cell_m_)));
  }
  [[nodiscard]] bool is_free(Cell cell) const {
    auto const evidence = grid_.at(cell);
    return evidence.is_seen() && evidence.probability() <= free_up_to_;
  }
  void look_around(std::size_t i) {
    constexpr double fewest = 3.0;
    Moments around;
    around.add(Eigen::Vector2d::Zero());  // from here, so that sums of squares keep their digits
    for_each_near(i, reach_, [&](std::size_t other) { around.add(pieces_[other].at - pieces_[i].at); });
    if (around.count < fewest) return;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const axes(around.covariance());
    auto& piece = pieces_[i];
    piece.along = axes.eigenvectors().col(1);
    piece.straight = 1.0 - axes.eigenvalues()(0) / axes.eigenvalues()(1);
    look_for_free_ground(piece, cells_[i]);
  }
  /// Calls with the way to each free cell within reach, in cells.
  template <class Visit>
  void for_each_free_near(Cell cell, Visit const& visit) const {
    for (int y = -open_reach_; y <= open_reach_; ++y)
      for (int x = -open_reach_; x <= open_reach_; ++x)
        if (is_free({cell.x + x, cell.y + y})) visit(Eigen::Vector2d(x, y));
  }
  void look_for_free_ground(Piece& piece, Cell cell) const {
    constexpr double least_beside = 0.5;  // cells; what lies on the line is on neither side
    constexpr int one_sided = 3;          // times as many there as on the other
    Eigen::Vector2d const left(-piece.along.y(), piece.along.x());
    int on_left = 0;
    int on_right = 0;
    for_each_free_near(cell, [&](Eigen::Vector2d const& way) {
      double const beside = left.dot(way);
      if (std::abs(beside) >= least_beside) ++(beside > 0.0 ? on_left : on_right);
    });
    if (on_left > one_sided * on_right) piece.open = left;
    if (on_right > one_sided * on_left) piece.open = -left;
  }

  map::OccupancyGrid const& grid_;
  double cell_m_;
  int reach_;
  int open_reach_;
  double free_up_to_;
  std::vector<Cell> cells_;
  std::vector<Piece> pieces_;
  CellNumbers numbers_;
};

/// Places that lie along one line, with free ground on the same side.
struct Region {
  std::vector<Eigen::Vector2d> places;
  Eigen::Vector2d open = Eigen::Vector2d::Zero();  ///< as of a piece
};

Fit fit(Region const& region) {
  auto const& begin = region.places.front();
  Moments moments;
  for (auto const& place : region.places) moments.add(place - begin);
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> const axes(moments.covariance());
  Fit line{.middle = begin + moments.sum / moments.count,
           .along = axes.eigenvectors().col(1),
           .spread = std::sqrt(std::max(0.0, axes.eigenvalues()(0))),
           .straight = 1.0 - axes.eigenvalues()(0) / axes.eigenvalues()(1)};
  for (auto const& place : region.places) {
    line.first = std::min(line.first, line.on_line(place));
    line.last = std::max(line.last, line.on_line(place));
  }
  return line;
}

/// The angle between two lines, which have no front: 0 to a quarter turn.
double turn_between(Eigen::Vector2d const& a, Eigen::Vector2d const& b) {
  return std::acos(std::min(1.0, std::abs(a.dot(b))));
}

Region grow(Pieces& pieces, std::size_t seed, WallOptions const& options) {
  constexpr int step_cells = 2;           // over a cell that no beam has met
  constexpr double least_straight = 0.9;  // a few cells of a thick surface lie along any line
  std::vector<std::size_t> members{seed};
  pieces[seed].is_used = true;
  Region region{.places = {pieces[seed].at}, .open = pieces[seed].open};
  Fit line{.middle = pieces[seed].at, .along = pieces[seed].along};
  std::size_t next_fit = 8;
  for (std::size_t i = 0; i < members.size(); ++i) {
    pieces.for_each_near(members[i], step_cells, [&](std::size_t near) {
      auto& piece = pieces[near];
      if (piece.is_used || piece.straight == 0.0 || turn_between(piece.along, line.along) > options.most_turn) return;
      if (!face_alike(piece.open, region.open) || line.beside(piece.at) > options.beside_m) return;
      piece.is_used = true;
      members.push_back(near);
      region.places.push_back(piece.at);
      if (region.open.isZero()) region.open = piece.open;
      if (region.places.size() < next_fit) return;
      if (auto const grown = fit(region); grown.straight >= least_straight) line = grown;
      next_fit += next_fit / 2;
    });
  }
  return region;
}

/// The share of the line's length that has places beside it, in steps of two cells.
double filled(Region const& region, Fit const& line, double cell_m) {
  double const step = 2.0 * cell_m;
  std::set<int> steps;
  for (auto const& place : region.places) steps.insert(static_cast<int>((line.on_line(place) - line.first) / step));
  return static_cast<double>(steps.size()) / (std::floor(line.length() / step) + 1.0);
}

struct Wall {
  Region region;
  Fit line;
};

bool continue_each_other(Wall const& a, Wall const& b, WallOptions const& options) {
  constexpr double most_turn = 0.09;
  if (!face_alike(a.region.open, b.region.open)) return false;
  if (turn_between(a.line.along, b.line.along) > most_turn) return false;
  auto const& longer = a.line.length() >= b.line.length() ? a.line : b.line;
  auto const& shorter = a.line.length() >= b.line.length() ? b.line : a.line;
  Eigen::Vector2d const first = shorter.middle + shorter.first * shorter.along;
  Eigen::Vector2d const last = shorter.middle + shorter.last * shorter.along;
  if (std::max(longer.beside(first), longer.beside(last)) > options.beside_m) return false;
  auto const [low, high] = std::minmax({longer.on_line(first), longer.on_line(last)});
  return std::max(low - longer.last, longer.first - high) <= options.most_gap_m;
}

void join(std::vector<Wall>& walls, WallOptions const& options) {
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = i + 1; j < walls.size(); ++j) {
      if (!continue_each_other(walls[i], walls[j], options)) continue;
      auto& places = walls[i].region.places;
      places.insert(places.end(), walls[j].region.places.begin(), walls[j].region.places.end());
      if (walls[i].region.open.isZero()) walls[i].region.open = walls[j].region.open;
      walls[i].line = fit(walls[i].region);
      walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(j));
      j = i;  // the longer one may continue what it did not before
    }
  }
}

/// In a corner the surroundings of a cell lie along neither wall: the cells there are taken in now, as far as they go
/// on without a gap.
void go_on_into_corners(Fit& line, map::OccupancyGrid const& grid, WallOptions const& options) {
  double const step = 0.5 * grid.resolution_m();
  auto const is_taken = [&](double on_line) {
    Eigen::Vector2d const place = line.middle + on_line * line.along;
    auto const evidence = grid.at(grid.cell_at(geo::Point<map::GridFrame>(place)));
    return evidence.is_seen() && evidence.probability() >= options.taken_from;
  };
  double const most = options.around_m;
  for (double const last = line.last + most; line.last < last && is_taken(line.last + step);) line.last += step;
  for (double const first = line.first - most; line.first > first && is_taken(line.first - step);) line.first -= step;
}

/// The same whichever way the axis came out.
WallLine line_of(Fit const& line) {
  Eigen::Vector2d from = line.middle + line.first * line.along;
  Eigen::Vector2d to = line.middle + line.last * line.along;
  if (std::pair(to.x(), to.y()) < std::pair(from.x(), from.y())) std::swap(from, to);
  return {.from = geo::Point<map::GridFrame>(from), .to = geo::Point<map::GridFrame>(to), .spread_m = line.spread};
}

}  // namespace

std::vector<WallLine> find_walls(map::OccupancyGrid const& grid, WallOptions const& options) {
  constexpr double least_straight = 0.6;
  constexpr std::size_t least_cells = 4;
  Pieces pieces(grid, options);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i].straight >= least_straight) order.push_back(i);
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) { return pieces[i].straight; });

  std::vector<Wall> walls;
  for (auto const seed : order) {
    if (pieces[seed].is_used) continue;
    auto region = grow(pieces, seed, options);
    if (region.places.size() < least_cells) continue;
    auto const line = fit(region);
    walls.push_back({std::move(region), line});
  }
  auto const longest_first = [&] {
    std::ranges::stable_sort(walls, std::ranges::greater(), [](Wall const& wall) { return wall.line.length(); });
  };
  longest_first();
  join(walls, options);
  double const cell_m = grid.resolution_m();
  for (auto& wall : walls) go_on_into_corners(wall.line, grid, options);
  std::erase_if(walls, [&](Wall const& wall) {
    return wall.line.length() + cell_m < options.least_m ||
           filled(wall.region, wall.line, cell_m) < options.least_filled;
  });
  longest_first();
  std::vector<WallLine> lines;
  for (auto const& wall : walls) lines.push_back(line_of(wall.line));
  return lines;
}

}  // namespace lapwing::slam
