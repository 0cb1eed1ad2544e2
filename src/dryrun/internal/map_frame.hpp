#pragma once

#include "dryrun/internal/picture.hpp"

namespace lapwing::dryrun::internal {

/// Metres of the site, north and east.
struct Extent {
  double south = 0.0;
  double north = 0.0;
  double west = 0.0;
  double east = 0.0;

  void include(double to_north, double to_east);
  [[nodiscard]] double width() const { return east - west; }
  [[nodiscard]] double height() const { return north - south; }
};

/// What a map has to show: all tracks, mission items and home, the fence as far as it is near, and some room.
[[nodiscard]] Extent extent_of(Subject const& subject);

/// Puts metres on the picture: north is up, both directions in one scale, the extent in the middle of the box.
class MapFrame {
 public:
  MapFrame(Extent const& extent, Box const& box);

  [[nodiscard]] Point at(double north_m, double east_m) const {
    return {centre_.x + (east_m - east_) * pixels_, centre_.y - (north_m - north_) * pixels_};
  }
  [[nodiscard]] Point at(geo::Ned place) const { return at(place.north, place.east); }
  [[nodiscard]] double pixels_per_m() const { return pixels_; }
  /// What the whole box shows.
  [[nodiscard]] Extent shown() const;

 private:
  Box box_;
  Point centre_;
  double north_;
  double east_;
  double pixels_;
};

}  // namespace lapwing::dryrun::internal
