#include "sim/building/picture/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim::building {

namespace {

using Vector = Eigen::Vector3d;

Vector lifted(Place const& place, double up_m) {
  return {place.x(), place.y(), up_m};
}

Surface face_of(Place const& from, Place const& to, double bottom_m, double top_m, Look look, Colour const& colour) {
  Surface surface;
  surface.corners = {lifted(from, bottom_m), lifted(to, bottom_m), lifted(to, top_m), lifted(from, top_m)};
  surface.corner_count = 4;
  auto const along = (to - from) * (1.0 / distance_m(from, to));
  surface.normal = {along.y(), -along.x(), 0.0};
  surface.origin = surface.corners[0];
  surface.across = {along.x(), along.y(), 0.0};
  surface.up = Vector::UnitZ();
  surface.look = look;
  surface.colour = colour;
  return surface;
}

Surface level(std::vector<Place> const& ring, double up_m, bool is_seen_from_above) {
  Surface surface;
  surface.corner_count = static_cast<int>(std::min<std::size_t>(ring.size(), Surface::most_corners));
  for (int i = 0; i < surface.corner_count; ++i)
    surface.corners[static_cast<std::size_t>(i)] = lifted(ring[static_cast<std::size_t>(i)], up_m);
  surface.normal = is_seen_from_above ? Vector(Vector::UnitZ()) : Vector(-Vector::UnitZ());
  surface.origin = {0.0, 0.0, up_m};
  return surface;
}

std::vector<Place> round(Place const& middle, double radius_m, int corners) {
  std::vector<Place> ring;
  for (int i = 0; i < corners; ++i) {
    double const angle = 2.0 * std::numbers::pi * (i + 0.5) / corners;
    ring.push_back(middle + radius_m * Shift(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

/// What stands on the ground at `ahead` and `aside` of somebody, turned as he is.
Pose beside(Pose const& pose, double ahead_m, double aside_m) {
  double const cos = std::cos(pose.yaw_rad);
  double const sin = std::sin(pose.yaw_rad);
  return {pose.position + Shift(ahead_m * cos - aside_m * sin, ahead_m * sin + aside_m * cos), pose.yaw_rad};
}

}  // namespace

void add_solid(Solid const& solid, std::vector<Surface>& into) {
  for (std::size_t i = 0; i < solid.ring.size(); ++i)
    into.push_back(face_of(solid.ring[i], solid.ring[(i + 1) % solid.ring.size()], solid.bottom_m, solid.top_m,
                           solid.look, solid.colour));
  for (bool const is_top : {false, true}) {
    if (!is_top && solid.bottom_m <= 0.0) continue;
    into.push_back(level(solid.ring, is_top ? solid.top_m : solid.bottom_m, is_top));
    into.back().look = solid.look;
    into.back().colour = solid.colour;
  }
}

std::shared_ptr<Lettering const> lettering_of(Sign const& sign) {
  Lettering lettering{.rows = {}, .width_m = sign.width_m, .height_m = sign.height_m};
  for (std::size_t begin = 0; begin <= sign.text.size();) {
    auto const end = std::min(sign.text.find('\n', begin), sign.text.size());
    lettering.rows.push_back(row_of_letters(std::string_view(sign.text).substr(begin, end - begin)));
    begin = end + 1;
  }
  return std::make_shared<Lettering const>(std::move(lettering));
}

void add_sign(Sign const& sign, std::shared_ptr<Lettering const> lettering, std::vector<Surface>& into) {
  // Who stands before it has its facing counterclockwise on the right.
  Shift const across(-std::sin(sign.facing_rad), std::cos(sign.facing_rad));
  auto const from = sign.middle - sign.width_m / 2.0 * across;
  auto const to = sign.middle + sign.width_m / 2.0 * across;
  into.push_back(face_of(from, to, sign.middle_up_m - sign.height_m / 2.0, sign.middle_up_m + sign.height_m / 2.0,
                         Look::plain, {0.93, 0.93, 0.9}));
  into.back().kind = Surface::Kind::sign;
  into.back().lettering = std::move(lettering);
}

std::vector<Surface> surfaces_of(BuildingPlan const& plan, Bodies const& bodies) {
  std::vector<Surface> surfaces;
  for (auto const& solid : bodies.solids) add_solid(solid, surfaces);
  for (auto const& solid : bodies.trimmings) add_solid(solid, surfaces);
  for (auto const& border : plan.borders)
    surfaces.push_back(face_of(border.from, border.to, 0.0, plan.ceiling_m, Look::plaster, plan.wall_colour));
  if (auto const extent = extent_of(plan)) {
    constexpr double around_m = 30.0;
    auto const low = extent->least - Shift(around_m, around_m);
    auto const high = extent->most + Shift(around_m, around_m);
    std::vector<Place> const ring = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    surfaces.push_back(level(ring, 0.0, true));
    surfaces.back().kind = Surface::Kind::floor;
    surfaces.back().colour = plan.floor_colour;
    surfaces.push_back(level(ring, plan.ceiling_m, false));
    surfaces.back().kind = Surface::Kind::ceiling;
    surfaces.back().colour = {0.9, 0.9, 0.88};
  }
  return surfaces;
}

std::vector<Solid> figure_of(People::Person const& person, std::size_t number) {
  constexpr std::array<Colour, 5> shirts = {
      {{0.2, 0.3, 0.55}, {0.55, 0.2, 0.22}, {0.2, 0.42, 0.3}, {0.78, 0.78, 0.8}, {0.3, 0.3, 0.33}}};
  constexpr Colour trousers{0.16, 0.17, 0.22};
  constexpr Colour skin{0.8, 0.62, 0.52};
  constexpr double stride_m = 0.7;
  constexpr double leg_swing_m = 0.18;
  std::vector<Solid> parts;
  auto const add = [&](std::vector<Place> ring, double bottom_m, double top_m, Look look, Colour const& colour) {
    parts.push_back({.ring = std::move(ring),
                     .bottom_m = bottom_m,
                     .top_m = top_m,
                     .material = Material::cloth,
                     .thing = Thing::person,
                     .number = static_cast<std::uint32_t>(number),
                     .look = look,
                     .colour = colour});
  };
  auto const& shirt = shirts[number % shirts.size()];
  double const swing_m = leg_swing_m * std::sin(std::numbers::pi * person.walked_m / stride_m);
  for (double const side : {-1.0, 1.0}) {
    add(rectangle(beside(person.pose, side * swing_m, side * 0.1), 0.16, 0.14), 0.0, 0.82, Look::plain, trousers);
    add(rectangle(beside(person.pose, -side * swing_m * 0.7, side * 0.25), 0.1, 0.09), 0.75, 1.38, Look::plain, shirt);
  }
  add(rectangle(person.pose, 0.22, 0.4), 0.8, 1.44, Look::plain, shirt);
  add(round(person.pose.position, 0.06, 8), 1.44, 1.5, Look::skin, skin);
  add(round(person.pose.position, 0.1, 8), 1.5, 1.74, Look::skin, skin);
  add(round(beside(person.pose, -0.01, 0.0).position, 0.105, 8), 1.68, 1.77, Look::plain, {0.2, 0.14, 0.1});
  return parts;
}

std::vector<Solid> robot_figure(Pose const& pose, double radius_m, double mast_up_m) {
  std::vector<Solid> parts;
  auto const add = [&](std::vector<Place> ring, double bottom_m, double top_m, Colour const& colour) {
    parts.push_back({.ring = std::move(ring),
                     .bottom_m = bottom_m,
                     .top_m = top_m,
                     .material = Material::wood,
                     .thing = Thing::robot,
                     .number = 0,
                     .look = Look::metal,
                     .colour = colour});
  };
  add(round(pose.position, radius_m, 8), 0.02, 0.18, {0.85, 0.45, 0.1});
  add(round(pose.position, radius_m * 0.4, 8), 0.18, 0.26, {0.12, 0.12, 0.13});
  add(rectangle(beside(pose, -0.05, 0.0), 0.03, 0.03), 0.18, mast_up_m, {0.6, 0.6, 0.62});
  add(rectangle(beside(pose, 0.02, 0.0), 0.08, 0.06), mast_up_m - 0.03, mast_up_m + 0.03, {0.12, 0.12, 0.13});
  return parts;
}

}  // namespace lapwing::sim::building
