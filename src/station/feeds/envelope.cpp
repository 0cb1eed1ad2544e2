#include "station/feeds/envelope.hpp"

#include <utility>

#include <fmt/format.h>

#include "base/assert.hpp"

namespace lapwing::station {

namespace {

constexpr char binary_format = 1;
constexpr char whole_flag = 1;

template <class T>
void append_little_endian(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes += static_cast<char>(value >> 8U * i & 0xFFU);
}

}  // namespace

std::string in_envelope(Frame frame, Envelope const& envelope) {
  if (frame.is_binary) {
    std::string bytes{binary_format, envelope.begins_whole ? whole_flag : '\0'};
    bytes.reserve(binary_header_size + frame.content.size());
    append_little_endian(bytes, envelope.feed_id);
    append_little_endian(bytes, std::uint32_t{0});  // so that what follows is aligned for numbers of 8 bytes
    append_little_endian(bytes, envelope.revision);
    return bytes.append(frame.content);
  }
  auto text = std::move(frame.content);
  LAPWING_ASSERT(text.ends_with('}'), envelope.feed);
  text.pop_back();
  text += fmt::format(R"(,"feed":"{}","revision":{}{}}})", envelope.feed, envelope.revision,
                      envelope.begins_whole ? R"(,"whole":true)" : "");
  return text;
}

}  // namespace lapwing::station
