// Asking vehicles for message rates, and giving them back.
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "fleet/network/network.hpp"
#include "mavlink/exchange/message_interval.hpp"

namespace lapwing::fleet {

using namespace std::chrono_literals;
using base::TimePoint;

namespace {

constexpr base::Duration time_to_give_back = 3s;
constexpr base::Duration ground_is_there = 10s;  // after its last heartbeat
constexpr base::Duration radio_is_there = 10s;
constexpr int most_refusals = 3;   // one may be about a message that it lacks; three say that it cannot tell
constexpr double as_often = 1.05;  // autopilots round intervals
mavlink::CommandOptions const asking{.tries = 3, .ack_timeout = 1s};
mavlink::CommandOptions const giving{.tries = 2, .ack_timeout = 500ms};

bool is_about(base::Duration a, base::Duration b) {
  return a < b * as_often && b < a * as_often;
}

}  // namespace

void Network::spare_slow_link(MavlinkVehicle& craft) {
  auto const counters = connection_.counters(craft.address);
  std::optional<double> buffer_free;
  auto const& radio = craft.state.links.radio;
  if (radio.value && loop().now() - radio.heard < radio_is_there) buffer_free = radio.value->transmit_buffer_free;
  auto& asked = asked_of(craft);
  auto const before = asked.telemetry_rate.factor();
  auto const factor = asked.telemetry_rate.update(counters.received, counters.lost, buffer_free, loop().now());
  if (factor == before) return;
  asked.rates->set_telemetry_rate(factor, loop().now());
  log_.info(factor > before ? fmt::format("{}: the link is poor; less telemetry is asked for", craft.state.name)
                            : fmt::format("{}: the link is better; more telemetry is asked for", craft.state.name));
}

/// One after the other: acknowledgements name the command only, not the message that was asked for.
base::Task<> Network::ask_for_messages(MavlinkVehicle& craft, std::vector<WantedMessage> wanted) {
  asked_of(craft).is_asking = true;
  for (auto const& message : wanted) {
    auto const copy = message;
    if (!may_be_asked(craft) || is_giving_back_) break;
    if (!co_await ask_for_message(craft, copy)) break;
  }
  asked_of(craft).is_asking = false;
}

/// What it was before is asked for first. False when the vehicle restarted meanwhile.
base::Task<bool> Network::ask_for_message(MavlinkVehicle& craft, WantedMessage message) {
  int const boots = craft.heard->boots;
  std::optional<std::optional<base::Duration>> before;
  if (craft.asked->intervals_untold < most_refusals && !craft.asked->rates->is_ours(message.id)) {
    auto const told = co_await mavlink::message_interval(connection_, craft.address, message.id, asking);
    if (craft.heard->boots != boots) co_return false;
    if (told) before = *told;
    bool const refused = !told && told.error().kind == base::ErrorKind::refused;
    asked_of(craft).intervals_untold = refused ? craft.asked->intervals_untold + 1 : 0;
    if (told && *told && **told <= message.interval * as_often) {
      asked_of(craft).rates->leave_alone(message.id, loop().now());
      co_return true;
    }
  }
  auto const asked =
      co_await mavlink::set_message_interval(connection_, craft.address, message.id, message.interval, asking);
  if (craft.heard->boots != boots) co_return false;
  if (asked) asked_of(craft).rates->changed(message, before);
  if (asked || asked.error().kind != base::ErrorKind::refused) co_return true;
  asked_of(craft).rates->denied(message.id, loop().now());
  log_.debug(fmt::format("{} will not send message {}: {}", craft.state.name, std::to_underlying(message.id),
                         asked.error().message));
  co_return true;
}

bool Network::others_may_depend_on(MavlinkVehicle const& craft) const {
  auto const found = other_ground_heard_.find(craft.heard->from);
  return found != other_ground_heard_.end() && loop().now() - found->second < ground_is_there;
}

base::Task<> Network::give_back_rates() {
  is_giving_back_ = true;
  auto const deadline = loop().now() + time_to_give_back;
  base::Scope all(loop());
  for (auto& [system_id, craft] : crafts_) {
    if (craft->asked->rates && may_be_asked(*craft) && !others_may_depend_on(*craft))
      all.spawn(give_back_rates_of(*craft, deadline));
  }
  (void)co_await all.join_until(deadline);
}

base::Task<> Network::give_back_rates_of(MavlinkVehicle& craft, TimePoint deadline) {
  auto const changes = craft.asked->rates->changes();
  for (auto const& change : changes) {
    if (loop().now() >= deadline) co_return;
    auto const id = change.id;
    auto const before = change.before;
    auto const now_set = co_await mavlink::message_interval(connection_, craft.address, id, giving);
    if (!now_set) co_return;  // cannot be reached any more
    if (!*now_set || !is_about(**now_set, change.set)) continue;
    (void)co_await mavlink::restore_message_interval(connection_, craft.address, id, before, giving);
  }
}

}  // namespace lapwing::fleet
