#include "sim/building/scene/solids.hpp"

#include <algorithm>
#include <cmath>

#include "base/assert.hpp"
#include "sim/building/picture/letters.hpp"
#include "sim/building/plan/door_opening.hpp"

namespace lapwing::sim::building {

namespace {

constexpr double frame_width_m = 0.06;
constexpr double frame_stands_out_m = 0.015;
constexpr Colour frame_colour{0.62, 0.64, 0.66};
constexpr Colour handle_colour{0.72, 0.72, 0.74};

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

double yaw_of(Shift const& way) {
  return std::atan2(way.y(), way.x());
}

Shift to_left(Shift const& way) {
  return {-way.y(), way.x()};
}

/// A block along a line from `begin` to `end`.
std::vector<Place> block(Place const& begin, Place const& end, double thickness_m) {
  auto const along = end - begin;
  return rectangle({begin + 0.5 * along, yaw_of(along)}, along.length(), thickness_m);
}

DoorFrame frame_of(DoorPlan const& door, WallPlan const& wall, Colour const& usual) {
  auto const along = (door.latch - door.hinge) * (1.0 / door.width_m());
  auto const into = door.opens_to == Side::left ? to_left(along) : -to_left(along);
  DoorFrame frame;
  frame.pivot = door.hinge + (wall.thickness_m - leaf_thickness_m) / 2.0 * into;
  frame.closed_rad = yaw_of(along);
  frame.opens_by = door.opens_to == Side::left ? 1.0 : -1.0;
  frame.width_m = door.width_m();
  frame.height_m = door.height_m;
  frame.wall_thickness_m = wall.thickness_m;
  frame.middle = door.hinge + 0.5 * (door.latch - door.hinge);
  frame.front_rad = yaw_of(-into);
  frame.id = door.id;
  frame.text = door.sign;
  frame.is_sign_on_leaf = door.is_sign_on_leaf;
  frame.colour = door.colour.value_or(usual);
  return frame;
}

void add_wall(BuildingPlan const& plan, std::size_t number, std::vector<Opening> const& openings, Bodies& bodies) {
  auto const& wall = plan.walls[number];
  double const length_m = distance_m(wall.from, wall.to);
  auto const way = (wall.to - wall.from) * (1.0 / length_m);
  Solid solid{.ring = {},
              .bottom_m = 0.0,
              .top_m = plan.ceiling_m,
              .material = wall.material,
              .thing = Thing::wall,
              .number = static_cast<std::uint32_t>(number),
              .look = Look::plaster,
              .colour = wall.colour.value_or(plan.wall_colour)};
  for (auto const& stretch : stretches_between(length_m, openings)) {
    // Walls that meet at their ends fill the corner between them.
    double const before_m = stretch.begin_m > 0.0 ? 0.0 : wall.thickness_m / 2.0;
    double const after_m = stretch.end_m < length_m ? 0.0 : wall.thickness_m / 2.0;
    solid.ring = block(wall.from + (stretch.begin_m - before_m) * way, wall.from + (stretch.end_m + after_m) * way,
                       wall.thickness_m);
    bodies.solids.push_back(solid);
  }
}

void add_lintel(BuildingPlan const& plan, DoorPlan const& door, Opening const& opening, Bodies& bodies) {
  auto const& wall = plan.walls[opening.wall];
  if (door.height_m >= plan.ceiling_m) return;
  bodies.solids.push_back({.ring = block(door.hinge, door.latch, wall.thickness_m),
                           .bottom_m = door.height_m,
                           .top_m = plan.ceiling_m,
                           .material = wall.material,
                           .thing = Thing::wall,
                           .number = static_cast<std::uint32_t>(opening.wall),
                           .look = Look::plaster,
                           .colour = wall.colour.value_or(plan.wall_colour)});
}

void add_trimmings(DoorPlan const& door, double wall_thickness_m, Bodies& bodies) {
  auto const way = (door.latch - door.hinge) * (1.0 / door.width_m());
  Solid part{.ring = {},
             .bottom_m = 0.0,
             .top_m = door.height_m,
             .material = Material::wood,
             .thing = Thing::door,
             .number = 0,
             .look = Look::metal,
             .colour = frame_colour};
  double const thickness_m = wall_thickness_m + 2.0 * frame_stands_out_m;
  auto const outside_hinge = door.hinge - frame_width_m * way;
  auto const outside_latch = door.latch + frame_width_m * way;
  part.ring = block(outside_hinge, door.hinge, thickness_m);
  bodies.trimmings.push_back(part);
  part.ring = block(door.latch, outside_latch, thickness_m);
  bodies.trimmings.push_back(part);
  part.ring = block(outside_hinge, outside_latch, thickness_m);
  part.bottom_m = door.height_m;
  part.top_m = door.height_m + frame_width_m;
  bodies.trimmings.push_back(part);
}

}  // namespace

Sign sign_of(std::string text) {
  constexpr double margin_m = 0.035;
  constexpr double line_m = 0.1;
  constexpr double least_width_m = 0.18;
  Sign sign;
  std::size_t lines = 0;
  double widest = 0.0;
  for (std::size_t begin = 0; begin <= text.size(); ++lines) {
    auto const end = std::min(text.find('\n', begin), text.size());
    widest = std::max(widest, row_of_letters(std::string_view(text).substr(begin, end - begin)).width);
    begin = end + 1;
  }
  sign.width_m = std::max(widest * letter_height_m + 2.0 * margin_m, least_width_m);
  sign.height_m = static_cast<double>(lines - 1) * line_m + letter_height_m + 2.0 * margin_m;
  sign.text = std::move(text);
  return sign;
}

std::vector<Place> rectangle(Pose const& middle, double length_m, double width_m) {
  auto const along = length_m / 2.0 * unit(middle.yaw_rad);
  auto const aside = width_m / 2.0 * to_left(unit(middle.yaw_rad));
  auto const& at = middle.position;
  return {at - along - aside, at + along - aside, at + along + aside, at - along + aside};
}

std::vector<Place> leaf_ring(DoorFrame const& frame, double angle_rad) {
  constexpr double play_m = 0.005;
  auto const way = unit(frame.closed_rad + frame.opens_by * angle_rad);
  return block(frame.pivot + play_m * way, frame.pivot + (frame.width_m - play_m) * way, leaf_thickness_m);
}

std::vector<Solid> handles(DoorFrame const& frame, double angle_rad) {
  constexpr double from_latch_m = 0.07;
  constexpr double lever_m = 0.12;
  constexpr double stands_off_m = 0.045;
  double const yaw = frame.closed_rad + frame.opens_by * angle_rad;
  auto const way = unit(yaw);
  auto const axis = frame.pivot + (frame.width_m - from_latch_m) * way;
  Solid part{.ring = {},
             .bottom_m = 1.02,
             .top_m = 1.05,
             .material = Material::wood,
             .thing = Thing::door,
             .number = 0,
             .look = Look::metal,
             .colour = handle_colour};
  std::vector<Solid> parts;
  for (double const side : {-1.0, 1.0}) {
    auto const out = side * to_left(way);
    part.ring = block(axis + 0.01 * way + stands_off_m * out, axis - lever_m * way + stands_off_m * out, 0.02);
    parts.push_back(part);
    part.ring = rectangle({axis + stands_off_m / 2.0 * out, yaw}, 0.02, stands_off_m);
    parts.push_back(part);
  }
  return parts;
}

Sign sign_at(DoorFrame const& frame, double angle_rad) {
  LAPWING_ASSERT(!frame.text.empty());
  constexpr double from_frame_m = 0.05;
  constexpr double off_wall_m = 0.006;
  constexpr double on_leaf_up_m = 1.5;
  auto sign = sign_of(frame.text);
  if (frame.is_sign_on_leaf) {
    double const turn = frame.opens_by * angle_rad;
    sign.facing_rad = geo::wrap_pi(frame.front_rad + turn);
    sign.middle = frame.pivot + frame.width_m / 2.0 * unit(frame.closed_rad + turn) +
                  (leaf_thickness_m / 2.0 + off_wall_m) * unit(sign.facing_rad);
    sign.middle_up_m = on_leaf_up_m;
  } else {
    sign.facing_rad = frame.front_rad;
    double const from_middle_m = frame.width_m / 2.0 + frame_width_m + from_frame_m + sign.width_m / 2.0;
    sign.middle = frame.middle + from_middle_m * unit(frame.closed_rad) +
                  (frame.wall_thickness_m / 2.0 + off_wall_m) * unit(frame.front_rad);
  }
  return sign;
}

Bodies bodies_of(BuildingPlan const& plan) {
  Bodies bodies;
  std::vector<std::vector<Opening>> openings(plan.walls.size());
  for (auto const& door : plan.doors) {
    auto const opening = opening_of(door, plan.walls);
    LAPWING_ASSERT(opening.has_value(), door.id);
    openings[opening->wall].push_back(*opening);
    add_lintel(plan, door, *opening, bodies);
    auto const& wall = plan.walls[opening->wall];
    add_trimmings(door, wall.thickness_m, bodies);
    bodies.doors.push_back(frame_of(door, wall, plan.door_colour));
  }
  for (std::size_t i = 0; i < plan.walls.size(); ++i) add_wall(plan, i, openings[i], bodies);
  for (std::size_t i = 0; i < plan.furniture.size(); ++i) {
    auto const& piece = plan.furniture[i];
    bodies.solids.push_back({.ring = rectangle(piece.middle, piece.length_m, piece.width_m),
                             .bottom_m = 0.0,
                             .top_m = piece.height_m,
                             .material = piece.material,
                             .thing = Thing::furniture,
                             .number = static_cast<std::uint32_t>(i),
                             .look = Look::plain,
                             .colour = piece.colour});
  }
  return bodies;
}

void add_faces(std::vector<Place> const& ring, Face const& like, std::vector<Face>& into) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    into.push_back(like);
    into.back().from = ring[i];
    into.back().to = ring[(i + 1) % ring.size()];
  }
}

std::vector<Face> faces_of(BuildingPlan const& plan, Bodies const& bodies, double up_m) {
  std::vector<Face> faces;
  for (auto const& border : plan.borders) faces.push_back({.from = border.from, .to = border.to});
  for (auto const& solid : bodies.solids) {
    if (solid.bottom_m > up_m || solid.top_m <= up_m) continue;
    add_faces(solid.ring,
              {.from = {}, .to = {}, .material = solid.material, .thing = solid.thing, .number = solid.number}, faces);
  }
  return faces;
}

}  // namespace lapwing::sim::building
