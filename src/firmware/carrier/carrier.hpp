#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "firmware/board.hpp"
#include "firmware/carrier/heading.hpp"
#include "firmware/carrier/motion.hpp"
#include "firmware/carrier/outbox.hpp"
#include "firmware/carrier/safe_distance.hpp"
#include "firmware/carrier/surroundings.hpp"
#include "firmware/carrier/tuning.hpp"
#include "firmware/carrier/wheel.hpp"

namespace lapwing::firmware {

/// Carries out commands: speed to 1 cm/s, heading to 1 degree; and what holds whatever was commanded: kill, safe
/// distance, watchdog, dead wheels (docs/reference/robot-serial.md, "What a board must do by itself").
///
/// Values in, values out: the same calls at the same times give the same voltages.
class Carrier {
 public:
  struct Voltages {
    float left = 0;  ///< of the full one, -1 to 1
    float right = 0;
  };

  Carrier(Description const& description, Tuning const& tuning);

  /// A kill holds from this call on: set the voltages again after it.
  void take(Time now, FromHost const& record, Outbox& out);

  // What the sensors say, whenever they say it.
  void feel(Time now, ImuSample const& sample) { heading_.feel(now, sample); }
  void hear(std::span<std::uint16_t const> echoes_us) { surroundings_.hear(echoes_us); }
  void see(LaserScan const& scan) { surroundings_.see(scan, way_m()); }

  /// Once each control period.
  void control(Time now, Pulses const& pulses, Outbox& out);

  [[nodiscard]] Voltages voltages() const { return {.left = left_.output(), .right = right_.output()}; }
  [[nodiscard]] std::uint16_t flags(Time now) const;
  /// The number of what is carried out; zero: it stands, or comes to stand.
  [[nodiscard]] CommandNumber command() const;
  [[nodiscard]] CommandNumber completed() const { return completed_; }
  [[nodiscard]] Motion motion() const;
  [[nodiscard]] bool is_killed() const { return is_killed_; }

 private:
  using Command = std::variant<std::monostate, Drive, Turn, Stop>;

  template <class Order>
  void accept(Time now, Order const& order, Outbox& out);
  void begin_anew();
  void kill(Time now, Outbox& out);
  void release(Time now, Outbox& out);
  void drop();
  [[nodiscard]] bool needs_heading(Command const& command) const;

  void look_for_faults(Time now, Outbox& out);
  void look_for_slip(Time period, Time now, Outbox& out);
  [[nodiscard]] Motion wanted(float period_s);
  [[nodiscard]] Motion wanted_by(Drive const& drive, float period_s);
  [[nodiscard]] Motion safe(Time now, Motion wanted, Outbox& out);
  [[nodiscard]] bool is_reached() const;
  void look_for_completion(Time now, Outbox& out);
  [[nodiscard]] float way_m() const { return (left_.way_m() + right_.way_m()) / 2; }

  Description body_;
  Tuning tuning_;
  Wheel left_;
  Wheel right_;
  Heading heading_;
  Surroundings surroundings_;
  SafeDistance safe_distance_;

  Command command_;
  CommandNumber last_number_ = 0;
  CommandNumber completed_ = 0;
  Motion ramped_;
  float heading_integral_rad_s_ = 0;
  Time last_control_{};
  Time heard_{};
  std::optional<Time> reached_since_;
  Time slipping_for_{};

  bool is_killed_ = false;
  bool is_too_near_ = false;
  bool has_gone_back_too_far_ = false;
  bool has_watchdog_bitten_ = false;
  bool is_slipping_ = false;
};

}  // namespace lapwing::firmware
