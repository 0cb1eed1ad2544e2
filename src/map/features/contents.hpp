#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "base/time.hpp"
#include "map/features/geometry.hpp"

/// What lies on the map, as values. Each kind is a layer; grids have a room of their own (`map/grid`).
namespace lapwing::map {

enum class SlotState { unknown, free, taken };

/// One marked place for a car.
struct Slot {
  SitePolygon outline = {};
  SlotState state = SlotState::unknown;
  std::optional<double> taken_probability = {};  ///< 0..1, calibrated: of ten slots at 0.9 nine are taken
  std::optional<base::UtcTime> seen_at = {};     ///< when a camera had it in view last; not after its account
  std::string seen_by = {};                      ///< vehicle id
  std::string name = {};                         ///< what is painted on it
  friend bool operator==(Slot const&, Slot const&) = default;
};

/// A straight wall, or a line of them.
struct Wall {
  LineString line = {};
  std::optional<double> thickness_m = {};
  std::optional<double> height_m = {};  ///< above the floor
  friend bool operator==(Wall const&, Wall const&) = default;
};

/// A door, a name tag, whatever a person would point to.
struct PointOfInterest {
  SitePoint position = {};
  double height_m = 0.0;                  ///< above the floor
  std::string kind = {};                  ///< "door", "name tag", ...
  std::string name = {};                  ///< "221"
  std::string text = {};                  ///< all that was read there
  std::string picture = {};               ///< content hash in the store; empty: none
  std::optional<double> facing_rad = {};  ///< counterclockwise from the frame's x axis: out of the wall
  std::optional<double> confidence = {};  ///< 0..1
  /// Of the position, in m^2, along x and y of the frame.
  std::optional<Eigen::Matrix2d> covariance_m2 = {};
  friend bool operator==(PointOfInterest const&, PointOfInterest const&) = default;
};

/// A picture taken from somewhere, with what of the ground is seen in it.
struct Picture {
  std::string image = {};      ///< content hash in the store
  std::string thumbnail = {};  ///< content hash in the store; empty: none yet
  std::string media_type = "image/jpeg";
  int width_px = 0;
  int height_px = 0;
  base::UtcTime taken_at = {};
  std::string vehicle = {};
  SitePoint position = {};
  double up_m = 0.0;  ///< above the site's anchor
  /// From the camera's frame (x right, y down, z ahead: OpenCV's) to the site's.
  std::optional<Eigen::Quaterniond> site_from_camera = {};
  /// The ground that the corners of the picture show, from its upper left one clockwise as it is seen: a true
  /// quadrilateral, by the camera's pose. Empty where it is not known, or the horizon is in the picture.
  std::vector<SitePoint> footprint = {};
  friend bool operator==(Picture const&, Picture const&) = default;
};

/// Where a vehicle has been.
struct Track {
  struct Sample {
    SitePoint position = {};
    double up_m = 0.0;  ///< above the site's anchor
    base::UtcTime at = {};
    friend bool operator==(Sample const&, Sample const&) = default;
  };
  std::string vehicle = {};
  std::vector<Sample> samples =
      {};  ///< in the order of time, no two of one moment, none after its account; at least two
  /// How coarse it has become: 0 with all samples, else with the first of each 2^(thinning - 4) seconds, and the last.
  int thinning = 0;
  friend bool operator==(Track const&, Track const&) = default;
};

/// A track with more samples than that is thinned (`map/live/merge.hpp`).
inline constexpr std::size_t most_track_samples = 4'000;

enum class AreaPurpose { wanted, fence, no_go };

/// Where vehicles shall look, must stay, or must not go.
struct Area {
  SitePolygon outline = {};
  AreaPurpose purpose = AreaPurpose::wanted;
  std::string name = {};
  std::optional<double> lowest_m = {};   ///< above the site's anchor
  std::optional<double> highest_m = {};  ///< above the site's anchor
  friend bool operator==(Area const&, Area const&) = default;
};

using Content = std::variant<Slot, Wall, PointOfInterest, Picture, Track, Area>;

}  // namespace lapwing::map
