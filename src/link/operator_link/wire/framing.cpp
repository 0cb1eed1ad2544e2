#include "link/operator_link/wire/framing.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include "base/assert.hpp"
#include "link/operator_link/wire/byte_order.hpp"

namespace lapwing::link::operator_link {

namespace {

constexpr std::uint8_t magic[] = {'L', 'W'};
constexpr std::size_t crc_at = 8;
/// What the CRC covers of the header: version, type and length.
constexpr std::size_t covered_from = 2;

std::uint32_t frame_crc(Bytes header, Bytes body) {
  return crc32(body, crc32(header.subspan(covered_from, crc_at - covered_from)));
}

std::unexpected<base::Error> fault(std::string what) {
  return base::fail(base::ErrorKind::invalid_input, std::move(what),
                    "The far end must speak Lapwing's operator link, or this end its JSON mode.");
}

}  // namespace

std::uint32_t crc32(Bytes bytes, std::uint32_t before) {
  if (bytes.empty()) return before;  // of which zlib would begin anew
  return static_cast<std::uint32_t>(::crc32(before, bytes.data(), static_cast<uInt>(bytes.size())));
}

void write_frame(std::vector<std::uint8_t>& to, FrameType type, Bytes body) {
  LAPWING_ASSERT(body.size() <= longest_body, body.size());
  auto const begin = to.size();
  ByteWriter writer(to);
  to.insert(to.end(), std::begin(magic), std::end(magic));
  writer.number(framing_version);
  writer.number(static_cast<std::uint8_t>(type));
  writer.number(static_cast<std::uint32_t>(body.size()));
  writer.number(frame_crc(Bytes(to).subspan(begin, crc_at), body));
  to.insert(to.end(), body.begin(), body.end());
}

void FrameReader::feed(Bytes bytes) {
  if (begin_ > 0) {
    buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
    begin_ = 0;
  }
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
}

base::Result<std::optional<Frame>> FrameReader::next() {
  auto const rest = Bytes(buffer_).subspan(begin_);
  for (std::size_t i = 0; i < std::size(magic) && i < rest.size(); ++i)
    if (rest[i] != magic[i])
      return fault(fmt::format("a frame begins with byte 0x{:02x} where 0x{:02x} belongs", rest[i], magic[i]));
  if (rest.size() > covered_from && rest[covered_from] != framing_version)
    return fault(
        fmt::format("frames of version {}; this program reads version {}", rest[covered_from], framing_version));
  if (rest.size() < frame_header_bytes) return std::optional<Frame>();
  ByteReader reader(rest.subspan(covered_from + 1, frame_header_bytes - covered_from - 1));
  auto const type = reader.number<std::uint8_t>();
  auto const length = reader.number<std::uint32_t>();
  auto const crc = reader.number<std::uint32_t>();
  if (length > longest_) return fault(fmt::format("a frame of {} bytes where {} are allowed", length, longest_));
  if (rest.size() < frame_header_bytes + length) return std::optional<Frame>();
  auto const body = rest.subspan(frame_header_bytes, length);
  if (frame_crc(rest, body) != crc) return fault("a frame does not match its CRC");
  begin_ += frame_header_bytes + length;
  return Frame{static_cast<FrameType>(type), body};
}

}  // namespace lapwing::link::operator_link
