#include "link/operator_link/delivery/peer_session.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

/// A ping that is lost with its packet, and one that is late, must not make a link lost.
constexpr int pings_in_silence = 3;

microseconds stamp(base::TimePoint now) {
  return std::chrono::floor<microseconds>(now.time_since_epoch());
}

base::Result<> result_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::taken: return {};
    case Outcome::overtaken:
      return base::fail(base::ErrorKind::cancelled, "a newer message took its place before it was taken");
    case Outcome::expired:
      return base::fail(base::ErrorKind::cancelled, "it expired before it was taken",
                        "Say it again if it still counts.");
    case Outcome::unknown:
      return base::fail(base::ErrorKind::lost, "the program at the far end ended before it answered",
                        "Look whether it was carried out before it is said again.");
  }
  return {};
}

}  // namespace

std::string_view to_string(EventKind kind) {
  switch (kind) {
    case EventKind::connected: return "connected";
    case EventKind::lost: return "lost";
    case EventKind::refused: return "refused";
    case EventKind::malformed: return "malformed";
    case EventKind::crowded: return "crowded";
    case EventKind::relieved: return "relieved";
    case EventKind::disk: return "disk";
    case EventKind::missing: return "missing";
  }
  return "unknown";
}

PeerSession::PeerSession(base::Loop& loop, std::string peer, std::uint64_t instance,
                         std::unique_ptr<DurableQueue> queue, SessionOptions options, Events events)
    : loop_(loop),
      peer_(std::move(peer)),
      instance_(instance),
      options_(options),
      events_(std::move(events)),
      queue_(std::move(queue)),
      outgoing_(instance, *queue_, options.limits, [this](MessageId id, Outcome outcome) { told(id, outcome); }),
      incoming_(options.window, *queue_),
      last_connected_(loop.now()),
      changed_(loop),
      expiring_(loop),
      connection_(loop) {
  queue_->listen({.ready = [this] { pump_soon(); },
                  .fault = [this](std::string what) { tell(EventKind::disk, std::move(what)); }});
}

PeerSession::~PeerSession() = default;

Hello PeerSession::hello() const {
  Hello hello;
  hello.instance = instance_;
  outgoing_.describe(hello.lanes);
  incoming_.describe(hello.lanes);
  hello.window = options_.window;
  hello.silence = std::chrono::ceil<milliseconds>(options_.link_lost);
  return hello;
}

// ---- what programs say and hear ------------------------------------------------------------------------------------

base::Result<MessageId> PeerSession::send(Message message) {
  bool const can_expire = message.lifetime > base::Duration::zero() && message.kind != Kind::durable;
  auto id = outgoing_.offer(std::move(message), loop_.now());
  if (!id && id.error().kind != base::ErrorKind::invalid_input && !std::exchange(is_crowded_, true))
    tell(EventKind::crowded, id.error().message);
  if (!id) return id;
  if (can_expire && !std::exchange(is_expiring_, true)) expiring_.spawn(expire_in_time());
  pump_soon();
  return id;
}

base::Task<base::Result<>> PeerSession::deliver(Message message, base::Duration timeout) {
  auto const id = send(std::move(message));
  if (!id) co_return std::unexpected(id.error());
  auto wait = taken(*id, timeout);
  co_return co_await wait;
}

base::Task<base::Result<>> PeerSession::taken(MessageId id, base::Duration timeout) {
  auto const deadline = loop_.now() + timeout;
  // Of a durable one the queue knows; what became of another before anybody asked, nobody does.
  bool const is_done = id.kind == Kind::durable && id.number < queue_->first();
  if (is_done) co_return base::Result<>();
  struct Watch {  // goes with the coroutine, wherever that ends
    std::map<MessageId, std::optional<Outcome>>& all;
    std::map<MessageId, std::optional<Outcome>>::iterator one;
    ~Watch() { all.erase(one); }
  };
  Watch const watch{watched_, watched_.try_emplace(id).first};
  while (!watch.one->second && loop_.now() < deadline) co_await changed_.wait_until(deadline);
  auto const outcome = watch.one->second;
  if (outcome) co_return result_of(*outcome);
  co_return base::fail(
      base::ErrorKind::timed_out,
      fmt::format("'{}' has not confirmed it within {:.1f} s{}", peer_, base::to_seconds(timeout),
                  is_connected() ? "" : "; it is not connected"),
      id.kind == Kind::durable ? "It is kept, and arrives once the far end is back." : "It may still arrive.");
}

base::Task<bool> PeerSession::drained(Kind kind, base::Duration timeout) {
  auto wait = changed_.wait_for([this, kind] { return outgoing_.waiting(kind) == 0; }, timeout);
  co_return co_await wait;
}

