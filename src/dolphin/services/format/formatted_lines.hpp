#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::dolphin {

/// One line of a formatted script before comments at its end are placed.
struct FormattedLine {
  std::size_t indent = 0;  ///< blanks
  std::string code = {};   ///< may hold line ends: text in triple quotes, long comments
  std::string comment = {};
  std::size_t comment_column = 0;  ///< where the comment began in the text that is formatted
  std::size_t comment_gap = 1;     ///< blanks before it there
  bool is_after_blank_line = false;
};

/// How many columns the last line of `text` takes; tabs go to multiples of 4.
[[nodiscard]] std::size_t width_of_last_line(std::string_view text);

/// The lines as a text. Comments that began in one column on lines that follow each other begin in one column again.
[[nodiscard]] std::string join_lines(std::vector<FormattedLine> const& lines);

}  // namespace lapwing::dolphin
