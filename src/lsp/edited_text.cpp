#include "lsp/edited_text.hpp"

#include <algorithm>
#include <utility>

namespace lapwing::lsp {

EditedText::EditedText(std::string text) : text_(std::move(text)), line_starts_{0} {
  find_lines(0, text_.size(), line_starts_);
}

/// Appends the lines that begin behind a line end in [begin, end).
void EditedText::find_lines(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& starts) const {
  for (auto i = begin; i < end; ++i) {
    bool const carriage_return = text_[i] == '\r' && (i + 1 == text_.size() || text_[i + 1] != '\n');
    if (text_[i] == '\n' || carriage_return) starts.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

std::uint32_t EditedText::offset(Position position) const {
  auto const size = static_cast<std::uint32_t>(text_.size());
  if (position.line >= line_starts_.size()) return size;
  auto const begin = line_starts_[position.line];
  auto end = position.line + 1 < line_starts_.size() ? line_starts_[position.line + 1] : size;
  while (end > begin && (text_[end - 1] == '\n' || text_[end - 1] == '\r')) --end;
  return begin + offset_of_unit(std::string_view(text_).substr(begin, end - begin), position.character);
}

void EditedText::replace(Position begin, Position end, std::string_view replacement) {
  auto const from = offset(begin);
  auto const to = std::max(from, offset(end));
  text_.replace(from, to - from, replacement);
  // Line ends before the character in front of the change, and those behind it, are what they were.
  auto const first = std::ranges::upper_bound(line_starts_, from == 0 ? 0 : from - 1);
  auto const behind = std::ranges::upper_bound(line_starts_, to);
  std::vector<std::uint32_t> found;
  auto const end_of_new = from + replacement.size();
  find_lines(from == 0 ? 0 : from - 1, end_of_new, found);
  auto const moved = static_cast<std::uint32_t>(end_of_new) - to;  // may wrap, as it should
  std::for_each(behind, line_starts_.end(), [&](std::uint32_t& start) { start += moved; });
  auto const at = line_starts_.erase(first, behind);
  line_starts_.insert(at, found.begin(), found.end());
}

}  // namespace lapwing::lsp
