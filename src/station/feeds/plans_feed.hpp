#pragma once

#include <map>
#include <vector>

#include "station/feeds/feed.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::station {

/// Where each vehicle is to go by its mission, as `plan` messages.
class PlansFeed final : public Feed {
 public:
  explicit PlansFeed(vehicle::Registry const& registry) : registry_(registry) {}

  [[nodiscard]] std::string_view name() const override { return "plans"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  struct Plan {
    unsigned long long looked_at = 0;  ///< the registry's revision
    std::vector<geo::Wgs84> path;
    std::uint64_t revision = 0;  ///< at which it changed; 0: it never held any
  };
  vehicle::Registry const& registry_;
  std::map<vehicle::VehicleId, Plan> plans_;
  std::uint64_t revision_ = 1;
};

}  // namespace lapwing::station
