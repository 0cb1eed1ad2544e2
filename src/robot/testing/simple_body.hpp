#pragma once

#include <cstdint>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "base/async/loop.hpp"
#include "base/async/task.hpp"
#include "robot/platform/body.hpp"

namespace lapwing::robot::testing {

/// A straight piece of wall, in metres.
struct Wall {
  Eigen::Vector2d from;
  Eigen::Vector2d to;
};
using Walls = std::vector<Wall>;

/// A corridor of 14 by 2 m with three rooms of 4 by 3.5 m on each side, behind doors of 0.9 m. The origin is 1 m from
/// the corridor's left end, in its middle.
[[nodiscard]] Walls small_office();
/// How much of it can be seen from inside, m^2.
inline constexpr double small_office_m2 = 14.0 * 2.0 + 6 * 4.0 * 3.5;
/// A corridor of 10 by 1 m, in which no two robots pass each other, with a bay of 1.2 m in its upper side that begins 4
/// m from the origin. That is 1 m from the corridor's left end, in its middle.
[[nodiscard]] Walls narrow_corridor();

struct SimpleBodyOptions {
  slam::Pose2 start = {};
  int beams = 360;
  double view_rad = 2.0 * std::numbers::pi;  ///< of the laser; half to each side of ahead
  double laser_m = 10.0;
  double laser_x_m = 0.0;  ///< ahead of its middle
  double range_noise_m = 0.01;
  double shift_noise = 0.03;  ///< of odometry: standard deviation of a step, per metre
  double turn_noise = 0.02;   ///< per radian
  double scale_bias = 0.02;   ///< every metre is told as so much more
  double radius_m = 0.18;
  std::uint64_t seed = 1;
};

/// A disc with wheels and a laser among walls, without firmware or link: what the platform is tested on. It does what
/// it is told at once but for its acceleration, and goes through walls, which it counts.
class SimpleBody final : public Body {
 public:
  SimpleBody(base::Loop& loop, Walls walls, SimpleBodyOptions const& options);

  void listen(Listener listener) override { listener_ = std::move(listener); }
  [[nodiscard]] slam::Sensor const* sensor() const override { return &laser_; }
  [[nodiscard]] Limits limits() const override { return {.radius_m = options_.radius_m}; }
  [[nodiscard]] std::string link() const override { return "test://"; }
  [[nodiscard]] std::optional<std::uint16_t> take_carrier_code() override {
    return is_silent ? std::nullopt : std::optional(carrier_code);
  }
  void drive(Motion motion) override;
  void kill() override { is_killed_ = true; }
  void release() override { is_killed_ = false; }

  [[nodiscard]] slam::Pose2 const& truth() const { return pose_; }
  [[nodiscard]] int collisions() const { return collisions_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] bool is_asked_to_move() const { return motion_ != Motion{}; }

  // ---- what tests do to it
  /// Somebody takes it up and puts it down there; its wheels feel nothing of that.
  void carry_to(slam::Pose2 const& pose) { pose_ = pose; }
  bool is_silent = false;  ///< says nothing
  bool is_numb = false;    ///< its sensors say nothing; its laser and its carrier do
  bool is_blind = false;   ///< its laser says nothing
  double battery = 0.9;
  double drain_per_s = 0.0;  ///< of the battery, moving or not
  std::uint16_t carrier_code = 0;
  std::uint16_t sensors_code = 0;
  std::vector<Wall> put_in_the_way = {};             ///< seen and hit like walls
  std::vector<SimpleBody const*> others_there = {};  ///< seen and hit as they stand

 private:
  base::Task<> live();
  void move();
  void look();
  void tell_reading();
  [[nodiscard]] double noise(double deviation) { return deviation * normal_(random_); }
  [[nodiscard]] double range_m(Eigen::Vector2d const& from, double yaw) const;

  base::Loop& loop_;
  Walls walls_;
  SimpleBodyOptions options_;
  slam::Sensor laser_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Listener listener_;
  slam::Pose2 pose_;
  slam::Pose2 odometry_;
  Motion wanted_;
  Motion motion_;
  base::TimePoint told_at_{};
  bool is_killed_ = false;
  int collisions_ = 0;
  double driven_m_ = 0.0;
  base::Task<> life_;
};

}  // namespace lapwing::robot::testing
