#pragma once

#include <optional>

#include "firmware/frames/records.hpp"
#include "robot/sensors/sonar_watch.hpp"

namespace lapwing::robot {

/// Looks at what the inertial unit says, ten times a second.
///
/// Dropouts: three readings without it. Stuck: all nine numbers the same over a second; noise alone changes the last
/// digit. Jumping: a turn or a force that no such body survives, or an orientation that does not follow the turn rate.
class ImuWatch {
 public:
  [[nodiscard]] SensorFault feed(firmware::Readings const& readings);

 private:
  struct Last {
    firmware::Time time{};
    firmware::Imu imu;
  };
  std::optional<Last> last_;
  int missing_ = 0;
  int same_ = 0;
};

}  // namespace lapwing::robot
