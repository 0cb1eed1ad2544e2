#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/positions.hpp"

namespace lapwing::lsp {

/// The text of an open script while somebody types: a change costs what it puts in, and the moving of what stands
/// behind it, however long the script is. Lines end as in base::SourceFile.
class EditedText {
 public:
  explicit EditedText(std::string text = {});

  [[nodiscard]] std::string const& text() const { return text_; }
  [[nodiscard]] std::vector<std::uint32_t> const& line_starts() const { return line_starts_; }
  /// Characters beyond the end of a line count as its end, lines beyond the text as its end.
  [[nodiscard]] std::uint32_t offset(Position position) const;
  /// A range that ends before it begins is empty.
  void replace(Position begin, Position end, std::string_view replacement);

 private:
  void find_lines(std::size_t begin, std::size_t end, std::vector<std::uint32_t>& starts) const;

  std::string text_;
  std::vector<std::uint32_t> line_starts_;
};

}  // namespace lapwing::lsp
