#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "sim/dynamics.hpp"
#include "sim/fence_plan.hpp"
#include "sim/safety.hpp"

namespace lapwing::sim {

/// Notices when a vehicle leaves its fence: the limits that parameters set and the areas that a ground station
/// uploaded. As AC_Fence of ArduPilot counts: a breach is counted when a limit is first crossed, and is over when the
/// vehicle is back inside.
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

  /// The limits newly breached, as bits.
  unsigned update(View const& view);
  /// DO_FENCE_ENABLE: goes before FENCE_ENABLE until the next start.
  void order(bool enabled) { ordered_ = enabled; }

  [[nodiscard]] bool enabled(FenceSettings const& settings) const { return ordered_.value_or(settings.enabled); }
  /// Whether `point` is inside every limit that is watched; with the areas as of the last update.
  [[nodiscard]] bool allows(geo::Ned point, geo::Ned home, FenceSettings const& settings) const;
  [[nodiscard]] unsigned breached() const { return breached_; }
  /// Why the vehicle must not arm where it is, in ArduPilot's words; empty when it may.
  [[nodiscard]] std::string objection() const;
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] base::Duration breached_at() const { return breached_at_; }

 private:
  void read(MissionPlan const& plan, Site const& site);
  [[nodiscard]] unsigned crossed(geo::Ned point, geo::Ned home, FenceSettings const& settings) const;
  [[nodiscard]] bool in_the_areas(geo::Ned point, bool any_inclusion) const;

  std::optional<bool> ordered_;
  MissionPlan read_;  ///< what `areas_` was made from
  std::vector<FenceArea> areas_;
  bool was_above_floor_ = false;
  unsigned breached_ = 0;
  int count_ = 0;
  base::Duration breached_at_{};
};

}  // namespace lapwing::sim
