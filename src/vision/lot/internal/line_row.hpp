#pragma once

#include <optional>
#include <span>
#include <vector>

#include "vision/lot/markings.hpp"
#include "vision/lot/seen_ground.hpp"

namespace lapwing::vision::internal {

/// A side of slots, in the row's own axes.
struct Tooth {
  double at = 0.0;  ///< across the sides, along the row
  double begin = 0.0;
  double end = 0.0;  ///< along the side
  /// The picture ends there, and not the side.
  bool is_begin_cut = false;
  bool is_end_cut = false;

  [[nodiscard]] double length() const { return end - begin; }
};

/// value(x) = offset + slope * x
struct Linear {
  double slope = 0.0;
  double offset = 0.0;

  [[nodiscard]] double operator()(double x) const { return offset + slope * x; }
};

/// How cars stand in a row: side by side, or one behind the other, as along a kerb.
enum class Parking { side_by_side, in_line };

/// Lines side by side at a pitch: one row of slots, or two that share their lines head to head.
struct LineRow {
  Parking parking = Parking::side_by_side;
  cv::Point2d along;         ///< a unit vector, as the sides lie
  cv::Point2d across;        ///< the other one
  std::vector<Tooth> teeth;  ///< by place
  double pitch = 0.0;
  Linear begin;  ///< where sides begin and end, by place along the row: slanted rows shift
  Linear end;
  std::optional<double> head;  ///< of two rows head to head: where they meet, 0 at `begin` and 1 at `end`

  [[nodiscard]] cv::Point2d point(double place, double share) const {
    return place * across + (begin(place) + share * (end(place) - begin(place))) * along;
  }
};

/// Every row that three or more of the lines make, as deep as they say. Where the picture cuts off its sides at one
/// end, the row that lies at the other one is told alone; where it does so at both, nothing is. Lines of a row in which
/// cars stand side by side are no sides of slots in line.
[[nodiscard]] std::vector<LineRow> rows_of(std::span<PaintedLine const> lines, SeenGround const& seen);

}  // namespace lapwing::vision::internal
