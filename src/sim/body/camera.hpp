#pragma once

#include <array>
#include <optional>
#include <vector>

#include "base/time.hpp"
#include "mavlink/codec/messages.hpp"
#include "sim/body/dynamics.hpp"

namespace lapwing::sim {

/// A camera wired to the autopilot: takes pictures by command, at intervals of time, and by distance flown.
class Camera {
 public:
  struct Shot {
    int index = 0;  ///< from 0 since power-on
    base::Duration at{};
    geo::Ned position_m;
    vehicle::Attitude attitude;
  };

  /// Whether it is a command for cameras, which is then carried out; as a mission item or from the ground.
  bool perform(mavlink::MavCmd command, std::array<float, 4> const& params, mavlink::ItemPlace const& place,
               base::Duration now);
  /// The pictures taken since the last step, which ended at `now` with the vehicle in `body`.
  [[nodiscard]] std::vector<Shot> step(Body const& body, base::Duration now);
  /// Every one since power-on.
  [[nodiscard]] std::vector<Shot> const& shots() const { return shots_; }

 private:
  void shoot(Body const& body, base::Duration now);

  std::vector<Shot> shots_;
  std::size_t told_ = 0;
  int pending_ = 0;  ///< to be taken at the next step
  // At intervals.
  int left_ = 0;  ///< negative: until stopped
  base::Duration next_{};
  base::Duration period_{};
  // By distance.
  double distance_m_ = 0.0;  ///< 0: not
  std::optional<geo::Ned> last_m_;
};

}  // namespace lapwing::sim
