#include "route/shaper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::route {

namespace {

/// What may be saved up for a burst, as a time of sending.
double constexpr burst_s = 0.1;

constexpr std::array classes{MessageClass::command, MessageClass::telemetry, MessageClass::bulk};

bool is_limited(Rate const& rate) {
  return !std::isinf(rate.bytes_per_s) || !std::isinf(rate.messages_per_s);
}

}  // namespace

bool Limits::any() const {
  return is_limited(all) || std::ranges::any_of(by_class, is_limited);
}

// ---- gates and lines

Shaper::Gate::Gate(Rate const& rate)
    : bytes_(rate.bytes_per_s, std::max(rate.bytes_per_s * burst_s, static_cast<double>(mavlink::max_frame_size))),
      messages_(rate.messages_per_s, std::max(rate.messages_per_s * burst_s, 1.0)) {}

base::TimePoint Shaper::Gate::ready(std::size_t size, base::TimePoint now) const {
  return std::max(bytes_.ready(static_cast<double>(size), now), messages_.ready(1.0, now));
}

void Shaper::Gate::take(std::size_t size, base::TimePoint now) {
  bytes_.take(static_cast<double>(size), now);
  messages_.take(1.0, now);
}

void Shaper::Kept::keep(mavlink::FrameView const& frame) {
  std::ranges::copy(frame.bytes, bytes.begin());
  size = frame.bytes.size();
}

void Shaper::Ring::pop() {
  first = (first + 1) % indices.size();
  --count;
}

Shaper::Shaper(Limits const& limits)
    : all_(limits.all),
      gates_{Gate(limits.by_class[0]), Gate(limits.by_class[1]), Gate(limits.by_class[2])},
      lines_{Line(max_single), Line(max_streams), Line(max_single)} {
  line(MessageClass::command).kept.resize(max_single);
  line(MessageClass::bulk).kept.resize(max_single);
}

// ---- going in

Shaper::Verdict Shaper::offer(mavlink::FrameView const& frame, base::TimePoint now) {
  auto const c = class_of(frame);
  // What waits was there before; but commands do not wait for telemetry.
  bool const is_next = c == MessageClass::command ? line(c).order.count == 0 : waiting() == 0;
  if (is_next && ready(c, frame.bytes.size(), now) <= now) {
    pay(c, frame.bytes.size(), now);
    return Verdict::go;
  }
  return c == MessageClass::telemetry ? keep_newest(frame) : keep_single(line(c), frame);
}

/// Places are taken in turn; the line is never longer than they are many, so the next one is free.
Shaper::Verdict Shaper::keep_single(Line& line, mavlink::FrameView const& frame) {
  auto& order = line.order;
  if (order.full()) return Verdict::refused;
  auto const place = static_cast<std::uint32_t>((order.first + order.count) % max_single);
  line.kept[place].keep(frame);
  order.push(place);
  return Verdict::waits;
}

Shaper::Verdict Shaper::keep_newest(mavlink::FrameView const& frame) {
  auto& [kept, order] = line(MessageClass::telemetry);
  auto const stream = stream_of(frame);
  auto found = streams_.find(stream);
  if (found == streams_.end()) {
    if (kept.size() == max_streams) forget_idle_streams();
    if (kept.size() == max_streams) return Verdict::refused;
    found = streams_.emplace(stream, static_cast<std::uint32_t>(kept.size())).first;
    kept.emplace_back().stream = stream;
  }
  auto& place = kept[found->second];
  place.keep(frame);
  if (std::exchange(place.waits, true)) return Verdict::replaced;
  order.push(found->second);
  return Verdict::waits;
}

/// Keeps what waits, in its order. Sources come and go; their kinds of messages must not fill the memory for good.
void Shaper::forget_idle_streams() {
  auto& [kept, order] = line(MessageClass::telemetry);
  if (order.count == kept.size()) return;
  std::vector<Kept> waiting;
  waiting.reserve(max_streams);
  Ring new_order(max_streams);
  streams_.clear();
  for (; order.count > 0; order.pop()) {
    auto const place = static_cast<std::uint32_t>(waiting.size());
    waiting.push_back(kept[order.front()]);
    streams_.emplace(waiting.back().stream, place);
    new_order.push(place);
  }
  kept = std::move(waiting);
  order = std::move(new_order);
}

// ---- coming out

std::optional<std::span<std::uint8_t const>> Shaper::release(base::TimePoint now) {
  auto const may_go = [&](MessageClass c) { return front_ready(c, now) <= now; };
  if (may_go(MessageClass::command)) return release_front(MessageClass::command, now);
  auto first = MessageClass::telemetry;
  auto second = MessageClass::bulk;
  if (bulk_is_next_) std::swap(first, second);
  if (may_go(first)) return release_front(first, now);
  if (may_go(second)) return release_front(second, now);
  return std::nullopt;
}

std::span<std::uint8_t const> Shaper::release_front(MessageClass c, base::TimePoint now) {
  auto& [kept, order] = line(c);
  auto& front = kept[order.front()];
  front.waits = false;
  order.pop();
  pay(c, front.size, now);
  if (c != MessageClass::command) bulk_is_next_ = c == MessageClass::telemetry;
  return front.view();
}

base::TimePoint Shaper::next_release(base::TimePoint now) const {
  auto next = base::TimePoint::max();
  for (auto const c : classes) next = std::min(next, front_ready(c, now));
  return next;
}

std::size_t Shaper::waiting() const {
  std::size_t count = 0;
  for (auto const& line : lines_) count += line.order.count;
  return count;
}

base::TimePoint Shaper::ready(MessageClass c, std::size_t size, base::TimePoint now) const {
  return std::max(all_.ready(size, now), gates_[static_cast<std::size_t>(c)].ready(size, now));
}

base::TimePoint Shaper::front_ready(MessageClass c, base::TimePoint now) const {
  auto const& [kept, order] = line(c);
  if (order.count == 0) return base::TimePoint::max();
  return ready(c, kept[order.front()].size, now);
}

void Shaper::pay(MessageClass c, std::size_t size, base::TimePoint now) {
  all_.take(size, now);
  gates_[static_cast<std::size_t>(c)].take(size, now);
}

}  // namespace lapwing::route
