#include "robot/watch/carrier_guard.hpp"

#include <utility>

#include <fmt/format.h>

namespace lapwing::robot {

namespace {

using namespace std::chrono_literals;
base::Duration constexpr look_period = 20ms;

}  // namespace

CarrierGuard::CarrierGuard(base::Loop& loop, CarrierClient& client, ModuleWatch& watch, Listener listener)
    : loop_(loop), client_(client), watch_(watch), listener_(std::move(listener)), scope_(loop) {
  scope_.spawn(look());
}

base::Task<> CarrierGuard::look() {
  for (;;) {
    auto const clearance = watch_.clearance(loop_.now());
    if (was_free_ && !clearance.may_move) {
      // Refused where it is killed or away: then it stands, or comes to stand by itself.
      (void)client_.begin(firmware::Stop{});
      if (listener_.stopped) listener_.stopped(clearance);
    }
    if (!was_free_ && clearance.may_move && listener_.free) listener_.free();
    was_free_ = clearance.may_move;
    co_await loop_.sleep(look_period);
  }
}

base::Result<> CarrierGuard::may_move() const {
  auto const clearance = watch_.clearance(loop_.now());
  if (clearance.may_move) return {};
  return base::fail(base::ErrorKind::refused, fmt::format("the robot stays where it is: {}", clearance.reason),
                    clearance.what_to_do);
}

base::Task<base::Result<>> CarrierGuard::carry_out(Order order, base::Duration timeout) {
  if (auto const may = may_move(); !may) co_return std::unexpected(may.error());
  auto carried = client_.carry_out(order, timeout);
  auto result = co_await carried;
  // The stop that replaced it has a reason that is worth more than "another command".
  if (!result && result.error().kind == base::ErrorKind::cancelled)
    if (auto const may = may_move(); !may) co_return std::unexpected(may.error());
  co_return result;
}

base::Result<> CarrierGuard::begin(Order order) {
  if (auto const may = may_move(); !may) return may;
  return client_.begin(order);
}

void CarrierGuard::kill() {
  client_.kill();
  watch_.kill();
}

base::Result<> CarrierGuard::restart() {
  if (auto const restarted = watch_.restart(loop_.now()); !restarted) return restarted;
  client_.release();
  return {};
}

}  // namespace lapwing::robot
