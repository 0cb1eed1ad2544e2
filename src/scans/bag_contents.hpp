#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "bus/messages/sensors.hpp"
#include "scans/planar.hpp"
#include "scans/storage/bag_listener.hpp"
#include "slam/log/pose_track.hpp"

namespace lapwing::scans {

/// Which topic of several of one type.
struct BagChoice {
  std::string scan_topic = {};      ///< of sensor_msgs/LaserScan; empty: the only one
  std::string odometry_topic = {};  ///< of nav_msgs/Odometry, or "/tf"; empty: the only one, else /tf
};

/// What a bag holds for a map, gathered as it is read.
class BagContents final : public BagListener {
 public:
  /// Topics may be named without the stroke before them.
  explicit BagContents(BagChoice choice);

  [[nodiscard]] bool wants(BagTopic const& topic) override;
  [[nodiscard]] base::Result<> take(BagTopic const& topic, std::chrono::nanoseconds logged,
                                    std::string_view message) override;

  /// A frame that something tells the place of, again and again.
  struct MovingFrame {
    bus::TransformStamped first;
    std::vector<slam::PoseTrack::Moment> moments;
    bool moves = false;  ///< false: it has been in one place all the time
  };
  struct Scan {
    std::chrono::nanoseconds stamp{};
    bus::LaserScan message;  ///< without its intensities
  };

  [[nodiscard]] BagChoice const& choice() const { return choice_; }
  /// How many messages each topic of a type has, also those that are not chosen.
  std::map<std::string, std::size_t> laser_topics;
  std::map<std::string, std::size_t> odometry_topics;
  /// Of the chosen topics, or the first.
  std::vector<Scan> scans;
  std::vector<slam::PoseTrack::Moment> odometry;
  std::string odometry_child;  ///< the robot's frame, as the odometry calls it
  StaticFrames fixed;
  std::map<std::string, MovingFrame> moving;  ///< by the name of the frame
  std::size_t not_whole = 0;                  ///< messages that could not be read
  std::vector<std::string> others;            ///< topics of which nothing is needed, the first few, with their types
  std::string foreign;                        ///< a topic of a type that is needed, but not in CDR

 private:
  base::Result<> take_scan(BagTopic const& topic, std::chrono::nanoseconds logged, std::string_view message);
  base::Result<> take_odometry(BagTopic const& topic, std::chrono::nanoseconds logged, std::string_view message);
  base::Result<> take_frames(std::chrono::nanoseconds logged, std::string_view message);
  void take_fixed(std::string_view message);
  base::Result<> count_moment();

  BagChoice choice_;
  std::size_t readings_ = 0;
  std::size_t moments_ = 0;
};

}  // namespace lapwing::scans
