#include "dolphin/syntax/lexer.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "dolphin/syntax/characters.hpp"

namespace lapwing::dolphin {
namespace {

using enum TokenKind;

struct Lexed {
  std::vector<TokenKind> kinds;
  std::vector<std::string> texts;
  std::size_t errors;
  std::string complaints;
};

Lexed lexed(std::string text) {
  base::SourceFile const source("t", std::move(text));
  base::Diagnostics diagnostics(source);
  Lexed out{};
  for (auto const& token : lex(diagnostics).tokens) {
    out.kinds.push_back(token.kind);
    out.texts.emplace_back(source.text(token.span));
  }
  out.kinds.pop_back();
  out.texts.pop_back();
  out.errors = diagnostics.error_count();
  out.complaints = render(diagnostics);
  return out;
}

using Kinds = std::vector<TokenKind>;
using Texts = std::vector<std::string>;

TEST(Lexer, TellsUnitsDecimalsAndRangesApart) {
  EXPECT_EQ(lexed("10.minutes").kinds, (Kinds{integer, dot, identifier}));
  EXPECT_EQ(lexed("2.5.km").texts, (Texts{"2.5", ".", "km"}));
  EXPECT_EQ(lexed("1..3").kinds, (Kinds{integer, range, integer}));
  EXPECT_EQ(lexed("a..<b").kinds, (Kinds{identifier, range_exclusive, identifier}));
  EXPECT_EQ(lexed("1e3 1.0e-3 2E+4").kinds, (Kinds{decimal, decimal, decimal}));
  EXPECT_EQ(lexed("1_000 0x1F 0b101 7L 3g 2d 1.5f").kinds,
            (Kinds{integer, integer, integer, integer, integer, decimal, decimal}));
}

TEST(Lexer, ReportsWhatCannotFollowANumber) {
  auto const out = lexed("10km 5");
  EXPECT_EQ(out.kinds, (Kinds{integer, integer}));
  EXPECT_EQ(out.errors, 1U);
}

TEST(Lexer, SkipsByteOrderMarkFirstLineAndComments) {
  EXPECT_EQ(lexed("\xEF\xBB\xBF#!/usr/bin/env lapwing\nx // c\n/* y\n */ z").texts, (Texts{"x", "z"}));
}

TEST(Lexer, JoinsLinesAfterABackslash) {
  base::SourceFile const source("t", "a \\\n b\r\nc");
  base::Diagnostics diagnostics(source);
  auto const tokens = lex(diagnostics).tokens;
  EXPECT_FALSE(tokens[1].newline_before);
  EXPECT_TRUE(tokens[2].newline_before);
}

TEST(Lexer, TakesStringsWithoutInterpolationAsOneToken) {
  EXPECT_EQ(lexed(R"('a\'b' "c\$d" """e
"f" """ '''g''' "$ 5")")
                .kinds,
            (Kinds{string, string, string, string, string}));
}

TEST(Lexer, OpensInterpolationsAndNestsThem) {
  EXPECT_EQ(lexed(R"("n=${a} $x.y.")").kinds,
            (Kinds{string_open, string_text, interpolation_open, identifier, interpolation_close, string_text,
                   interpolation_name, string_text, string_close}));
  EXPECT_EQ(lexed(R"("${[1].each { "<${it}>" }}")").errors, 0U);
  EXPECT_EQ(lexed(R"("$x.y.")").texts, (Texts{"\"", "$x.y", ".", "\""}));
}

TEST(Lexer, ClosesWhatTheTextLeavesOpen) {
  EXPECT_EQ(lexed("'abc\nx").kinds, (Kinds{string, identifier}));
  EXPECT_EQ(lexed("\"abc\nx").kinds, (Kinds{string, identifier}));
  EXPECT_EQ(lexed("\"${a\nx").kinds,
            (Kinds{string_open, interpolation_open, identifier, interpolation_close, string_close, identifier}));
  EXPECT_EQ(lexed("'''abc\nx").kinds, (Kinds{string}));
  for (auto const* text : {"'", "\"", "'''", "\"\"\"", "\"$x", "\"${", "\"${'", "\"\"\"${\n", "/*", "/* /* */ /*",
                           "'\\", "\"\\", "\"${\"${"}) {
    EXPECT_GE(lexed(text).errors, 1U) << text;
  }
}

TEST(Lexer, MatchesBracketsAndLeavesOutThoseThatCloseNothing) {
  base::SourceFile const source("t", "f(a [1)\n) }");
  base::Diagnostics diagnostics(source);
  auto const tokens = lex(diagnostics).tokens;
  ASSERT_EQ(tokens.size(), 7U);
  EXPECT_EQ(tokens[1].partner, 5U);
  EXPECT_EQ(tokens[5].partner, 1U);
  EXPECT_EQ(tokens[3].partner, Token::unclosed);
  EXPECT_EQ(diagnostics.error_count(), 3U);
}

TEST(Lexer, KeepsBracketsOfAnInterpolationToItself) {
  auto const out = lexed("f(\"${)}\")");
  EXPECT_EQ(out.errors, 1U) << out.complaints;
  EXPECT_EQ(out.kinds.back(), right_paren);
}

TEST(Lexer, TakesLettersOfAnyScript) {
  EXPECT_EQ(lexed("größe _x ñ1 日本").kinds, (Kinds{identifier, identifier, identifier, identifier}));
  EXPECT_EQ(lexed("a\xC2\xA0"
                  "b")
                .texts,
            (Texts{"a", "b"}));
  EXPECT_EQ(lexed("a \xFF\xFE b").errors, 1U);
  EXPECT_EQ(lexed(std::string("a \0\0 b", 6)).errors, 1U);
}

/// Everything between tokens is blank, comment or reported.
void expect_source_back(std::string text) {
  base::SourceFile const source("t", std::move(text));
  base::Diagnostics diagnostics(source);
  auto const stream = lex(diagnostics);
  std::string out;
  std::uint32_t at = 0;
  for (auto const& token : stream.tokens) {
    ASSERT_LE(at, token.span.begin);
    ASSERT_LE(token.span.begin, token.span.end);
    auto const gap = source.text({at, token.span.begin});
    bool const is_plain = gap.find_first_not_of(" \t\r\n\f\v\\") == std::string_view::npos;
    bool const has_comment = gap.contains("//") || gap.contains("/*") || gap.contains("#!");
    EXPECT_TRUE(is_plain || has_comment || diagnostics.has_errors()) << gap;
    out += gap;
    out += source.text(token.span);
    at = token.span.end;
  }
  EXPECT_EQ(out, source.text());
}

TEST(Lexer, GivesTheSourceBackFromTokensAndGaps) {
  namespace fs = std::filesystem;
  for (auto const* folder : {"tests/golden/check", "examples"}) {
    for (auto const& entry : fs::directory_iterator(fs::path(LAPWING_SOURCE_DIR) / folder)) {
      std::ifstream in(entry.path(), std::ios::binary);
      std::ostringstream text;
      text << in.rdbuf();
      expect_source_back(text.str());
    }
  }
}

TEST(Lexer, GivesTheSourceBackFromRandomPieces) {
  std::vector<std::string> const pieces = {"\"", "'",  "\"\"\"", "'''",  "${",   "}",  "{",  "(",   ")",  "[", "]",
                                           "$x", "a",  "1",      ".",    "..",   "\n", " ",  "\\",  "/",  "*", "//",
                                           "/*", "*/", "->",     "ä",    "=",    "\r", ">>", "?",   ":",  "#", "@",
                                           ",",  ";",  "def",    "1e3x", "\xFF", "~",  "$ ", "===", "/x/"};
  std::mt19937 random(7);
  for (int round = 0; round < 2000; ++round) {
    std::string text;
    for (int i = 0; i < 20; ++i) text += pieces[random() % pieces.size()];
    expect_source_back(text);
    if (HasFailure()) FAIL() << text;
  }
}

TEST(Lexer, SaysOnceThatAFileIsUtf16) {
  std::string wide("\xFF\xFE", 2);
  for (char const c : std::string_view("message 'north'\n")) wide += {c, '\0'};
  EXPECT_EQ(lexed(wide).errors, 1U);
  EXPECT_NE(lexed(wide).complaints.find("this file is saved as UTF-16"), std::string::npos);
  EXPECT_NE(lexed(wide.substr(2)).complaints.find("this file is saved as UTF-16"), std::string::npos);
}

TEST(Lexer, TellsPatternsFromDivisions) {
  EXPECT_EQ(lexed("x = /a b/").texts, (Texts{"x", "=", "/a b/"}));
  EXPECT_EQ(lexed("f(/a\\/b/, /c/)").texts, (Texts{"f", "(", "/a\\/b/", ",", "/c/", ")"}));
  EXPECT_EQ(lexed("t ==~ /a/").kinds, (Kinds{identifier, full_match, pattern}));
  EXPECT_EQ(lexed("x = a / b / c").kinds,
            (Kinds{identifier, assign, identifier, slash, identifier, slash, identifier}));
  EXPECT_EQ(lexed("x = (a\n / b / c)").errors, 0U);
  EXPECT_EQ(lexed("t / { c } / { d }").kinds.size(), 9U);
  EXPECT_EQ(lexed("x = /a\nb/").kinds, (Kinds{identifier, assign, slash, identifier, identifier, slash}));
}

TEST(Lexer, RefusesTextsThatAreTooLong) {
  EXPECT_EQ(lexed(std::string(max_source_size + 1, ' ')).errors, 1U);
  EXPECT_EQ(lexed(std::string(max_token_count + 10, ',')).errors, 1U);
}

TEST(Characters, AreMadeUtf8) {
  EXPECT_EQ(as_utf8("a\xFF\xC3z\xC3\xA4"), "a\uFFFD\uFFFDzä");
  EXPECT_EQ(as_utf8(""), "");
}

}  // namespace
}  // namespace lapwing::dolphin
