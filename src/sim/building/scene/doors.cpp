#include "sim/building/scene/doors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace lapwing::sim::building {

namespace {

constexpr std::size_t faces_a_leaf = 4;

/// Exponential, but never shorter than it takes to walk through.
double waiting_time(Noise& noise, double mean_s) {
  constexpr double least_s = 2.0;
  return least_s - std::max(mean_s - least_s, 0.0) * std::log(1.0 - noise.uniform());
}

}  // namespace

Doors::Doors(std::span<DoorPlan const> plans, std::vector<DoorFrame> frames, std::uint64_t seed)
    : frames_(std::move(frames)) {
  faces_.resize(faces_a_leaf * frames_.size());
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    auto const& plan = plans[i];
    states_.push_back({.angle_rad = plan.angle_rad,
                       .wanted_rad = plan.angle_rad,
                       .most_rad = plan.angle_rad > 0.0 ? plan.angle_rad : std::numbers::pi / 2.0,
                       .habit = plan.habit,
                       .changes_in_s = 0.0,
                       .noise = Noise(seed, "door", i)});
    auto& state = states_.back();
    if (state.habit)
      state.changes_in_s =
          waiting_time(state.noise, state.angle_rad > 0.0 ? state.habit->open_s : state.habit->closed_s);
    draw(i);
  }
}

void Doors::step(double seconds, std::function<bool(std::vector<Place> const&)> const& stands_in_way) {
  for (std::size_t i = 0; i < states_.size(); ++i) {
    auto& state = states_[i];
    if (state.habit) {
      state.changes_in_s -= seconds;
      if (state.changes_in_s <= 0.0) {
        bool const opens = state.wanted_rad <= 0.0;
        state.wanted_rad = opens ? state.most_rad : 0.0;
        state.changes_in_s = waiting_time(state.noise, opens ? state.habit->open_s : state.habit->closed_s);
      }
    }
    if (state.angle_rad == state.wanted_rad) continue;
    double const most = speed_rad_s * seconds;
    double const next = state.angle_rad + std::clamp(state.wanted_rad - state.angle_rad, -most, most);
    if (stands_in_way(leaf_ring(frames_[i], next))) continue;
    state.angle_rad = next;
    draw(i);
  }
}

void Doors::hold(std::size_t door, double angle_rad) {
  states_[door].habit.reset();
  states_[door].wanted_rad = angle_rad;
}

void Doors::draw(std::size_t door) {
  std::vector<Face> leaf;
  add_faces(leaf_ring(frames_[door], states_[door].angle_rad),
            {.from = {},
             .to = {},
             .material = Material::wood,
             .thing = Thing::door,
             .number = static_cast<std::uint32_t>(door)},
            leaf);
  std::ranges::copy(leaf, faces_.begin() + static_cast<std::ptrdiff_t>(faces_a_leaf * door));
  ++revision_;
}

}  // namespace lapwing::sim::building
