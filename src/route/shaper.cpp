#include "route/shaper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lapwing::route {

namespace {

/// What may be saved up for a burst, as a time of sending.
double constexpr burst_s = 0.1;

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
      lines_{Line{MessageClass::command, std::vector<Kept>(max_single), Ring(max_single)},
             Line{MessageClass::command, std::vector<Kept>(max_single), Ring(max_single)},
             Line{MessageClass::telemetry, {}, Ring(max_streams)},
             Line{MessageClass::bulk, std::vector<Kept>(max_single), Ring(max_single)}} {}

// ---- going in

Shaper::LineId Shaper::line_of(mavlink::FrameView const& frame) {
  switch (class_of(frame)) {
    case MessageClass::command: return is_order(frame) ? LineId::orders : LineId::commands;
    case MessageClass::telemetry: return LineId::telemetry;
    case MessageClass::bulk: break;
  }
  return LineId::bulk;
}

/// What waits was there before; but orders wait for orders alone, and other commands not for telemetry.
bool Shaper::is_next(LineId line) const {
  if (line == LineId::orders) return lines_[LineId::orders].order.count == 0;
  if (line == LineId::commands) return lines_[LineId::orders].order.count + lines_[LineId::commands].order.count == 0;
  return waiting() == 0;
}

Shaper::Verdict Shaper::offer(mavlink::FrameView const& frame, base::TimePoint now) {
  drop_expired(now);
  auto const line = line_of(frame);
  auto const c = lines_[line].message_class;
  if (is_next(line) && ready(c, frame.bytes.size(), now) <= now) {
    pay(c, frame.bytes.size(), now);
    return Verdict::go;
  }
  return line == LineId::telemetry ? keep_newest(frame) : keep_single(line, frame, now);
}

/// Places are taken in turn; the line is never longer than they are many, so the next one is free.
Shaper::Verdict Shaper::keep_single(LineId id, mavlink::FrameView const& frame, base::TimePoint now) {
  auto& [message_class, kept, order] = lines_[id];
  bool const is_full = order.full();
  if (is_full && id != LineId::orders) return Verdict::refused;
  if (is_full) order.pop();  // the newest may be a stop
  auto const place = static_cast<std::uint32_t>((order.first + order.count) % max_single);
  auto const life = shelf_life(frame);
  kept[place].keep(frame);
  kept[place].expires = life ? now + *life : base::TimePoint::max();
  order.push(place);
  return is_full ? Verdict::displaced : Verdict::waits;
}

/// From the front: of one line all live about equally long.
void Shaper::drop_expired(base::TimePoint now) {
  for (auto& [message_class, kept, order] : lines_) {
    while (order.count > 0 && kept[order.front()].expires < now) {
      order.pop();
      ++expired_;
    }
  }
}

Shaper::Verdict Shaper::keep_newest(mavlink::FrameView const& frame) {
  auto& [message_class, kept, order] = lines_[LineId::telemetry];
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
  auto& [message_class, kept, order] = lines_[LineId::telemetry];
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

std::optional<Shaper::Released> Shaper::release(base::TimePoint now) {
  drop_expired(now);
  auto const turns = bulk_is_next_ ? std::array{LineId::orders, LineId::commands, LineId::bulk, LineId::telemetry}
                                   : std::array{LineId::orders, LineId::commands, LineId::telemetry, LineId::bulk};
  for (auto const id : turns)
    if (front_ready(lines_[id], now) <= now) return release_front(id, now);
  return std::nullopt;
}

Shaper::Released Shaper::release_front(LineId id, base::TimePoint now) {
  auto& [message_class, kept, order] = lines_[id];
  auto& front = kept[order.front()];
  front.waits = false;
  order.pop();
  pay(message_class, front.size, now);
  if (message_class != MessageClass::command) bulk_is_next_ = id == LineId::telemetry;
  return {front.view(), message_class};
}

base::TimePoint Shaper::next_release(base::TimePoint now) const {
  auto next = base::TimePoint::max();
  for (auto const& line : lines_) next = std::min(next, front_ready(line, now));
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

base::TimePoint Shaper::front_ready(Line const& line, base::TimePoint now) const {
  if (line.order.count == 0) return base::TimePoint::max();
  return ready(line.message_class, line.kept[line.order.front()].size, now);
}

void Shaper::pay(MessageClass c, std::size_t size, base::TimePoint now) {
  all_.take(size, now);
  gates_[static_cast<std::size_t>(c)].take(size, now);
}

}  // namespace lapwing::route
