#include "dolphin/syntax/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "dolphin/check/signs.hpp"
#include "dolphin/syntax/characters.hpp"
#include "dolphin/syntax/codes.hpp"
#include "dolphin/syntax/internal/brackets.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;
using enum TokenKind;

/// A string whose interpolation is being read.
struct OpenString {
  Span quotes;
  std::size_t quote_size;       ///< 1 or 3
  std::size_t open_braces = 0;  ///< of closures inside the interpolation
  Span interpolation;
};

class Lexer {
 public:
  explicit Lexer(base::Diagnostics& diagnostics) : diagnostics_(diagnostics), text_(diagnostics.source().text()) {}

  TokenStream run();

 private:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] bool looking_at(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  [[nodiscard]] Span since(std::size_t begin) const {
    return {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(at_)};
  }
  void emit(TokenKind kind, std::size_t begin);

  void skip_first_line();
  bool skip_blanks();
  bool skip_line_end();
  void skip_line_comment();
  void skip_block_comment();
  void note_inner_comment(std::size_t begin);
  void close_no_comment();
  void skip_unreadable();
  [[nodiscard]] bool is_unreadable() const;
  void read_typographic_string(Unreadable const& quote);

  void read_token();
  void read_word();
  void read_number();
  void read_operator();
  bool read_foreign_operator();
  bool read_pattern();
  void refuse_utf16();
  void read_plain_string(std::size_t quote_size);
  void read_double_quoted(std::size_t quote_size);
  void read_string_text();
  void close_interpolation(std::size_t begin);
  void abandon_open_strings();

  [[nodiscard]] bool at_quotes(char quote, std::size_t size) const;
  [[nodiscard]] bool at_interpolation() const;
  void step_over_string_character();

  base::Diagnostics& diagnostics_;
  std::string_view text_;
  std::size_t at_ = 0;
  TokenStream out_;
  std::vector<OpenString> open_;
  /// The last comment, when another seems to begin in it.
  struct InnerComment {
    std::size_t begin;
    std::size_t end;     ///< of both
    std::size_t tokens;  ///< before it
  };
  std::optional<InnerComment> inner_comment_;
  bool newline_before_ = true;
};

void Lexer::emit(TokenKind kind, std::size_t begin) {
  auto const previous_end = out_.tokens.empty() ? 0 : out_.tokens.back().span.end;
  Token token;
  token.kind = kind;
  token.newline_before = std::exchange(newline_before_, false);
  token.blank_before = previous_end != begin;
  token.span = since(begin);
  out_.tokens.push_back(token);
}

// ---- what is skipped ----------------------------------------------------------------------------

void Lexer::skip_first_line() {
  if (looking_at("\xEF\xBB\xBF")) at_ += 3;
  if (looking_at("#!")) skip_line_comment();
}

/// True when something was skipped.
bool Lexer::skip_line_end() {
  if (peek() != '\n' && peek() != '\r') return false;
  at_ += looking_at("\r\n") ? 2 : 1;
  return true;
}

void Lexer::skip_line_comment() {
  auto const begin = at_;
  while (!at_end() && peek() != '\n' && peek() != '\r') ++at_;
  out_.comments.push_back(since(begin));
}

void Lexer::skip_block_comment() {
  auto const begin = at_;
  auto const end = text_.find("*/", at_ + 2);
  at_ = end == std::string_view::npos ? text_.size() : end + 2;
  if (end != std::string_view::npos) note_inner_comment(begin);
  auto const comment = since(begin);
  if (end == std::string_view::npos) {
    diagnostics_.report(code("unclosed-comment"), {comment.begin, comment.begin + 2}, "this comment is never closed",
                        "close it with */");
  }
  if (text_.substr(comment.begin, comment.size()).find_first_of("\r\n") != std::string_view::npos)
    newline_before_ = true;
  out_.comments.push_back(comment);
}

/// Comments do not nest: in /* a /* b */ c */ the first */ ends both, and the last one closes nothing. What stands
/// between them is then passed over, as it was meant to be.
void Lexer::note_inner_comment(std::size_t begin) {
  auto const inner = text_.substr(0, at_).find("/*", begin + 2);
  bool const is_there = inner != std::string_view::npos && inner + 2 < at_;
  inner_comment_.reset();
  if (is_there && open_.empty()) inner_comment_ = InnerComment{inner, at_, out_.tokens.size()};
}

