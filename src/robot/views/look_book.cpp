#include "robot/views/look_book.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "geo/position.hpp"

namespace lapwing::robot {

namespace {

constexpr double piece_m = 0.4;
constexpr double clearer = 1.3;       ///< by so much, and what could not be told may be told now
constexpr double much_clearer = 2.0;  ///< by so much, and something may be seen where nothing was
constexpr int enough_reads = 2;
constexpr int most_tries = 3;

WallPoint middle_of(WallPiece const& piece) {
  auto const& [x, y, quarter] = piece;
  return {.position = {(x + 0.5) * piece_m, (y + 0.5) * piece_m},
          .facing_rad = geo::wrap_pi(quarter * std::numbers::pi / 2.0)};
}

}  // namespace

WallPiece piece_of(WallPoint const& wall) {
  auto const quarter = static_cast<int>(std::lround(wall.facing_rad / (std::numbers::pi / 2.0)));
  return {static_cast<int>(std::floor(wall.position.x() / piece_m)),
          static_cast<int>(std::floor(wall.position.y() / piece_m)), (quarter % 4 + 4) % 4};
}

double clearness(CameraMount const& mount, WallPoint const& wall, double way_rad) {
  double const focal_px = mount.width_px / 2.0 / std::tan(mount.view_rad / 2.0);
  double const slant_rad = geo::wrap_pi(wall.facing_rad + std::numbers::pi - way_rad);
  return focal_px * std::max(0.0, std::cos(slant_rad)) / std::max(wall.range_m, 0.1);
}

void LookBook::pass(WallPoint const& wall) {
  auto& known = pieces_[piece_of(wall)].wall;
  if (!known || wall.range_m < known->range_m) known = wall;
}

bool LookBook::is_due(WallPiece const& piece, double clearness) const {
  auto const found = pieces_.find(piece);
  if (found == pieces_.end() || found->second.tries == 0) return true;
  auto const& looks = found->second;
  if (looks.reads >= enough_reads) return false;
  bool const is_blank = looks.last == Outcome::blank;
  bool const is_clearer = clearness >= looks.clearest * clearer;
  if (is_blank && looks.clearest >= noticed_px_m) return false;
  if (is_blank) return is_clearer && clearness >= std::min(looks.clearest * much_clearer, noticed_px_m);
  if (is_clearer) return true;
  return looks.tries < most_tries && clearness * clearer >= looks.clearest;
}

void LookBook::note(WallPiece const& piece, double clearness, Outcome outcome) {
  auto& looks = pieces_[piece];
  if (clearness >= looks.clearest * clearer) looks.tries = 0;
  looks.clearest = std::max(looks.clearest, clearness);
  // The piece's edge may be all that this picture shows of it, and the sign is at the other one; or somebody stands
  // before what was noticed from afar.
  bool const may_hide_it = looks.last == Outcome::cut_off || (looks.last == Outcome::poor && clearness < clear_px_m);
  if (outcome != Outcome::blank || !may_hide_it) looks.last = outcome;
  ++looks.tries;
  if (outcome == Outcome::read) ++looks.reads;
}

void LookBook::give_up(WallPiece const& piece) {
  auto const found = pieces_.find(piece);
  if (found != pieces_.end()) found->second.is_given_up = true;
}

void LookBook::move(MapMove const& moved) {
  std::map<WallPiece, Piece> pieces;
  for (auto const& [key, piece] : pieces_) {
    auto wall = piece.wall.value_or(middle_of(key));
    auto const now = moved({wall.position, wall.facing_rad});
    wall.position = now.position;
    wall.facing_rad = now.yaw_rad;
    // Two may come to be one: what was seen clearer counts.
    auto& there = pieces.try_emplace(piece_of(wall), piece).first->second;
    auto both = piece.clearest > there.clearest ? piece : there;
    both.wall = piece.wall ? wall : there.wall;
    both.is_given_up = piece.is_given_up || there.is_given_up;
    there = std::move(both);
  }
  pieces_ = std::move(pieces);
}

std::vector<LookBook::Unclear> LookBook::unclear() const {
  std::vector<Unclear> walls;
  for (auto const& [key, piece] : pieces_) {
    bool const is_clear = piece.reads > 0 || (piece.last == Outcome::blank && piece.clearest >= noticed_px_m) ||
                          (piece.last == Outcome::poor && piece.clearest >= clear_px_m);
    if (piece.wall && !is_clear && !piece.is_given_up)
      walls.push_back({.wall = *piece.wall, .shows_something = piece.last != Outcome::blank});
  }
  return walls;
}

}  // namespace lapwing::robot
