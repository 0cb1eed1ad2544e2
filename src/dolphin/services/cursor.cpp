#include "dolphin/services/cursor.hpp"

#include <algorithm>

namespace lapwing::dolphin {

namespace {

using base::Span;
using enum TokenKind;

bool opens(TokenKind kind) {
  return kind == left_paren || kind == left_bracket || kind == left_brace || kind == interpolation_open;
}
bool closes(TokenKind kind) {
  return kind == right_paren || kind == right_bracket || kind == right_brace || kind == string_close ||
         kind == interpolation_close;
}
bool is_word(TokenKind kind) {
  return kind == identifier || is_reserved_word(kind);
}
/// A line that ends so goes on in the next.
bool asks_for_more(TokenKind kind) {
  return kind == comma || kind == colon || kind == dot ||
         (kind >= range && kind <= bit_xor && kind != plus_plus && kind != minus_minus);
}
bool begins_value(TokenKind kind) {
  return kind == assign || (kind >= plus_assign && kind <= bit_or_assign) || kind == kw_return || kind == colon ||
         kind == arrow;
}

/// The token before `index`, over whole brackets.
std::size_t previous(std::vector<Token> const& tokens, std::size_t index) {
  auto const partner = tokens[index].partner;
  auto const begin = closes(tokens[index].kind) && partner != Token::unclosed ? partner : index;
  return begin == 0 ? no_token : begin - 1;
}

bool in_open_string(std::string_view text) {
  return text.size() < 2 || text.back() != text.front();
}

/// `text` between the end of the token before and the offset tells whether a line ends there.
bool is_first_of_statement(Document const& document, Cursor const& cursor) {
  if (cursor.before == no_token) return true;
  auto const& before = document.stream().tokens[cursor.before];
  if (before.kind == left_brace || before.kind == semicolon || before.kind == arrow || before.kind == kw_else)
    return true;
  auto const gap = document.text({before.span.end, std::max(before.span.end, cursor.word.begin)});
  return gap.find_first_of("\r\n") != std::string_view::npos && !asks_for_more(before.kind);
}

void look_inside(Document const& document, std::size_t index, Cursor& cursor) {
  auto const& token = document.stream().tokens[index];
  auto const [begin, end] = token.span;
  cursor.before = index == 0 ? no_token : index - 1;
  bool const inside = begin < cursor.offset && (cursor.offset < end || (cursor.offset == end && is_word(token.kind)));
  if (is_word(token.kind) && inside) {
    cursor.word = token.span;
  } else if (token.kind == interpolation_name && begin < cursor.offset && cursor.offset <= end) {
    cursor.word = {begin + 1, end};
  } else if ((token.kind == integer || token.kind == decimal) && begin < cursor.offset && cursor.offset <= end) {
    cursor.in_number = true;
  } else if (token.kind == string && begin < cursor.offset && (inside || in_open_string(document.text(token.span)))) {
    cursor.in_text = true;
    cursor.word = {begin + 1, in_open_string(document.text(token.span)) ? end : end - 1};
  } else if (token.kind == string_text && begin <= cursor.offset && cursor.offset <= end) {
    cursor.in_text = true;
  } else if (end <= cursor.offset && token.kind != end_of_file) {
    cursor.before = index;
  }
}

}  // namespace

Cursor cursor_at(Document const& document, std::uint32_t offset) {
  Cursor out{.offset = offset, .word = {offset, offset}};
  auto const& stream = document.stream();
  auto const comment = std::ranges::lower_bound(stream.comments, offset, {}, &Span::end);
  if (comment != stream.comments.end() && comment->begin < offset) {
    bool const is_line = document.text(*comment).starts_with("//") || document.text(*comment).starts_with("#!");
    out.in_comment = offset < comment->end || is_line;
    if (out.in_comment) return out;
  }
  auto const ends_before = [&](Token const& token) { return token.span.end < offset; };
  auto const found = std::ranges::partition_point(stream.tokens, ends_before);
  auto const index = std::min(static_cast<std::size_t>(found - stream.tokens.begin()), stream.tokens.size() - 1);
  look_inside(document, index, out);
  out.begins_statement = !out.in_text && is_first_of_statement(document, out);
  return out;
}

std::vector<BlockWords const*> blocks_round(Document const& document, Cursor const& cursor) {
  auto const& tokens = document.stream().tokens;
  std::vector<BlockWords const*> out;
  for (auto i = cursor.before; i != no_token; i = previous(tokens, i)) {
    if (tokens[i].kind != left_brace || i == 0) continue;
    auto callee = i - 1;
    if (tokens[callee].kind == left_paren && callee > 0) --callee;
    if (tokens[callee].kind == right_paren) {
      auto const before = previous(tokens, callee);
      if (before == no_token) continue;
      callee = before;
    }
    if (tokens[callee].kind != identifier) continue;
    if (auto const* block = document.vocabulary().block(document.text(tokens[callee].span))) out.push_back(block);
  }
  return out;
}

std::optional<OpenCall> open_call(Document const& document, Cursor const& cursor) {
  auto const& tokens = document.stream().tokens;
  OpenCall out;
  auto candidate = no_token;  // the first word of what has been passed over
  for (auto i = cursor.before; i != no_token; i = previous(tokens, i)) {
    auto const kind = tokens[i].kind;
    if (opens(kind)) {
      bool const is_call = kind == left_paren && i > 0 && tokens[i - 1].kind == identifier;
      if (is_call) return OpenCall{i - 1, out.argument};
      break;
    }
    if (kind == semicolon || begins_value(kind)) break;
    if (kind == comma) ++out.argument;
    auto const partner = tokens[i].partner;
    candidate = closes(kind) && partner != Token::unclosed ? partner : i;
    auto const before = candidate == 0 ? no_token : candidate - 1;
    bool const is_head =
        tokens[candidate].newline_before && (before == no_token || !asks_for_more(tokens[before].kind));
    if (is_head) break;
  }
  if (candidate == no_token || tokens[candidate].kind != identifier) return std::nullopt;
  if (tokens[candidate].span.end >= cursor.word.begin && !cursor.in_text) return std::nullopt;
  out.callee = candidate;
  return out;
}

Callee callee_named(std::string_view name, std::vector<BlockWords const*> const& blocks, Vocabulary const& vocabulary) {
  for (auto const* block : blocks) {
    auto const found = std::ranges::find(block->words, name, &InstructionSpec::name);
    if (found != block->words.end()) return {&*found, block};
  }
  return {vocabulary.instructions().find(name), nullptr};
}

}  // namespace lapwing::dolphin