std::optional<Received> PeerSession::take() {
  auto message = incoming_.take(loop_.now());
  if (message) ++counters_.messages_taken;
  if (channel_) pump_soon();  // its ack
  if (plain_ && incoming_.size() < options_.window.messages / 2) plain_->pause(false);
  return message;
}

base::Task<std::optional<Received>> PeerSession::receive(base::Duration timeout) {
  auto const deadline = loop_.now() + timeout;
  for (;;) {
    if (auto message = take()) co_return message;
    if (loop_.now() >= deadline) co_return std::nullopt;
    co_await changed_.wait_until(deadline);
  }
}

void PeerSession::told(MessageId id, Outcome outcome) {
  if (auto const found = watched_.find(id); found != watched_.end()) found->second = outcome;
  changed_.notify_all();
}

void PeerSession::tell(EventKind kind, std::string text) {
  changed_.notify_all();
  if (events_.event) events_.event({kind, peer_, std::move(text)});
}

/// Not at the first byte that is free: the next message would be refused again.
void PeerSession::room_again() {
  if (!is_crowded_ || queue_->bytes() > queue_->most_bytes() / 4 * 3) return;
  for (auto const kind : {Kind::command, Kind::latest})
    if (outgoing_.waiting(kind) > options_.limits.live_messages / 4 * 3) return;
  is_crowded_ = false;
  tell(EventKind::relieved, "there is room for messages again");
}

base::Task<> PeerSession::expire_in_time() {
  for (auto next = outgoing_.next_expiry(); next != base::TimePoint::max(); next = outgoing_.next_expiry()) {
    co_await loop_.sleep_until(next);
    outgoing_.expire(loop_.now());
    changed_.notify_all();
  }
  is_expiring_ = false;
}

// ---- the connection
// --------------------------------------------------------------------------------------------------

void PeerSession::attach(std::unique_ptr<Channel> channel, Hello const& peer,
                         std::function<void(Hello const& own)> const& welcome) {
  bury_connection();
  channel_ = std::move(channel);
  channel_->trust();
  channel_->hand_over({.heard = [this](Speech speech) { hear(std::move(speech)); },
                       .drained = [this] { pump_soon(); },
                       .ended = [this](std::string why) { lose(why); }});
  peer_instance_ = peer.instance;
  peer_silence_ = std::max<base::Duration>(peer.silence, milliseconds(1));
  last_heard_ = loop_.now();
  incoming_.connected(peer);
  if (welcome) welcome(hello());
  incoming_.report_all();
  outgoing_.connected(peer, loop_.now());
  ++counters_.connections;
  connection_.spawn(keep_alive());
  tell(EventKind::connected, channel_->peer_name());
  pump_soon();
}

void PeerSession::attach_plain(std::unique_ptr<ByteStream> stream) {
  bury_connection();
  objects_ = JsonObjects();
  plain_ = std::move(stream);
  plain_->start({.data = [this](Bytes bytes) { hear_plain(bytes); },
                 .drained = [this] { plain_drained(); },
                 .ended = [this](std::string why) { lose(why); }});
  Hello peer;
  peer.instance = 1;  // one that answers nothing: what the operating system did not take is said again
  outgoing_.connected(peer, loop_.now());
  ++counters_.connections;
  tell(EventKind::connected, plain_->peer_name());
  pump_soon();
}

void PeerSession::detach(std::string const& why) {
  if (!is_connected()) return;
  if (channel_) {
    channel_->say(Bye{why.substr(0, 200)});
    channel_->close();
  }
  lose(why);
}

void PeerSession::lose(std::string const& why) {
  if (!is_connected()) return;
  bury_connection();
  tell(EventKind::lost, why);
}

/// What ends may be on the stack now: it goes on a later turn.
void PeerSession::bury_connection() {
  if (!is_connected()) return;
  last_connected_ = loop_.now();
  if (channel_) channel_->close();
  if (plain_) plain_->close();
  if (channel_) buried_channels_.push_back(std::move(channel_));
  if (plain_) buried_streams_.push_back(std::move(plain_));
  channel_.reset();
  plain_.reset();
  loop_.post([this, alive = std::weak_ptr(alive_)] {
    if (alive.expired()) return;
    buried_channels_.clear();
    buried_streams_.clear();
    if (!is_connected()) connection_.clear();
  });
}

base::Task<> PeerSession::keep_alive() {
  auto const mine = counters_.connections;
  auto const period = peer_silence_ / pings_in_silence;
  auto next_ping = loop_.now() + period;
  for (;;) {
    auto const lost_at = last_heard_ + options_.link_lost;
    co_await loop_.sleep_until(std::min(next_ping, lost_at));
    if (!channel_ || counters_.connections != mine) co_return;
    auto const now = loop_.now();
    if (now >= last_heard_ + options_.link_lost) {
      lose(fmt::format("silent for {:.1f} s", base::to_seconds(options_.link_lost)));
      co_return;
    }
    if (now < next_ping) continue;
    next_ping = now + period;
    channel_->say(Ping{stamp(now)});
    channel_->flush();
  }
}

