#include "scans/bag_contents.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bus/cdr/cdr.hpp"
#include "bus/messages/navigation.hpp"
#include "scans/stamp.hpp"
#include "scans/storage/unpack.hpp"
#include "slam/readers/log_builder.hpp"

namespace lapwing::scans {

namespace {

using std::chrono::nanoseconds;

/// Two hundred a second for a day.
constexpr std::size_t most_moments = 20'000'000;
constexpr std::size_t most_frames = 1000;
constexpr std::size_t most_others = 12;

enum class Kind { scan, odometry, frames, fixed_frames, none };

Kind kind_of(BagTopic const& topic) {
  auto const type = topic.type;
  if (type == bus::Description<bus::LaserScan>::name) return Kind::scan;
  if (type == bus::Description<bus::Odometry>::name) return Kind::odometry;
  if (type == bus::Description<bus::TFMessage>::name)
    return topic.name.ends_with("tf_static") ? Kind::fixed_frames : Kind::frames;
  return Kind::none;
}

/// A driver that tells no time leaves it to the recorder.
nanoseconds stamp_of(bus::Header const& header, nanoseconds logged) {
  return header.stamp == bus::Time{} ? logged : since_epoch(header.stamp);
}

/// As ROS 1 had them, frames begin with a stroke, which tf2 takes off.
std::string bare(std::string const& frame) {
  return frame.starts_with('/') ? frame.substr(1) : frame;
}

void make_bare(bus::TFMessage& message) {
  for (auto& one : message.transforms) {
    one.header.frame_id = bare(one.header.frame_id);
    one.child_frame_id = bare(one.child_frame_id);
  }
}

bool is_elsewhere(slam::Pose2 const& a, slam::Pose2 const& b) {
  constexpr double same = 1e-6;  // metres and radians
  return !(slam::distance_m(a, b) < same && slam::turn_rad(a, b) < same);
}

}  // namespace

BagContents::BagContents(BagChoice choice) : choice_(std::move(choice)) {
  for (auto* topic : {&choice_.scan_topic, &choice_.odometry_topic})
    if (!topic->empty() && !topic->starts_with('/')) topic->insert(0, "/");
}

bool BagContents::wants(BagTopic const& topic) {
  auto const kind = kind_of(topic);
  if (kind == Kind::none) {
    if (others.size() < most_others) others.push_back(fmt::format("{} ({})", topic.name, topic.type));
    return false;
  }
  if (topic.encoding != "cdr") foreign = fmt::format("{} is encoded as {:?}", topic.name, topic.encoding);
  return topic.encoding == "cdr";
}

base::Result<> BagContents::take(BagTopic const& topic, nanoseconds logged, std::string_view message) {
  // rosbag2 may pack each message by itself. None in CDR begins as Zstandard does: its first byte is zero.
  std::string unpacked;
  if (is_zstd(message)) message = unpacked = unpack(Packing::zstd, message, most_packed_together);
  switch (kind_of(topic)) {
    case Kind::scan: return take_scan(topic, logged, message);
    case Kind::odometry: return take_odometry(topic, logged, message);
    case Kind::frames: return take_frames(logged, message);
    case Kind::fixed_frames: take_fixed(message); break;
    case Kind::none: break;
  }
  return {};
}

base::Result<> BagContents::take_scan(BagTopic const& topic, nanoseconds logged, std::string_view message) {
  ++laser_topics[topic.name];
  auto const chosen = choice_.scan_topic.empty() ? laser_topics.size() == 1 : choice_.scan_topic == topic.name;
  if (!chosen) return {};
  auto scan = bus::decode<bus::LaserScan>(message);
  if (!scan) {
    ++not_whole;
    return {};
  }
  readings_ += scan->ranges.size();
  if (readings_ > slam::LogBuilder::most_readings)
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("more than {} readings", slam::LogBuilder::most_readings), "cut the bag into parts");
  scan->intensities = {};
  scan->header.frame_id = bare(scan->header.frame_id);
  scans.push_back({.stamp = stamp_of(scan->header, logged), .message = *std::move(scan)});
  return {};
}

base::Result<> BagContents::take_odometry(BagTopic const& topic, nanoseconds logged, std::string_view message) {
  ++odometry_topics[topic.name];
  auto const chosen =
      choice_.odometry_topic.empty() ? odometry_topics.size() == 1 : choice_.odometry_topic == topic.name;
  if (!chosen) return {};
  auto const told = bus::decode<bus::Odometry>(message);
  if (!told) {
    ++not_whole;
    return {};
  }
  auto const& pose = told->pose.pose;
  if (odometry_child.empty()) odometry_child = bare(told->child_frame_id);
  odometry.push_back(
      {.stamp = stamp_of(told->header, logged), .pose = {pose.position.x, pose.position.y, yaw_of(pose.orientation)}});
  return count_moment();
}

base::Result<> BagContents::take_frames(nanoseconds logged, std::string_view message) {
  auto told = bus::decode<bus::TFMessage>(message);
  if (!told) {
    ++not_whole;
    return {};
  }
  make_bare(*told);
  for (auto const& one : told->transforms) {
    if (moving.size() == most_frames && !moving.contains(one.child_frame_id)) continue;
    auto& frame = moving[one.child_frame_id];
    if (frame.moments.empty()) frame.first = one;
    if (frame.first.header.frame_id != one.header.frame_id) continue;  // two that tell of one frame: the first counts
    frame.moments.push_back({.stamp = stamp_of(one.header, logged), .pose = planar(one.transform).pose});
    frame.moves = frame.moves || is_elsewhere(frame.moments.front().pose, frame.moments.back().pose);
    if (auto done = count_moment(); !done) return done;
  }
  return {};
}

void BagContents::take_fixed(std::string_view message) {
  auto told = bus::decode<bus::TFMessage>(message);
  if (!told) {
    ++not_whole;
    return;
  }
  make_bare(*told);
  fixed.take(*told);
}

base::Result<> BagContents::count_moment() {
  if (++moments_ <= most_moments) return {};
  return base::fail(base::ErrorKind::invalid_input,
                    fmt::format("more than {} poses of odometry and frames", most_moments), "cut the bag into parts");
}

}  // namespace lapwing::scans
