#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace lapwing::scans {

struct BagTopic {
  std::string name;      ///< "/scan"
  std::string type;      ///< "sensor_msgs/msg/LaserScan"
  std::string encoding;  ///< "cdr" for ROS 2, "ros1" for what was converted without reading it
};

/// Who is told what a bag holds, message by message as they lie in it.
class BagListener {
 public:
  BagListener() = default;
  BagListener(BagListener const&) = delete;
  BagListener& operator=(BagListener const&) = delete;
  virtual ~BagListener() = default;

  /// Asked for each topic before its first message, maybe several times.
  [[nodiscard]] virtual bool wants(BagTopic const& topic) = 0;
  /// `logged`: when the recorder got it. An error ends the reading.
  [[nodiscard]] virtual base::Result<> take(BagTopic const& topic, std::chrono::nanoseconds logged,
                                            std::string_view message) = 0;
};

/// As many as a file may have. Robots have some hundred topics.
inline constexpr std::size_t most_topics = 10'000;
/// Of a message, and of a part of a file that is packed as a whole, unpacked. Scans and odometry are a few kilobytes;
/// recorders pack a megabyte or a few at once.
inline constexpr std::size_t most_packed_together = std::size_t{256} << 20;

/// What is told of a file besides its messages: what is missing or damaged, as a sentence. Empty: nothing.
using BagRemark = std::string;

}  // namespace lapwing::scans