void Lexer::close_no_comment() {
  auto const begin = at_;
  at_ += 2;
  if (!inner_comment_) {
    diagnostics_.report(code("nested-comment"), since(begin), "this */ closes no comment");
    return emit(invalid, begin);
  }
  auto const place = [](std::size_t at) {
    return Span{static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(at + 2)};
  };
  diagnostics_.report(code("nested-comment"), place(inner_comment_->begin), "a comment cannot stand in a comment",
                      "// begins one that ends with its line", {{place(inner_comment_->end - 2), "both end here"}});
  out_.tokens.resize(inner_comment_->tokens);
  newline_before_ = true;
  inner_comment_.reset();
}

/// Blanks, comments and line ends before the next token. False when an open interpolation ends with its line.
bool Lexer::skip_blanks() {
  while (!at_end()) {
    auto const c = peek();
    if (c == '\n' || c == '\r') {
      if (!open_.empty() && open_.back().quote_size == 1) return false;
      skip_line_end();
      newline_before_ = true;
    } else if (auto const blank = blank_size(text_.substr(at_)); blank > 0) {
      at_ += blank;
    } else if (c == '/' && peek(1) == '/') {
      skip_line_comment();
    } else if (c == '/' && peek(1) == '*') {
      skip_block_comment();
    } else if (c == '\\' && (peek(1) == '\n' || peek(1) == '\r')) {
      ++at_;
      skip_line_end();
    } else {
      return true;
    }
  }
  return open_.empty();
}

/// A run of characters that no script has, as one mistake. Typographic quotes and dashes still mean what they look
/// like.
void Lexer::skip_unreadable() {
  auto const begin = at_;
  auto const first = unreadable_character(text_.substr(at_));
  if (first.looks_like == Unreadable::Like::quote) return read_typographic_string(first);
  if (first.looks_like == Unreadable::Like::dash) {
    at_ += first.size;
    diagnostics_.report(code("invalid-character"), since(begin), std::string(first.message),
                        {std::string(first.hint), {{since(begin), "-"}}});
    return emit(minus, begin);
  }
  do {
    at_ += unreadable_character(text_.substr(at_)).size;
  } while (!at_end() && is_unreadable() && unreadable_character(text_.substr(at_)).message == first.message);
  diagnostics_.report(code("invalid-character"), since(begin), std::string(first.message), std::string(first.hint));
  if (first.looks_like == Unreadable::Like::comment) return skip_line_comment();
  if (first.looks_like != Unreadable::Like::blank) emit(invalid, begin);
}

/// Nothing that could stand in a script begins here.
bool Lexer::is_unreadable() const {
  auto const rest = text_.substr(at_);
  if (identifier_character(rest) > 0 || blank_size(rest) > 0) return false;
  if (std::string_view("\n\r'\"").contains(rest.front())) return false;
  return !sign_at(rest);
}

void Lexer::read_typographic_string(Unreadable const& quote) {
  auto const begin = at_;
  at_ += quote.size;
  auto const opening = since(begin);
  auto const plain = std::string(quote.hint.substr(quote.hint.size() - 1));  // it ends with the quote to write
  base::Hint hint(std::string(quote.hint), {{opening, plain}});
  while (!at_end() && peek() != '\n' && peek() != '\r') {
    auto const place = at_;
    auto const c = unreadable_character(text_.substr(at_));
    at_ += c.size;
    if (c.looks_like != Unreadable::Like::quote) continue;
    hint.fix.push_back({since(place), plain});
    break;
  }
  diagnostics_.report(code("invalid-character"), opening, std::string(quote.message), std::move(hint));
  emit(string, begin);
}

// ---- tokens -------------------------------------------------------------------------------------

void Lexer::read_word() {
  auto const begin = at_;
  while (auto const size = identifier_character(text_.substr(at_))) at_ += size;
  auto const word = text_.substr(begin, at_ - begin);
  emit(kind_of_word(word), begin);
}

