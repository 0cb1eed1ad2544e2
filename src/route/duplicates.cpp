#include "route/duplicates.hpp"

#include <utility>

namespace lapwing::route {

namespace {

/// A number that comes again later than this many frames is another round of the 256.
std::uint64_t constexpr half_a_round = 128;

}  // namespace

Duplicates::Duplicates() : sources_(std::make_unique<std::array<std::unique_ptr<Source>, 65536>>()) {}

Duplicates::Source* Duplicates::source_of(mavlink::Address address) {
  auto& source = (*sources_)[static_cast<std::size_t>(address.system) << 8U | address.component];
  if (!source && count_ < max_sources) {
    source = std::make_unique<Source>();
    ++count_;
  }
  return source.get();
}

bool Duplicates::is_copy(mavlink::FrameView const& frame, std::uint16_t channel, base::TimePoint now) {
  auto* source = source_of(frame.source);
  if (!source) return false;
  auto& seen = source->by_seq[frame.seq];
  if (seen.number > 0 && seen.message_id == frame.message_id && seen.checksum == frame.checksum &&
      source->frames - seen.number < half_a_round && now - seen.at < (channel == seen.channel ? within : across))
    return true;
  seen = {now, ++source->frames, frame.message_id, frame.checksum, channel};
  return false;
}

}  // namespace lapwing::route
