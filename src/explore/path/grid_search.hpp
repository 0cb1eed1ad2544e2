#pragma once

#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <vector>

#include "explore/known/known_map.hpp"

namespace lapwing::explore {

/// Paths over standable cells (A*, Hart, Nilsson & Raphael 1968; eight directions, octile distance). Cells near walls
/// count half as long again, so that paths keep off them where there is room, and those that can be stood on for the
/// one reason that a robot has driven there four times. Of all paths that cost the same, and over open floor there are
/// many, it is a straight one where a straight line is among them. Its memory is kept between searches.
class GridSearch {
 public:
  explicit GridSearch(KnownMap const& map);

  struct Request {
    Cell from = {};
    Cell to = {};
    double radius_m = 0.0;  ///< of the robot: where it stands too near to something it may leave over what it fits on
    std::vector<Disc> const* closed = nullptr;  ///< where not to go through, unless it stands there
    std::size_t most_cells = 40'000;            ///< looked at, then it gives up
  };
  /// Both ends included; empty: no path, or none within so many cells.
  [[nodiscard]] std::vector<Cell> path(KnownMap const& map, Request const& request);

 private:
  struct Mark {
    std::uint32_t search = 0;
    float so_far = 0.0F;
    std::uint8_t came_by = 0;
    bool is_closed = false;
  };
  struct Open {
    float estimate = 0.0F;
    std::uint32_t index = 0;
    bool operator>(Open const& other) const { return estimate > other.estimate; }
  };
  using Queue = std::priority_queue<Open, std::vector<Open>, std::greater<>>;

  /// A straight line that ends on the path that was found costs no more than that does.
  [[nodiscard]] bool is_as_cheap(KnownMap const& map, Request const& request, Cell from,
                                 std::span<Cell const> line) const;
  [[nodiscard]] std::vector<Cell> straightened(KnownMap const& map, Request const& request,
                                               std::vector<Cell> const& path) const;
  void look_around(KnownMap const& map, Request const& request, std::uint32_t index, Queue& open);

  DenseGrid<Mark> marks_;
  std::uint32_t searches_ = 0;
};

}  // namespace lapwing::explore