void Lexer::read_number() {
  auto const number = scan_number(text_.substr(at_));
  auto const begin = at_;
  at_ += number.size;
  if (number.junk > 0) {
    auto const end = static_cast<std::uint32_t>(at_);
    auto const junk = static_cast<std::uint32_t>(number.junk);
    auto const tail = text_.substr(at_ - number.junk, number.junk);
    auto const digits = text_.substr(begin, number.size - number.junk);
    diagnostics_.report(code("invalid-number"), {static_cast<std::uint32_t>(at_ - number.junk), end},
                        fmt::format("'{}' cannot follow a number", tail),
                        digits == "0" ? base::Hint()
                                      : base::Hint(fmt::format("a unit is written with a point: {}.{}", digits, tail),
                                                   {{{end - junk, end - junk}, "."}}));
  }
  emit(number.is_decimal ? decimal : integer, begin);
}

bool Lexer::read_foreign_operator() {
  auto const* found = foreign_sign_at(text_.substr(at_));
  if (!found) return false;
  auto const begin = at_;
  at_ += found->theirs.size();
  diagnostics_.report(code("foreign-operator"), since(begin), fmt::format("there is no operator {}", found->theirs),
                      std::string(found->hint));
  emit(found->kind, begin);
  return true;
}

/// `/a+b/` where a value may begin, closed in the same line. A slash that begins a line goes on dividing.
bool Lexer::read_pattern() {
  if (peek() != '/' || newline_before_ || out_.tokens.empty() || !asks_for_value(out_.tokens.back().kind)) return false;
  auto end = at_ + 1;
  while (end < text_.size() && text_[end] != '/' && text_[end] != '\n' && text_[end] != '\r') {
    end += text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] == '/' ? 2 : 1;
  }
  if (end >= text_.size() || text_[end] != '/') return false;
  auto const begin = std::exchange(at_, end + 1);
  emit(pattern, begin);
  return true;
}

void Lexer::read_operator() {
  if (looking_at("*/") && open_.empty()) return close_no_comment();
  if (read_pattern() || read_foreign_operator()) return;
  auto const sign = sign_at(text_.substr(at_));
  if (!sign) return skip_unreadable();
  auto const begin = at_;
  if (!open_.empty()) {
    auto& braces = open_.back().open_braces;
    if (sign->kind == right_brace && braces == 0) return close_interpolation(begin);
    if (sign->kind == left_brace) ++braces;
    if (sign->kind == right_brace) --braces;
  }
  at_ += sign->size;
  emit(sign->kind, begin);
}

bool Lexer::at_quotes(char quote, std::size_t size) const {
  return peek() == quote && (size == 1 || (peek(1) == quote && peek(2) == quote));
}

/// `$` that is followed by neither a name nor a brace is only a character.
bool Lexer::at_interpolation() const {
  return peek() == '$' && (peek(1) == '{' || identifier_start(text_.substr(at_ + 1)) > 0);
}

void Lexer::step_over_string_character() {
  if (peek() == '\\' && !at_end()) ++at_;
  if (!at_end() && !skip_line_end()) ++at_;
}

void Lexer::read_plain_string(std::size_t quote_size) {
  auto const begin = at_;
  auto const quote = peek();
  at_ += quote_size;
  while (!at_end() && !at_quotes(quote, quote_size)) {
    if (quote_size == 1 && (peek() == '\n' || peek() == '\r')) break;
    step_over_string_character();
  }
  if (at_quotes(quote, quote_size)) {
    at_ += quote_size;
  } else {
    diagnostics_.report(
        code("unclosed-string"),
        quote_size == 1 ? since(begin) : Span{static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(begin + 3)},
        "this string is never closed", fmt::format("close it with {}", std::string(quote_size, quote)));
  }
  emit(string, begin);
}

/// A string in double quotes is one token unless it has an interpolation.
void Lexer::read_double_quoted(std::size_t quote_size) {
  auto const begin = at_;
  at_ += quote_size;
  while (!at_end() && !at_quotes('"', quote_size) && !at_interpolation()) {
    if (quote_size == 1 && (peek() == '\n' || peek() == '\r')) break;
    step_over_string_character();
  }
  if (!at_interpolation()) {
    at_ = begin;
    return read_plain_string(quote_size);
  }
  at_ = begin + quote_size;
  emit(string_open, begin);
  open_.push_back({since(begin), quote_size, 0, {}});
  read_string_text();
}

