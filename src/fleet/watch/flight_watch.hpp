#pragma once

#include <optional>
#include <string>

#include "base/log.hpp"
#include "fleet/mission/flight_plan.hpp"
#include "fleet/mission/mission_end.hpp"
#include "fleet/state/mavlink_vehicle.hpp"
#include "fleet/watch/believed_position.hpp"
#include "fleet/watch/leg_progress.hpp"
#include "fleet/watch/legs.hpp"
#include "fleet/watch/place_trace.hpp"
#include "mavlink/connection/connection.hpp"

namespace lapwing::fleet {

/// Watches one flight of a mission and judges it: it is done when its places were passed and its end was reached. What
/// stands against that (somebody else changed the mission, items were skipped, the vehicle stands on the ground, makes
/// no progress, or tells of a place where it cannot be) is told in the log at once and ends the flight as failed.
///
/// Made before the mission is begun, so that no place is missed.
class FlightWatch {
 public:
  /// References outlive it. `plan_id`: the vehicle's name for the mission that it holds; 0: it gives none.
  FlightWatch(mavlink::Connection& connection, MavlinkVehicle const& craft, FlightPlan const& plan,
              std::uint32_t plan_id, base::Logger const& log);
  FlightWatch(FlightWatch const&) = delete;
  FlightWatch& operator=(FlightWatch const&) = delete;

  /// The vehicle has shown its mission mode.
  void begin();
  [[nodiscard]] MissionVerdict look();
  /// The item that it named last.
  [[nodiscard]] std::optional<int> item() const { return item_; }

 private:
  void take(mavlink::Received const& received);
  void take_position(mavlink::GlobalPosition const& heard, base::TimePoint now);
  void take_current(mavlink::MissionCurrent const& heard, base::TimePoint now);
  void take_fence(mavlink::FenceStatus const& heard, base::TimePoint now);
  [[nodiscard]] MissionSight sight() const;
  [[nodiscard]] base::Duration silence() const;
  [[nodiscard]] MissionVerdict judge_other_kind();
  [[nodiscard]] MissionVerdict judge_end(Aftermath aftermath);
  [[nodiscard]] MissionVerdict judge_way();
  [[nodiscard]] MissionVerdict judge_progress();
  [[nodiscard]] std::optional<std::string> foreign_mission() const;
  [[nodiscard]] bool stands_in_the_middle() const;
  void tell_jump();
  void tell_skipped_items();
  [[nodiscard]] base::TimePoint now() const { return connection_.loop().now(); }

  mavlink::Connection& connection_;
  MavlinkVehicle const& craft_;
  FlightPlan const& plan_;
  std::uint32_t plan_id_;
  base::Logger const& log_;
  vehicle::Family family_;
  base::TimePoint begun_;
  bool has_begun_ = false;

  BelievedPosition believed_;
  PlaceTrace places_;
  Legs legs_;
  LegProgress progress_;
  std::optional<base::Duration> clock_;  ///< the vehicle's, at the last position
  std::optional<base::TimePoint> position_heard_;
  double sinks_m_s_ = 0.0;
  bool fell_ = false;
  std::optional<int> item_;
  std::optional<base::TimePoint> in_the_air_since_;  ///< since then its item is one at which it flies
  std::string other_mission_;                        ///< how it differs from what was uploaded; empty: not at all
  std::optional<base::TimePoint> other_mission_since_;
  std::optional<base::TimePoint> other_kind_since_;
  std::optional<int> fence_breaches_;
  std::optional<base::TimePoint> fence_breached_;  ///< when the last new breach was heard of
  std::optional<base::TimePoint> ended_at_;
  std::optional<base::TimePoint> skipped_since_;
  bool has_told_skipped_ = false;
  bool has_told_stall_ = false;
  mavlink::Subscription subscription_;
};

}  // namespace lapwing::fleet
