#pragma once

#include <optional>
#include <string>
#include <variant>

#include "sim/autopilot/mission_runner.hpp"
#include "sim/body/trail.hpp"
#include "sim/guidance/flight_context.hpp"
#include "sim/guidance/guided.hpp"
#include "sim/guidance/return_home.hpp"
#include "sim/guidance/tuning.hpp"
#include "sim/model/parameter_table.hpp"
#include "sim/model/status_texts.hpp"
#include "sim/safety/arming.hpp"
#include "sim/safety/failsafe.hpp"
#include "sim/safety/fence.hpp"
#include "sim/safety/safety.hpp"

namespace lapwing::sim {

/// The flight logic of one ArduPilot or PX4 vehicle with its body and battery: modes, arming, missions, failsafes. No
/// protocol in it.
///
/// Time is counted from power-on and only moves with `step`. What happened is left in `outbox()`.
class Autopilot {
 public:
  struct Setup {
    Kind kind;
    geo::Ned start;  ///< on the ground
    double heading_rad = 0.0;
    BootTimeline boot;
    BatteryPack battery{5000.0};
  };
  /// `parameters` and `plans` are the vehicle's and outlive this.
  Autopilot(Setup const& setup, Site const& site, ParameterTable const& parameters, Plans const& plans);

  /// One step of `dt_s` ending at `now`.
  void step(base::Duration now, geo::Ned wind_m_s, double utc_day_s, double dt_s);

  // Commands, answered as ArduPilot answers; reasons go to the outbox as texts.
  mavlink::MavResult arm(bool force);
  mavlink::MavResult disarm(bool force);
  mavlink::MavResult set_mode(std::uint32_t number);
  /// To a height above home; PX4's changes the mode for it and takes its own height if none is given (NaN).
  mavlink::MavResult take_off(double height_m);
  mavlink::MavResult start_mission();
  /// Guided flight to a point; `change_mode` allows leaving another mode for it. A radius makes a plane circle there.
  mavlink::MavResult reposition(geo::Ned point, bool change_mode, double radius_m = 0.0);
  mavlink::MavResult guide_velocity(geo::Ned velocity_m_s);
  /// What wheels alone can do.
  mavlink::MavResult guide_wheels(Steer const& wanted);
  mavlink::MavResult change_speed(double speed_m_s);
  mavlink::MavResult turn_to(double yaw_rad);
  mavlink::MavResult pause(bool paused);
  bool set_current_item(int seq);
  /// Goes on with the mission at its DO_LAND_START; failed where it has none.
  mavlink::MavResult start_landing();
  void set_home(geo::Ned place);
  /// DO_FENCE_ENABLE.
  void enable_fence(bool enabled) { fence_.order(enabled); }
  void plan_changed() { mission_.plan_changed(outbox_); }
  void plan_cleared() { mission_.plan_cleared(); }
  /// A setpoint came: PX4 goes by them in OFFBOARD, which it enters and stays in only while they come.
  void setpoint_heard() { setpoint_heard_ = now_; }
  void ground_station_heard() { ground_station_.heard(now_); }

  // Faults.
  /// Refuses arming with this reason; empty: no longer.
  void set_arming_fault(std::string reason) { arming_fault_ = std::move(reason); }
  void lose_gps() { start_up_.lose_gps(now_); }
  void restore_gps() { start_up_.restore_gps(now_); }
  [[nodiscard]] BatteryPack& battery() { return battery_; }

  [[nodiscard]] Body const& body() const { return body_; }
  [[nodiscard]] Kind const& kind() const { return kind_; }
  [[nodiscard]] Airframe const& airframe() const { return airframe_; }
  [[nodiscard]] Navigation const& navigation() const { return navigation_; }
  [[nodiscard]] BatteryPack const& battery() const { return battery_; }
  [[nodiscard]] MissionRunner const& mission() const { return mission_; }
  [[nodiscard]] FlightMode const& mode() const { return *mode_; }
  [[nodiscard]] Goal const& goal() const { return goal_; }
  [[nodiscard]] Pace const& pace() const { return pace_; }
  [[nodiscard]] bool armed() const { return armed_; }
  [[nodiscard]] FenceWatch const& fence() const { return fence_; }
  [[nodiscard]] bool fence_enabled() const { return fence_.enabled(safety_.fence); }
  [[nodiscard]] bool fence_present() const { return fence_.present(safety_.fence); }
  /// Whether a breach would be acted on.
  [[nodiscard]] bool fence_acts() const { return fence_enabled() && !safety_.fence.action.empty(); }
  [[nodiscard]] bool radio_lost() const { return radio_.active(); }
  [[nodiscard]] RadioSignal radio_signal() const { return safety_.signal; }
  /// Home; nothing before the origin is set.
  [[nodiscard]] std::optional<geo::Ned> home() const;
  [[nodiscard]] base::Duration now() const { return now_; }
  [[nodiscard]] std::uint8_t base_mode() const;
  [[nodiscard]] mavlink::MavState system_status() const;
  [[nodiscard]] bool prearm_ok() const;
  [[nodiscard]] mavlink::MavLandedState landed_state() const;
  [[nodiscard]] Outbox& outbox() { return outbox_; }
  [[nodiscard]] BootTimeline const& boot() const { return start_up_.timeline(); }

