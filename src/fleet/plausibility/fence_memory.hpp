#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "base/time.hpp"
#include "mavlink/codec/messages.hpp"
#include "plan/plausibility/vehicle_fence.hpp"
#include "vehicle/family.hpp"

namespace lapwing::fleet {

/// The parameters that make a vehicle's own fence.
struct FenceNames {
  std::span<std::string_view const> needed;    ///< every version of the autopilot has them
  std::span<std::string_view const> optional;  ///< some have them
};
/// None for autopilots of which nothing is known.
[[nodiscard]] FenceNames fence_names(vehicle::Autopilot autopilot, vehicle::Family family);

/// What a vehicle has told of its own fence. What it says unasked counts as much as answers do, so that a value that
/// somebody changes is right here a moment later, and areas that somebody replaces are forgotten.
class FenceMemory {
 public:
  /// Of any message from the vehicle's autopilot.
  void note(mavlink::Message const& message, vehicle::Autopilot autopilot, base::TimePoint now);
  /// It has restarted, and may be another one.
  void forget();

  /// The fence, if what tells about it is known, as it stands now; one that is switched off is none.
  [[nodiscard]] std::optional<plan::plausibility::VehicleFence> known(vehicle::Autopilot autopilot,
                                                                      vehicle::Family family) const;

  // For who reads it.
  [[nodiscard]] bool has_heard(std::string_view name, base::TimePoint since) const;
  /// It has said since then that it watches none.
  [[nodiscard]] bool is_off(vehicle::Autopilot autopilot, base::TimePoint since) const;
  [[nodiscard]] bool is_untold(std::string_view name) const { return untold_.contains(name); }
  /// Asked for in vain while others came: this vehicle does not have it.
  void set_untold(std::string_view name) { untold_.insert(std::string(name)); }
  /// It is switched on, and areas belong to it.
  [[nodiscard]] bool wants_areas(vehicle::Autopilot autopilot) const;
  [[nodiscard]] bool has_areas(base::TimePoint since) const { return areas_ && areas_heard_ >= since; }
  void set_areas(plan::GeoFence areas, base::TimePoint now);

  /// What did not come, and for how long it was waited for.
  struct Failure {
    std::string what;
    base::Duration patience{};
  };
  bool is_being_read = false;
  std::optional<base::TimePoint> read;  ///< when it was last asked for
  std::optional<Failure> failure;       ///< of that

 private:
  struct Value {
    double value = 0.0;
    base::TimePoint heard{};
  };
  [[nodiscard]] std::optional<double> value(std::string_view name) const;
  [[nodiscard]] std::optional<double> positive(std::string_view name) const;
  [[nodiscard]] bool is_on(vehicle::Autopilot autopilot) const;
  void note_value(mavlink::ParamValue const& heard, vehicle::Autopilot autopilot, base::TimePoint now);

  std::map<std::string, Value, std::less<>> values_;
  std::set<std::string, std::less<>> untold_;
  std::optional<plan::GeoFence> areas_;
  base::TimePoint areas_heard_{};
  std::uint32_t fence_id_ = 0;
};

}  // namespace lapwing::fleet
