#pragma once

#include <cstdint>
#include <string_view>

#include "base/text/source.hpp"

namespace lapwing::lsp {

/// A place as LSP counts: lines from 0, characters in UTF-16 code units from 0.
struct Position {
  std::uint32_t line = 0;
  std::uint32_t character = 0;
  friend constexpr bool operator==(Position, Position) = default;
};

/// Converts places of one text. Places that are asked for in rising order cost no more than reading the text once.
class Positions {
 public:
  explicit Positions(base::SourceFile const& source) : source_(source) {}

  [[nodiscard]] Position of(std::uint32_t offset);
  /// Characters beyond the end of a line count as its end, lines beyond the text as its end.
  [[nodiscard]] std::uint32_t offset(Position position) const;

 private:
  base::SourceFile const& source_;
  base::Span line_;  ///< of the last place, with its line end
  std::uint32_t line_number_ = 0;
  std::uint32_t last_offset_ = 0;
  std::uint32_t last_character_ = 0;
};

/// The byte of a line at which the UTF-16 unit begins, or the line's end; the middle of a character counts as its end.
[[nodiscard]] std::uint32_t offset_of_unit(std::string_view line, std::uint32_t unit);

}  // namespace lapwing::lsp
