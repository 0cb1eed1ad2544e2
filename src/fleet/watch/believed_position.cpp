#include "fleet/watch/believed_position.hpp"

#include <fmt/format.h>

namespace lapwing::fleet {

using namespace std::chrono_literals;

namespace {

// An estimator may correct itself by so much when its GPS comes back.
constexpr double correction_m = 300.0;
constexpr double fastest_m_s = 150.0;

bool is_within_reach(geo::Wgs84 from, geo::Wgs84 to, base::Duration time) {
  return geo::surface_distance_m(from, to) <= correction_m + fastest_m_s * base::to_seconds(time);
}

}  // namespace

std::string to_text(PositionJump const& jump) {
  auto const far = jump.distance_m >= 1000.0 ? fmt::format("{:.1f} km", jump.distance_m / 1000.0)
                                             : fmt::format("{:.0f} m", jump.distance_m);
  return fmt::format("its position jumped by {} within {:.1f} s", far, base::to_seconds(jump.within));
}

bool BelievedPosition::note(geo::Wgs84 place, base::Duration since_last) {
  since_believed_ += since_last;
  if (!believed_ || is_within_reach(*believed_, place, since_believed_)) {
    believed_ = place;
    since_believed_ = {};
    jump_.reset();
    told_.reset();
    return true;
  }
  if (jump_ && is_within_reach(*told_, place, since_last)) {
    jump_->lasts += since_last;
  } else {
    jump_ = PositionJump{geo::surface_distance_m(*believed_, place), since_believed_, {}};
  }
  told_ = place;
  return false;
}

}  // namespace lapwing::fleet
