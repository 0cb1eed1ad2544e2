#include "fleet/plausibility/own_home.hpp"

#include <functional>

#include "base/async/scope.hpp"
#include "fleet/plausibility/situation.hpp"
#include "mavlink/exchange/command.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::Task;

namespace {

constexpr base::Duration left_alone_for = 1min;
constexpr base::Duration answer_time = 1s;  // for the message itself, behind its acknowledgement

Task<> request_home(MavlinkVehicle& craft) {
  constexpr mavlink::CommandOptions quickly{.tries = 3, .ack_timeout = 500ms};
  auto const command = mavlink::request_message(mavlink::MessageId::home_position);
  auto const asked = co_await mavlink::run_command(craft.connection, craft.address, command, quickly);
  if (!asked) co_return;
  std::function<bool()> is_known = [&craft] { return craft.state.home.known(); };
  (void)co_await craft.changed.wait_for(std::move(is_known), answer_time);
}

}  // namespace

Task<> learn_home(MavlinkVehicle& craft, base::Duration patience) {
  auto& loop = craft.connection.loop();
  bool const did_not_tell = craft.home_untold && loop.now() - *craft.home_untold < left_alone_for;
  // One that does not know where it is has no home yet.
  bool const knows_its_place = situation_of(craft, {}).position.has_value();
  if (craft.state.home.known() || did_not_tell || !knows_its_place) co_return;
  // Another question may be before it, for longer than anybody waits.
  base::Scope scope(loop);
  scope.spawn(request_home(craft));
  (void)co_await scope.join_until(loop.now() + patience);
  if (!craft.state.home.known()) craft.home_untold = loop.now();
}

}  // namespace lapwing::fleet
