#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "sim/body/dynamics.hpp"
#include "sim/model/fence_plan.hpp"
#include "sim/safety/safety.hpp"

namespace lapwing::sim {

/// Notices when a vehicle leaves its fence: the limits that parameters set and the areas that a ground station
/// uploaded. As AC_Fence of ArduPilot counts: a breach is counted when a limit is first crossed, again each time the
/// vehicle has gone 20 m farther out (but for areas), and is over when it is back inside.
class FenceWatch {
 public:
  enum Limit : unsigned { height = 1, circle = 2, areas = 4, floor = 8 };  ///< the bits of FENCE_TYPE
  /// What is looked at.
  struct View {
    Body const& body;
    Site const& site;
    geo::Ned home;
    MissionPlan const& plan;
    FenceSettings const& settings;
    bool position_ok = false;
    base::Duration now{};
  };
  /// What an update found.
  struct News {
    unsigned breached = 0;  ///< the limits newly breached, or breached anew farther out, as bits
    bool is_first = false;  ///< none was breached before
    bool calls_for_action = false;
    bool is_over = false;            ///< the vehicle is back inside
    unsigned left_margin = 0;        ///< limits that it is no longer close to
    std::optional<double> near_m{};  ///< time to tell how near a limit is
    std::optional<bool> floor_on{};  ///< the floor begins, or ceases, to be watched
  };

  News update(View const& view);
  /// DO_FENCE_ENABLE: goes before FENCE_ENABLE until the next start.
  void order(bool enabled) { ordered_ = enabled; }
  /// A change of mode during a breach: somebody brings the vehicle back. New breaches call for no action for 10 s.
  void begin_recovery(base::Duration now);

  [[nodiscard]] bool enabled(FenceSettings const& settings) const { return ordered_.value_or(settings.enabled); }
  /// Whether there is a limit that could be watched, switched on or not.
  [[nodiscard]] bool present(FenceSettings const& settings) const;
  /// Whether `point` is inside every limit that is watched; with the areas as of the last update.
  [[nodiscard]] bool allows(geo::Ned point, geo::Ned home, FenceSettings const& settings) const;
  /// Metres beyond the worst of the breached limits.
  [[nodiscard]] double depth_m(unsigned limits, geo::Ned point, geo::Ned home, FenceSettings const& settings) const;
  [[nodiscard]] unsigned breached() const { return breached_; }
  /// The limits to which the vehicle is closer than the margin, or which it has breached.
  [[nodiscard]] unsigned near() const { return near_; }
  /// Why the vehicle must not arm where it is, in ArduPilot's words; empty when it may.
  [[nodiscard]] std::string objection(FenceSettings const& settings) const;
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] base::Duration breached_at() const { return breached_at_; }

 private:
  void read(MissionPlan const& plan, Site const& site);
  [[nodiscard]] unsigned crossed(geo::Ned point, geo::Ned home, FenceSettings const& settings, double margin_m) const;
  [[nodiscard]] bool in_the_areas(geo::Ned point, bool any_inclusion) const;
  [[nodiscard]] double depth_of(Limit limit, geo::Ned point, geo::Ned home, FenceSettings const& settings) const;
  unsigned farther_out(unsigned now, View const& view);
  void watch_floor(View const& view, News& news);
  void watch_margin(unsigned now, View const& view, News& news);

  std::optional<bool> ordered_;
  MissionPlan read_;  ///< what `areas_` was made from
  std::vector<FenceArea> areas_;
  bool watches_floor_ = false;
  unsigned breached_ = 0;
  unsigned near_ = 0;
  std::optional<base::Duration> told_near_;
  std::optional<double> again_at_height_m_;  ///< so far beyond the limit it is breached anew
  std::optional<double> again_at_circle_m_;
  base::Duration recovers_until_{};
  int count_ = 0;
  base::Duration breached_at_{};
};

/// "Circle fence", "Max Alt, Polygon fences": as ArduPilot names limits in its texts.
[[nodiscard]] std::string fence_names(unsigned limits);

}  // namespace lapwing::sim
