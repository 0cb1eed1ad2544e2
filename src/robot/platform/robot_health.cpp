#include "robot/platform/robot_health.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::robot {

namespace {

constexpr base::Duration report_period = std::chrono::milliseconds(100);

}  // namespace

RobotHealth::RobotHealth(Surroundings surroundings)
    : around_(std::move(surroundings)),
      guard_(
          around_.loop, around_.body, watch_,
          {.stopped =
               [this](Clearance const& why) {
                 around_.log.warn(fmt::format("{} stops: {}; {}", around_.name, why.reason, why.what_to_do));
               },
           .free = [this] { around_.log.info(fmt::format("{} may move: all its modules are well", around_.name)); }}),
      scope_(around_.loop) {
  scope_.spawn(beat());
}

base::Task<> RobotHealth::beat() {
  for (;;) {
    co_await around_.loop.sleep(report_period);
    report_carrier();
    for (auto const module : {Module::mapping, Module::planner})
      if (auto const& mine = own(module); !mine.is_at_work) report(module, mine.state, mine.code);
    report_if_it_speaks(Module::communication, around_.communication);
    report_if_it_speaks(Module::points_of_interest, around_.points_of_interest);
  }
}

void RobotHealth::report_if_it_speaks(Module module, std::function<std::optional<std::uint16_t>()> const& code) {
  if (!code) return;
  if (auto const said = code()) report(module, ModuleState::ready, *said);
}

void RobotHealth::report_carrier() {
  if (auto const code = around_.body.take_carrier_code())
    watch_.report(Module::carrier, {.state = ModuleState::ready, .error_code = *code}, around_.loop.now());
}

void RobotHealth::sensed(std::uint16_t code) {
  report_carrier();
  report(Module::sensors, ModuleState::ready, code);
}

void RobotHealth::say(Module module, ModuleState state, std::uint16_t code) {
  own(module) = {.is_at_work = false, .state = state, .code = code};
  report(module, state, code);
}

void RobotHealth::report(Module module, ModuleState state, std::uint16_t code) {
  auto const use = meter_.use();
  watch_.report(module,
                {.state = state, .error_code = code, .memory_bytes = use.memory_bytes, .cpu_share = use.cpu_share},
                around_.loop.now());
}

}  // namespace lapwing::robot
