#pragma once

#include <memory>
#include <string>

#include "station/feeds/feed.hpp"
#include "vehicle/registry.hpp"

namespace lapwing::station {

/// What is known of each vehicle, as `vehicles` messages: everything for a newcomer, only news for the others.
///
/// Each field of a vehicle is news when its value or the time at which it was heard changed. Ages go as seconds at the
/// moment of encoding, so client and station need no common clock, and what a viewer missed is never told as if it were
/// fresh.
class VehiclesFeed final : public Feed {
 public:
  explicit VehiclesFeed(vehicle::Registry const& registry);
  ~VehiclesFeed() override;

  [[nodiscard]] std::string_view name() const override { return "vehicles"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  struct Known;
  vehicle::Registry const& registry_;
  std::unique_ptr<Known> known_;
  std::uint64_t revision_ = 1;
};

/// The full message alone, for `GET /api/v1/vehicles`.
[[nodiscard]] std::string vehicles_message(vehicle::Registry const& registry, base::TimePoint now);

}  // namespace lapwing::station
