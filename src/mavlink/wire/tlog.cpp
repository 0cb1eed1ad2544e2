#include "mavlink/wire/tlog.hpp"

#include <algorithm>
#include <istream>

namespace lapwing::mavlink {

namespace {

using std::chrono::microseconds;

constexpr std::size_t stamp_size = 8;
constexpr std::size_t largest_entry = stamp_size + max_frame_size;
constexpr std::size_t chunk = 1 << 16;
constexpr std::uint64_t end_of_time = 4'102'444'800'000'000;  ///< 2100-01-01: no log is younger, junk mostly is

std::uint64_t big_endian_64(std::uint8_t const* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < stamp_size; ++i) value = value << 8U | bytes[i];
  return value;
}

/// Of the packet that `bytes` begin with; 0 when they begin with none.
std::size_t packet_size(std::span<std::uint8_t const> bytes) {
  std::size_t size = 0;
  FrameParser parser;
  parser.feed(bytes.first(std::min(bytes.size(), max_frame_size)), [&](Frame const& frame) {
    bool const is_first = parser.counters().frames == 1 && parser.counters().junk_bytes == 0;
    if (is_first) size = serialize_as_received(frame).bytes().size();
  });
  return size;
}

}  // namespace

void append_tlog(std::vector<std::uint8_t>& out, base::UtcTime at, Frame const& frame) {
  auto const stamp =
      static_cast<std::uint64_t>(std::chrono::duration_cast<microseconds>(at.time_since_epoch()).count());
  for (int shift = 56; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(stamp >> shift));
  auto const packet = serialize(frame);
  out.insert(out.end(), packet.bytes().begin(), packet.bytes().end());
}

std::optional<TlogEntry> TlogReader::next() {
  for (;;) {
    if (buffer_.size() - begin_ < largest_entry) refill();
    auto const left = std::span<std::uint8_t const>(buffer_).subspan(begin_);
    if (left.size() <= stamp_size) {
      drop(left.size());
      return std::nullopt;
    }
    auto const stamp = big_endian_64(left.data());
    auto const size = stamp < end_of_time ? packet_size(left.subspan(stamp_size)) : 0;
    if (size == 0) {
      drop(1);
      continue;
    }
    begin_ += stamp_size + size;
    return TlogEntry{base::UtcTime(microseconds(static_cast<microseconds::rep>(stamp))),
                     left.subspan(stamp_size, size)};
  }
}

void TlogReader::refill() {
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  auto const kept = buffer_.size();
  buffer_.resize(kept + chunk);
  in_.read(reinterpret_cast<char*>(buffer_.data() + kept), static_cast<std::streamsize>(chunk));
  buffer_.resize(kept + static_cast<std::size_t>(in_.gcount()));
}

void TlogReader::drop(std::size_t bytes) {
  begin_ += bytes;
  skipped_bytes_ += bytes;
}

}  // namespace lapwing::mavlink
