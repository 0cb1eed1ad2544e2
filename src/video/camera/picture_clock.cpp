#include "video/camera/picture_clock.hpp"

#include <utility>

namespace lapwing::video {

using namespace std::chrono_literals;

namespace {

/// A source's clock goes wrong by less than 1 part in that many; the begin may move by as much.
constexpr int clock_parts = 10'000;
/// Pictures do not wait longer on their way.
constexpr base::Duration longest_way = 2s;

}  // namespace

base::UtcTime PictureClock::taken(base::Duration position, base::UtcTime arrived) {
  auto const begin = arrived - position;
  auto const before = std::exchange(position_, position);
  if (!before || position <= *before) {
    begin_ = begin;
    return arrived;
  }
  begin_ += (position - *before) / clock_parts;
  if (begin < begin_ || begin - begin_ > longest_way) begin_ = begin;
  return begin_ + position;
}

}  // namespace lapwing::video
