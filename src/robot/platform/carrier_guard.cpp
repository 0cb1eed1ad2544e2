#include "robot/platform/carrier_guard.hpp"

#include <utility>

namespace lapwing::robot {

namespace {

constexpr base::Duration look_period = std::chrono::milliseconds(20);

}  // namespace

CarrierGuard::CarrierGuard(base::Loop& loop, Body& body, ModuleWatch& watch, Listener listener)
    : loop_(loop), body_(body), watch_(watch), listener_(std::move(listener)), scope_(loop) {
  scope_.spawn(look());
}

base::Task<> CarrierGuard::look() {
  for (;;) {
    auto const clearance = watch_.clearance(loop_.now());
    if (was_free_ && !clearance.may_move) {
      body_.drive({});
      if (listener_.stopped) listener_.stopped(clearance);
    }
    if (!was_free_ && clearance.may_move && listener_.free) listener_.free();
    was_free_ = clearance.may_move;
    co_await loop_.sleep(look_period);
  }
}

Motion CarrierGuard::drive(Motion motion) {
  if (!watch_.clearance(loop_.now()).may_move) motion = {};
  body_.drive(motion);
  return motion;
}

void CarrierGuard::kill() {
  body_.kill();
  watch_.kill();
}

base::Result<> CarrierGuard::restart() {
  if (auto const restarted = watch_.restart(loop_.now()); !restarted) return restarted;
  body_.release();
  return {};
}

}  // namespace lapwing::robot
