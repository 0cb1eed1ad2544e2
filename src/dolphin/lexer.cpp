#include "dolphin/lexer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "dolphin/codes.hpp"
#include "dolphin/internal/brackets.hpp"
#include "dolphin/internal/characters.hpp"

namespace lapwing::dolphin {

namespace {

using base::Span;
using enum TokenKind;

constexpr auto words = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"as", kw_as},
    {"assert", kw_assert},
    {"break", kw_break},
    {"case", kw_case},
    {"catch", kw_catch},
    {"class", kw_class},
    {"continue", kw_continue},
    {"def", kw_def},
    {"default", kw_default},
    {"do", kw_do},
    {"else", kw_else},
    {"enum", kw_enum},
    {"false", kw_false},
    {"finally", kw_finally},
    {"for", kw_for},
    {"if", kw_if},
    {"import", kw_import},
    {"in", kw_in},
    {"instanceof", kw_instanceof},
    {"interface", kw_interface},
    {"new", kw_new},
    {"null", kw_null},
    {"package", kw_package},
    {"return", kw_return},
    {"switch", kw_switch},
    {"throw", kw_throw},
    {"true", kw_true},
    {"try", kw_try},
    {"while", kw_while},
});
static_assert(std::ranges::is_sorted(words, {}, &std::pair<std::string_view, TokenKind>::first));

/// Longest first where one begins another.
constexpr auto operators = std::to_array<std::pair<std::string_view, TokenKind>>({
    {"..<", range_exclusive},
    {"<=>", compare},
    {"**=", power_assign},
    {"<<=", shift_left_assign},
    {">>=", shift_right_assign},
    {"..", range},
    {"?.", safe_dot},
    {"?:", elvis},
    {"->", arrow},
    {"+=", plus_assign},
    {"-=", minus_assign},
    {"*=", times_assign},
    {"/=", divide_assign},
    {"%=", remainder_assign},
    {"&=", bit_and_assign},
    {"^=", bit_xor_assign},
    {"|=", bit_or_assign},
    {"**", power},
    {"++", plus_plus},
    {"--", minus_minus},
    {"<<", shift_left},
    {">>", shift_right},
    {"<=", less_equal},
    {">=", greater_equal},
    {"==", equal},
    {"!=", not_equal},
    {"&&", logical_and},
    {"||", logical_or},
    {"(", left_paren},
    {")", right_paren},
    {"[", left_bracket},
    {"]", right_bracket},
    {"{", left_brace},
    {"}", right_brace},
    {",", comma},
    {";", semicolon},
    {":", colon},
    {".", dot},
    {"?", question},
    {"=", assign},
    {"+", plus},
    {"-", minus},
    {"*", star},
    {"/", slash},
    {"%", percent},
    {"<", less},
    {">", greater},
    {"!", logical_not},
    {"&", bit_and},
    {"|", bit_or},
    {"^", bit_xor},
});

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
  void skip_unreadable();
  void read_typographic_string(Unreadable const& quote);

  void read_token();
  void read_word();
  void read_number();
  void read_operator();
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
  auto const comment = since(begin);
  if (end == std::string_view::npos) {
    diagnostics_.report(code("unclosed-comment"), {comment.begin, comment.begin + 2}, "this comment is never closed",
                        "close it with */");
  }
  if (text_.substr(comment.begin, comment.size()).find_first_of("\r\n") != std::string_view::npos)
    newline_before_ = true;
  out_.comments.push_back(comment);
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
  } while (!at_end() && unreadable_character(text_.substr(at_)).message == first.message);
  diagnostics_.report(code("invalid-character"), since(begin), std::string(first.message), std::string(first.hint));
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
  auto const found = std::ranges::lower_bound(words, word, {}, &std::pair<std::string_view, TokenKind>::first);
  emit(found != words.end() && found->first == word ? found->second : identifier, begin);
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

void Lexer::read_operator() {
  auto const rest = text_.substr(at_);
  auto const found = std::ranges::find_if(operators, [&](auto const& entry) { return rest.starts_with(entry.first); });
  if (found == operators.end()) return skip_unreadable();
  auto const begin = at_;
  if (!open_.empty()) {
    auto& braces = open_.back().open_braces;
    if (found->second == right_brace && braces == 0) return close_interpolation(begin);
    if (found->second == left_brace) ++braces;
    if (found->second == right_brace) --braces;
  }
  at_ += found->first.size();
  emit(found->second, begin);
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

TokenStream Lexer::run() {
  if (text_.size() > max_source_size) {
    diagnostics_.report(
        code("script-too-long"), {0, 0},
        fmt::format("the script is too long: {} bytes, at most {} are read", text_.size(), max_source_size));
    text_ = {};
  }
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
