#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "explore/lot/fence_routes.hpp"
#include "explore/lot/flight.hpp"
#include "explore/lot/lot_bits.hpp"
#include "explore/lot/lot_map.hpp"

namespace lapwing::explore {

using AirPlace = geo::Point3<geo::SiteFrame>;

/// What the planner counts with. One set for all car parks; docs/reference/survey.md says what each does to the
/// figures.
struct SurveySettings {
  geo::Lens camera;
  double tilt_rad = 0.0;     ///< of the camera, which turns with the drone; 0 looks straight down
  double ground_up_m = 0.0;  ///< above the site's anchor
  double lowest_m = 7.0;     ///< hover heights above the ground
  double desired_m = 10.0;
  double highest_m = 20.0;
  FlightLimits flight = {};
  double fence_margin_m = 2.0;
  LookErrors errors = {};
  double block_m = 2.0;         ///< of ground that is judged as one
  double step_m = 4.0;          ///< between places that are thought of
  double row_share = 0.35;      ///< a place in a row is flown to for that share of what fresh ground would tell there
  double least_bits = 2.0;      ///< a place that tells less is not flown to
  double least_bits_a_s = 0.5;  ///< nor is one that tells less in each second from the nearest other one
  double arrived_m = 1.0;
  bool keeps_watching = false;  ///< looks again at what has grown old, until energy or time ends it
  base::Duration watch_again = std::chrono::seconds(20);
};

/// What it may use.
struct SurveyBudget {
  map::SitePoint home;
  double flying_s = std::numeric_limits<double>::infinity();  ///< until it must be over home: of the energy
  double time_s = std::numeric_limits<double>::infinity();    ///< until the survey is to end
  bool is_asked_to_end = false;
};

struct SurveyDrone {
  AirPlace place;
  double yaw_rad = 0.0;  ///< counterclockwise from east
};

/// Fly there.
struct SurveyGoal {
  AirPlace place;
  double yaw_rad = 0.0;
  double bits = 0.0;     ///< what is expected to be learned there and on the way
  double takes_s = 0.0;  ///< to get there
};
/// Stay: nothing has grown old enough.
struct SurveyWait {
  base::Duration time{};
};
enum class SurveyEnding { nothing_more, energy, time, asked_to, out_of_fence };
[[nodiscard]] std::string_view to_string(SurveyEnding ending);
struct SurveyEnd {
  SurveyEnding reason{};
  double coverage = 0.0;  ///< share of the area that was seen well enough
};
using SurveyStep = std::variant<SurveyGoal, SurveyWait, SurveyEnd>;

/// The path planner: where a drone flies next so that it learns most of a car park in the time that it has.
///
/// What a view would tell is counted in bits (`LotBits`) with the real ground that the camera shows from there. Ground
/// that was never seen is covered in rows along the area's narrowest way, as far apart as pictures are wide, at the
/// height that tells most a second; what is still unsure then is gathered by the fewest places that show it. The order
/// is that of a short tour, and only its first leg is flown before everything is thought of anew.
class SurveyPlanner {
 public:
  /// Errors, invalid_input: a lens or fence that is none, heights in no order, a camera that sees no ground from any.
  [[nodiscard]] static base::Result<SurveyPlanner> make(geo::Polygon<geo::SiteFrame> fence, SurveySettings settings,
                                                        LotSettings const& lot = {});

  /// `goal`: what it was told last, while it flies there; it is kept as long as it is worth it. `others`: where other
  /// drones that share the lot are, or are flying to: what they will see is left to them.
  [[nodiscard]] SurveyStep next(LotMap const& lot, SurveyDrone const& drone, SurveyBudget const& budget,
                                std::optional<SurveyGoal> const& goal, std::span<AirPlace const> others,
                                base::UtcTime now) const;

  /// Of a place that an operator wants: may it be flown to, and is it in the lot as far as that is known?
  [[nodiscard]] bool is_in_bounds(LotMap const& lot, map::SitePoint const& place, base::UtcTime now) const;
  /// How long the way home takes from there, landing left out.
  [[nodiscard]] double seconds_home(AirPlace const& place, SurveyBudget const& budget) const;
  /// The next place to fly straight to on that way.
  [[nodiscard]] map::SitePoint toward_home(AirPlace const& place, SurveyBudget const& budget) const;

  [[nodiscard]] SurveySettings const& settings() const { return settings_; }

 private:
  /// A height, a way that the drone looks, and what it sees of the ground so.
  struct Pose {
    double height_m;
    double yaw_rad;
    Reach reach;
    double slot_error;
  };
  struct Stop {
    map::SitePoint place;
    std::size_t pose = 0;
    double bits = 0.0;
  };
  SurveyPlanner(FenceRoutes fence, SurveySettings settings, LotSettings lot);

  void find_poses(double axis_rad);
  [[nodiscard]] LotBits::Viewpoint viewpoint(Stop const& stop) const;
  [[nodiscard]] AirPlace air_place(Stop const& stop) const;
  [[nodiscard]] std::size_t row_pose() const;
  [[nodiscard]] std::vector<Stop> rows(LotMap const& lot, LotBits& bits) const;
  [[nodiscard]] std::vector<Stop> rest(LotMap const& lot, LotBits& bits) const;
  void leave_to_others(LotBits& bits, std::span<AirPlace const> others) const;
  [[nodiscard]] std::vector<std::size_t> order(std::vector<Stop> const& stops, SurveyDrone const& drone) const;
  [[nodiscard]] double seconds_between(Stop const& a, Stop const& b) const;
  [[nodiscard]] double seconds_to(Stop const& stop, SurveyDrone const& drone) const;
  /// Without those that are out of reach, or too far from the drone and all others for what they tell.
  void keep_worthwhile(std::vector<Stop>& stops, SurveyDrone const& drone) const;
  [[nodiscard]] SurveyGoal goal_of(std::vector<Stop> const& stops, std::vector<std::size_t> const& tour,
                                   SurveyDrone const& drone) const;
  [[nodiscard]] bool is_within(SurveyGoal const& goal, SurveyDrone const& drone, SurveyBudget const& budget) const;
  [[nodiscard]] bool is_worth(SurveyGoal const& goal, LotBits const& bits) const;

  FenceRoutes fence_;
  SurveySettings settings_;
  LotSettings lot_;
  double axis_rad_ = 0.0;
  std::vector<Pose> poses_;
};

/// The way along which a polygon's rows are longest and fewest: that of the edge across which it is narrowest (Huang
/// 2001).
[[nodiscard]] double narrowest_axis(geo::Polygon<geo::SiteFrame> const& area);

}  // namespace lapwing::explore
