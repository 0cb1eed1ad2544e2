#include "robot/ros/ros_shown.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "base/async/pool.hpp"
#include "explore/known/known_map.hpp"
#include "scans/planar.hpp"
#include "scans/stamp.hpp"

namespace lapwing::robot::ros {

using namespace std::chrono_literals;

namespace {

constexpr base::Duration look_period = 500ms;
/// Of a map of megabytes, in a network of the air.
constexpr base::Duration map_period = 2s;
/// Frames are told for a little later, so that who has the newest scan need not wait for them.
constexpr std::chrono::nanoseconds frames_hold = 200ms;
constexpr std::int8_t unknown = -1;
constexpr std::int8_t is_free = 0;
constexpr std::int8_t taken = 100;

std::int8_t value_of(map::Evidence evidence) {
  switch (explore::knowledge_of(evidence)) {
    case explore::Knowledge::unknown: return unknown;
    case explore::Knowledge::free: return is_free;
    case explore::Knowledge::wall: return taken;
  }
  return unknown;
}

template <class Visit>
void for_each_seen(map::OccupancyGrid const& grid, Visit const& visit) {
  for (auto const& [key, tile] : grid.tiles()) {
    std::size_t index = 0;
    for (std::int32_t y = 0; y < map::tile_cells; ++y)
      for (std::int32_t x = 0; x < map::tile_cells; ++x, ++index)
        if (auto const evidence = tile->cells[index]; evidence.is_seen())
          visit(map::Cell{key.x * map::tile_cells + x, key.y * map::tile_cells + y}, evidence);
  }
}

bus::Pose pose_message(slam::Pose2 const& pose) {
  return {.position = {pose.x, pose.y, 0.0}, .orientation = scans::rotation_to(pose.yaw)};
}

/// `covariance`: of x, y and yaw.
bus::Covariance covariance_message(Eigen::Matrix3d const& covariance) {
  constexpr std::array<std::size_t, 3> places{0, 1, 5};  // of x, y, z and the rotations about them
  bus::Covariance all{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      all[6 * places[row] + places[column]] =
          covariance(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column));
  return all;
}

}  // namespace

bus::OccupancyGrid grid_message(map::OccupancyGrid const& grid) {
  constexpr auto most = std::numeric_limits<std::int32_t>::max();
  map::Cell low{most, most};
  map::Cell high{-most, -most};
  for_each_seen(grid, [&](map::Cell cell, map::Evidence) {
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  });
  bus::OccupancyGrid message;
  message.info.resolution = static_cast<float>(grid.resolution_m());
  if (low.x > high.x) return message;
  auto const width = static_cast<std::size_t>(high.x - low.x + 1);
  auto const height = static_cast<std::size_t>(high.y - low.y + 1);
  message.info.width = static_cast<std::uint32_t>(width);
  message.info.height = static_cast<std::uint32_t>(height);
  message.info.origin.position = {low.x * grid.resolution_m(), low.y * grid.resolution_m(), 0.0};
  message.data.assign(width * height, unknown);
  for_each_seen(grid, [&](map::Cell cell, map::Evidence evidence) {
    auto const row = static_cast<std::size_t>(cell.y - low.y);
    message.data[row * width + static_cast<std::size_t>(cell.x - low.x)] = value_of(evidence);
  });
  return message;
}

base::Result<std::unique_ptr<RosShown>> RosShown::open(base::Loop& loop, bus::Bus& bus, std::string const& name_space) {
  auto shown = std::unique_ptr<RosShown>(new RosShown(loop, bus));
  auto const open = [&]<bus::Message M>(std::optional<bus::Publisher<M>>& into, std::string const& topic,
                                        bus::Profile profile) -> base::Result<> {
    auto opened = bus::Publisher<M>::open(bus, name_space + topic, profile);
    if (!opened) return std::unexpected(opened.error());
    into.emplace(*std::move(opened));
    return {};
  };
  if (auto done = open(shown->maps_, "/map", bus::Profile::latched); !done) return std::unexpected(done.error());
  if (auto done = open(shown->poses_, "/pose", bus::Profile::standard); !done) return std::unexpected(done.error());
  if (auto done = open(shown->ways_, "/plan", bus::Profile::standard); !done) return std::unexpected(done.error());
  shown->scope_.spawn(shown->keep_telling());
  return shown;
}

RosShown::~RosShown() {
  way_.clear();
  if (told_way_) tell_way();
}

void RosShown::set_odometry(std::chrono::nanoseconds stamp, std::string const& frame) {
  constexpr std::string_view usual = "odom";
  stamp_ = stamp;
  if (frame == odometry_frame_) return;
  odometry_frame_ = frame;
  auto const prefix = frame.ends_with(usual) ? frame.substr(0, frame.size() - usual.size()) : std::string();
  map_frame_ = prefix + "map";
}

bus::Header RosShown::header() const {
  return {.stamp = scans::stamp_at(stamp_), .frame_id = map_frame_};
}

void RosShown::show_pose(PoseOnMap const& here, std::string const& tf_topic) {
  poses_->publish({.header = header(),
                   .pose = {.pose = pose_message(here.pose), .covariance = covariance_message(here.covariance)}});
  if (!frames_) {
    // Where it cannot be told the rest still is.
    auto opened = bus::Publisher<bus::TFMessage>::open(bus_, tf_topic, bus::Profile::standard);
    if (!opened) return;
    frames_.emplace(*std::move(opened));
  }
  auto const odometry = here.pose * slam::between(here.odometry, slam::Pose2{});
  bus::TransformStamped const frame{
      .header = {.stamp = scans::stamp_at(stamp_ + frames_hold), .frame_id = map_frame_},
      .child_frame_id = odometry_frame_,
      .transform = {.translation = {odometry.x, odometry.y, 0.0}, .rotation = scans::rotation_to(odometry.yaw)}};
  frames_->publish({.transforms = {frame}});
}

base::Task<> RosShown::keep_telling() {
  for (;;) {
    co_await loop_.sleep(look_period);
    if (odometry_frame_.empty()) continue;
    tell_way();
    if (!grid_ || loop_.now() - mapped_at_ < map_period) continue;
    mapped_at_ = loop_.now();
    auto grid = *std::exchange(grid_, std::nullopt);
    auto message = co_await loop_.on_pool(&grid_message, std::move(grid));
    message.header = header();
    message.info.map_load_time = message.header.stamp;
    maps_->publish(message);
  }
}

void RosShown::tell_way() {
  if (told_way_ == way_) return;
  told_way_ = way_;
  bus::Path path{.header = header()};
  for (std::size_t i = 0; i < way_.size(); ++i) {
    // Each looks to the next one, the last as the one before.
    auto const from = way_[i + 1 < way_.size() || i == 0 ? i : i - 1];
    auto const to = way_[std::min(i + 1, way_.size() - 1)];
    path.poses.push_back(
        {.header = path.header,
         .pose = pose_message({way_[i].x(), way_[i].y(), std::atan2(to.y() - from.y(), to.x() - from.x())})});
  }
  ways_->publish(path);
}

}  // namespace lapwing::robot::ros
