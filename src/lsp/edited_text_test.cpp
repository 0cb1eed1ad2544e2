#include "lsp/edited_text.hpp"

#include <gtest/gtest.h>

#include <random>

#include "base/text/source.hpp"

namespace lapwing::lsp {
namespace {

/// Two lines; ä takes 2 bytes and 1 unit, the bird 4 bytes and 2 units.
EditedText changed(Position begin, Position end, std::string_view replacement) {
  EditedText out("aä🐦b\r\nxyz");
  out.replace(begin, end, replacement);
  return out;
}

TEST(EditedText, ReplacesParts) {
  EXPECT_EQ(changed({0, 2}, {0, 4}, "-").text(), "aä-b\r\nxyz");
  EXPECT_EQ(changed({0, 5}, {1, 1}, "").text(), "aä🐦byz");
  EXPECT_EQ(changed({9, 9}, {9, 9}, "!").text(), "aä🐦b\r\nxyz!");
  EXPECT_EQ(changed({1, 2}, {0, 0}, "?").text(), "aä🐦b\r\nxy?z") << "a range that ends before it begins is empty";
}

std::vector<std::uint32_t> lines_of(std::string const& text) {
  base::SourceFile const source("test", text);
  std::vector<std::uint32_t> out;
  for (std::uint32_t line = 1; line <= source.line_count(); ++line) out.push_back(source.line_span(line).begin);
  return out;
}

/// Line ends that grow together and fall apart are where it is easy to be wrong.
TEST(EditedText, KnowsItsLinesAfterAnyChange) {
  std::mt19937 random(7);
  auto const pick = [&](std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random);
  };
  constexpr std::string_view pieces[] = {"\r", "\n", "\r\n", "a", "ab\n", "", "\n\r", "x\ry"};
  EditedText edited("a\r\nb\n\rc");
  for (int i = 0; i < 3000; ++i) {
    Position const begin{pick(6), pick(4)};
    Position const end{begin.line + pick(3), pick(4)};
    std::string expected(edited.text());
    auto const from = edited.offset(begin);
    auto const to = std::max(from, edited.offset(end));
    auto const piece = pieces[pick(std::size(pieces))];
    expected.replace(from, to - from, piece);
    edited.replace(begin, end, piece);
    ASSERT_EQ(edited.text(), expected);
    ASSERT_EQ(edited.line_starts(), lines_of(expected)) << i;
    if (expected.size() > 40) edited = EditedText(expected.substr(20));
  }
}

}  // namespace
}  // namespace lapwing::lsp
