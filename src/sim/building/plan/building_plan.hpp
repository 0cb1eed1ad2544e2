#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "geo/site.hpp"
#include "geo/transform.hpp"
#include "map/grid/occupancy_grid.hpp"

/// A building as it is drawn: values alone, nothing moves yet. The frame is that of its one floor: x and y level, z up
/// from the ground.
namespace lapwing::sim::building {

using Place = geo::Point<geo::FloorFrame>;
using Shift = geo::Vector<geo::FloorFrame>;
using Pose = geo::Pose<geo::FloorFrame>;

/// What a surface is made of, as far as sensors notice.
enum class Material {
  plaster,  ///< smooth: a sonar's pulse that comes aslant is mirrored away
  wood,
  cloth,  ///< people, chairs, curtains: scatters sound, and swallows some
  dark,   ///< a laser's light is often swallowed
  glass,  ///< as smooth as plaster to a sonar; a laser's light goes through but where it is met squarely
};

struct Colour {
  double red = 0.0;  ///< each 0 to 1
  double green = 0.0;
  double blue = 0.0;
  friend bool operator==(Colour const&, Colour const&) = default;
};

/// A straight piece of wall by its middle line, as high as the building's ceiling.
struct WallPlan {
  Place from;
  Place to;
  double thickness_m = 0.15;
  Material material = Material::plaster;
  std::optional<Colour> colour = std::nullopt;  ///< nothing: the building's
  friend bool operator==(WallPlan const&, WallPlan const&) = default;
};

/// Whether somebody opens and closes a door now and then: how long it stays each way on the mean.
struct DoorHabit {
  double open_s = 0.0;
  double closed_s = 0.0;
  friend bool operator==(DoorHabit const&, DoorHabit const&) = default;
};

enum class Side { left, right };

/// A door in a wall, between two jambs on the wall's middle line. It swings into the room on one side; frame and sign
/// are seen from both and from the other.
struct DoorPlan {
  std::string id;  ///< unique
  Place hinge;
  Place latch;
  Side opens_to = Side::left;  ///< looking from the hinge to the latch
  double height_m = 2.05;
  double angle_rad = 0.0;  ///< at the beginning; 0 is closed
  std::optional<DoorHabit> habit = std::nullopt;
  std::string sign = {};         ///< lines with '\n' between; empty: none
  bool is_sign_on_leaf = false;  ///< or on the wall beside the latch
  std::optional<Colour> colour = std::nullopt;

  [[nodiscard]] double width_m() const { return distance_m(hinge, latch); }
  friend bool operator==(DoorPlan const&, DoorPlan const&) = default;
};

struct PersonPlan {
  Pose start;
  bool walks = false;
  std::vector<Place> way = {};  ///< there, and back to the first; empty: wherever there is room
  double speed_m_s = 0.8;
  friend bool operator==(PersonPlan const&, PersonPlan const&) = default;
};

/// A block on the ground: a cabinet, a desk with a front, a box.
struct FurniturePlan {
  Pose middle;
  double length_m = 1.0;  ///< along its own x axis
  double width_m = 0.5;
  double height_m = 0.75;
  Material material = Material::wood;
  Colour colour{0.45, 0.47, 0.5};
  friend bool operator==(FurniturePlan const&, FurniturePlan const&) = default;
};

/// Only told: what the area is called, for truth and for maps.
struct RoomPlan {
  std::string name;
  std::vector<Place> corners;
  friend bool operator==(RoomPlan const&, RoomPlan const&) = default;
};

/// The border of something solid of which nothing else is known, as a map shows it: solid to the left, going from
/// `from` to `to`.
struct BorderPlan {
  Place from;
  Place to;
  friend bool operator==(BorderPlan const&, BorderPlan const&) = default;
};

struct BuildingPlan {
  std::string name = "building";
  /// Of the site. Nothing: the building lies nowhere on the globe.
  std::optional<geo::Wgs84> anchor = std::nullopt;
  geo::Transform<geo::SiteFrame, geo::FloorFrame> site_from_floor = {};
  double ceiling_m = 2.7;
  Colour wall_colour{0.86, 0.85, 0.82};
  Colour floor_colour{0.42, 0.45, 0.5};
  Colour door_colour{0.58, 0.38, 0.22};
  std::vector<WallPlan> walls = {};
  std::vector<BorderPlan> borders = {};
  std::vector<DoorPlan> doors = {};
  std::vector<PersonPlan> people = {};
  std::vector<FurniturePlan> furniture = {};
  std::vector<RoomPlan> rooms = {};
  std::vector<Pose> starts = {};  ///< of robots
};

/// The upright rectangle around everything solid; nothing for an empty plan.
[[nodiscard]] std::optional<geo::Box<geo::FloorFrame>> extent_of(BuildingPlan const& plan);

/// A building of a map as ROS has them: the borders of all that is not surely free are walls. It has no doors, people
/// or rooms; those can be added. Errors, invalid_input: nothing free, more than `most_map_cells` around what was seen.
[[nodiscard]] base::Result<BuildingPlan> plan_of_map(map::OccupancyGrid const& grid, std::string name);
inline constexpr std::int64_t most_map_cells = 64'000'000;

}  // namespace lapwing::sim::building