 private:
  using Logic = std::variant<std::monostate, Guided, Landing, ReturnHome, Retrace, Circle, HoldAt, TakeOff>;

  [[nodiscard]] FlightContext context(double utc_day_s) const;
  void read_parameters();
  /// `set_mode`, by the vehicle's own decision.
  mavlink::MavResult change_mode(std::uint32_t number);
  bool may_enter(FlightMode const& mode);
  bool may_enter_auto();
  [[nodiscard]] bool is_copter_like() const;
  void enter(FlightMode const& mode);
  [[nodiscard]] Logic logic_for(FlightMode const& mode) const;
  Guided& guided();
  void do_disarm(std::string_view words);
  [[nodiscard]] std::optional<std::string_view> px4_objection(FlightMode const& mode) const;
  [[nodiscard]] bool failsafe_active() const;
  void leave_take_off();
  void watch_setpoints();

  Goal fly(FlightContext const& flight);
  Goal fly_mission(FlightContext const& flight);
  [[nodiscard]] bool has_nothing_to_fly() const;
  void end_mission(FlightContext const& flight);
  Goal hold_on_the_ground(Goal goal, FlightContext const& flight);
  template <class Way>
  Goal go_home(Way& way, FlightContext const& flight);
  [[nodiscard]] Goal kept_in_the_fence(Goal goal) const;
  void follow_trail();

  // What goes wrong and what is done about it, in autopilot_failsafes.cpp.
  void watch_health();
  void watch_ground_station();
  void watch_radio();
  void watch_plane_radio(SilenceWatch::Event event);
  void watch_estimate();
  void watch_battery();
  void watch_fence();
  void tell_of_the_fence(FenceWatch::News const& news);
  void answer_breach(unsigned limits);
  void watch_gps();
  /// Changes the mode by itself: tries one after the other.
  void act(Reaction const& reaction);
  /// What a lost link changes: it is told, and the vehicle reacts unless it may carry on.
  void lose_link(std::string_view type, LossSettings const& loss);
  void lose_link_on_copter(std::string_view type, LossSettings const& loss);
  void lose_link_on_rover(std::string_view type, LossSettings const& loss);
  void lose_link_on_plane(std::string_view type, LossSettings const& loss);
  void regain_link(std::string_view type);
  [[nodiscard]] bool is_disarmed_by_failsafes() const;
  [[nodiscard]] std::string_view reason_to_carry_on(LossSettings const& loss, bool is_radio) const;
  /// Why it must not arm that lies outside of the modes and its estimate; empty: nothing.
  [[nodiscard]] std::string objection() const;
  void disarm_when_idle();
  void notice_touch_down();
  void notice_landing();
  void repeat_prearm_fault();

  Kind kind_;  ///< a boat's family is `rover`, as the airframe's
  Words const& words_;
  Airframe airframe_;
  Site const& site_;
  ParameterTable const& parameters_;
  Plans const& plans_;
  MissionRunner mission_;
  StartUp start_up_;
  BatteryPack battery_;
  SilenceWatch ground_station_;
  SilenceWatch radio_;
  BatteryWatch battery_watch_;
  FenceWatch fence_;
  Navigation navigation_;
  Body body_;
  FlightMode const* mode_;
  Logic logic_;
  Goal goal_ = StandStill{};
  Pace pace_;
  Tuning tuning_;
  Safety safety_;
  unsigned parameters_read_ = 0;
  geo::Ned home_;
  bool home_locked_ = false;
  bool armed_ = false;
  bool landed_ = true;             ///< takes itself for landed: one that hits the ground on its way elsewhere does not
  bool take_off_allowed_ = false;  ///< stands for the raised throttle stick in AUTO
  bool has_flown_ = false;         ///< since it was armed
  bool estimate_failed_ = false;
  bool gps_is_cut_off_ = false;
  bool fence_took_over_ = false;                      ///< the mode is what a breach made of it
  bool link_failsafe_ = false;                        ///< a lost link has been acted on
  std::optional<base::Duration> long_radio_loss_at_;  ///< an aeroplane's second reaction is due
  Trail trail_;
  std::optional<double> speed_override_;
  std::optional<double> take_off_height_m_;  ///< above home, asked for by command
  std::optional<base::Duration> setpoint_heard_;
  std::optional<base::Duration> lift_at_;
  std::optional<base::Duration> idle_since_;
  base::Duration next_prearm_text_{};
  std::string arming_fault_;
  base::Duration now_{};
  Outbox outbox_;
};

}  // namespace lapwing::sim