/// From inside a string with interpolation to its end, or to the next ${.
void Lexer::read_string_text() {
  auto const quotes = open_.back();
  for (auto begin = at_;; begin = at_) {
    while (!at_end() && !at_quotes('"', quotes.quote_size) && !at_interpolation()) {
      if (quotes.quote_size == 1 && (peek() == '\n' || peek() == '\r')) break;
      step_over_string_character();
    }
    if (at_ > begin) emit(string_text, begin);
    if (!at_interpolation()) break;
    begin = at_++;
    if (peek() == '{') {
      ++at_;
      open_.back().interpolation = since(begin);
      return emit(interpolation_open, begin);
    }
    while (auto const size = identifier_character(text_.substr(at_))) at_ += size;
    while (peek() == '.' && identifier_start(text_.substr(at_ + 1)) > 0) {
      ++at_;
      while (auto const size = identifier_character(text_.substr(at_))) at_ += size;
    }
    emit(interpolation_name, begin);
  }
  auto const begin = at_;
  open_.pop_back();
  if (at_quotes('"', quotes.quote_size)) {
    at_ += quotes.quote_size;
  } else {
    diagnostics_.report(code("unclosed-string"), quotes.quotes, "this string is never closed",
                        fmt::format("close it with {}", std::string(quotes.quote_size, '"')));
  }
  emit(string_close, begin);
}

void Lexer::close_interpolation(std::size_t begin) {
  ++at_;
  emit(interpolation_close, begin);
  read_string_text();
}

/// An interpolation that ends with its line or with the text: closed with empty tokens so that the parser sees whole
/// strings.
void Lexer::abandon_open_strings() {
  while (!open_.empty()) {
    if (!at_end() && open_.back().quote_size == 3) return;
    diagnostics_.report(code("unclosed-interpolation"), open_.back().interpolation,
                        "this interpolation is never closed", "close it with }");
    open_.pop_back();
    emit(interpolation_close, at_);
    emit(string_close, at_);
  }
}

void Lexer::read_token() {
  auto const c = peek();
  if (identifier_start(text_.substr(at_)) > 0) return read_word();
  if (is_digit(c)) return read_number();
  if (c == '\'') return read_plain_string(looking_at("'''") ? 3 : 1);
  if (c == '"') return read_double_quoted(looking_at("\"\"\"") ? 3 : 1);
  read_operator();
}

/// As other editors save: every second byte of English text is 0, and each would be a mistake of its own.
void Lexer::refuse_utf16() {
  auto const begin = text_.substr(0, 64);
  auto const zeros = static_cast<std::size_t>(std::ranges::count(begin, '\0'));
  bool const is_marked = begin.starts_with("\xFF\xFE") || begin.starts_with("\xFE\xFF");
  if (!is_marked && (begin.size() < 8 || zeros * 3 < begin.size())) return;
  diagnostics_.report(code("wrong-encoding"), {0, 0}, "this file is saved as UTF-16", "save it as UTF-8");
  text_ = {};
}

TokenStream Lexer::run() {
  if (text_.size() > max_source_size) {
    diagnostics_.report(
        code("script-too-long"), {0, 0},
        fmt::format("the script is too long: {} bytes, at most {} are read", text_.size(), max_source_size));
    text_ = {};
  }
  refuse_utf16();
  out_.tokens.reserve(text_.size() / 4);
  skip_first_line();
  while (true) {
    if (!skip_blanks()) {
      abandon_open_strings();
      continue;
    }
    if (at_end()) break;
    if (out_.tokens.size() >= max_token_count) {
      diagnostics_.report(code("script-too-long"), since(at_),
                          fmt::format("the script is too long: more than {} words", max_token_count));
      at_ = text_.size();
      abandon_open_strings();
      break;
    }
    read_token();
  }
  emit(end_of_file, at_);
  match_brackets(out_.tokens, diagnostics_);
  return std::move(out_);
}

}  // namespace

TokenStream lex(base::Diagnostics& diagnostics) {
  return Lexer(diagnostics).run();
}

}  // namespace lapwing::dolphin
