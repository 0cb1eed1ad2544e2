#include "sim/building/scene/people.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim::building {

namespace {

constexpr double apart_m = 0.4;  ///< so far from a robot or a person somebody stops
constexpr double from_walls_m = 0.05;
constexpr double farthest_walk_m = 8.0;
constexpr double begins_ahead_m = 0.01;

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

/// How far somebody can go straight on: what three rays beside each other leave, with room for the body.
double room_ahead_m(Place const& from, Shift const& way, double farthest_m, std::size_t number,
                    Surroundings const& around) {
  Shift const aside(-way.y(), way.x());
  double room_m = farthest_m;
  for (double const off_m : {-People::radius_m - from_walls_m, 0.0, People::radius_m + from_walls_m}) {
    auto const begin = from + off_m * aside;
    if (auto const hit = around.fixed.cast(begin, way, farthest_m + People::radius_m))
      room_m = std::min(room_m, hit->range_m - People::radius_m - from_walls_m);
    for (auto const& face : around.moving) {
      if (auto const hit = meet(face, begin, way, farthest_m + People::radius_m))
        room_m = std::min(room_m, hit->range_m - People::radius_m - from_walls_m);
    }
  }
  for (auto const& post : around.posts) {
    if (post.thing == Thing::person && post.number == number) continue;
    auto const to = post.middle - from;
    double const reach_m = post.radius_m + People::radius_m + apart_m;
    double const along_m = to.dot(way);
    double const aside_m = std::abs(way.cross(to));
    if (along_m <= 0.0 || aside_m >= reach_m) continue;
    room_m = std::min(room_m, along_m - std::sqrt(reach_m * reach_m - aside_m * aside_m));
  }
  return room_m;
}

}  // namespace

People::People(std::span<PersonPlan const> plans, std::uint64_t seed) {
  for (std::size_t i = 0; i < plans.size(); ++i) {
    people_.push_back({.pose = plans[i].start,
                       .walks = plans[i].walks,
                       .speed_m_s = plans[i].speed_m_s,
                       .way = plans[i].way,
                       .to = plans[i].way.empty() ? plans[i].start.position : plans[i].way.front(),
                       .noise = Noise(seed, "person", i)});
  }
}

void People::put(std::size_t person, Pose const& pose) {
  people_[person].pose = pose;
  people_[person].walks = false;
}

void People::step(double seconds, Surroundings const& around) {
  for (std::size_t i = 0; i < people_.size(); ++i) {
    auto& person = people_[i];
    if (!person.walks) continue;
    if (person.waits_s > 0.0)
      person.waits_s -= seconds;
    else
      walk(person, i, seconds, around);
  }
}

void People::choose(Person& person, std::size_t number, Surroundings const& around) {
  person.waits_s = person.noise.uniform(0.0, 3.0);
  if (!person.way.empty()) {
    person.next_on_way = (person.next_on_way + 1) % person.way.size();
    person.to = person.way[person.next_on_way];
    return;
  }
  auto const way = unit(person.noise.uniform(-std::numbers::pi, std::numbers::pi));
  double const room_m = room_ahead_m(person.pose.position, way, farthest_walk_m, number, around);
  person.to = person.pose.position + person.noise.uniform(0.0, std::max(room_m, 0.0)) * way;
}

void People::walk(Person& person, std::size_t number, double seconds, Surroundings const& around) {
  auto const left = person.to - person.pose.position;
  double const step_m = person.speed_m_s * seconds;
  if (left.length() <= step_m) {
    choose(person, number, around);
    return;
  }
  auto const way = left * (1.0 / left.length());
  person.pose.yaw_rad = std::atan2(way.y(), way.x());
  if (room_ahead_m(person.pose.position, way, step_m + begins_ahead_m, number, around) < step_m) {
    // On a way, wait until it is free; without one, go elsewhere.
    person.waits_s = person.noise.uniform(0.3, 1.0);
    if (person.way.empty()) choose(person, number, around);
    return;
  }
  person.pose.position = person.pose.position + step_m * way;
  person.walked_m += step_m;
}

void People::add_posts(std::vector<Post>& into) const {
  for (std::size_t i = 0; i < people_.size(); ++i)
    into.push_back({.middle = people_[i].pose.position,
                    .radius_m = radius_m,
                    .material = Material::cloth,
                    .thing = Thing::person,
                    .number = static_cast<std::uint32_t>(i)});
}

}  // namespace lapwing::sim::building
