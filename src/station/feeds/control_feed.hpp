#pragma once

#include <optional>
#include <string>

#include "station/feeds/feed.hpp"
#include "vehicle/control.hpp"

namespace lapwing::station {

/// What operators have commanded and what became of it, as `emergency` and `commands` messages, whole each time.
class ControlFeed final : public Feed {
 public:
  explicit ControlFeed(vehicle::VehicleControl const& control) : control_(control) {}

  [[nodiscard]] std::string_view name() const override { return "control"; }
  [[nodiscard]] std::uint64_t refresh(base::TimePoint now) override;
  [[nodiscard]] News since(std::uint64_t revision, base::TimePoint now, std::size_t room) const override;

 private:
  vehicle::VehicleControl const& control_;
  std::optional<std::uint64_t> looked_at_;  ///< its own revision
  std::string emergency_;
  std::string commands_;
  std::uint64_t emergency_revision_ = 0;
  std::uint64_t commands_revision_ = 0;
};

}  // namespace lapwing::station
