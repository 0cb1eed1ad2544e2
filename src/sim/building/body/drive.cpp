#include "sim/building/body/drive.hpp"

#include <algorithm>
#include <cmath>

namespace lapwing::sim::building {

namespace {

Shift unit(double yaw_rad) {
  return {std::cos(yaw_rad), std::sin(yaw_rad)};
}

}  // namespace

DrivenBody::DrivenBody(DriveSettings const& settings, Pose const& pose, std::uint64_t seed, std::uint32_t number)
    : settings_(settings), number_(number), noise_(seed, "wheels", number), pose_(pose) {
  for (auto& wheel : wheels_) {
    wheel.full_speed_m_s = settings.full_voltage_speed_m_s * (1.0 + settings.motor_spread * noise_.gaussian());
    wheel.pulses_per_m = settings.pulses_per_m * (1.0 + settings.wheel_spread * noise_.gaussian());
  }
}

void DrivenBody::drive(Wheel& wheel, double voltage, double seconds) const {
  double const held = std::abs(voltage) < settings_.dead_band ? 0.0 : std::clamp(voltage, -1.0, 1.0);
  double const wanted = wheel.full_speed_m_s * held;
  double const nearer = (wanted - wheel.speed_m_s) * (1.0 - std::exp(-seconds / settings_.lag_s));
  double const most = settings_.most_force_m_s2 * seconds;
  wheel.speed_m_s += std::clamp(nearer, -most, most);
  wheel.turned_m += wheel.speed_m_s * seconds;
}

/// Slip is an Ornstein-Uhlenbeck process over the way: smooth, as a gyroscope would feel jerks, and after many changes
/// the sum of a random walk with the deviation of the settings.
double DrivenBody::ground_way_m(Wheel& wheel, double seconds) {
  double const way_m = wheel.speed_m_s * seconds;
  if (way_m == 0.0) return 0.0;
  double const changes_m = settings_.slip_changes_m;
  double const deviation = settings_.slip_m_per_sqrt_m / std::sqrt(2.0 * changes_m);
  double const kept = std::exp(-std::abs(way_m) / changes_m);
  wheel.slip = kept * wheel.slip + deviation * std::sqrt(1.0 - kept * kept) * noise_.gaussian();
  return (wheel.grip + wheel.slip) * way_m;
}

std::vector<Contact> DrivenBody::step(double seconds, double left, double right, Surroundings const& around) {
  drive(wheels_[0], left, seconds);
  drive(wheels_[1], right, seconds);
  double const left_m = ground_way_m(wheels_[0], seconds);
  double const right_m = ground_way_m(wheels_[1], seconds);
  double const turned = (right_m - left_m) / settings_.wheel_base_m;
  double const ahead_m = (left_m + right_m) / 2.0;
  auto const before = pose_;
  double const speed_before = speed_m_s_;
  auto const ahead = unit(pose_.yaw_rad + turned / 2.0);
  pose_.position = pose_.position + ahead_m * ahead;
  pose_.yaw_rad = geo::wrap_pi(pose_.yaw_rad + turned);
  auto contacts = push_out(around);
  auto const moved = pose_.position - before.position;
  if (!contacts.empty()) {
    // What stops the body stalls the motors; what it slides along does not.
    double const kept_m = moved.dot(ahead);
    double const lost_m_s = (ahead_m - kept_m) / seconds;
    for (auto& wheel : wheels_) {
      wheel.turned_m -= lost_m_s * seconds;
      wheel.speed_m_s -= lost_m_s;
    }
  }
  speed_m_s_ = moved.dot(ahead) / seconds;
  turn_rad_s_ = turned / seconds;
  acceleration_m_s2_ = (speed_m_s_ - speed_before) / seconds;
  driven_m_ += moved.length();
  return contacts;
}

std::vector<Contact> DrivenBody::push_out(Surroundings const& around) {
  std::vector<Contact> contacts;
  auto const came_from = pose_.position;
  auto const push = [&](Place const& from, double reach_m, Thing thing, std::uint32_t number) {
    auto const away = pose_.position - from;
    double const length_m = away.length();
    if (length_m >= reach_m || length_m <= 0.0) return;
    auto const out = away * (1.0 / length_m);
    double const into_m_s = -out.dot(unit(pose_.yaw_rad)) * (wheels_[0].speed_m_s + wheels_[1].speed_m_s) / 2.0;
    pose_.position = from + reach_m * out;
    if (std::ranges::none_of(contacts, [&](auto const& one) { return one.thing == thing && one.number == number; }))
      contacts.push_back({.thing = thing, .number = number, .speed_m_s = std::max(into_m_s, 0.0), .at = from});
  };
  auto const push_from = [&](Face const& face) {
    // Seen from behind, it is the far side of something.
    if ((face.to - face.from).cross(pose_.position - face.from) > 0.0) return;
    push(nearest_point(face, pose_.position), settings_.radius_m, face.thing, face.number);
  };
  // Out of one thing and into the next: a corner takes two rounds.
  constexpr int rounds = 3;
  for (int i = 0; i < rounds; ++i) {
    auto const before = pose_.position;
    around.fixed.near(pose_.position, settings_.radius_m, push_from);
    for (auto const& face : around.moving) push_from(face);
    for (auto const& post : around.posts) {
      if (post.thing == Thing::robot && post.number == number_) continue;
      push(post.middle, settings_.radius_m + post.radius_m, post.thing, post.number);
    }
    if (pose_.position == before) break;
  }
  // No push is farther than what a step can have driven it in.
  constexpr double farthest_m = 0.05;
  if (distance_m(pose_.position, came_from) > farthest_m)
    pose_.position = came_from + farthest_m / distance_m(pose_.position, came_from) * (pose_.position - came_from);
  return contacts;
}

void DrivenBody::set_grip(Side wheel, double grip) {
  wheels_[index(wheel)].grip = grip;
}

std::int32_t DrivenBody::pulses(Side wheel) const {
  auto const& one = wheels_[index(wheel)];
  return static_cast<std::int32_t>(static_cast<std::int64_t>(std::floor(one.turned_m * one.pulses_per_m)));
}

}  // namespace lapwing::sim::building
