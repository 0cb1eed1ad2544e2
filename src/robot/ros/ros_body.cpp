#include "robot/ros/ros_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "robot/ros/scan_sides.hpp"
#include "robot/watch/codes.hpp"
#include "scans/stamp.hpp"

namespace lapwing::robot::ros {

using namespace std::chrono_literals;

namespace {

/// Readings and commands go ten times a second, whatever the rate of the odometry.
constexpr base::Duration reading_period = 95ms;
/// A command may get lost on its way; what makes it stand is said a few times.
constexpr int zeros = 3;
constexpr base::Duration kill_period = 50ms;
constexpr auto remembered = 3s;  ///< of where it was: more than a scan takes
/// A base that says nothing for so long is away.
constexpr base::Duration base_is_away = 500ms;
constexpr base::Duration readers_come_within = 2s;
constexpr double low_battery = 0.15;
/// A battery is told from 0 to 1, a full one now and then as a little more. Some drivers (a Kobuki's, a TurtleBot 3's)
/// tell percent.
constexpr double surely_percent = 1.5;

bool is_finite(slam::Pose2 const& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

}  // namespace

base::Result<std::unique_ptr<RosBody>> RosBody::open(base::Loop& loop, RosBodyOptions const& options,
                                                     base::Logger log) {
  auto bus = bus::Bus::open(loop, {.domain = options.domain, .is_local = options.is_local});
  if (!bus) return std::unexpected(bus.error());
  auto body = std::unique_ptr<RosBody>(new RosBody(loop, options, *std::move(bus), std::move(log)));
  if (auto opened = body->open_topics(); !opened) return std::unexpected(opened.error());
  return body;
}

RosBody::RosBody(base::Loop& loop, RosBodyOptions const& options, std::unique_ptr<bus::Bus> bus, base::Logger log)
    : loop_(loop), options_(options), log_(std::move(log)), bus_(std::move(bus)), scope_(loop) {
  scope_.spawn(keep_killed());
}

RosBody::~RosBody() {
  if (commands_ && stood_ < zeros) send({});
}

base::Result<> RosBody::open_topics() {
  auto const open = [&]<bus::Message M>(std::optional<bus::Subscription<M>>& into, std::string_view topic,
                                        bus::Profile profile, std::function<void(M const&)> heard) -> base::Result<> {
    auto opened = bus::Subscription<M>::open(*bus_, topic, profile, std::move(heard));
    if (!opened) return std::unexpected(opened.error());
    into.emplace(*std::move(opened));
    return {};
  };
  auto const named = [&](std::string_view topic) { return fmt::format("{}/{}", options_.name_space, topic); };
  using enum bus::Profile;
  auto commands = DriveCommands::open(*bus_, named("cmd_vel"));
  if (!commands) return std::unexpected(commands.error());
  commands_.emplace(*std::move(commands));
  if (auto done = open.operator()<bus::Odometry>(odometry_, named("odom"), sensor_data,
                                                 [this](auto const& odometry) { take(odometry); });
      !done)
    return done;
  if (auto done = open.operator()<bus::BatteryState>(batteries_, named("battery_state"), sensor_data,
                                                     [this](auto const& battery) { take(battery); });
      !done)
    return done;
  auto laser = RosLaser::open(
      loop_, *bus_, options_.name_space,
      [this](RosLaser::Seen seen) {
        waiting_ = std::move(seen);
        tell_scan();
      },
      log_);
  if (!laser) return std::unexpected(laser.error());
  laser_ = *std::move(laser);
  auto shown = RosShown::open(loop_, *bus_, options_.name_space);
  if (!shown) return std::unexpected(shown.error());
  shown_ = *std::move(shown);
  return {};
}

std::string RosBody::link() const {
  return fmt::format("{}://{}{}", options_.is_local ? "ros2" : "ros2-lan", options_.domain, options_.name_space);
}

// ---- in

void RosBody::take(bus::Odometry const& odometry) {
  auto const& pose = odometry.pose.pose;
  Moment const moment{.stamp = scans::since_epoch(odometry.header.stamp),
                      .pose = {pose.position.x, pose.position.y, scans::yaw_of(pose.orientation)},
                      .speed_m_s = odometry.twist.twist.linear.x};
  if (!is_finite(moment.pose) || !std::isfinite(moment.speed_m_s)) return;
  base_frame_ = odometry.child_frame_id;
  shown_->set_odometry(moment.stamp, odometry.header.frame_id);
  laser_->set_base_frame(base_frame_);
  track_.add({.stamp = moment.stamp, .pose = moment.pose});
  track_.forget_before(moment.stamp - remembered);
  now_ = moment;
  tell_scan();
  if (loop_.now() - told_at_ >= reading_period) tell_reading();
}

void RosBody::take(bus::BatteryState const& battery) {
  double const told = battery.percentage;
  if (!(told >= 0.0)) return;  // also what is no number
  is_told_in_percent_ = is_told_in_percent_ || told > surely_percent;
  battery_ = std::min(is_told_in_percent_ ? told / 100.0 : told, 1.0);
}

// ---- on to the robot

void RosBody::tell_scan() {
  if (!waiting_ || !now_ || waiting_->times.end() > now_->stamp) return;
  auto const seen = *std::exchange(waiting_, std::nullopt);
  sides_ = sides_of(*sensor(), seen.ranges_m);
  // By another clock than the base's, or one that was set: then it is as if it had just been taken.
  auto const pose_at = [this](std::chrono::nanoseconds stamp) { return track_.at(stamp).value_or(now_->pose); };
  if (listener_.on_scan) listener_.on_scan(*scans::lay(seen.ranges_m, *sensor(), seen.times, pose_at));
}

void RosBody::tell_reading() {
  told_at_ = loop_.now();
  commands_->follow_readers();
  if (listener_.on_reading)
    listener_.on_reading({.at = told_at_,
                          .odometry = now_->pose,
                          .speed_m_s = now_->speed_m_s,
                          .battery = battery_,
                          .sides = sides_,
                          .is_killed = is_killed_});
}

std::optional<std::uint16_t> RosBody::take_carrier_code() {
  if (!now_ || loop_.now() - told_at_ >= base_is_away) return code::board_away;
  if (std::exchange(carrier_told_, told_at_) == told_at_) return std::nullopt;
  if (is_driving_unread()) return code::nobody_drives;
  if (battery_ && *battery_ <= low_battery) return code::battery_low;
  return is_killed_ ? code::killed : code::none;
}

// ---- out

void RosBody::send(Motion motion) {
  is_driving_ = motion != Motion{};
  commands_->send(motion, base_frame_);
}

/// For longer than it takes to find each other.
bool RosBody::is_driving_unread() {
  if (!is_driving_ || commands_->is_read())
    unread_since_.reset();
  else if (!unread_since_)
    unread_since_ = loop_.now();
  return unread_since_ && loop_.now() - *unread_since_ >= readers_come_within;
}

void RosBody::drive(Motion motion) {
  if (is_killed_) return;
  if (motion != Motion{}) {
    stood_ = 0;
    send(motion);
  } else if (stood_ < zeros) {
    ++stood_;
    send({});
  }
}

void RosBody::kill() {
  is_killed_ = true;
  send({});
}

void RosBody::show_pose(PoseOnMap const& here) {
  shown_->show_pose(here, laser_->has_own_frames() ? options_.name_space + "/tf" : "/tf");
}

base::Task<> RosBody::keep_killed() {
  for (;;) {
    co_await loop_.sleep(kill_period);
    if (is_killed_) send({});
  }
}

}  // namespace lapwing::robot::ros
