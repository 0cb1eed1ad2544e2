#pragma once

#include <string>
#include <vector>

#include "sim/building/plan/building_plan.hpp"
#include "sim/building/scene/faces.hpp"

/// The drawn plan as bodies: one source for what sensors meet and for what cameras see.
namespace lapwing::sim::building {

/// How a camera sees a surface, beyond its colour.
enum class Look : std::uint8_t { plain, plaster, wood, metal, skin };

/// An upright prism over a convex ring, counterclockwise.
struct Solid {
  std::vector<Place> ring;
  double bottom_m = 0.0;
  double top_m = 0.0;
  Material material = Material::plaster;
  Thing thing = Thing::wall;
  std::uint32_t number = 0;
  Look look = Look::plaster;
  Colour colour;
};

/// A plate with letters, upright, seen from where it faces.
struct Sign {
  std::string text;  ///< lines with '\n' between
  Place middle;
  double middle_up_m = 1.4;
  double facing_rad = 0.0;
  double width_m = 0.0;
  double height_m = 0.0;
};

/// Capitals on signs are so high.
inline constexpr double letter_height_m = 0.06;

/// `facing` is left to whoever hangs it.
[[nodiscard]] Sign sign_of(std::string text);

/// A rectangle around `middle`: `length_m` along the pose's x axis.
[[nodiscard]] std::vector<Place> rectangle(Pose const& middle, double length_m, double width_m);

/// How a door hangs in its wall.
struct DoorFrame {
  Place pivot;              ///< of the leaf, on the side to which it opens
  double closed_rad = 0.0;  ///< from the pivot along the closed leaf
  double opens_by = 1.0;    ///< 1 counterclockwise, -1 clockwise
  double width_m = 0.0;
  double height_m = 0.0;
  double wall_thickness_m = 0.0;
  Place middle;            ///< of the opening, on the wall's middle line
  double front_rad = 0.0;  ///< the way that its front looks: away from where it opens to
  std::string id;
  std::string text;
  bool is_sign_on_leaf = false;
  Colour colour;
};

inline constexpr double leaf_thickness_m = 0.04;

/// The leaf at an angle, as a ring, and the wood that a camera sees of it.
[[nodiscard]] std::vector<Place> leaf_ring(DoorFrame const& frame, double angle_rad);
/// What hangs on the leaf: handles on both sides.
[[nodiscard]] std::vector<Solid> handles(DoorFrame const& frame, double angle_rad);
/// Where the sign hangs while the leaf stands at that angle. Precondition: it has a text.
[[nodiscard]] Sign sign_at(DoorFrame const& frame, double angle_rad);

/// What never moves.
struct Bodies {
  std::vector<Solid> solids;     ///< walls, lintels, furniture
  std::vector<Solid> trimmings;  ///< only to be seen: frames of doors
  std::vector<DoorFrame> doors;
};

/// Precondition: each door stands in a wall (`opening_of`).
[[nodiscard]] Bodies bodies_of(BuildingPlan const& plan);

/// The faces that a sensor at that height meets.
[[nodiscard]] std::vector<Face> faces_of(BuildingPlan const& plan, Bodies const& bodies, double up_m);
/// Of one ring.
void add_faces(std::vector<Place> const& ring, Face const& like, std::vector<Face>& into);

}  // namespace lapwing::sim::building
