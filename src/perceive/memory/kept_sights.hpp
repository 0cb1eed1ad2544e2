#pragma once

#include <deque>
#include <string>

#include "explore/lot/lot_sight.hpp"

namespace lapwing::perceive {

/// The sights by which a map can be drawn anew, as few as that takes: those that showed ground which nobody had seen,
/// and of the others one a minute from each place. The oldest give way when there are too many.
class KeptSights {
 public:
  /// Whether it was kept.
  bool add(explore::LotSight const& sight, bool shows_new_ground);
  void forget_before(base::UtcTime time);

  [[nodiscard]] std::size_t size() const { return kept_.size(); }
  /// Each on a line of its own, the oldest first.
  [[nodiscard]] std::string lines() const;

  /// Some hours of flying over ground that is known, or a car park of 50,000 m^2 seen for the first time.
  static constexpr std::size_t most = 4'000;
  static constexpr std::size_t most_bytes = std::size_t{24} * 1024 * 1024;

 private:
  struct Kept {
    base::UtcTime at;
    geo::CameraPlace from;
    std::string line;
  };
  [[nodiscard]] bool tells_again(explore::LotSight const& sight) const;
  void drop_oldest();

  std::deque<Kept> kept_;
  std::size_t bytes_ = 0;
};

}  // namespace lapwing::perceive
