#include "dolphin/services/format/formatted_lines.hpp"

#include <algorithm>

namespace lapwing::dolphin {

namespace {

constexpr std::size_t tab_width = 4;

std::size_t width(FormattedLine const& line) {
  return line.code.contains('\n') ? width_of_last_line(line.code) : line.indent + width_of_last_line(line.code);
}

/// The end of the run of lines whose comments began in the same column.
std::size_t end_of_run(std::vector<FormattedLine> const& lines, std::size_t begin) {
  auto const belongs = [&](FormattedLine const& line) {
    return !line.comment.empty() && line.comment_column == lines[begin].comment_column && !line.is_after_blank_line;
  };
  auto end = begin + 1;
  while (end < lines.size() && belongs(lines[end])) ++end;
  return end;
}

std::size_t column_of_run(std::vector<FormattedLine> const& lines, std::size_t begin, std::size_t end) {
  std::size_t longest = 0;
  auto gap = lines[begin].comment_gap;
  for (auto i = begin; i < end; ++i) {
    longest = std::max(longest, width(lines[i]));
    gap = std::min(gap, lines[i].comment_gap);
  }
  return longest + std::max<std::size_t>(gap, 1);
}

}  // namespace

std::size_t width_of_last_line(std::string_view text) {
  auto const line_end = text.find_last_of("\n\r");
  if (line_end != std::string_view::npos) text.remove_prefix(line_end + 1);
  std::size_t out = 0;
  for (char const c : text) {
    bool const continues_character = (static_cast<unsigned char>(c) & 0xC0u) == 0x80u;
    if (!continues_character) out += c == '\t' ? tab_width - out % tab_width : 1;
  }
  return out;
}

std::string join_lines(std::vector<FormattedLine> const& lines) {
  std::string out;
  std::size_t run_end = 0;
  std::size_t column = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    auto const& line = lines[i];
    if (line.is_after_blank_line) out += '\n';
    out.append(line.indent, ' ').append(line.code);
    if (!line.comment.empty()) {
      if (i >= run_end) {
        run_end = end_of_run(lines, i);
        column = column_of_run(lines, i, run_end);
      }
      out.append(column - width(line), ' ').append(line.comment);
    }
    out += '\n';
  }
  return out;
}

}  // namespace lapwing::dolphin
