#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/assert.hpp"
#include "base/async/notifier.hpp"
#include "base/async/scope.hpp"
#include "base/error.hpp"
#include "sim/body/gusts.hpp"
#include "sim/mavlink/flight_controller.hpp"

namespace lapwing::sim {

/// One simulated vehicle on its own link: powers on, flies, reboots. Runs by itself on the loop until destroyed.
///
/// Faults that a test or a person wants are methods. Thread-bound to the loop.
class Vehicle {
 public:
  struct Options {
    Kind kind;
    std::uint8_t system_id = 1;
    geo::Ned start;  ///< on the ground, in the site's frame
    double heading_rad = 0.0;
    /// What it takes for its altitude above sea level is so much more than the truth, as GPS and barometer have it.
    double altitude_error_m = 0.0;
    BootTimeline boot = quick_boot();
    double battery_capacity_mah = 5000.0;
    double battery_remaining = 1.0;
    /// Somebody puts a full battery into a vehicle that has stood disarmed for so long; nothing: nobody does.
    std::optional<base::Duration> battery_swap_after = std::nullopt;
    geo::Ned wind_m_s;
    double gust_m_s = 0.0;
    std::uint64_t seed = 1;
    std::optional<mavlink::SigningKey> signing_key = std::nullopt;
  };
  /// Makes the link of one power-on: a new one each time, as a real vehicle has a new source port each time.
  using OpenLink = std::function<base::Result<std::unique_ptr<link::ByteLink>>()>;

  Vehicle(base::Loop& loop, Options options, Site const& site, OpenLink open_link, base::Logger log);
  Vehicle(Vehicle const&) = delete;
  Vehicle& operator=(Vehicle const&) = delete;

  /// Opens the link and begins to run. Errors: those of the link.
  base::Result<> power_on();

  // Faults.
  /// Arming is refused with "Arm: `reason`"; empty: no longer.
  void refuse_arming(std::string reason);
  /// Uploads of that mission item are answered with `result`; nullopt: no longer. Survives no reboot.
  void refuse_item(std::optional<int> seq, mavlink::MavMissionResult result = mavlink::MavMissionResult::error);
  /// The flight controller starts anew, wherever the vehicle is; one in the air comes down where it was.
  void reboot();
  /// Neither hears nor sends for that long; flies on.
  void fall_silent(base::Duration duration);
  void fall_silent_for_good();
  void set_battery(double remaining);
  bool pilot_sets_mode(std::uint32_t number);
  void lose_gps();
  void restore_gps();

  [[nodiscard]] Options const& options() const { return options_; }
  [[nodiscard]] bool running() const { return controller_ != nullptr; }
  /// Precondition: running().
  [[nodiscard]] Autopilot const& autopilot() const {
    LAPWING_ASSERT(running());
    return controller_->autopilot();
  }
  [[nodiscard]] Gimbal const& gimbal() const { return controller_->gimbal(); }
  [[nodiscard]] ParameterTable& parameters() { return memory_.parameters; }
  [[nodiscard]] MissionPlan const& mission() const { return memory_.plans.mission; }
  [[nodiscard]] Plans& plans() { return memory_.plans; }
  [[nodiscard]] geo::Wgs84 place() const { return site_.place_at(body_.position_m); }

 private:
  base::Task<void> live();
  base::Result<> switch_on();
  void connect_payload();
  void switch_off();
  void keep_up();
  void swap_battery_when_due();

  base::Loop& loop_;
  Options options_;
  Site site_;  ///< as the vehicle takes it to lie
  OpenLink open_link_;
  base::Logger log_;
  Memory memory_;
  Gusts gusts_;
  Body body_;  ///< as of the last step; what remains while switched off
  BatteryPack battery_;
  std::string arming_fault_;
  std::unique_ptr<FlightController> controller_;
  base::TimePoint next_step_{};
  base::TimePoint silent_until_{};
  base::TimePoint busy_until_{};  ///< when it was last seen armed or with a full battery
  bool reboot_wanted_ = false;
  base::Scope scope_;
};

}  // namespace lapwing::sim
