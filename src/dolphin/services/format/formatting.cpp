#include "dolphin/services/format/formatting.hpp"

#include <algorithm>
#include <utility>

#include "dolphin/services/format/formatted_lines.hpp"
#include "dolphin/services/format/layout_pieces.hpp"
#include "dolphin/syntax/codes.hpp"
#include "dolphin/syntax/lexer.hpp"
#include "dolphin/syntax/parser.hpp"

namespace lapwing::dolphin {

namespace {

using enum TokenKind;

constexpr std::size_t step = 2;               ///< of a block, of what stands in brackets
constexpr std::size_t continuation_step = 4;  ///< of the further lines of a statement

bool opens(TokenKind kind) {
  return kind == left_paren || kind == left_bracket || kind == left_brace;
}
bool closes(TokenKind kind) {
  return kind == right_paren || kind == right_bracket || kind == right_brace;
}

/// LF ends, no blanks before them.
std::string with_tidy_line_ends(std::string_view text, bool strips_blanks) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\r' && text.substr(at + 1).starts_with('\n')) continue;
    bool const ends_line = text[at] == '\n' || text[at] == '\r';
    while (ends_line && strips_blanks && !out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
    out += ends_line ? '\n' : text[at];
  }
  while (strips_blanks && !out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
  return out;
}

/// A comment of several lines moves as a whole, as far as the margin lets it.
std::string moved(std::string_view comment, std::size_t from, std::size_t to) {
  auto rest = with_tidy_line_ends(comment, true);
  auto end = std::min(rest.find('\n'), rest.size());
  auto out = rest.substr(0, end);
  while (end < rest.size()) {
    auto const begin = end + 1;
    end = std::min(rest.find('\n', begin), rest.size());
    auto const line = std::string_view(rest).substr(begin, end - begin);
    auto const margin = std::min(line.find_first_not_of(" \t"), line.size());
    auto const old_indent = width_of_last_line(line.substr(0, margin));
    out += '\n';
    if (margin < line.size()) out.append(old_indent + to > from ? old_indent + to - from : 0, ' ');
    out += line.substr(margin);
  }
  return out;
}

/// Writes the pieces line by line.
class Layout {
 public:
  Layout(std::vector<Piece> const& pieces, StatementPlaces const& places, base::SourceFile const& source)
      : pieces_(pieces), places_(places), source_(source) {}

  std::vector<FormattedLine> run() {
    for (at_ = 0; at_ + 1 < pieces_.size(); ++at_) {  // the last one is end_of_file
      place(pieces_[at_]);
      if (!pieces_[at_].is_comment()) follow(pieces_[at_]);
    }
    return std::move(lines_);
  }

 private:
  /// A pair of brackets, or the script itself.
  struct Bracket {
    bool holds_statements = true;
    std::size_t outer_indent = 0;      ///< of the line with the opening bracket
    std::size_t indent = 0;            ///< of what is inside
    std::size_t statement_indent = 0;  ///< of the statement that is being written
    bool is_in_entry = false;          ///< behind `name:`, up to the comma
  };

  void place(Piece const& piece) {
    bool const begins_line = lines_.empty() || piece.line_ends > 0 || piece.is_continued;
    if (begins_line) {
      begin_line(piece);
    } else if (is_line_comment(piece)) {
      return add_comment(piece);
    } else {
      lines_.back().code.append(blanks_between(pieces_[at_ - 1], piece), ' ');
    }
    lines_.back().code += text_of(piece, begins_line);
  }

  void begin_line(Piece const& piece) {
    FormattedLine line{.indent = indent_of(piece)};
    if (!lines_.empty()) {
      if (piece.is_continued) lines_.back().code += " \\";
      auto const& before = pieces_[at_ - 1];
      bool const at_bracket =
          (opens(before.kind) && !before.is_comment()) || (closes(piece.kind) && !piece.is_comment());
      line.is_after_blank_line = piece.line_ends > 1 && !at_bracket;
    }
    lines_.push_back(std::move(line));
  }

  [[nodiscard]] bool is_line_comment(Piece const& piece) const {
    return piece.is_comment() && source_.text(piece.span).starts_with("//");
  }

  [[nodiscard]] std::size_t column_of(std::uint32_t offset) const {
    auto const line = source_.line_span(source_.line(offset));
    return width_of_last_line(source_.text({line.begin, offset}));
  }

