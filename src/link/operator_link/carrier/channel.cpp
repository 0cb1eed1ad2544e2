#include "link/operator_link/carrier/channel.hpp"

#include <utility>

namespace lapwing::link::operator_link {

void Channel::start(Events events) {
  events_ = std::move(events);
  stream_->start({.data = [this](Bytes bytes) { take(bytes); },
                  .drained =
                      [this] {
                        if (!is_closed_ && events_.drained) events_.drained();
                      },
                  .ended = [this](std::string why) { end(std::move(why)); }});
}

void Channel::take(Bytes bytes) {
  if (is_closed_) return;
  reader_.feed(bytes);
  while (!is_closed_) {
    auto const frame = reader_.next();
    if (!frame) return end(frame.error().message);
    if (!*frame) return;
    auto speech = read(**frame);
    if (!speech) return end(speech.error().message);
    // A copy: what is heard may hand the channel over.
    auto const heard = events_.heard;
    if (*speech && heard) heard(**std::move(speech));
  }
}

void Channel::flush() {
  if (is_closed_ || unsent_.empty()) return;
  stream_->write(unsent_);
  unsent_.clear();
}

void Channel::end(std::string why) {
  if (std::exchange(is_closed_, true)) return;
  stream_->close();
  auto const ended = events_.ended;
  if (ended) ended(std::move(why));
}

void Channel::close() {
  if (is_closed_) return;
  flush();
  is_closed_ = true;
  stream_->close();
}

}  // namespace lapwing::link::operator_link
