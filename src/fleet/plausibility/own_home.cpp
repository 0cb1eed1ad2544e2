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
  std::function<bool()> is_known = [&craft] { return craft.state.motion.home.known(); };
  (void)co_await craft.changed.wait_for(std::move(is_known), answer_time);
}

}  // namespace

/// Writes what came of asking, for the function of this file.
class HomeQuestion {
 public:
  static void note_untold(MavlinkVehicle& craft, base::TimePoint now) {
    craft.asked.write(As<HomeQuestion>()).home_untold = now;
  }
};

Task<> learn_home(MavlinkVehicle& craft, base::Duration patience) {
  auto& loop = craft.connection.loop();
  bool const did_not_tell = craft.asked->home_untold && loop.now() - *craft.asked->home_untold < left_alone_for;
  // One that does not know where it is has no home yet.
  if (craft.state.motion.home.known() || did_not_tell || !knows_its_place(craft)) co_return;
  // Another question may be before it, for longer than anybody waits.
  base::Scope scope(loop);
  scope.spawn(request_home(craft));
  (void)co_await scope.join_until(loop.now() + patience);
  if (!craft.state.motion.home.known()) HomeQuestion::note_untold(craft, loop.now());
}

}  // namespace lapwing::fleet