  void add_comment(Piece const& piece) {
    auto& line = lines_.back();
    line.comment = with_tidy_line_ends(source_.text(piece.span), true);
    line.comment_column = column_of(piece.span.begin);
    line.comment_gap = line.comment_column - column_of(pieces_[at_ - 1].span.end);
  }

  [[nodiscard]] std::string text_of(Piece const& piece, bool begins_line) const {
    auto const text = source_.text(piece.span);
    if (!piece.is_comment()) return text.contains('\r') ? with_tidy_line_ends(text, false) : std::string(text);
    auto const from = column_of(piece.span.begin);
    return moved(text, from, begins_line ? lines_.back().indent : from);
  }

  // ---- indentation

  /// Comments stand where the next token would.
  [[nodiscard]] std::size_t indent_of(Piece const& piece) const {
    auto const& here = brackets_.back();
    auto next = at_;
    while (pieces_[next].is_comment()) ++next;
    auto const& token = pieces_[next];
    if (token.kind == end_of_file) return 0;
    if (closes(token.kind)) return piece.is_comment() ? here.indent : here.outer_indent;
    if (auto const found = places_.find(token.span.begin); found != places_.end()) {
      return here.indent + found->second * step;
    }
    bool const is_case = token.kind == kw_case || token.kind == kw_default;
    if (is_case && here.holds_statements) return here.indent;
    auto out = here.statement_indent + (here.holds_statements ? continuation_step : 0);
    if (is_entry_name(next)) return out;
    if (here.is_in_entry) out += step;
    bool const follows_head = here.is_in_entry || !here.holds_statements;
    return is_chain_word(token) && follows_head ? out + step : out;
  }

  [[nodiscard]] bool is_entry_name(std::size_t index) const {
    return index + 1 < pieces_.size() && pieces_[index + 1].role == Role::label;
  }
  [[nodiscard]] bool is_chain_word(Piece const& token) const {
    auto const text = source_.text(token.span);
    return token.kind == identifier && (text == "then" || text == "run" || text == "onError");
  }

  /// What the token means for the lines below it.
  void follow(Piece const& token) {
    if (closes(token.kind)) return brackets_.pop_back();
    auto& here = brackets_.back();
    if (auto const found = places_.find(token.span.begin); found != places_.end()) {
      here.is_in_entry = false;
      here.statement_indent = here.indent + found->second * step;
    }
    if (token.role == Role::label) here.is_in_entry = true;
    if (token.kind == comma) here.is_in_entry = false;
    if (!opens(token.kind)) return;
    auto const indent = lines_.back().indent;
    brackets_.push_back({token.kind == left_brace, indent, indent + step, indent + step});
  }

  std::vector<Piece> const& pieces_;
  StatementPlaces const& places_;
  base::SourceFile const& source_;
  std::size_t at_ = 0;
  std::vector<Bracket> brackets_{1};
  std::vector<FormattedLine> lines_;
};

/// The proof that nothing but the layout changed: the tokens of both texts, one by one. A blank before a parenthesis
/// tells a call from an argument.
bool have_same_tokens(TokenStream const& before, base::SourceFile const& source, std::string const& text) {
  base::SourceFile const formatted(source.name(), text);
  base::Diagnostics diagnostics(formatted);
  auto const after = lex(diagnostics);
  if (before.tokens.size() != after.tokens.size() || before.comments.size() != after.comments.size()) return false;
  for (std::size_t i = 0; i < before.tokens.size(); ++i) {
    auto const& a = before.tokens[i];
    auto const& b = after.tokens[i];
    if (a.kind != b.kind) return false;
    if (a.kind == end_of_file) break;
    bool const tells_calls = a.kind == left_paren && i > 0 && before.tokens[i - 1].kind == identifier;
    if (a.newline_before != b.newline_before || (tells_calls && a.blank_before != b.blank_before)) return false;
    if (with_tidy_line_ends(source.text(a.span), false) != formatted.text(b.span)) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> format(base::Diagnostics& diagnostics) {
  auto const& source = diagnostics.source();
  auto const program = parse(diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  base::Diagnostics again(source);
  auto const stream = lex(again);
  auto const places = statement_places(program, stream.tokens, source);
  auto text = join_lines(Layout(layout_pieces(stream, places, source), places, source).run());
  if (have_same_tokens(stream, source, text)) return text;
  diagnostics.report(code("internal"), {0, 0}, "this script cannot be formatted without changing what it means",
                     "this is a mistake of the formatter, please report it");
  return std::nullopt;
}

}  // namespace lapwing::dolphin
