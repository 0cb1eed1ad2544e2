#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "sim/building/picture/letters.hpp"
#include "sim/building/scene/people.hpp"
#include "sim/building/scene/solids.hpp"

/// The building as a camera sees it: convex flat pieces with a look.
namespace lapwing::sim::building {

/// A sign's letters, laid out once.
struct Lettering {
  std::vector<LetterRow> rows;
  double width_m = 0.0;
  double height_m = 0.0;
};

struct Surface {
  enum class Kind : std::uint8_t { solid, floor, ceiling, sign };

  static constexpr int most_corners = 8;
  std::array<Eigen::Vector3d, most_corners> corners;
  int corner_count = 0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< towards where it is seen from
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();   ///< of its own plane, lower left
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();  ///< in its own plane, to the right
  Eigen::Vector3d up = Eigen::Vector3d::UnitY();
  Kind kind = Kind::solid;
  Look look = Look::plain;
  Colour colour;
  std::shared_ptr<Lettering const> lettering = nullptr;  ///< of a sign; shared by every picture of it
};

/// Sides, and top and bottom.
void add_solid(Solid const& solid, std::vector<Surface>& into);
void add_sign(Sign const& sign, std::shared_ptr<Lettering const> lettering, std::vector<Surface>& into);
[[nodiscard]] std::shared_ptr<Lettering const> lettering_of(Sign const& sign);

/// All that never moves: walls, furniture, frames, floor and ceiling.
[[nodiscard]] std::vector<Surface> surfaces_of(BuildingPlan const& plan, Bodies const& bodies);

/// A person as a figure of blocks, with clothes by `number`.
[[nodiscard]] std::vector<Solid> figure_of(People::Person const& person, std::size_t number);
/// A robot as a drum with a mast.
[[nodiscard]] std::vector<Solid> robot_figure(Pose const& pose, double radius_m, double mast_up_m);

}  // namespace lapwing::sim::building
