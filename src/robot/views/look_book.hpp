#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "robot/views/tag_place.hpp"

namespace lapwing::robot {

/// A piece of wall, as wide as a camera's middle surely shows: its place in such widths, and the quarter it faces.
using WallPiece = std::tuple<int, int, int>;
[[nodiscard]] WallPiece piece_of(WallPoint const& wall);

/// How large a camera shows what hangs on a wall: pixels for each metre along it. Distance makes it less, and so does
/// slant, which makes letters narrow.
[[nodiscard]] double clearness(CameraMount const& mount, WallPoint const& wall, double way_rad);

/// Which pieces of wall have been looked at, and how clearly, so that each is looked at a few times and not more.
///
/// A look that could tell nothing from afar or aslant does not settle a piece: it is looked at again when it is seen
/// clearer than ever before, by much where nothing was seen. What shows nothing where a sign would have been noticed is
/// settled. That is what bounds the pictures: looking at one takes a good part of a second of a core, and a building
/// has more walls than signs.
class LookBook {
 public:
  enum class Outcome {
    blank,    ///< nothing is written there
    read,     ///< sharply, all of it, with a number
    poor,     ///< blurred, from afar, or without a number
    cut_off,  ///< by the edge of the picture
  };
  /// So clear, and what is written there can be read for sure: letters of 6 cm are 24 pixels high then.
  static constexpr double clear_px_m = 400.0;
  /// So clear, and what shows nothing is blank: rendered signs are noticed, at 0.9 rad aslant all but one of ten
  /// (bench_notice).
  static constexpr double noticed_px_m = 150.0;

  /// The robot came past it, whether a camera looked or not.
  void pass(WallPoint const& wall);
  [[nodiscard]] bool is_due(WallPiece const& piece, double clearness) const;
  void note(WallPiece const& piece, double clearness, Outcome outcome);
  /// The map has moved, and its walls with it.
  void move(MapMove const& moved);
  /// What it came past and never saw clearly.
  struct Unclear {
    WallPoint wall;
    bool shows_something = false;  ///< a sign, that could not be read or was cut off
  };
  [[nodiscard]] std::vector<Unclear> unclear() const;
  /// Nothing more is to be expected of it. One that is not known, as the map has moved meanwhile, is left.
  void give_up(WallPiece const& piece);

 private:
  struct Piece {
    std::optional<WallPoint> wall = {};  ///< as it was seen from nearest by
    double clearest = 0.0;
    int reads = 0;
    int tries = 0;  ///< at the clearest, or not much less clear
    Outcome last = Outcome::blank;
    bool is_given_up = false;  ///< nobody goes there for it
  };

  std::map<WallPiece, Piece> pieces_;
};

}  // namespace lapwing::robot
