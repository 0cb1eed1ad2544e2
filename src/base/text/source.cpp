#include "base/text/source.hpp"

#include <algorithm>

namespace lapwing::base {

namespace {

bool continues_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
}

}  // namespace

SourceFile::SourceFile(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  line_starts_.push_back(0);
  for (std::size_t i = 0; i < text_.size(); ++i) {
    bool const carriage_return = text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
    if (text_[i] == '\n' || carriage_return) line_starts_.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::string_view SourceFile::text(Span span) const {
  auto const begin = std::min<std::size_t>(span.begin, text_.size());
  auto const end = std::clamp<std::size_t>(span.end, begin, text_.size());
  return std::string_view(text_).substr(begin, end - begin);
}

std::uint32_t SourceFile::line(std::uint32_t offset) const {
  offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
  auto const after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  return static_cast<std::uint32_t>(after - line_starts_.begin());
}

LineColumn SourceFile::place(std::uint32_t offset) const {
  auto const line_number = line(offset);
  auto const before = text({line_starts_[line_number - 1], offset});
  auto const characters = std::count_if(before.begin(), before.end(), [](char c) { return !continues_character(c); });
  return {line_number, static_cast<std::uint32_t>(characters) + 1};
}

Span SourceFile::line_span(std::uint32_t line) const {
  auto const size = static_cast<std::uint32_t>(text_.size());
  if (line == 0 || line > line_starts_.size()) return {size, size};
  auto const begin = line_starts_[line - 1];
  auto end = line < line_starts_.size() ? line_starts_[line] : size;
  while (end > begin && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;
  return {begin, end};
}

}  // namespace lapwing::base
