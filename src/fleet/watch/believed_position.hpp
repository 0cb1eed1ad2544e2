#pragma once

#include <optional>
#include <string>

#include "base/time.hpp"
#include "geo/position.hpp"

namespace lapwing::fleet {

/// The vehicle told a place to which nothing gets in the time: its estimator, its GPS or somebody else has it wrong.
struct PositionJump {
  double distance_m = 0.0;  ///< from where it was believed to be
  base::Duration within{};
  base::Duration lasts{};  ///< for how long it has been telling of the new place
};

/// "its position jumped by 111.2 km within 0.2 s"
[[nodiscard]] std::string to_text(PositionJump const& jump);

/// Where a vehicle can be believed to be: tells a place that it has flown to from one to which it has jumped.
class BelievedPosition {
 public:
  /// A position was heard, `since_last` after the one before. False when the vehicle cannot be there.
  bool note(geo::Wgs84 place, base::Duration since_last);

  /// As long as it tells of a place where it cannot be.
  [[nodiscard]] std::optional<PositionJump> const& jump() const { return jump_; }

 private:
  std::optional<geo::Wgs84> believed_;
  base::Duration since_believed_{};
  std::optional<geo::Wgs84> told_;  ///< where it cannot be
  std::optional<PositionJump> jump_;
};

}  // namespace lapwing::fleet
