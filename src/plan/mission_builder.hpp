#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plan/mission.hpp"
#include "plan/survey.hpp"

namespace lapwing::plan {

/// A turn in place, round the point.
struct Loiter {
  enum class Kind { unlimited, turns, time };
  Kind kind = Kind::unlimited;
  double amount = 0.0;     ///< turns, or seconds
  double radius_m = 15.0;  ///< negative: counterclockwise
};

/// Metres from some point.
struct Offset {
  double north_m = 0.0;
  double east_m = 0.0;
  double up_m = 0.0;
};

/// Turns the commands of a mission block into mission items (language spec, 5.5, column "ours").
///
/// Every command with a place moves the *last position*, from which relative ones count (REC-34); it starts at home.
/// Angles are in degrees, as MAVLink's parameters are; NaN leaves a yaw to the vehicle. Errors are invalid_input: the
/// command that is wrong adds nothing, and those after it may still be tried.
class MissionBuilder {
 public:
  static constexpr double free_yaw = std::numeric_limits<double>::quiet_NaN();

  void name(std::string name) { mission_.name = std::move(name); }
  /// The first command: the mission's home. Later ones stay DO_SET_HOME items. Sets the last position if there is none.
  base::Result<> home(geo::Wgs84 place);

  /// `displaced` from the last position, or from home. Errors when there is none (REC-35).
  [[nodiscard]] base::Result<geo::Wgs84> from_last(Offset offset) const;
  [[nodiscard]] base::Result<geo::Wgs84> from_home(Offset offset) const;

  base::Result<> waypoint(geo::Wgs84 place, double acceptance_radius_m = 50.0);
  base::Result<> take_off(geo::Wgs84 place, double pitch_deg, double yaw_deg = free_yaw);
  base::Result<> loiter(geo::Wgs84 place, Loiter loiter);
  /// `precision_mode`: MAVLink's PRECISION_LAND_MODE, 0 to 2.
  base::Result<> land(geo::Wgs84 place, double yaw_deg, int precision_mode);
  /// Flies `area`, whose base becomes the last position.
  base::Result<> survey(SurveyArea const& area);

  /// `type`: MAVLink's SPEED_TYPE, 0 air, 1 ground, 2 climb, 3 descent.
  base::Result<> change_speed(double speed_m_s, int type);
  base::Result<> change_altitude(double alt_m);
  base::Result<> delay(double seconds);
  base::Result<> capture_photo();
  /// `count` 0: until `stop_capture`.
  base::Result<> capture_photos(int count, double interval_s);
  base::Result<> stop_capture();
  /// `item` counts from 1, home being 0; may lie ahead. `repetitions` -1: for ever.
  base::Result<> jump(int item, int repetitions);

  /// As far as it is built.
  [[nodiscard]] Mission const& mission() const { return mission_; }
  /// What was built; `default_name` if it has none. Errors when a jump leads nowhere.
  [[nodiscard]] base::Result<Mission> finish(std::string default_name) const;

 private:
  base::Result<> add(mavlink::MavCmd command, std::array<double, 4> params,
                     std::optional<geo::Wgs84> place = std::nullopt);

  Mission mission_;
  std::optional<geo::Wgs84> home_;  ///< the latest
  std::optional<geo::Wgs84> last_;
  int photos_ = 0;
};

}  // namespace lapwing::plan
