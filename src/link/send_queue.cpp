#include "link/internal/send_queue.hpp"

#include <utility>

namespace lapwing::link::internal {

void SendQueue::drop_oldest() {
  bytes_ -= perishable_.front().size();
  perishable_bytes_ -= perishable_.front().size();
  perishable_.pop_front();
  ++dropped_;
}

bool SendQueue::push(Bytes packet, Urgency urgency) {
  bool const is_perishable = urgency == Urgency::perishable;
  auto const has_room = [&] {
    return bytes_ + packet.size() <= limits_.all_bytes &&
           (!is_perishable || perishable_bytes_ + packet.size() <= limits_.perishable_bytes);
  };
  while (!has_room() && !perishable_.empty()) drop_oldest();
  if (!has_room()) return false;
  bytes_ += packet.size();
  if (is_perishable) perishable_bytes_ += packet.size();
  (is_perishable ? perishable_ : urgent_).emplace_back(packet.begin(), packet.end());
  return true;
}

Bytes SendQueue::front() {
  if (!going_out_) {
    auto& next = urgent_.empty() ? perishable_ : urgent_;
    if (next.empty()) return {};
    if (&next == &perishable_) perishable_bytes_ -= next.front().size();
    going_out_ = std::move(next.front());
    next.pop_front();
    gone_ = 0;
  }
  return Bytes(*going_out_).subspan(gone_);
}

void SendQueue::pop(std::size_t size) {
  gone_ += size;
  bytes_ -= size;
  if (gone_ == going_out_->size()) going_out_.reset();
}

}  // namespace lapwing::link::internal
