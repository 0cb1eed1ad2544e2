#include "link/operator_link/delivery/incoming.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace lapwing::link::operator_link {

namespace {

std::chrono::microseconds to_us(base::TimePoint time) {
  return std::chrono::floor<std::chrono::microseconds>(time.time_since_epoch());
}

}  // namespace

Incoming::Incoming(Window window, DurableQueue& durable) : window_(window), durable_(durable) {
  auto const mark = durable.taken();
  auto& kept = lane(Kind::durable);
  kept.stream = mark.stream;
  kept.heard = kept.taken = mark.number;
}

void Incoming::describe(std::array<LaneState, kinds>& lanes) const {
  for (std::size_t i = 0; i < kinds; ++i) {
    lanes[i].heard_stream = lanes_[i].stream;
    lanes[i].heard = lanes_[i].heard;
  }
}

void Incoming::connected(Hello const& peer) {
  fastest_.reset();
  for (std::size_t i = 0; i < kinds; ++i) {
    auto const& state = peer.lanes[i];
    auto& here = lanes_[i];
    // What was not taken of another stream stays: its messages were accepted.
    if (here.stream != state.stream) {
      here = {.stream = state.stream, .messages = here.messages, .bytes = here.bytes};
      std::erase_if(returned_, [&](Returned const& one) { return one.kind == static_cast<Kind>(i); });
    }
    // What the far end no longer has was taken, and only this side has forgotten it.
    if (state.oldest > here.heard) here.heard = std::max(here.heard, state.oldest - 1);
  }
}

void Incoming::heard(std::chrono::microseconds sent, base::TimePoint now) {
  auto const transit = to_us(now) - sent;
  fastest_ = std::min(fastest_.value_or(transit), transit);
}

base::Result<> Incoming::arrived(Data data, base::TimePoint now) {
  heard(data.sent, now);
  auto& to = lane(data.kind);
  if (data.number <= to.heard) {
    to.is_to_report = true;  // it is said again because its ack was lost
    return {};
  }
  if (data.kind == Kind::durable) missing_ += data.number - to.heard - 1;
  to.heard = data.number;
  if (data.kind != Kind::durable) overtake(data.kind, data.key);
  auto const size = data.key.size() + data.text.size();
  if (to.messages > 0 && (to.messages >= window_.messages || to.bytes + size > window_.bytes))
    return base::fail(base::ErrorKind::invalid_input,
                      fmt::format("more than {} messages or {} bytes of kind '{}' came before one was taken",
                                  window_.messages, window_.bytes, to_string(data.kind)));
  Item item{{data.kind, std::move(data.key), std::move(data.text), to.stream, data.number}};
  if (data.left.count() > 0) item.expires = now + data.left - (to_us(now) - data.sent - *fastest_);
  ++to.messages;
  to.bytes += size;
  queue(data.kind).push_back(std::move(item));
  return {};
}

void Incoming::arrived_plain(Data data) {
  Item item{{data.kind, {}, std::move(data.text), 0, data.number}};
  auto& to = lane(data.kind);
  ++to.messages;
  to.bytes += item.size();
  others_.push_back(std::move(item));
}

void Incoming::overtake(Kind kind, std::string_view key) {
  auto& from = queue(kind);
  auto const found = key.empty() ? from.end() : std::ranges::find_if(from, [&](Item const& item) {
    return item.message.kind == kind && item.message.key == key;
  });
  if (found == from.end()) return;
  give_back(*found, Outcome::overtaken);
  forget(*found);
  from.erase(found);
}

void Incoming::give_back(Item const& item, Outcome why) {
  auto const& of = lane(item.message.kind);
  if (of.stream != item.message.stream) return;
  returned_.push_back({item.message.kind, item.message.number, why});
  ++returned_to_report_;
  // No more can be under way than two lanes hold.
  while (returned_.size() > 2 * std::size_t{window_.messages}) returned_.pop_front();
  returned_to_report_ = std::min(returned_to_report_, returned_.size());
}

void Incoming::forget(Item const& item) {
  auto& of = lane(item.message.kind);
  --of.messages;
  of.bytes -= item.size();
}

void Incoming::note_taken(Received const& message) {
  auto& of = lane(message.kind);
  if (of.stream != message.stream || message.stream == 0) return;
  of.taken = message.number;
  of.is_to_report = true;
  if (message.kind == Kind::durable) durable_.note_taken({message.stream, message.number});
}

std::deque<Incoming::Item>* Incoming::next_queue() {
  if (!commands_.empty()) return &commands_;
  return others_.empty() ? nullptr : &others_;
}

Received const* Incoming::front(base::TimePoint now) {
  for (auto* from = next_queue(); from != nullptr; from = next_queue()) {
    auto const& item = from->front();
    if (item.expires > now) return &item.message;
    give_back(item, Outcome::expired);
    note_taken(item.message);
    forget(item);
    from->pop_front();
  }
  return nullptr;
}

std::optional<Received> Incoming::take(base::TimePoint now) {
  if (front(now) == nullptr) return std::nullopt;
  auto& from = *next_queue();
  forget(from.front());
  auto message = std::move(from.front().message);
  from.pop_front();
  note_taken(message);
  return message;
}

std::vector<Speech> Incoming::reports() {
  std::vector<Speech> speeches(returned_.end() - static_cast<std::ptrdiff_t>(returned_to_report_), returned_.end());
  returned_to_report_ = 0;
  for (std::size_t i = 0; i < kinds; ++i)
    if (std::exchange(lanes_[i].is_to_report, false) && lanes_[i].taken > 0)
      speeches.emplace_back(Ack{static_cast<Kind>(i), lanes_[i].taken});
  return speeches;
}

void Incoming::report_all() {
  for (auto& one : lanes_) one.is_to_report = true;
  returned_to_report_ = returned_.size();
}

}  // namespace lapwing::link::operator_link
