#include "sim/mavlink/payload_node.hpp"

namespace lapwing::sim {

using namespace std::chrono_literals;
using namespace mavlink;

namespace {

constexpr base::Duration heartbeat_period = 1s;

Connection::Options connection_options(PayloadNode::Setup const& setup) {
  return {.self = setup.self, .heartbeat = {}, .timesync_period = {}, .keys = ring_of(setup.signing_key)};
}

}  // namespace

CommandInt as_command_int(CommandLong const& command) {
  auto const& p = command.params;
  CommandInt same{.target = command.target,
                  .frame = MavFrame::global_relative_alt,
                  .command = command.command,
                  .params = {p[0], p[1], p[2], p[3]},
                  .place = {}};
  auto const place = geo::Wgs84::from_degrees(p[4], p[5]);
  same.place = {.lat_rad = place.lat_rad, .lon_rad = place.lon_rad, .x = p[4], .y = p[5], .z_m = p[6]};
  return same;
}

PayloadNode::PayloadNode(base::Loop& loop, Setup const& setup, Ports ports, std::unique_ptr<link::ByteLink> link,
                         base::Logger log)
    : type_(setup.type),
      ports_(std::move(ports)),
      connection_(loop, connection_options(setup), std::move(log)),
      subscription_(connection_.subscribe([this](Received const& received) { receive(received); })) {
  connection_.add_link(std::move(link));
}

void PayloadNode::step(base::Duration now) {
  if (now < next_heartbeat_) return;
  next_heartbeat_ = now + heartbeat_period;
  tell(Heartbeat{.type = type_,
                 .autopilot = MavAutopilot::invalid,
                 .base_mode = 0,
                 .custom_mode = 0,
                 .system_status = MavState::active});
}

void PayloadNode::tell(Message const& message) {
  if (!ports_.silent()) connection_.send_to_all(message);
}

void PayloadNode::receive(Received const& received) {
  auto const self = connection_.self();
  auto const target = target_of(received.message);
  bool const is_ours = target && (target->system == self.system || target->system == 0) &&
                       (target->component == self.component || target->component == 0);
  if (!is_ours || ports_.silent()) return;
  if (auto const* command = std::get_if<CommandInt>(&received.message)) answer(*command, received.source);
  if (auto const* command = std::get_if<CommandLong>(&received.message))
    answer(as_command_int(*command), received.source);
}

/// To one that is for every component it only answers when it can do it.
void PayloadNode::answer(CommandInt const& command, Address from) {
  auto const result = perform(command, from);
  if (!result && command.target.component == 0) return;
  (void)connection_.send(from, CommandAck{.target = from,
                                          .command = command.command,
                                          .result = result.value_or(MavResult::unsupported),
                                          .progress = {}});
}

std::optional<MavResult> PayloadNode::perform(CommandInt const& command, Address from) {
  if (command.command != MavCmd::request_message) return ports_.perform(command);
  auto const id = static_cast<MessageId>(static_cast<std::uint32_t>(command.params[0]));
  auto const message = ports_.report(id, command.params[1]);
  if (message) (void)connection_.send(from, *message);
  if (!message && command.target.component == 0) return std::nullopt;
  return message ? MavResult::accepted : MavResult::denied;
}

}  // namespace lapwing::sim
