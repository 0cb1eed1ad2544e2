#include "mavlink/wire/frame.hpp"

#include <algorithm>
#include <cstring>

#include "base/assert.hpp"

namespace lapwing::mavlink {

namespace {

std::uint8_t constexpr magic_v1 = 0xFE;
std::uint8_t constexpr magic_v2 = 0xFD;
std::size_t constexpr header_v1 = 6;
std::size_t constexpr header_v2 = 10;
std::size_t constexpr checksum_size = 2;
std::uint8_t constexpr flag_signed = 0x01;

bool is_magic(std::uint8_t byte) {
  return byte == magic_v1 || byte == magic_v2;
}

std::uint8_t low(std::uint32_t value) {
  return static_cast<std::uint8_t>(value & 0xFFU);
}

std::uint32_t little_endian_24(std::uint8_t const* p) {
  return p[0] | static_cast<std::uint32_t>(p[1]) << 8U | static_cast<std::uint32_t>(p[2]) << 16U;
}

/// `sum` is the CRC over header and payload; the last byte to go in is the message's own seed. That of an unknown
/// message is unknown too, but only one `checksum` in 256 fits any seed at all, which tells a frame from junk well
/// enough.
bool checksum_fits(std::uint16_t checksum, std::uint16_t sum, MessageTraits const* traits) {
  if (traits) return crc_accumulate({&traits->crc_extra, 1}, sum) == checksum;
  for (unsigned seed = 0; seed < 256; ++seed) {
    auto const byte = static_cast<std::uint8_t>(seed);
    if (crc_accumulate({&byte, 1}, sum) == checksum) return true;
  }
  return false;
}

/// MAVLink 2 leaves out zero bytes at the payload's end, but never its first byte; MAVLink 1 has no extension fields.
std::uint8_t travelling_size(Frame const& frame, MessageTraits const* traits) {
  if (frame.version == 1) return traits ? traits->min_size : frame.payload_size;
  std::uint8_t size = frame.payload_size;
  while (size > 1 && frame.payload[size - 1U] == 0) --size;
  return size;
}

}  // namespace

FrameBytes serialize(Frame const& frame) {
  FrameBytes out;
  out.write(frame, travelling_size(frame, find_traits(frame.message_id)));
  return out;
}

FrameBytes serialize_as_received(Frame const& frame) {
  FrameBytes out;
  out.write(frame, frame.payload_size);
  return out;
}

void FrameBytes::write(Frame const& frame, std::size_t payload_size) {
  LAPWING_ASSERT(frame.version == 2 || frame.message_id < 256, frame.version, frame.message_id);
  LAPWING_ASSERT(payload_size <= frame.payload.size(), payload_size);
  auto const size = static_cast<std::uint8_t>(payload_size);
  auto* p = data_.data();
  auto const* traits = find_traits(frame.message_id);
  if (frame.version == 1) {
    std::uint8_t const header[] = {
        magic_v1, size, frame.seq, frame.source.system, frame.source.component, low(frame.message_id)};
    p = std::copy(std::begin(header), std::end(header), p);
  } else {
    std::uint8_t const header[] = {magic_v2,
                                   size,
                                   frame.incompat_flags,
                                   frame.compat_flags,
                                   frame.seq,
                                   frame.source.system,
                                   frame.source.component,
                                   low(frame.message_id),
                                   low(frame.message_id >> 8U),
                                   low(frame.message_id >> 16U)};
    p = std::copy(std::begin(header), std::end(header), p);
  }
  p = std::copy_n(frame.payload.data(), size, p);
  auto checksum = frame.checksum;  // of a message that is not in the dialect only its sender knows the seed
  if (traits) {
    checksum = crc_accumulate({data_.data() + 1, p});
    checksum = crc_accumulate({&traits->crc_extra, 1}, checksum);
  }
  *p++ = low(checksum);
  *p++ = low(static_cast<std::uint32_t>(checksum >> 8U));
  if (frame.version == 2 && frame.is_signed()) p = std::ranges::copy(frame.signature, p).out;
  size_ = static_cast<std::size_t>(p - data_.data());
}

/// What an earlier call left is an unfinished frame, or junk that looks like the start of one. If the new bytes begin
/// with a whole valid frame, no frame can reach from the old bytes into them, so none that needs them is waited for.
void FrameParser::begin(std::span<std::uint8_t const> bytes) {
  input_ = bytes;
  sealed_ = 0;
  if (kept_.empty()) return;
  std::size_t used = 0;
  if (!bytes.empty() && is_magic(bytes.front()) && parse_at(bytes, used) == Step::frame) sealed_ = kept_.size();
  kept_.insert(kept_.end(), bytes.begin(), bytes.end());
  input_ = kept_;
}

/// Goes on to the next frame in `input_`; false when there is none that is complete.
bool FrameParser::next() {
  while (!input_.empty()) {
    auto const visible = sealed_ > 0 ? input_.first(sealed_) : input_;
    std::size_t used = 0;
    auto step = Step::skip;
    if (is_magic(visible.front()))
      step = parse_at(visible, used);
    else
      used = static_cast<std::size_t>(std::ranges::find_if(visible, is_magic) - visible.begin());
    if (step == Step::need_more) {
      if (sealed_ == 0) return false;
      step = Step::skip;
    }
    input_ = input_.subspan(used);
    sealed_ -= std::min(sealed_, used);
    if (step == Step::frame) {
      ++counters_.frames;
      if (!view_.traits) ++counters_.unknown_ids;
      return true;
    }
    if (step == Step::bad_checksum) ++counters_.crc_errors;
    counters_.junk_bytes += used;
  }
  return false;
}

void FrameParser::keep_rest() {
  if (input_.empty()) {
    kept_.clear();
    return;
  }
  // The rest may lie in kept_ itself, so it is taken out before kept_ changes.
  std::array<std::uint8_t, max_frame_size> rest;
  auto const size = input_.size();
  std::ranges::copy(input_, rest.begin());
  kept_.assign(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(size));
  input_ = {};
}

/// Reads the frame that begins with the magic at `at`. `used`: its bytes, or 1 to look on behind a magic that began
/// none.
FrameParser::Step FrameParser::parse_at(std::span<std::uint8_t const> at, std::size_t& used) {
  used = 1;
  if (at.size() < 3) return Step::need_more;
  bool const v2 = at[0] == magic_v2;
  if (v2 && (at[2] & ~flag_signed) != 0) return Step::skip;
  bool const is_signed = v2 && at[2] == flag_signed;
  std::size_t const header = v2 ? header_v2 : header_v1;
  std::size_t const checksum_at = header + at[1];
  std::size_t const total = checksum_at + checksum_size + (is_signed ? frame_.signature.size() : 0);
  if (at.size() < total) return Step::need_more;

  auto const id = v2 ? little_endian_24(&at[7]) : at[5];
  auto const checksum = static_cast<std::uint16_t>(at[checksum_at] | at[checksum_at + 1] << 8U);
  auto const sum = crc_accumulate(at.subspan(1, checksum_at - 1));
  auto const* traits = find_traits(id);
  if (!checksum_fits(checksum, sum, traits)) return Step::bad_checksum;

  view_ = {.bytes = at.first(total),
           .payload = at.subspan(header, at[1]),
           .message_id = id,
           .checksum = checksum,
           .version = static_cast<std::uint8_t>(v2 ? 2 : 1),
           .seq = at[header - (v2 ? 6U : 4U)],
           .source = {at[header - (v2 ? 5U : 3U)], at[header - (v2 ? 4U : 2U)]},
           .traits = traits};
  used = total;
  return Step::frame;
}

void FrameParser::unpack(FrameView const& view) {
  bool const v2 = view.version == 2;
  frame_.version = view.version;
  frame_.incompat_flags = v2 ? view.bytes[2] : std::uint8_t{0};
  frame_.compat_flags = v2 ? view.bytes[3] : std::uint8_t{0};
  frame_.seq = view.seq;
  frame_.source = view.source;
  frame_.message_id = view.message_id;
  frame_.checksum = view.checksum;
  take_payload(view.payload);
  if (frame_.is_signed()) std::ranges::copy(view.bytes.last(frame_.signature.size()), frame_.signature.begin());
}

/// Behind `payload_size` the frame's payload is always zero, so only what the last frame left there is cleared.
void FrameParser::take_payload(std::span<std::uint8_t const> payload) {
  auto const end = std::ranges::copy(payload, frame_.payload.begin()).out;
  auto const old_end = frame_.payload.begin() + frame_.payload_size;
  if (end < old_end) std::fill(end, old_end, std::uint8_t{0});
  frame_.payload_size = static_cast<std::uint8_t>(payload.size());
}

}  // namespace lapwing::mavlink
