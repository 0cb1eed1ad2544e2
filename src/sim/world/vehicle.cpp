#include "sim/world/vehicle.hpp"

#include <fmt/core.h>

namespace lapwing::sim {

using namespace std::chrono_literals;

namespace {

/// The period of flight control and motion: fixed, so that a seeded run is the same however the loop is paced.
constexpr base::Duration step_period = 50ms;
/// How many steps a vehicle that is late makes before others have their turn.
constexpr int most_steps_at_once = 4;
/// From power-off to power-on, as measured on ArduPilot's reboot (0.25 to 1.2 s).
constexpr base::Duration reboot_time = 500ms;

}  // namespace

Vehicle::Vehicle(base::Loop& loop, Options options, Site const& site, OpenLink open_link, base::Logger log)
    : loop_(loop),
      options_(options),
      site_(site.raised(options.altitude_error_m)),
      open_link_(std::move(open_link)),
      log_(std::move(log)),
      memory_{ParameterTable(options.kind, options.system_id), {}, options.signing_key},
      gusts_(options.wind_m_s, options.gust_m_s, options.seed),
      battery_(options.battery_capacity_mah, options.battery_remaining),
      scope_(loop) {
  body_.position_m = options.start;
  body_.position_m.down = 0.0;
  body_.attitude.yaw_rad = geo::wrap_pi(options.heading_rad);
  auto const* const capacity = options.kind.is_px4() ? "BAT1_CAPACITY" : "BATT_CAPACITY";
  memory_.parameters.set(capacity, static_cast<float>(options.battery_capacity_mah));
}

base::Result<> Vehicle::power_on() {
  auto on = switch_on();
  if (on) scope_.spawn(live());
  return on;
}

base::Result<> Vehicle::switch_on() {
  auto link = open_link_();
  if (!link) return std::unexpected(link.error());
  FlightController::Setup const setup{
      .system_id = options_.system_id,
      .autopilot = {.kind = options_.kind,
                    .start = {body_.position_m.north, body_.position_m.east, 0.0},
                    .heading_rad = body_.attitude.yaw_rad,
                    .boot = options_.boot,
                    .battery = battery_},
      .powered_on = loop_.now(),
  };
  controller_ = std::make_unique<FlightController>(loop_, setup, site_, memory_, std::move(*link), log_);
  connect_payload();
  controller_->autopilot().set_arming_fault(arming_fault_);
  controller_->fall_silent(silent_until_);
  next_step_ = loop_.now() + step_period;
  reboot_wanted_ = false;
  return {};
}

/// What speaks for itself is not heard when its link cannot be opened; the vehicle flies without.
void Vehicle::connect_payload() {
  auto const open = [this](std::string_view what) -> std::unique_ptr<link::ByteLink> {
    auto link = open_link_();
    if (link) return std::move(*link);
    log_.warn(fmt::format("cannot open the link of its {}: {}", what, link.error().message));
    return nullptr;
  };
  if (controller_->has_camera_node())
    if (auto link = open("camera")) controller_->connect_camera(std::move(link));
  if (controller_->has_gimbal_node())
    if (auto link = open("gimbal")) controller_->connect_gimbal(std::move(link));
}

void Vehicle::switch_off() {
  controller_.reset();
  log_.info("rebooting");
}

base::Task<void> Vehicle::live() {
  for (;;) {
    while (!reboot_wanted_ && !controller_->reboot_requested()) {
      auto const wake = std::min(next_step_, controller_->next_due_between(step_period));
      co_await loop_.sleep_until(wake);
      keep_up();
    }
    switch_off();
    do {
      co_await loop_.sleep(reboot_time);
      if (auto const on = switch_on(); !on) log_.warn(fmt::format("cannot open its link: {}", on.error().message));
    } while (!controller_);
  }
}

/// Makes the steps whose time has come: more than one after the loop was late, but not so many that a machine which
/// cannot keep up is busy with nothing else.
void Vehicle::keep_up() {
  for (int steps = 0; steps < most_steps_at_once && next_step_ <= loop_.now(); ++steps) {
    controller_->step(step_period, gusts_.step(base::to_seconds(step_period)));
    next_step_ += step_period;
    body_ = controller_->autopilot().body();
    battery_ = controller_->autopilot().battery();
  }
  swap_battery_when_due();
  controller_->send_due();
}

void Vehicle::swap_battery_when_due() {
  if (!options_.battery_swap_after) return;
  constexpr double full = 0.99;
  if (controller_->autopilot().armed() || battery_.remaining() >= full) busy_until_ = loop_.now();
  if (loop_.now() - busy_until_ < *options_.battery_swap_after) return;
  log_.info(fmt::format("gets a full battery; {:.0f} % were left", 100.0 * battery_.remaining()));
  set_battery(1.0);
}

void Vehicle::refuse_arming(std::string reason) {
  arming_fault_ = std::move(reason);
  if (controller_) controller_->autopilot().set_arming_fault(arming_fault_);
}

void Vehicle::refuse_item(std::optional<int> seq, mavlink::MavMissionResult result) {
  if (controller_) controller_->missions().refuse_item(seq, result);
}

void Vehicle::reboot() {
  reboot_wanted_ = true;
}

void Vehicle::fall_silent(base::Duration duration) {
  silent_until_ = loop_.now() + duration;
  if (controller_) controller_->fall_silent(silent_until_);
}

void Vehicle::fall_silent_for_good() {
  silent_until_ = base::TimePoint::max();
  if (controller_) controller_->fall_silent(silent_until_);
}

void Vehicle::set_battery(double remaining) {
  battery_.set_remaining(remaining);
  if (controller_) controller_->autopilot().battery().set_remaining(remaining);
}

bool Vehicle::pilot_sets_mode(std::uint32_t number) {
  return controller_ && controller_->pilot_sets_mode(number);
}

void Vehicle::lose_gps() {
  if (controller_) controller_->autopilot().lose_gps();
}

void Vehicle::restore_gps() {
  if (controller_) controller_->autopilot().restore_gps();
}

}  // namespace lapwing::sim
