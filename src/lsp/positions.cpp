#include "lsp/positions.hpp"

#include <algorithm>

namespace lapwing::lsp {

namespace {

/// How many UTF-16 units the character takes whose first byte this is; 0 for the other bytes of a character.
std::uint32_t units_of(char byte) {
  auto const c = static_cast<unsigned char>(byte);
  if ((c & 0xC0u) == 0x80u) return 0;
  return c >= 0xF0u ? 2 : 1;
}

std::uint32_t units_of(std::string_view text) {
  std::uint32_t out = 0;
  for (char const c : text) out += units_of(c);
  return out;
}

}  // namespace

Position Positions::of(std::uint32_t offset) {
  offset = std::min(offset, static_cast<std::uint32_t>(source_.text().size()));
  if (line_number_ == 0 || offset < last_offset_ || offset > line_.end) {
    line_number_ = source_.line(offset);
    line_ = source_.line_span(line_number_);
    last_offset_ = line_.begin;
    last_character_ = 0;
  }
  auto const end = std::clamp(offset, last_offset_, std::max(last_offset_, line_.end));
  last_character_ += units_of(source_.text({last_offset_, end}));
  last_offset_ = end;
  return {line_number_ - 1, last_character_};
}

std::uint32_t Positions::offset(Position position) const {
  if (position.line >= source_.line_count()) return static_cast<std::uint32_t>(source_.text().size());
  auto const line = source_.line_span(position.line + 1);
  return line.begin + offset_of_unit(source_.text(line), position.character);
}

std::uint32_t offset_of_unit(std::string_view line, std::uint32_t unit) {
  std::uint32_t units = 0;
  std::uint32_t at = 0;
  while (at < line.size() && units < unit) {
    units += units_of(line[at++]);
    while (at < line.size() && units_of(line[at]) == 0) ++at;
  }
  return at;
}

}  // namespace lapwing::lsp
