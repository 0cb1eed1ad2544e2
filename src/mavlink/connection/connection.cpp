#include "mavlink/connection/connection.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "mavlink/connection/internal/echoes.hpp"
#include "mavlink/connection/internal/listeners.hpp"
#include "mavlink/path/routes.hpp"
#include "mavlink/wire/impossible_values.hpp"

namespace lapwing::mavlink {

using base::ErrorKind;
using base::fail;

namespace {

base::Duration constexpr watch_period = std::chrono::milliseconds(500);

}  // namespace

Heartbeat Connection::ground_station_heartbeat() {
  return {.type = MavType::gcs, .autopilot = MavAutopilot::invalid, .system_status = MavState::active};
}

Connection::Connection(base::Loop& loop, Options options, base::Logger log)
    : loop_(loop),
      options_(std::move(options)),
      log_(std::move(log)),
      routes_(std::make_unique<internal::Routes>([this](PeerRef peer) {
        if (guard_) guard_->forget({peer.link, peer.peer.key});
      })),
      echoes_(std::make_unique<internal::Echoes>()),
      impossible_(std::make_unique<internal::ImpossibleValues>()),
      listeners_(std::make_unique<internal::Listeners>()),
      commands_(loop),
      scope_(loop) {
  set_keys(options_.keys);
  if (options_.heartbeat) scope_.spawn(beat());
  scope_.spawn(watch());
}

Connection::~Connection() = default;

std::size_t Connection::add_link(std::unique_ptr<link::ByteLink> link) {
  auto const number = links_.size();
  routes_->add_link(link->bytes_per_s());
  links_.push_back(std::move(link));
  if (guard_) guard_->name_link(number, links_.back()->name());
  links_.back()->start([this, number](link::Peer peer, link::Bytes bytes) { receive({number, peer}, bytes); });
  return number;
}

void Connection::set_keys(std::optional<KeyRing> keys) {
  if (!keys) return guard_.reset();
  if (guard_) return guard_->set_ring(*std::move(keys));
  guard_.emplace(*std::move(keys), options_.signed_until);
  for (std::size_t number = 0; number < links_.size(); ++number) guard_->name_link(number, links_[number]->name());
}

base::Task<void> Connection::beat() {
  for (;;) {
    co_await loop_.turn();  // links may still be added in this turn
    send_to_all(options_.heartbeat());
    co_await loop_.sleep(options_.heartbeat_period);
  }
}

/// Measures links and tells one vehicle on two of them from two vehicles.
base::Task<void> Connection::watch() {
  for (unsigned turn = 0;; ++turn) {
    co_await loop_.sleep(watch_period);
    for (auto const id : routes_->examine(loop_.now()))
      if (auto const both = conflict(id))
        log_.warn(fmt::format(
            "two vehicles use system id {}: {} and {}; give one of them another id, until then neither is commanded",
            id, both->first, both->second));
    if (options_.timesync_period > base::Duration{}) ask_who_they_are(turn % 10 == 0);
  }
}

/// Those of a known conflict seldom: that lasts until somebody mends it.
void Connection::ask_who_they_are(bool with_conflicts) {
  auto const now = loop_.now();
  auto const suspects = routes_->suspects(with_conflicts, now);
  for (auto const& [peer, asked] : routes_->ask_clocks(suspects, options_.timesync_period, now)) {
    auto frame = encode(Timesync{.tc1 = {}, .ts1 = asked.time_since_epoch()}, options_.self, 0);
    send_frame(peer, frame);
  }
  for (auto const& [system_id, peer, knows_hardware] : suspects) {
    for (auto const wanted : {MessageId::autopilot_version, MessageId::global_position_int}) {
      if (knows_hardware && wanted == MessageId::autopilot_version) continue;
      CommandLong const request{.target = {system_id, autopilot_component},
                                .command = MavCmd::request_message,
                                .params = {static_cast<float>(wanted)}};
      auto frame = encode(request, options_.self, 0);
      send_frame(peer, frame);
    }
  }
}

// ---- receiving

void Connection::receive(PeerRef from, link::Bytes bytes) {
  auto& peer = routes_->hear(from, loop_.now());
  peer.parser.feed(bytes, [this, from, &peer](Frame const& frame) { accept(from, peer, frame); });
}

void Connection::accept(PeerRef from, internal::PeerState& peer, Frame const& frame) {
  if (frame.source == options_.self && echoes_->has(frame.seq, frame.checksum)) return;
  if (guard_ && !may_be_heard(from, frame)) return;
  auto const now = loop_.now();
  if (frame.version == 2) peer.spoke_v2 = true;
  if (!std::exchange(peer.spoke, true) && options_.heartbeat) {
    auto greeting = encode(options_.heartbeat(), options_.self, 0);
    send_frame(from, greeting);
  }
  auto const taken = routes_->take(from, peer, frame, now);
  if (!taken.is_fresh) return;
  auto const id = static_cast<MessageId>(frame.message_id);
  if (id == MessageId::timesync || (taken.is_one_of_several && tells_identity(id))) look_into(from, frame);
  if (!taken.is_news) return;
  if (frame_hook_ && !tells_a_key(frame)) frame_hook_(Direction::received, frame, now);
  if (forward_hook_) forward_hook_(from, frame);
  if (listeners_->is_empty()) return;
  if (auto const message = understand(from, frame)) listeners_->tell({*message, frame.source, from, now});
}

std::optional<Message> Connection::understand(PeerRef from, Frame const& frame) {
  left_out_.clear();
  auto message = decode(frame, left_out_);
  if (!left_out_.empty()) [[unlikely]]
    for (auto const& line : impossible_->note(from.link, frame, left_out_, loop_.now())) log_.warn(line);
  return message;
}

/// Clocks and hardware numbers, for the routes; and answers to vehicles that ask for our clock.
void Connection::look_into(PeerRef from, Frame const& frame) {
  auto const message = decode(frame);
  if (!message) return;
  routes_->identify(from, frame.source, *message, loop_.now());
  auto const* request = std::get_if<Timesync>(&*message);
  bool const asks = request && request->tc1 == base::Duration{} && frame.source.component == autopilot_component;
  if (!asks || options_.timesync_period == base::Duration{}) return;
  auto answer = encode(Timesync{.tc1 = loop_.now().time_since_epoch(), .ts1 = request->ts1}, options_.self, 0);
  send_frame(from, answer);
}

bool Connection::may_be_heard(PeerRef from, Frame const& frame) {
  if (guard_->accepts(frame, {from.link, from.peer.key}, loop_.utc_now())) return true;
  if (!std::exchange(has_told_of_strangers_, true)) {
    log_.warn(fmt::format(
        "system {} on {} {}; nothing of the kind is listened to", frame.source.system, describe(from),
        frame.is_signed() ? "signs with another key or plays back what is past" : "does not sign its packets"));
  }
  return false;
}

Subscription Connection::subscribe(Subscription::Handler handler) {
  return listen(std::nullopt, std::move(handler));
}

Subscription Connection::subscribe(std::uint8_t system_id, Subscription::Handler handler) {
  return listen(system_id, std::move(handler));
}

Subscription Connection::listen(std::optional<std::uint8_t> system_id, Subscription::Handler handler) {
  auto shared = std::make_shared<Subscription::Handler>(std::move(handler));
  listeners_->add(system_id, shared);
  return Subscription(std::move(shared));
}

void Connection::set_frame_hook(FrameHook hook) {
  frame_hook_ = std::move(hook);
}

// ---- sending

namespace {

/// Why a link took nothing, for people.
std::string why_not_sent(link::ByteLink const& link) {
  if (auto known = link.last_error(); !known.empty()) return known;
  return link.state() == link::LinkState::open ? "more waits for it than it carries" : "it is not connected";
}

/// As a send guard sees it: setpoints of which this program knows no fields count as the one that it does know.
std::optional<Message> guarded(Frame const& frame) {
  auto message = decode(frame);
  auto const* traits = find_traits(frame.message_id);
  if (message || !traits || !is(frame.message_id, Kind::setpoint)) return message;
  Address const target{frame.payload[traits->target_system_at], frame.payload[traits->target_component_at]};
  return SetPositionTargetGlobalInt{.target = target};
}

}  // namespace

base::Result<> Connection::send(Address target, Message message) {
  set_target(message, target);
  if (target.system == 0) {
    send_to_all(message);
    return {};
  }
  return send(target, encode(message, options_.self, 0));
}

base::Result<> Connection::send(Address target, Frame frame) {
  if (send_guard_) {
    auto const message = guarded(frame);
    if (auto allowed = message ? send_guard_(target, *message) : base::Result<>{}; !allowed) return allowed;
  }
  if (auto const both = conflict(target.system))
    return fail(ErrorKind::refused,
                fmt::format("two vehicles use system id {}: {} and {}", both->system_id, both->first, both->second),
                "give one of them another system id (ArduPilot: SYSID_THISMAV or MAV_SYSID, PX4: MAV_SYS_ID)");
  auto const routes = routes_->routes_to(target, traffic_of(frame.message_id), loop_.now());
  if (routes.empty())
    return fail(ErrorKind::lost, fmt::format("vehicle {} has not been heard on any link", target.system),
                "check that it is switched on and sends to this station");
  for (auto const route : routes)
    if (send_frame(route, frame, target.system)) return {};
  auto const& link = *links_[routes.front().link];
  return fail(ErrorKind::lost,
              fmt::format("vehicle {} cannot be reached over {}: {}", target.system, link.name(), why_not_sent(link)));
}

void Connection::send_to_all(Message const& message) {
  auto peers = routes_->talkers(loop_.now());
  for (std::size_t number = 0; number < links_.size(); ++number)
    for (auto const peer : links_[number]->standing_peers()) peers.push_back({number, peer});
  std::ranges::sort(peers);
  auto const repeated = std::ranges::unique(peers);
  peers.erase(repeated.begin(), repeated.end());

  auto frame = encode(message, options_.self, 0);
  for (auto const peer : peers) send_frame(peer, frame);
}

namespace {

std::uint16_t checksum_in(std::span<std::uint8_t const> packet, bool is_signed) {
  auto const end = packet.size() - (is_signed ? Frame{}.signature.size() : 0U);
  return static_cast<std::uint16_t>(packet[end - 2] | packet[end - 1] << 8U);
}

}  // namespace

/// Fills in what depends on the far end: sequence and protocol version.
bool Connection::send_frame(PeerRef to, Frame& frame, std::uint8_t system_id) {
  auto& peer = routes_->speak_to(to);
  frame.version = peer.spoke && !peer.spoke_v2 ? 1 : 2;
  if (frame.version == 1 && frame.message_id > 255) return false;
  frame.seq = peer.next_seq;
  frame.incompat_flags = 0;  // signed anew for each far end, or not at all
  if (guard_) guard_->sign(frame, {to.link, to.peer.key}, system_id, loop_.utc_now());
  auto const out = serialize(frame);
  if (!links_[to.link]->send(to.peer, out.bytes(), urgency_of(frame))) return false;
  ++peer.next_seq;
  echoes_->note_sent(frame.seq, checksum_in(out.bytes(), frame.is_signed()));
  if (frame_hook_ && !tells_a_key(frame)) frame_hook_(Direction::sent, frame, loop_.now());
  return true;
}

bool Connection::pass_on(PeerRef to, std::span<std::uint8_t const> packets) {
  if (to.link >= links_.size()) return false;
  bool have_all_gone = true;
  FrameParser parser;
  parser.feed(packets, [&](Frame const& frame) {
    // One by one: what is held back, or finds no room, takes no other with it.
    bool const has_gone =
        !is_held_back(frame) && links_[to.link]->send(to.peer, serialize_as_received(frame).bytes(), urgency_of(frame));
    have_all_gone = have_all_gone && has_gone;
    if (has_gone) note_passed_on(frame);
    if (has_gone && frame_hook_ && !tells_a_key(frame)) frame_hook_(Direction::sent, frame, loop_.now());
  });
  return have_all_gone;
}

/// By the guard, whoever sends it.
bool Connection::is_held_back(Frame const& frame) const {
  if (!send_guard_) return false;
  auto const message = guarded(frame);
  auto const target = message ? target_of(*message) : std::nullopt;
  return target && !send_guard_(*target, *message);
}

void Connection::note_passed_on(Frame const& frame) {
  constexpr std::uint32_t command_int = 75;
  constexpr std::uint32_t command_long = 76;
  if (frame.message_id != command_int && frame.message_id != command_long) return;
  auto const message = decode(frame);
  if (!message) return;
  if (auto const* as_long = std::get_if<CommandLong>(&*message))
    commands_.note_passed_on(as_long->target.system, as_long->command, loop_.now());
  if (auto const* as_int = std::get_if<CommandInt>(&*message))
    commands_.note_passed_on(as_int->target.system, as_int->command, loop_.now());
}

// ---- what is known

std::string Connection::describe(PeerRef peer) const {
  auto const& link = *links_[peer.link];
  return fmt::format("{} from {}", link.name(), link.peer_name(peer.peer));
}

std::optional<std::string> Connection::whereabouts(std::uint8_t system_id) const {
  auto const routes = routes_->routes_to({system_id, autopilot_component}, Traffic::command, loop_.now());
  if (routes.empty()) return std::nullopt;
  return describe(routes.front());
}

std::optional<Conflict> Connection::conflict(std::uint8_t system_id) const {
  auto const* claims = routes_->claims(system_id);
  auto const both = claims ? claims->conflict() : std::nullopt;
  if (!both) return std::nullopt;
  return Conflict{system_id, describe(both->first), describe(both->second)};
}

bool Connection::is_contested(std::uint8_t system_id) const {
  auto const* claims = routes_->claims(system_id);
  return claims && claims->is_contested(loop_.now());
}

bool Connection::are_one(std::uint8_t system_id, PeerRef a, PeerRef b) const {
  auto const* claims = routes_->claims(system_id);
  return claims && claims->are_one(a, b);
}

std::optional<base::Duration> Connection::round_trip(std::uint8_t system_id) const {
  return routes_->round_trip(system_id, loop_.now());
}

std::optional<base::TimePoint> Connection::last_heard(Address source) const {
  return routes_->last_heard(source);
}

SourceCounters Connection::counters(Address source) const {
  return routes_->counters(source);
}

ParserCounters Connection::parser_counters(std::size_t link) const {
  return routes_->parser_counters(link);
}

std::vector<LinkReport> Connection::report() const {
  std::vector<LinkReport> reports(links_.size());
  for (std::size_t number = 0; number < links_.size(); ++number) {
    auto const& link = *links_[number];
    auto& report = reports[number];
    report.number = number;
    report.name = link.name();
    report.state = link.state();
    report.last_error = link.last_error();
    report.bytes = link.counters();
  }
  routes_->report(reports, loop_.now());
  impossible_->report(reports);
  for (auto& report : reports)
    for (auto& source : report.sources) source.address = links_[report.number]->peer_name(source.from.peer);
  return reports;
}

}  // namespace lapwing::mavlink
