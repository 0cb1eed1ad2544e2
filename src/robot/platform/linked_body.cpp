#include "robot/platform/linked_body.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "robot/ranges/scan_laying.hpp"
#include "robot/ranges/sonar_scan.hpp"
#include "robot/watch/self_report.hpp"

namespace lapwing::robot {

using firmware::Flag;

namespace {

/// What there is no echo of is as far away as a sonar hears.
explore::SideDistances sides_of(WallDistances const& walls) {
  constexpr double side_m = 5.0;
  constexpr double front_m = 7.5;
  return {walls.left_m.value_or(side_m), walls.front_m.value_or(front_m), walls.right_m.value_or(side_m)};
}

/// Of a disc around the axle's middle that covers the hull, which is round enough to turn on the spot wherever it
/// stands. What a board does not say is as with most.
Limits limits_of(firmware::Description const& board) {
  Limits limits;
  double const reaches_m =
      std::max({double{board.hull.front_m}, double{board.hull.back_m}, double{board.hull.half_width_m}});
  if (reaches_m > 0.0) limits.radius_m = reaches_m;
  if (board.top_speed_m_s > 0.0F) {
    limits.speed_m_s = std::min(limits.speed_m_s, double{board.top_speed_m_s});
    limits.near_speed_m_s = std::min(limits.near_speed_m_s, limits.speed_m_s);
  }
  if (board.braking_m_s2 > 0.0F)
    limits.acceleration_m_s2 = std::min(limits.acceleration_m_s2, double{board.braking_m_s2});
  return limits;
}

}  // namespace

LinkedBody::LinkedBody(base::Loop& loop, std::unique_ptr<link::ByteLink> link, base::Logger log)
    : loop_(loop), log_(std::move(log)), link_(std::move(link)), client_(loop, *link_) {
  client_.start({.here = [this](firmware::Hello const& hello, bool) { meet(hello); },
                 .away = [this](std::string const& why) { log_.warn(fmt::format("the board is away: {}", why)); },
                 .readings = [this](firmware::Readings const& readings) { take(readings); },
                 .scan = [this](LaserRanges const& scan) { take(scan); },
                 .log = [this](firmware::Log const& log_record) { tell(log_record); }});
}

void LinkedBody::meet(firmware::Hello const& hello) {
  // A board that starts anew begins a new frame where it stands; how its laser looks and how large it is must stay, as
  // the map is made by the one and plans by the other.
  auto const here = odometry_ ? odometry_->pose() : slam::Pose2{};
  description_ = hello.description;
  odometry_.emplace(hello.description, here);
  scan_.reset();
  auto const limits = limits_of(hello.description);
  if (limits.radius_m > most_radius_m) {
    log_.error(
        fmt::format("the board says that its body reaches {:.2f} m from its axle's middle; {} m is the most: the "
                    "robot stands",
                    limits.radius_m, most_radius_m));
    return;
  }
  if (!sensor_) limits_ = limits;
  bool const has_laser = hello.description.laser.beams > 0;
  if (!sensor_ && has_laser) sensor_ = sensor_of(hello.description.laser);
  if (!sensor_) sensor_ = sensor_of(hello.description.sonar_places());
  if (!has_laser && hello.description.sonar_count > 0)
    log_.warn(
        "the board has no laser: a map by sonars alone is coarse, and edges that they do not hear may be touched");
  if (!sensor_) log_.warn("the board has neither laser nor sonars: there is no map, and the robot stands");
  log_.info(fmt::format("a board with {} sonars and a laser of {} beams", hello.description.sonar_count,
                        hello.description.laser.beams));
}

void LinkedBody::take(firmware::Readings const& readings) {
  auto const sensed = odometry_ ? odometry_->feed(readings) : std::nullopt;
  if (!sensed) return;
  std::optional<double> battery;
  if (readings.battery_percent) battery = *readings.battery_percent / 100.0;
  if (listener_.on_reading)
    listener_.on_reading({.at = loop_.now(),
                          .odometry = odometry_->pose(),
                          .speed_m_s = sensed->speed_m_s,
                          .battery = battery,
                          .sides = sides_of(sensed->walls),
                          .is_killed = readings.has(Flag::killed),
                          .is_too_near = readings.has(Flag::too_near),
                          .is_waiting = readings.has(Flag::watchdog),
                          .sensors_code = sensors_code(sensed->faults)});
  bool const has_laser = description_->laser.beams > 0;
  if (!has_laser && sensor_ && listener_.on_scan) listener_.on_scan(scan_of(*sensed, odometry_->pose(), *sensor_));
  if (!scan_ || end_of(*scan_, description_->laser) > readings.time) return;
  auto const scan = *std::exchange(scan_, std::nullopt);
  bool const fits = sensor_ && scan.ranges_m.size() == sensor_->bearings_rad.size();
  if (fits && listener_.on_scan) listener_.on_scan(lay(scan, description_->laser, *sensor_, *odometry_));
}

void LinkedBody::take(LaserRanges const& scan) {
  if (description_) scan_ = scan;
}

void LinkedBody::tell(firmware::Log const& log) {
  log_.info(fmt::format("the board says {} ({})", static_cast<int>(log.code), log.value));
}

std::optional<std::uint16_t> LinkedBody::take_carrier_code() {
  constexpr base::Duration while_of_frames = std::chrono::seconds(2);
  auto const status = client_.status();
  if (status.is_here && status.heard == told_of_) return std::nullopt;
  told_of_ = status.heard;
  auto const code = carrier_code(status, frames_then_);
  if (loop_.now() - frames_since_ >= while_of_frames) {
    frames_then_ = status.frames;
    frames_since_ = loop_.now();
  }
  return code;
}

void LinkedBody::drive(Motion motion) {
  bool const stands = motion == Motion{};
  if (stands && is_told_to_stand_) return;
  is_told_to_stand_ = stands;
  // A command that is refused, or lost with the board, is shown by the readings; the next one comes with them.
  if (stands) {
    (void)client_.begin(firmware::Stop{});
  } else {
    (void)client_.begin(firmware::Drive{.speed_m_s = static_cast<float>(motion.speed_m_s),
                                        .by = firmware::Drive::By::rate,
                                        .turn = static_cast<float>(motion.turn_rad_s)});
  }
}

}  // namespace lapwing::robot
