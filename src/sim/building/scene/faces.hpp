#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/building/plan/building_plan.hpp"

/// What is solid at the height of a robot's sensors, and rays into it.
namespace lapwing::sim::building {

/// What a ray meets or a robot bumps into.
enum class Thing : std::uint8_t { wall, door, furniture, person, robot };

[[nodiscard]] std::string_view to_string(Thing thing);

/// One side of something solid, which lies to its left, going from `from` to `to`.
struct Face {
  Place from;
  Place to;
  Material material = Material::plaster;
  Thing thing = Thing::wall;
  std::uint32_t number = 0;  ///< which one of its kind
};

/// An upright cylinder.
struct Post {
  Place middle;
  double radius_m = 0.0;
  Material material = Material::cloth;
  Thing thing = Thing::person;
  std::uint32_t number = 0;
};

struct Hit {
  double range_m = 0.0;
  Shift normal;            ///< outwards, one long
  double to_edge_m = 0.0;  ///< from the nearer end of what was hit; a post has none, which is infinite
  Material material = Material::plaster;
  Thing thing = Thing::wall;
  std::uint32_t number = 0;
};

/// Where a ray that comes from outside meets it, within `range_m`. `way` is one long.
[[nodiscard]] std::optional<Hit> meet(Face const& face, Place const& from, Shift const& way, double range_m);
[[nodiscard]] std::optional<Hit> meet(Post const& post, Place const& from, Shift const& way, double range_m);

/// The point of a face that is nearest.
[[nodiscard]] Place nearest_point(Face const& face, Place const& to);

/// Faces that do not move, found by place.
class FaceIndex {
 public:
  explicit FaceIndex(std::vector<Face> faces);

  [[nodiscard]] std::span<Face const> faces() const { return faces_; }
  /// The nearest hit.
  [[nodiscard]] std::optional<Hit> cast(Place const& from, Shift const& way, double range_m) const;
  /// Calls `visit(face)` for each that may be nearer than `reach_m`, some more than once.
  template <class Visit>
  void near(Place const& place, double reach_m, Visit const& visit) const {
    auto const low = cell_at(place - Shift(reach_m, reach_m));
    auto const high = cell_at(place + Shift(reach_m, reach_m));
    for (auto y = std::max(low.y, 0); y <= std::min(high.y, height_ - 1); ++y) {
      for (auto x = std::max(low.x, 0); x <= std::min(high.x, width_ - 1); ++x) {
        for (auto const face : in({x, y})) visit(faces_[face]);
      }
    }
  }

 private:
  [[nodiscard]] map::Cell cell_at(Place const& place) const;
  [[nodiscard]] std::span<std::uint32_t const> in(map::Cell cell) const;
  template <class Visit>
  void each_cell(Face const& face, Visit const& visit) const;

  std::vector<Face> faces_;
  Place corner_;
  double cell_m_ = 0.5;
  int width_ = 0;
  int height_ = 0;
  std::vector<std::uint32_t> begins_;  ///< of each cell's faces in `in_cells_`, and the end
  std::vector<std::uint32_t> in_cells_;
};

/// All that is solid at one moment.
struct Surroundings {
  FaceIndex const& fixed;
  std::vector<Face> moving = {};
  std::vector<Post> posts = {};

  /// The nearest hit; what the ray begins inside of is not met.
  [[nodiscard]] std::optional<Hit> cast(Place const& from, Shift const& way, double range_m) const;
};

}  // namespace lapwing::sim::building
