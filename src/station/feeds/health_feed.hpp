#pragma once

#include <string>

#include "station/feeds/feed.hpp"
#include "vehicle/modules.hpp"

namespace lapwing::station {

/// How the modules of vehicles do, whole each time: at once when one changes its state or its error, and otherwise once
/// a second, with ages, rates and memory as they are then.
class HealthFeed final : public Feed {
 public:
  /// It outlives this.
  explicit HealthFeed(vehicle::VehicleModules const& modules) : modules_(modules) {}

  [[nodiscard]] std::string_view name() const override { return "health"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  vehicle::VehicleModules const& modules_;
  std::string matters_;  ///< what is told at once
  base::TimePoint told_at_{};
  std::uint64_t revision_ = 0;
};

}  // namespace lapwing::station
