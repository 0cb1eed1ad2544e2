#pragma once

#include <optional>

#include "base/time.hpp"
#include "vehicle/energy/drain_meter.hpp"

namespace lapwing::robot {

/// Shares of a full charge.
struct HomeChargeOptions {
  double margin = 0.05;  ///< on top of what the way home takes
  double least = 0.15;   ///< of that a carrier says that its battery is low, and share cells give in soon after
  /// As long as nobody knows what driving draws: that takes the first few percents, and no farther than these take it.
  double when_unknown = 0.20;
  base::Duration sure_after = std::chrono::seconds(5);  ///< a motor that starts pulls the voltage down for a moment
};

/// Whether a robot's charge takes it home and little farther: by what its drive draws, how fast it gets on, and how far
/// it is from home.
class HomeCharge {
 public:
  /// `speed_m_s`: its highest.
  explicit HomeCharge(double speed_m_s, HomeChargeOptions const& options = {})
      : speed_m_s_(speed_m_s), options_(options) {}

  struct Now {
    base::TimePoint at{};
    std::optional<double> charge = {};  ///< 0..1; nothing: it is never due
    double driven_m = 0.0;
    bool is_under_way = false;
  };
  void note(Now const& now);
  void set_way(double home_m) { home_m_ = home_m; }

  /// It is time to turn home.
  [[nodiscard]] bool is_due() const { return is_due_; }

 private:
  [[nodiscard]] double needed(Now const& now, std::optional<vehicle::Drain> const& drain) const;

  double speed_m_s_;
  HomeChargeOptions options_;
  vehicle::DrainMeter meter_;
  double home_m_ = 0.0;
  bool was_under_way_ = false;
  base::TimePoint set_out_at_{};
  double set_out_m_ = 0.0;
  std::optional<base::TimePoint> low_since_;
  bool is_due_ = false;
};

}  // namespace lapwing::robot
