#include "link/internal/send_queue.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::link::internal {

SendQueue::Line SendQueue::line_of(Urgency urgency) {
  if (urgency == Urgency::urgent) return Line::urgent;
  return urgency == Urgency::perishable ? Line::perishable : Line::prompt;
}

void SendQueue::drop_oldest(Line line) {
  auto const size = lines_[line].front().bytes.size();
  bytes_ -= size;
  if (line == Line::perishable) perishable_bytes_ -= size;
  lines_[line].pop_front();
  ++dropped_;
}

void SendQueue::drop_old(base::TimePoint now) {
  for (auto const line : {Line::urgent, Line::prompt, Line::perishable})
    while (!lines_[line].empty() && now - lines_[line].front().since > limits_.wait) drop_oldest(line);
}

bool SendQueue::push(Bytes packet, Urgency urgency, base::TimePoint now) {
  drop_old(now);
  auto const line = line_of(urgency);
  auto const has_room = [&] {
    return bytes_ + packet.size() <= limits_.all_bytes &&
           (line != Line::perishable || perishable_bytes_ + packet.size() <= limits_.perishable_bytes);
  };
  while (!has_room() && !lines_[Line::perishable].empty()) drop_oldest(Line::perishable);
  if (line == Line::urgent)
    while (!has_room() && !lines_[Line::prompt].empty()) drop_oldest(Line::prompt);
  if (!has_room()) return false;
  bytes_ += packet.size();
  if (line == Line::perishable) perishable_bytes_ += packet.size();
  lines_[line].push_back({{packet.begin(), packet.end()}, now});
  return true;
}

Bytes SendQueue::front(base::TimePoint now) {
  if (!going_out_) {
    drop_old(now);
    auto const next = std::ranges::find_if(lines_, [](auto const& line) { return !line.empty(); });
    if (next == lines_.end()) return {};
    going_out_ = std::move(next->front());
    next->pop_front();
    if (next == lines_.begin() + Line::perishable) perishable_bytes_ -= going_out_->bytes.size();
    gone_ = 0;
  }
  return Bytes(going_out_->bytes).subspan(gone_);
}

void SendQueue::pop(std::size_t size) {
  gone_ += size;
  bytes_ -= size;
  if (gone_ == going_out_->bytes.size()) going_out_.reset();
}

}  // namespace lapwing::link::internal
