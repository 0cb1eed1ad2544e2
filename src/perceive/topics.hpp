#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "bus/messages/arrays.hpp"
#include "bus/messages/diagnostics.hpp"
#include "bus/messages/mavros.hpp"
#include "bus/messages/mavros_services.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/participant/ends.hpp"
#include "explore/lot/lot_map.hpp"
#include "explore/lot/survey_planner.hpp"
#include "perceive/pose_track.hpp"
#include "perceive/survey_order.hpp"

namespace lapwing::perceive {

/// What the bus has said so far.
struct Heard {
  PoseTrack track = {};
  std::optional<base::TimePoint> pose_at = {};  ///< when the newest came
  std::optional<SurveyGround> ground = {};
  HoverHeights heights = {};
  std::optional<base::TimePoint> home_by = {};  ///< when it has to be over home, by its battery; nothing: not known
  bool explores = false;                        ///< the drone flies where the planner says
  std::optional<map::SitePoint> wanted = {};    ///< of which it has not been said yet whether it is in the lot
};

/// The bus as perceive needs it.
class Topics {
 public:
  /// `bus` outlives it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<Topics>> open(base::Loop& loop, bus::Bus& bus);
  Topics(Topics const&) = delete;
  Topics& operator=(Topics const&) = delete;

  [[nodiscard]] Heard const& heard() const { return heard_; }
  /// That is not asked again.
  [[nodiscard]] std::optional<map::SitePoint> take_wanted() { return std::exchange(heard_.wanted, std::nullopt); }

  void say_goal(explore::SurveyGoal const& goal);
  void say_map(explore::LotOccupancy const& map, base::UtcTime at);
  void say_sees_lot(bool sees) { sees_lot_->publish({sees}); }
  void say_in_lot(bool is_in_lot) { in_lot_->publish({is_in_lot}); }
  /// GeoJSON.
  void say_slots(std::string const& collection) { slots_->publish({collection}); }
  void say_report(std::string const& words) { report_->publish({words}); }
  void say_health(std::optional<bus::DiagnosticStatus> const& vision, bus::DiagnosticStatus const& mapper,
                  bus::DiagnosticStatus const& planner);
  /// Over the ground, for what is flown from now on.
  void ask_for_speed(double speed_m_s);

 private:
  explicit Topics(base::Loop& loop) : loop_(loop) {}
  base::Result<> open_ends(bus::Bus& bus);
  void take(bus::PoseStamped const& pose);
  void take(bus::mavros::HomePosition const& home);
  void take(bus::Float64MultiArray const& heights);
  void take(bus::Float64 const& seconds);

  base::Loop& loop_;
  Heard heard_;
  std::optional<bus::Publisher<bus::PoseStamped>> setpoint_;
  std::optional<bus::Publisher<bus::OccupancyGrid>> map_;
  std::optional<bus::Publisher<bus::Bool>> sees_lot_;
  std::optional<bus::Publisher<bus::Bool>> in_lot_;
  std::optional<bus::Publisher<bus::String>> slots_;
  std::optional<bus::Publisher<bus::String>> report_;
  std::optional<bus::Publisher<bus::DiagnosticStatus>> vision_;
  std::optional<bus::Publisher<bus::DiagnosticStatus>> mapper_;
  std::optional<bus::Publisher<bus::DiagnosticStatus>> planner_;
  std::optional<bus::ServiceClient<bus::mavros::CommandLong>> commands_;
  bus::Subscriptions topics_;  ///< last: nothing comes any more
};

}  // namespace lapwing::perceive