void PeerSession::hear(Speech speech) {
  last_heard_ = loop_.now();
  if (auto* const data = std::get_if<Data>(&speech)) return hear_data(std::move(*data));
  if (auto const* const ack = std::get_if<Ack>(&speech)) {
    if (auto const fine = outgoing_.acknowledged(*ack); !fine) return lose(fine.error().message);
    changed_.notify_all();
    room_again();
    return pump_soon();
  }
  if (auto const* const returned = std::get_if<Returned>(&speech)) {
    outgoing_.returned(*returned);
    return pump_soon();
  }
  if (auto const* const ping = std::get_if<Ping>(&speech)) {
    incoming_.heard(ping->sent, loop_.now());
    channel_->say(Pong{ping->sent});
    return channel_->flush();
  }
  if (auto const* const pong = std::get_if<Pong>(&speech)) {
    counters_.round_trip = loop_.now() - base::TimePoint(pong->sent);
    return;
  }
  if (auto const* const bye = std::get_if<Bye>(&speech)) return lose(bye->reason);
  lose("a hello in the middle of a connection");
}

void PeerSession::hear_data(Data data) {
  if (auto const fine = incoming_.arrived(std::move(data), loop_.now()); !fine) return lose(fine.error().message);
  if (auto const missing = incoming_.missing(); missing > missing_told_)
    tell(EventKind::missing, fmt::format("{} messages were lost there before they were sent",
                                         missing - std::exchange(missing_told_, missing)));
  changed_.notify_all();
  pump_soon();
  if (events_.arrived) events_.arrived();
}

void PeerSession::hear_plain(Bytes bytes) {
  objects_.feed(bytes);
  while (auto item = objects_.next()) {
    if (!*item) {
      tell(EventKind::malformed, item->error());
      continue;
    }
    Data data;
    data.number = ++plain_number_;
    data.text = **std::move(item);
    incoming_.arrived_plain(std::move(data));
    changed_.notify_all();
    if (events_.arrived) events_.arrived();
  }
  if (plain_ && incoming_.size() >= options_.window.messages) plain_->pause(true);
}

// ---- what goes out
// ---------------------------------------------------------------------------------------------------

/// Once for all that happens in one turn of the loop.
void PeerSession::pump_soon() {
  if (!is_connected() || std::exchange(is_pumping_, true)) return;
  loop_.post([this, alive = std::weak_ptr(alive_)] {
    if (alive.expired()) return;
    is_pumping_ = false;
    if (channel_) pump();
    if (plain_) pump_plain();
  });
}

base::Result<std::optional<Data>> PeerSession::next() {
  auto data = outgoing_.next(loop_.now());
  if (!data) tell(EventKind::disk, data.error().message);
  return data;
}

void PeerSession::pump() {
  for (auto const& report : incoming_.reports()) channel_->say(report);
  while (channel_->has_room()) {
    auto data = next();
    if (!channel_) return;  // whoever was told of a disk's fault ended it
    if (!data || !*data) break;
    (*data)->sent = stamp(loop_.now());
    channel_->say(**std::move(data));
    ++counters_.messages_sent;
  }
  bool const is_full = !channel_->has_room();
  channel_->flush();
  // The operating system took all of it at once, so nobody will say that there is room again.
  if (is_full && channel_->has_room()) pump_soon();
}

void PeerSession::pump_plain() {
  constexpr std::size_t most_backlog = 64 * 1024;
  std::vector<std::uint8_t> lines;
  while (plain_->backlog() + lines.size() < most_backlog) {
    auto const data = next();
    if (!plain_) return;
    if (!data || !*data) break;
    lines.insert(lines.end(), (*data)->text.begin(), (*data)->text.end());
    lines.push_back('\n');
    ++counters_.messages_sent;
  }
  if (lines.empty()) return;
  plain_->write(lines);
  if (plain_ && plain_->backlog() == 0) plain_drained();
}

/// Old parts confirm nothing: what the operating system has taken counts as taken.
void PeerSession::plain_drained() {
  for (auto const kind : {Kind::durable, Kind::command, Kind::latest})
    if (outgoing_.last_sent(kind) > 0) (void)outgoing_.acknowledged({kind, outgoing_.last_sent(kind)});
  changed_.notify_all();
  room_again();
  if (outgoing_.has_waiting()) pump_soon();
}

}  // namespace lapwing::link::operator_link
