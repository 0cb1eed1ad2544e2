#include "link/operator_link/delivery/outgoing.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

using std::chrono::milliseconds;

/// The rest of a lifetime; at least one millisecond, as none would mean that there is no end.
milliseconds left_of(base::TimePoint expires, base::TimePoint now) {
  if (expires == base::TimePoint::max()) return milliseconds(0);
  constexpr milliseconds longest(std::numeric_limits<std::uint32_t>::max());
  return std::clamp(std::chrono::ceil<milliseconds>(expires - now), milliseconds(1), longest);
}

bool has_room(Window const& window, std::size_t messages, std::size_t bytes, std::size_t size) {
  return messages == 0 || (messages < window.messages && bytes + size <= window.bytes);
}

template <class Lives>
bool has_key(Lives const& lives, std::string_view key) {
  return std::ranges::any_of(lives, [key](auto const& live) { return live.key == key; });
}

}  // namespace

base::Result<MessageId> Outgoing::offer(Message message, base::TimePoint now) {
  if (message.text.size() > longest_text)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("a message of {} bytes", message.text.size()),
                      fmt::format("At most {} bytes go into one message: cut it into several.", longest_text));
  if (message.key.size() > longest_key)
    return base::fail(base::ErrorKind::invalid_input, fmt::format("a key of {} bytes", message.key.size()),
                      fmt::format("At most {} bytes are a key.", longest_key));
  if (message.kind != Kind::durable) return offer_live(std::move(message), now);
  auto const number = durable_.append(message.key, message.text);
  if (!number) return std::unexpected(number.error());
  return MessageId{Kind::durable, *number};
}

base::Result<MessageId> Outgoing::offer_live(Message message, base::TimePoint now) {
  auto& to = lane(message.kind);
  drop_expired(message.kind, now);
  overtake(message.kind, message.key);
  Live live{next_ticket_, 0, std::move(message.key), std::move(message.text)};
  if (message.lifetime > base::Duration::zero()) live.expires = now + message.lifetime;
  auto const messages = to.waiting.size() + to.under_way.size();
  if (messages >= limits_.live_messages || to.bytes + live.size() > limits_.live_bytes)
    return base::fail(
        base::ErrorKind::refused,
        fmt::format("{} messages of kind '{}' with {} bytes wait for the far end, and there is no room for more",
                    messages, to_string(message.kind), to.bytes),
        "Wait until some have been taken, or give those that replace each other one key.");
  to.bytes += live.size();
  to.waiting.push_back(std::move(live));
  return MessageId{message.kind, next_ticket_++};
}

/// Takes out what waits under the key.
bool Outgoing::overtake(Kind kind, std::string_view key) {
  auto& from = lane(kind);
  auto const found = key.empty() ? from.waiting.end() : std::ranges::find(from.waiting, key, &Live::key);
  if (found == from.waiting.end()) return false;
  from.bytes -= found->size();
  auto const ticket = found->ticket;
  from.waiting.erase(found);
  tell_({kind, ticket}, Outcome::overtaken);
  return true;
}

void Outgoing::drop_expired(Kind kind, base::TimePoint now) {
  auto& from = lane(kind);
  std::vector<std::uint64_t> expired;
  std::erase_if(from.waiting, [&](Live const& live) {
    if (live.expires > now) return false;
    expired.push_back(live.ticket);
    from.bytes -= live.size();
    return true;
  });
  for (auto const ticket : expired) tell_({kind, ticket}, Outcome::expired);
}

void Outgoing::expire(base::TimePoint now) {
  drop_expired(Kind::command, now);
  drop_expired(Kind::latest, now);
}

base::TimePoint Outgoing::next_expiry() const {
  auto next = base::TimePoint::max();
  for (auto const* one : {&commands_, &latest_})
    for (auto const& live : one->waiting) next = std::min(next, live.expires);
  return next;
}

std::uint64_t Outgoing::waiting(Kind kind) const {
  if (kind == Kind::durable) return durable_.next() - durable_.first();
  return lane(kind).waiting.size() + lane(kind).under_way.size();
}

bool Outgoing::has_waiting() const {
  return durable_next_ <= durable_.ready() || !commands_.waiting.empty() || !latest_.waiting.empty();
}

std::uint64_t Outgoing::last_sent(Kind kind) const {
  return kind == Kind::durable ? durable_next_ - 1 : lane(kind).next_number - 1;
}

void Outgoing::describe(std::array<LaneState, kinds>& lanes) const {
  lanes[static_cast<std::size_t>(Kind::durable)].stream = durable_.stream();
  lanes[static_cast<std::size_t>(Kind::durable)].oldest = durable_.first();
  for (auto const kind : {Kind::command, Kind::latest}) {
    lanes[static_cast<std::size_t>(kind)].stream = instance_;
    auto const& of = lane(kind);
    lanes[static_cast<std::size_t>(kind)].oldest = of.under_way.empty() ? of.next_number : of.under_way.front().number;
  }
}

void Outgoing::connected(Hello const& peer, base::TimePoint now) {
  auto const heard = [&](Kind kind, std::uint64_t stream) {
    auto const& state = peer.lanes[static_cast<std::size_t>(kind)];
    return state.heard_stream == stream ? state.heard : 0;
  };
  bool const is_another = std::exchange(peer_instance_, peer.instance) != peer.instance;
  window_ = peer.window;
  expire(now);
  resume_live(Kind::command, heard(Kind::command, instance_), is_another, now);
  resume_live(Kind::latest, heard(Kind::latest, instance_), is_another, now);
  resume_durable(heard(Kind::durable, durable_.stream()));
}

