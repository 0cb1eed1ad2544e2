#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>

#include "explore/lot/lot_map.hpp"
#include "explore/lot/survey_planner.hpp"
#include "geo/site.hpp"
#include "map/features/feature.hpp"
#include "perceive/memory/kept_sights.hpp"
#include "perceive/memory/survey_memory.hpp"
#include "perceive/survey_order.hpp"
#include "video/camera/camera.hpp"

namespace lapwing::perceive {

/// What is new to the surveyor.
struct News {
  base::UtcTime now;
  std::optional<explore::LotSight> sight = {};
  std::optional<video::BodyPlace> drone = {};  ///< nothing: it is not known where it is
  double speed_m_s = 0.0;
  double flying_s = std::numeric_limits<double>::infinity();  ///< until it has to be over home
  bool explores = false;                                      ///< it flies where the planner says
  std::optional<map::SitePoint> wanted = {};                  ///< is that place in the lot?
  bool wants_map = false;
};

struct SurveyFigures {
  double coverage = 0.0;
  std::size_t slots = 0;  ///< on the map
  std::size_t taken = 0;
  std::size_t free = 0;
  std::size_t sights = 0;                   ///< that showed some of the area
  std::optional<base::UtcTime> begun = {};  ///< when the drone began to explore, the last time
  std::string ending = {};                  ///< why that is over; empty: it is not
  friend bool operator==(SurveyFigures const&, SurveyFigures const&) = default;
};

/// What follows from it.
struct Conclusion {
  std::optional<explore::SurveyGoal> goal = {};  ///< for the drone, whose yaw it has
  std::optional<std::string> report = {};        ///< once, when the survey is over: for the operator
  std::optional<bool> is_in_lot = {};            ///< the wanted place
  std::optional<bool> sees_lot = {};             ///< nothing as long as that cannot be told
  std::optional<explore::LotOccupancy> map = {};
  SurveyFigures figures = {};
};

/// Mapper and path planner of one survey: sights of the ground become a map, and the map tells where to fly next. It
/// goes on mapping whatever the drone does; it leads only while the drone explores. Each time that it begins to, it
/// flies to whatever is not known well by then.
class Surveyor {
 public:
  /// Errors: those of LotMap and SurveyPlanner; invalid_input for an anchor that is no place.
  [[nodiscard]] static base::Result<Surveyor> make(SurveyOrder order, SurveyGround const& ground,
                                                   HoverHeights const& heights);

  /// Goes on with the map of an earlier process: its slots with their ids and as they were seen last, and the ground
  /// that was seen. New slots get ids that none of it has. Precondition: nothing was seen yet.
  void recall(SurveyMemory memory, base::UtcTime now);
  /// All that a later process takes up, as `read_memory` reads it. What was seen before `since` is left out.
  [[nodiscard]] std::string memory(base::UtcTime now, base::UtcTime since);

  /// When home or heights are others from now on. Errors: those of SurveyPlanner; it goes on as before.
  base::Result<> adapt(geo::Point3<geo::SiteFrame> const& home, HoverHeights const& heights);
  [[nodiscard]] Conclusion think(News news);
  /// In whose frame the map is.
  [[nodiscard]] geo::Site const& site() const { return site_; }
  /// Those on the map.
  [[nodiscard]] std::vector<map::Slot> slots() const;
  /// The slots as GeoJSON, on one line, and how far the survey is as its member `survey`.
  [[nodiscard]] std::string slots_line() const;
  /// The same for people, with their ages and the survey's figures.
  [[nodiscard]] std::string slots_text(base::UtcTime now);

 private:
  Surveyor(SurveyOrder order, SurveyGround const& ground, HoverHeights const& heights, geo::Site site,
           explore::LotMap lot);
  [[nodiscard]] base::Result<explore::SurveyPlanner> make_planner() const;
  void take(explore::LotSight const& sight);
  void know(map::Feature slot);
  [[nodiscard]] std::optional<bool> sees_lot() const;
  void lead(News const& news, Conclusion& conclusion);
  [[nodiscard]] explore::SurveyBudget budget(News const& news) const;
  [[nodiscard]] explore::SurveyStep next_step(News const& news) const;
  [[nodiscard]] bool is_there(video::BodyPlace const& drone, double speed_m_s) const;
  [[nodiscard]] std::string end(std::string_view reason);
  [[nodiscard]] explore::SurveyGoal way_home(News const& news) const;
  [[nodiscard]] SurveyFigures figures() const;
  [[nodiscard]] double camera_yaw(video::BodyPlace const& drone) const;

  SurveyOrder order_;
  SurveyGround ground_;
  geo::Site site_;
  explore::LotMap lot_;
  HoverHeights heights_;
  std::optional<explore::SurveyPlanner> planner_ = {};  ///< there once it is made
  std::map<std::string, map::Feature> slots_;           ///< by their ids
  KeptSights kept_ = {};
  int lives_ = 1;
  std::size_t sights_ = 0;
  std::optional<base::UtcTime> found_at_ = {};   ///< of the last slot
  std::optional<base::UtcTime> looked_at_ = {};  ///< of the last sight of the area
  base::Duration without_{};                     ///< a slot, over the area
  std::optional<base::UtcTime> explores_since_ = {};
  std::optional<base::UtcTime> begun_ = {};  ///< the same, and kept when it does no more
  std::optional<explore::SurveyGoal> goal_ = {};
  base::UtcTime planned_at_{};
  std::string ending_ = {};                           ///< why the survey is over; empty: it is not
  std::optional<video::BodyPlace> turned_home_ = {};  ///< where it was over for want of energy
};

}  // namespace lapwing::perceive
