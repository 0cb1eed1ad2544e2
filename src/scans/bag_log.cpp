#include "scans/bag_log.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bus/messages/navigation.hpp"
#include "scans/scan_reader.hpp"
#include "scans/storage/bag_files.hpp"
#include "slam/readers/log_builder.hpp"

namespace lapwing::scans {

namespace {

using base::ErrorKind;
using base::fail;

std::string listed(std::map<std::string, std::size_t> const& topics) {
  std::vector<std::string> words;
  for (auto const& [name, count] : topics) words.push_back(fmt::format("{} ({})", name, count));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// The name of the topic that is to be read; empty: there is none, and none was asked for.
base::Result<std::string> chosen(std::map<std::string, std::size_t> const& topics, std::string const& asked,
                                 std::string_view type, std::string_view option) {
  if (!asked.empty()) {
    if (topics.contains(asked)) return asked;
    return fail(ErrorKind::invalid_input, fmt::format("no {} on {}", type, asked),
                topics.empty() ? "it has none at all" : fmt::format("it has {}", listed(topics)));
  }
  if (topics.empty()) return std::string();
  if (topics.size() == 1) return topics.begin()->first;
  return fail(ErrorKind::invalid_input, fmt::format("several topics of {}: {}", type, listed(topics)),
              fmt::format("name one by {}", option));
}

/// Several may send on one topic.
struct Laser {
  std::string frame;
  float range_max_m = 0.0F;
  ScanReader reader;
  int sensor = 0;  ///< its number in the log
};

/// Puts a log together from what a bag holds.
class Converter {
 public:
  explicit Converter(BagContents& contents) : contents_(contents), frames_(contents.fixed) {
    for (auto const& [name, frame] : contents.moving)
      if (!frame.moves && !frames_.knows(name)) frames_.take({.transforms = {frame.first}});
  }

  base::Result<BagLog> run() {
    auto const scan_topic = chosen(contents_.laser_topics, contents_.choice().scan_topic,
                                   bus::Description<bus::LaserScan>::name, "--scan-topic");
    if (!scan_topic) return std::unexpected(scan_topic.error());
    if (scan_topic->empty()) return no_scans();
    made_.scan_topic = *scan_topic;
    if (auto done = find_odometry(); !done) return std::unexpected(done.error());
    for (auto& scan : contents_.scans) add(scan);
    if (builder_.is_empty())
      return fail(ErrorKind::invalid_input,
                  fmt::format("no scan on {} can be used: {}", made_.scan_topic, fmt::join(remarks(), "; ")));
    made_.remarks = remarks();
    made_.log = std::move(builder_).finish();
    return std::move(made_);
  }

 private:
  [[nodiscard]] std::unexpected<base::Error> no_scans() const {
    if (!contents_.foreign.empty())
      return fail(ErrorKind::invalid_input, fmt::format("{}, and only cdr is read", contents_.foreign),
                  "convert the recording to a bag of ROS 2");
    return fail(ErrorKind::invalid_input, "no sensor_msgs/msg/LaserScan in it",
                contents_.others.empty() ? "it has no topics at all"
                                         : fmt::format("it has {}", fmt::join(contents_.others, ", ")));
  }

  base::Result<> find_odometry() {
    auto const laser = contents_.scans.empty() ? std::string() : contents_.scans.front().message.header.frame_id;
    constexpr std::string_view from_frames = "/tf";
    if (contents_.choice().odometry_topic != from_frames) {
      auto const topic = chosen(contents_.odometry_topics, contents_.choice().odometry_topic,
                                bus::Description<bus::Odometry>::name, "--odom-topic (or /tf)");
      if (!topic) return std::unexpected(topic.error());
      if (!topic->empty()) {
        base_ = contents_.odometry_child.empty() ? frames_.root_of(laser) : contents_.odometry_child;
        track_.emplace(std::move(contents_.odometry));
        made_.odometry = *topic;
        return {};
      }
    }
    base_ = frames_.root_of(laser);
    auto const frame = contents_.moving.find(base_);
    if (frame == contents_.moving.end() || !frame->second.moves) {
      if (contents_.choice().odometry_topic == from_frames)
        return fail(ErrorKind::invalid_input, fmt::format("/tf does not say how {} moves", base_));
      return {};
    }
    track_.emplace(std::move(frame->second.moments));
    made_.odometry = fmt::format("/tf ({} to {})", frame->second.first.header.frame_id, base_);
    return {};
  }

  PlanarFrame mount_of(std::string const& laser) {
    if (auto const mount = frames_.find(laser, base_)) return *mount;
    without_mount_ = laser;
    return {};
  }

  /// How scans like this one are read. Nothing where no laser sends such, or there are too many kinds of them.
  Laser const* laser_of(bus::LaserScan const& scan) {
    auto const known = std::ranges::find_if(lasers_, [&](Laser const& laser) {
      return laser.frame == scan.header.frame_id && laser.range_max_m == scan.range_max && laser.reader.fits(scan);
    });
    if (known != lasers_.end()) return &*known;
    if (lasers_.size() == slam::LogBuilder::most_sensors) return nullptr;
    auto reader = ScanReader::make(scan, mount_of(scan.header.frame_id));
    if (!reader) return nullptr;
    auto const number = builder_.sensor(reader->sensor());
    if (!number) return nullptr;
    lasers_.push_back({.frame = scan.header.frame_id,
                       .range_max_m = scan.range_max,
                       .reader = *std::move(reader),
                       .sensor = *number});
    return &lasers_.back();
  }

  void add(BagContents::Scan& scan) {
    auto const* laser = laser_of(scan.message);
    auto ranges = laser == nullptr ? std::nullopt : laser->reader.ranges(scan.message);
    if (!ranges) {
      ++unusable_;
      return;
    }
    auto const times = laser->reader.times(scan.message, scan.stamp);
    scan.message.ranges = std::vector<float>();  // two of them all need not be there at once
    auto laid = lay(*std::move(ranges), laser->reader.sensor(), times,
                    [this](std::chrono::nanoseconds stamp) { return track_ ? track_->at(stamp) : slam::Pose2{}; });
    if (!laid) {
      ++without_odometry_;
      return;
    }
    laid->sensor = laser->sensor;
    if (!builder_.add(*std::move(laid))) ++unusable_;
  }

  [[nodiscard]] std::vector<std::string> remarks() const {
    std::vector<std::string> said;
    if (without_mount_)
      said.push_back(fmt::format("no frames say where {:?} is on {:?}: it is taken for its middle, looking ahead",
                                 *without_mount_, base_));
    if (unusable_ > 0) said.push_back(fmt::format("{} scans left out that no laser sends", unusable_));
    if (without_odometry_ > 0)
      said.push_back(fmt::format("{} scans left out before or after all odometry", without_odometry_));
    if (contents_.not_whole > 0)
      said.push_back(fmt::format("{} messages left out that are not whole", contents_.not_whole));
    return said;
  }

  BagContents& contents_;
  StaticFrames frames_;  ///< also those of /tf that never move
  std::string base_;     ///< the robot's frame
  std::optional<slam::PoseTrack> track_;
  std::vector<Laser> lasers_;
  slam::LogBuilder builder_;
  BagLog made_;
  std::optional<std::string> without_mount_;  ///< the frame of a laser
  std::size_t unusable_ = 0;
  std::size_t without_odometry_ = 0;
};

/// Files of one bag are told apart where there are several.
std::string in_file(std::filesystem::path const& file, std::size_t files, std::string const& what) {
  return files == 1 ? what : fmt::format("{}: {}", file.filename().string(), what);
}

}  // namespace

base::Result<BagLog> log_of(BagContents& contents) {
  return Converter(contents).run();
}

base::Result<BagLog> read_bag(std::filesystem::path const& path, BagChoice const& choice) {
  auto const files = bag_files(path);
  if (!files) return std::unexpected(files.error());
  BagContents contents(choice);
  std::vector<std::string> remarks;
  for (auto const& file : *files) {
    auto const remark = read_bag_file(file, contents);
    if (!remark)
      return fail(remark.error().kind, in_file(file, files->size(), remark.error().message), remark.error().hint);
    if (!remark->empty()) remarks.push_back(in_file(file, files->size(), *remark));
  }
  auto made = log_of(contents);
  if (made) made->remarks.insert(made->remarks.begin(), remarks.begin(), remarks.end());
  return made;
}

}  // namespace lapwing::scans
