#include "slam/readers/carmen.hpp"

#include <map>
#include <numbers>

#include "slam/readers/log_builder.hpp"
#include "slam/readers/text_lines.hpp"

namespace lapwing::slam {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::vector<float> even_bearings(std::size_t count, double first, double step) {
  std::vector<float> bearings;
  for (std::size_t i = 0; i < count; ++i) bearings.push_back(static_cast<float>(first + step * static_cast<double>(i)));
  return bearings;
}

/// FLASER says nothing of angles. A SICK looks 180 degrees wide: 181 beams a degree apart, or 180 without the last, or
/// twice as many. 541 and 1081 are those of scanners that look 270 degrees wide.
std::vector<float> flaser_bearings(std::size_t count) {
  auto const whole = count == 541 || count == 1081 ? 270.0 : 180.0;
  auto const steps = count % 2 == 0 ? count : count - 1;
  return even_bearings(count, -0.5 * whole * degree,
                       whole * degree / static_cast<double>(std::max<std::size_t>(1, steps)));
}

class Reader {
 public:
  explicit Reader(std::string_view text) : lines_(text) {}

  base::Result<ScanLog> run() {
    while (auto const line = lines_.next()) {
      Words words(*line);
      auto const kind = words.next();
      base::Result<> done;
      if (kind == "FLASER") done = flaser(words);
      if (kind == "ROBOTLASER1") done = robot_laser(words);
      if (kind == "PARAM") parameter(words);
      if (!done && lines_.is_whole()) return std::unexpected(done.error());
    }
    if (builder_.is_empty())
      return base::fail(base::ErrorKind::invalid_input, "no FLASER or ROBOTLASER1 line",
                        "a log of CARMEN has one scan a line, such as 'FLASER 180 1.2 ...'");
    return std::move(builder_).finish();
  }

 private:
  base::Result<std::size_t> count(Words& words, std::string_view of_what) const {
    auto const value = words.finite();
    if (!value || *value < 0.0 || *value > static_cast<double>(LogBuilder::most_beams) || *value != std::floor(*value))
      return fail_at(lines_.number(), fmt::format("the number of {} must be 0 to {}", of_what, LogBuilder::most_beams));
    return static_cast<std::size_t>(*value);
  }

  base::Result<std::vector<float>> ranges(Words& words, std::size_t count) const {
    std::vector<float> ranges;
    ranges.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      auto const range = words.number();
      if (!range)
        return fail_at(lines_.number(),
                       fmt::format("{} readings were announced, reading {} is no number", count, i + 1));
      ranges.push_back(static_cast<float>(*range));
    }
    return ranges;
  }

  base::Result<std::vector<double>> numbers(Words& words, std::size_t count, std::string_view names) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
      auto const value = words.finite();
      if (!value) return fail_at(lines_.number(), fmt::format("expected the numbers {} after the readings", names));
      values.push_back(*value);
    }
    return values;
  }

  base::Result<> add(Sensor const& sensor, std::vector<float> ranges, Pose2 const& laser, Pose2 const& robot,
                     double time) {
    auto mounted = sensor;
    mounted.mount_m = offset_ ? Eigen::Vector2f(*offset_, 0.0F) : mount(laser, robot);
    auto const number = builder_.sensor(mounted);
    if (!number)
      return fail_at(lines_.number(), fmt::format("more than {} kinds of scans", LogBuilder::most_sensors),
                     "is the angle between beams different in each line?");
    Scan scan{.time = LogTime(time), .sensor = *number, .odometry = robot, .ranges_m = std::move(ranges)};
    if (builder_.add(std::move(scan))) return {};
    return fail_at(lines_.number(), fmt::format("more than {} readings", LogBuilder::most_readings),
                   "cut the log into parts");
  }

  /// Where the laser stands on the robot, if the poses of both say so. In logs that were corrected afterwards they are
  /// of different worlds; then the first scan shows an offset of metres, or the robot's turning one that changes.
  Eigen::Vector2f mount(Pose2 const& laser, Pose2 const& robot) {
    constexpr double longest_robot_m = 1.0;
    constexpr double same_m = 0.002;
    auto const offset = between(robot, laser);
    if (!first_mount_) first_mount_ = place(offset);
    if ((place(offset) - *first_mount_).norm() > same_m || first_mount_->norm() > longest_robot_m)
      is_mount_known_ = false;
    if (!is_mount_known_) return Eigen::Vector2f::Zero();
    // To the millimetre, so that rounding in the file does not make a sensor of every scan.
    return (((*first_mount_) * 1000.0).array().round() / 1000.0).matrix().cast<float>();
  }

  base::Result<> flaser(Words& words) {
    auto const beams = count(words, "readings");
    if (!beams) return std::unexpected(beams.error());
    auto measured = ranges(words, *beams);
    if (!measured) return std::unexpected(measured.error());
    auto const poses = numbers(words, 7, "x y theta odom_x odom_y odom_theta ipc_timestamp");
    if (!poses) return std::unexpected(poses.error());
    auto const& p = *poses;
    auto& bearings = bearings_[*beams];
    if (bearings.empty()) bearings = flaser_bearings(*beams);
    return add({.bearings_rad = bearings}, *std::move(measured), {p[0], p[1], p[2]}, {p[3], p[4], p[5]}, p[6]);
  }

  base::Result<> robot_laser(Words& words) {
    auto const head = numbers(words, 7, "type start_angle field_of_view resolution max_range accuracy remission_mode");
    if (!head) return std::unexpected(head.error());
    auto const beams = count(words, "readings");
    if (!beams) return std::unexpected(beams.error());
    auto measured = ranges(words, *beams);
    if (!measured) return std::unexpected(measured.error());
    auto const remissions = count(words, "remissions");
    if (!remissions) return std::unexpected(remissions.error());
    if (auto const skipped = ranges(words, *remissions); !skipped) return std::unexpected(skipped.error());
    auto const tail = numbers(words, 12, "laser pose, robot pose, tv rv forward side turn, ipc_timestamp");
    if (!tail) return std::unexpected(tail.error());
    auto const& h = *head;
    auto const& t = *tail;
    if (std::abs(h[1]) > 7.0 || !(h[3] > 1e-5) || h[3] * static_cast<double>(*beams) > 7.0)
      return fail_at(lines_.number(), "start angle and resolution do not describe a scan of at most one turn");
    Sensor sensor{.bearings_rad = even_bearings(*beams, h[1], h[3])};
    if (h[4] > 0.0) sensor.no_return_m = static_cast<float>(h[4]);
    return add(sensor, *std::move(measured), {t[0], t[1], t[2]}, {t[3], t[4], t[5]}, t[11]);
  }

  void parameter(Words& words) {
    if (words.next() != "robot_frontlaser_offset") return;
    if (auto const offset = words.finite(); offset && std::abs(*offset) < 2.0) offset_ = static_cast<float>(*offset);
  }

  Lines lines_;
  LogBuilder builder_;
  std::map<std::size_t, std::vector<float>> bearings_;
  std::optional<float> offset_;
  std::optional<Eigen::Vector2d> first_mount_;
  bool is_mount_known_ = true;
};

}  // namespace

base::Result<ScanLog> read_carmen(std::string_view text) {
  return Reader(text).run();
}

}  // namespace lapwing::slam