/// What the far end has not heard waits again, at the head and in its order, unless something newer waits already. What
/// a program that is gone may have heard: a command must not be carried out twice, so it is given up.
void Outgoing::resume_live(Kind kind, std::uint64_t heard, bool is_another, base::TimePoint now) {
  auto& to = lane(kind);
  auto under_way = std::exchange(to.under_way, {});
  to.bytes_under_way = 0;
  for (auto live = under_way.rbegin(); live != under_way.rend(); ++live) {
    bool const is_heard = live->number <= heard && !is_another;
    if (is_heard) {
      to.bytes_under_way += live->size();
      to.under_way.push_front(std::move(*live));
      continue;
    }
    bool const is_newer_there = !live->key.empty() && has_key(to.waiting, live->key);
    auto outcome = std::optional<Outcome>();
    if (is_another && kind == Kind::command) outcome = Outcome::unknown;
    if (is_newer_there) outcome = outcome.value_or(Outcome::overtaken);
    if (live->expires <= now) outcome = outcome.value_or(Outcome::expired);
    if (!outcome) {
      to.waiting.push_front(std::move(*live));
      continue;
    }
    to.bytes -= live->size();
    tell_({kind, live->ticket}, *outcome);
  }
}

void Outgoing::resume_durable(std::uint64_t heard) {
  if (heard >= durable_.next()) durable_.skip_to(heard + 1);
  durable_read_.reset();
  std::erase_if(durable_under_way_, [&](Sent const& sent) { return sent.number > heard; });
  durable_bytes_under_way_ = 0;
  for (auto const& sent : durable_under_way_) durable_bytes_under_way_ += sent.size;
  // Of what an earlier process sent nobody here knows how much room it takes there.
  bool const is_known = heard < durable_.first() ||
                        (!durable_under_way_.empty() && durable_under_way_.front().number <= durable_.first());
  durable_held_until_ = is_known ? 0 : heard;
  durable_next_ = std::max(durable_.first(), heard + 1);
}

base::Result<std::optional<Data>> Outgoing::next(base::TimePoint now) {
  for (auto const kind : {Kind::command, Kind::latest})
    if (auto data = next_live(kind, now)) return data;
  return next_durable();
}

/// Of latest ones only one of a key is under way: so there are never more than the far end can take.
std::optional<Data> Outgoing::next_live(Kind kind, base::TimePoint now) {
  auto& from = lane(kind);
  if (from.waiting.empty()) return std::nullopt;
  drop_expired(kind, now);
  auto const found = std::ranges::find_if(
      from.waiting, [&](Live const& live) { return kind == Kind::command || !has_key(from.under_way, live.key); });
  if (found == from.waiting.end()) return std::nullopt;
  if (!has_room(window_, from.under_way.size(), from.bytes_under_way, found->size())) return std::nullopt;
  found->number = from.next_number++;
  Data data{kind, found->number, left_of(found->expires, now), {}, found->key, found->text};
  from.bytes_under_way += found->size();
  from.under_way.push_back(std::move(*found));
  from.waiting.erase(found);
  return data;
}

base::Result<std::optional<Data>> Outgoing::next_durable() {
  if (durable_next_ > durable_.ready() || durable_held_until_ >= durable_.first()) return std::optional<Data>();
  if (!durable_read_) {
    auto entry = durable_.read(durable_next_);
    if (!entry) return std::unexpected(entry.error());
    if (!*entry || (*entry)->number > durable_.ready()) return std::optional<Data>();
    durable_read_ = std::move(*entry);
  }
  auto const size = durable_read_->key.size() + durable_read_->text.size();
  if (!has_room(window_, durable_under_way_.size(), durable_bytes_under_way_, size)) return std::optional<Data>();
  durable_under_way_.push_back({durable_read_->number, size});
  durable_bytes_under_way_ += size;
  durable_next_ = durable_read_->number + 1;
  Data data{
      Kind::durable, durable_read_->number, {}, {}, std::move(durable_read_->key), std::move(durable_read_->text)};
  durable_read_.reset();
  return std::optional(std::move(data));
}

base::Result<> Outgoing::acknowledged(Ack ack) {
  if (ack.number > last_sent(ack.kind))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("message {} of kind '{}' was taken, and none after {} was sent", ack.number,
                                  to_string(ack.kind), last_sent(ack.kind)));
  if (ack.kind == Kind::durable) {
    durable_.acknowledge(ack.number);
    while (!durable_under_way_.empty() && durable_under_way_.front().number <= ack.number) {
      auto const sent = durable_under_way_.front();
      durable_under_way_.pop_front();
      durable_bytes_under_way_ -= sent.size;
      tell_({Kind::durable, sent.number}, Outcome::taken);
    }
    return {};
  }
  auto& from = lane(ack.kind);
  while (!from.under_way.empty() && from.under_way.front().number <= ack.number) {
    auto const live = std::move(from.under_way.front());
    from.under_way.pop_front();
    from.bytes -= live.size();
    from.bytes_under_way -= live.size();
    tell_({ack.kind, live.ticket}, Outcome::taken);
  }
  return {};
}

void Outgoing::returned(Returned returned) {
  if (returned.kind == Kind::durable) return;  // they do not come back
  auto& from = lane(returned.kind);
  auto const found = std::ranges::find(from.under_way, returned.number, &Live::number);
  if (found == from.under_way.end()) return;
  auto const ticket = found->ticket;
  from.bytes -= found->size();
  from.bytes_under_way -= found->size();
  from.under_way.erase(found);
  tell_({returned.kind, ticket}, returned.why);
}

}  // namespace lapwing::link::operator_link
