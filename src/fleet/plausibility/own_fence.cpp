#include "fleet/plausibility/own_fence.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "base/async/scope.hpp"
#include "mavlink/exchange/mission_transfer.hpp"
#include "plan/files/vehicle_plan.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::ErrorKind;
using base::fail;
using base::Result;
using base::Task;
using base::TimePoint;

namespace {

constexpr base::Duration values_keep = 1min;
constexpr base::Duration areas_keep = 10min;
constexpr base::Duration ask_again = 400ms;
/// ArduPilot is silent about parameters that it does not have: what still has not come after that many rounds, when
/// everything else has, it does not have.
constexpr int rounds_for_optional = 2;

}  // namespace

/// Ends a reading also when who wanted it is stopped in the middle.
class FenceReading {
 public:
  static FenceMemory& memory_of(MavlinkVehicle& craft) { return craft.heard.write(As<FenceReading>()).fence; }

  explicit FenceReading(MavlinkVehicle& craft) : craft_(craft) { memory_of(craft_).is_being_read = true; }
  FenceReading(FenceReading const&) = delete;
  FenceReading& operator=(FenceReading const&) = delete;
  ~FenceReading() {
    memory_of(craft_).is_being_read = false;
    craft_.changed.notify_all();
  }

 private:
  MavlinkVehicle& craft_;
};

namespace {

std::vector<std::string_view> missing(FenceMemory const& memory, std::span<std::string_view const> names,
                                      TimePoint since) {
  std::vector<std::string_view> found;
  for (auto const name : names)
    if (!memory.has_heard(name, since) && !memory.is_untold(name)) found.push_back(name);
  return found;
}

/// All at once: a link's round trip is waited for once, not ten times.
Result<> ask_for(MavlinkVehicle& craft, std::span<std::string_view const> names, TimePoint since) {
  for (auto const name : missing(craft.heard->fence, names, since)) {
    auto sent = craft.connection.send(craft.address, mavlink::ParamRequestRead{.name = std::string(name)});
    if (!sent) return sent;
  }
  return {};
}

Task<Result<>> read_values(MavlinkVehicle& craft, TimePoint deadline) {
  auto& loop = craft.connection.loop();
  auto const names = fence_names(craft.state.autopilot, craft.state.family);
  auto const begun = loop.now();
  for (int round = 0;; ++round) {
    auto const next = std::min(begun + (round + 1) * ask_again, deadline);
    for (auto const& some : {names.needed, names.optional})
      if (auto sent = ask_for(craft, some, begun); !sent) co_return sent;
    while (loop.now() < next) {
      bool const has_all = missing(craft.heard->fence, names.needed, begun).empty() &&
                           missing(craft.heard->fence, names.optional, begun).empty();
      if (has_all || craft.heard->fence.is_off(craft.state.autopilot, begun)) co_return Result<>{};
      co_await craft.changed.wait_until(next);
    }
    auto const needed = missing(craft.heard->fence, names.needed, begun);
    if (needed.empty() && round + 1 >= rounds_for_optional) break;
    if (loop.now() >= deadline)
      co_return fail(ErrorKind::timed_out, needed.empty() ? "its parameters" : std::string(needed.front()));
  }
  for (auto const name : missing(craft.heard->fence, names.optional, begun))
    FenceReading::memory_of(craft).set_untold(name);
  co_return Result<>{};
}

using Held = std::optional<Result<mavlink::HeldPlan>>;

Task<> fetch_areas(MavlinkVehicle& craft, Held& into) {
  constexpr mavlink::TransferOptions quickly{.silence_limit = 2s, .restarts = 0};
  into = co_await mavlink::download_mission(craft.connection, craft.address, mavlink::MissionType::fence, quickly);
}

Task<Result<>> read_areas(MavlinkVehicle& craft, TimePoint deadline) {
  auto& loop = craft.connection.loop();
  Held held;
  base::Scope scope(loop);
  scope.spawn(fetch_areas(craft, held));
  (void)co_await scope.join_until(deadline);
  if (!held || !*held) co_return fail(ErrorKind::timed_out, "its stored areas");
  auto areas = plan::fence_from((*held)->items);
  if (!areas) co_return fail(ErrorKind::timed_out, "stored areas that make sense: " + areas.error().message);
  FenceReading::memory_of(craft).set_areas(*std::move(areas), loop.now());
  co_return Result<>{};
}

Task<Result<>> read_all(MavlinkVehicle& craft, base::Duration patience) {
  auto const now = craft.connection.loop().now();
  auto& memory = FenceReading::memory_of(craft);
  bool const is_fresh = memory.read && now - *memory.read < values_keep;
  if (is_fresh && memory.failure && memory.failure->patience >= patience)
    co_return fail(ErrorKind::timed_out, memory.failure->what);
  Result<> done;
  if (!is_fresh || memory.failure) done = co_await read_values(craft, now + patience);
  bool const lacks_areas = memory.wants_areas(craft.state.autopilot) && !memory.has_areas(now - areas_keep);
  if (done && lacks_areas) done = co_await read_areas(craft, now + patience);
  if (!is_fresh) memory.read = now;
  memory.failure.reset();
  if (!done) memory.failure = {.what = done.error().message, .patience = patience};
  co_return done;
}

}  // namespace

Task<Result<>> learn_fence(MavlinkVehicle& craft, base::Duration patience) {
  if (fence_names(craft.state.autopilot, craft.state.family).needed.empty()) co_return Result<>{};
  auto const deadline = craft.connection.loop().now() + patience;
  while (craft.heard->fence.is_being_read) {
    if (craft.connection.loop().now() >= deadline) co_return fail(ErrorKind::timed_out, "its parameters");
    co_await craft.changed.wait_until(deadline);
  }
  FenceReading const reading(craft);
  co_return co_await read_all(craft, patience);
}

Task<> learn_fence(MavlinkVehicle& craft, base::Duration patience, base::Logger log) {
  auto const learned = co_await learn_fence(craft, patience);
  if (!learned)
    log.warn(fmt::format("{} has not told its own fence ({}): nobody knows whether this leaves it", craft.state.name,
                         learned.error().message));
}

}  // namespace lapwing::fleet
