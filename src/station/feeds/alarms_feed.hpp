#pragma once

#include <optional>

#include "station/feeds/feed.hpp"
#include "vehicle/alarm.hpp"

namespace lapwing::station {

/// The alarms that stand, as `alarms` messages, whole each time.
class AlarmsFeed final : public Feed {
 public:
  /// Without `alarms` there are none.
  explicit AlarmsFeed(vehicle::VehicleAlarms const* alarms) : alarms_(alarms) {}

  [[nodiscard]] std::string_view name() const override { return "alarms"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  vehicle::VehicleAlarms const* alarms_;
  std::optional<std::uint64_t> looked_at_;  ///< their own revision
  std::uint64_t revision_ = 1;
};

}  // namespace lapwing::station
