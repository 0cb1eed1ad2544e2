#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "autonomy/interface/heights.hpp"
#include "autonomy/interface/said.hpp"
#include "autonomy/interface/told.hpp"
#include "autonomy/operator/occupancy_map.hpp"
#include "base/async/loop.hpp"
#include "bus/messages/arrays.hpp"
#include "bus/messages/diagnostics.hpp"
#include "bus/messages/navigation.hpp"
#include "bus/participant/ends.hpp"
#include "onboard/decide/flight_listener.hpp"

namespace lapwing::onboard {

/// The processes that report their health, by the names that a configuration calls them.
[[nodiscard]] std::vector<std::string_view> known_processes();

/// How far the lot reaches, as far as it was seen: around the cells that are known. Nothing when none is.
[[nodiscard]] std::optional<geo::Box<autonomy::ArmingFrame>> seen_extent(autonomy::OccupancyMap const& map);

/// The processes that look, map and plan: what they say, and what they are told.
class SurveyProcesses {
 public:
  /// `relies_on`: those without which the drone does not fly, of `known_processes`. Others may be there or not. All
  /// outlive it. Errors: those of the bus.
  [[nodiscard]] static base::Result<std::unique_ptr<SurveyProcesses>> open(base::Loop& loop, bus::Bus& bus,
                                                                           FlightHeard const& flight,
                                                                           std::vector<std::string> const& relies_on);
  SurveyProcesses(SurveyProcesses const&) = delete;
  SurveyProcesses& operator=(SurveyProcesses const&) = delete;

  /// Writes what they have said.
  void tell(autonomy::Told& told) const;
  [[nodiscard]] std::optional<autonomy::OccupancyMap> const& map() const { return map_; }
  /// The places to park, as GeoJSON: what was said last and not taken yet.
  [[nodiscard]] std::optional<std::string> take_slots() { return std::exchange(slots_, std::nullopt); }
  /// What the machine has decided.
  void hear(autonomy::Said const& said);
  /// Those in force, between which the planner is to stay.
  void hear(autonomy::HoverHeights const& heights);
  /// What the planner has said to the operator since the last call.
  [[nodiscard]] std::vector<std::string> take_reports() { return std::exchange(reports_, {}); }

 private:
  struct Process {
    std::string name;
    Heard<bus::DiagnosticStatus> health = {};
  };
  SurveyProcesses(base::Loop& loop, FlightHeard const& flight) : loop_(loop), flight_(flight), began_(loop.now()) {}
  base::Result<> open_topics(bus::Bus& bus, std::vector<std::string> const& relies_on);
  void take(bus::OccupancyGrid const& grid);
  void take_report(std::string const& words);
  /// To the planner, twice a second as long as it is known.
  void tell_time_left(autonomy::Said const& said);
  [[nodiscard]] std::optional<base::Duration> silence_of(Process const& process) const;

  base::Loop& loop_;
  FlightHeard const& flight_;
  base::TimePoint began_;
  std::vector<std::unique_ptr<Process>> processes_;
  Heard<bus::Bool> sees_lot_;
  Heard<bus::Bool> place_in_lot_;
  Heard<bus::PoseStamped> setpoint_;
  std::optional<autonomy::OccupancyMap> map_;
  std::optional<geo::Box<autonomy::ArmingFrame>> lot_;
  std::optional<autonomy::State> told_state_;
  std::vector<std::string> reports_;
  std::optional<std::string> slots_;
  std::optional<autonomy::HoverHeights> told_heights_;
  base::TimePoint time_left_due_{};
  std::optional<bus::Publisher<bus::Float64MultiArray>> heights_;
  std::optional<bus::Publisher<bus::Float64>> flying_time_left_;
  std::optional<bus::Publisher<bus::PoseStamped>> wanted_;
  std::optional<bus::Publisher<bus::String>> state_;
  bus::Subscriptions topics_;  ///< last: nothing comes any more
};

}  // namespace lapwing::onboard
