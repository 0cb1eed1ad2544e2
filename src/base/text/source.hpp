#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lapwing::base {

/// A range of bytes in one source text: [begin, end).
struct Span {
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  [[nodiscard]] constexpr std::uint32_t size() const { return end - begin; }
  [[nodiscard]] constexpr bool contains(std::uint32_t offset) const { return begin <= offset && offset < end; }
  friend constexpr bool operator==(Span, Span) = default;
};

/// The smallest span that holds both.
[[nodiscard]] constexpr Span cover(Span a, Span b) {
  return {a.begin < b.begin ? a.begin : b.begin, a.end > b.end ? a.end : b.end};
}

/// A place for people: both count from 1; columns count characters (code points), not bytes.
struct LineColumn {
  std::uint32_t line = 1;
  std::uint32_t column = 1;
  friend constexpr bool operator==(LineColumn, LineColumn) = default;
};

/// A text a person wrote (script, configuration) with the name it goes by in messages. Immutable; spans point into it.
/// LF, CRLF and CR end a line. Texts beyond 4 GiB are not supported: check the size before reading.
class SourceFile {
 public:
  SourceFile(std::string name, std::string text);

  [[nodiscard]] std::string const& name() const { return name_; }
  [[nodiscard]] std::string_view text() const { return text_; }
  [[nodiscard]] std::string_view text(Span span) const;

  [[nodiscard]] std::size_t line_count() const { return line_starts_.size(); }
  /// The line of a byte offset, from 1; offsets beyond the end count as the end. Logarithmic in the number of lines.
  [[nodiscard]] std::uint32_t line(std::uint32_t offset) const;
  /// The place of a byte offset. Counts the characters of its line: for messages, not for every node of a tree.
  [[nodiscard]] LineColumn place(std::uint32_t offset) const;
  /// The bytes of line `line` (from 1) without its line end; an empty span at the end of the text for lines it does not
  /// have.
  [[nodiscard]] Span line_span(std::uint32_t line) const;

 private:
  std::string name_;
  std::string text_;
  std::vector<std::uint32_t> line_starts_;
};

}  // namespace lapwing::base
